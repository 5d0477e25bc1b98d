//! A browser for tests of pages.

use std::path::PathBuf;
use std::process::Command;

/// Names of Chromium and its kin, those without a window first.
const NAMES: [&str; 5] =
    ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// The package of Debian and Ubuntu that CI installs where there is no browser.
const PACKAGE: &str = "chromium-headless-shell";

fn found() -> Option<PathBuf> {
    let folders: Vec<PathBuf> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let given = std::env::var_os("MENISCUS_BROWSER").map(PathBuf::from);
    let in_folders = |name| folders.iter().map(move |folder| folder.join(name)).find(|path| path.is_file());
    given.or_else(|| NAMES.into_iter().find_map(in_folders))
}

fn install() {
    for arguments in [&["update", "-qq"][..], &["install", "-y", "-qq", "--no-install-recommends", PACKAGE]] {
        // What fails is seen when the browser is looked for again.
        let _ = Command::new("apt-get").args(arguments).env("DEBIAN_FRONTEND", "noninteractive").output();
    }
}

/// A Chromium: that of `MENISCUS_BROWSER`, or one on the path; CI installs it.
///
/// Fails the test with what to install where there is none.
pub fn browser() -> PathBuf {
    if found().is_none() && std::env::var_os("CI").is_some() {
        install();
    }
    found().unwrap_or_else(|| {
        panic!(
            "a Chromium is needed: install it (Debian, Ubuntu: apt install chromium), or name it in MENISCUS_BROWSER"
        )
    })
}
