//! Builds the site: `cargo run --release --locked --package meniscus-site` writes it to `target/site`, which any server of files shows.
//!
//! It is the book in `docs`, the pages of three networks to play with in `play`, and the pages of the library in `api`.

mod equations;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use mdbook_driver::MDBook;
use mdbook_driver::errors::{Error, Result};

/// Name of each page to play with, and the arguments of the program that write it.
const PLAYED: [(&str, &[&str]); 3] = [
    (
        "chip",
        &[
            "network",
            "geometries/chip.svg",
            "--layers",
            "grains",
            "--inlet",
            "left",
            "--outlet",
            "right",
            "--angle-deg",
            "40",
            "--tension",
            "0.0728",
        ],
    ),
    ("cycle", &["run", "cases/network/cycle.toml"]),
    ("in-time", &["run", "cases/network/dynamic.toml"]),
];

fn main() -> Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let site = target.join("site");
    let mut book = MDBook::load(root.join("docs"))?;
    book.config.build.build_dir = site.clone();
    book.with_preprocessor(equations::Equations);
    book.build()?;
    std::fs::create_dir_all(site.join("play"))?;
    for (name, arguments) in PLAYED {
        let out = tempfile::tempdir()?;
        let program = ["run", "--release", "--locked", "--quiet", "--", "--quiet"];
        cargo(
            &root,
            program.iter().chain(arguments).chain(&["--out"]).map(Into::into).chain([out.path().join("run").into()]),
        )?;
        std::fs::copy(out.path().join("run/network.html"), site.join(format!("play/{name}.html")))?;
    }
    cargo(&root, ["doc", "--release", "--locked", "--no-deps", "--quiet"].map(Into::into))?;
    copy(&target.join("doc"), &site.join("api"))?;
    println!("the site is in {}", site.display());
    Ok(())
}

fn cargo(root: &Path, arguments: impl IntoIterator<Item = std::ffi::OsString>) -> Result<()> {
    let mut command = Command::new(env!("CARGO"));
    let status = command.current_dir(root).args(arguments).stdout(Stdio::null()).status()?;
    if status.success() { Ok(()) } else { Err(Error::msg(format!("{command:?}: {status}"))) }
}

/// Copies a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let (from, to) = (entry.as_ref().unwrap().path(), to.join(entry?.file_name()));
        if from.is_dir() { copy(&from, &to)? } else { std::fs::copy(from, to).map(drop)? }
    }
    Ok(())
}
