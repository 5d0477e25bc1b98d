//! The program from outside: arguments, texts and exit codes.

use std::path::Path;
use std::process::{Command, Output};

fn meniscus(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_meniscus")).args(arguments).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_help_names_every_command_and_the_exit_codes() {
    let folder = tempfile::tempdir().unwrap();
    let output = meniscus(&["--help"], folder.path());
    assert_eq!(output.status.code(), Some(0));
    let help = text(&output.stdout);
    for word in ["run", "check", "geometry", "study", "new", "list", "schema", "completions", "130 interrupted"] {
        assert!(help.contains(word), "{word} is missing in {help}");
    }
}

#[test]
fn a_wrong_argument_is_a_usage_error() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [&["fly"][..], &["run", "--threads", "0"], &["run", "--threads", "many"], &["check"]] {
        let output = meniscus(arguments, folder.path());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", text(&output.stderr));
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_network_of_no_file_is_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let output = meniscus(&["network", "shapes.toml", "--out", "x"], folder.path());
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("shapes.toml"));
    assert!(!folder.path().join("x").exists(), "nothing is written before the shapes are known to be good");
}

#[test]
fn a_missing_case_file_is_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let output = meniscus(&["run", "no-such-case.toml"], folder.path());
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert!(!folder.path().join("out").exists(), "nothing is written before the case is known to be good");
}

#[test]
fn the_starter_case_never_overwrites_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    std::fs::write(&file, "precious").unwrap();
    assert_eq!(meniscus(&["new", "mine.toml"], folder.path()).status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "precious");
}

#[test]
fn the_starter_case_meets_its_expectation() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(meniscus(&["new", "mine.toml"], folder.path()).status.code(), Some(0));
    // Twice the spacing, for time.
    let output = meniscus(&["run", "mine.toml", "--set", "sph.spacing=5.0e-5", "--out", "out"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    assert!(text(&meniscus(&["man"], folder.path()).stdout).contains(".TH meniscus 1"));
    assert_eq!(meniscus(&["man", "--out", "man"], folder.path()).status.code(), Some(0));
    for name in ["meniscus", "meniscus-run", "meniscus-network", "meniscus-network-verify", "meniscus-study-plan"] {
        let page = std::fs::read_to_string(folder.path().join(format!("man/{name}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
    }
}

#[test]
fn a_quiet_command_tells_errors_only() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(meniscus(&["new", "mine.toml", "--quiet"], folder.path()).status.code(), Some(0));
    let short =
        ["run", "mine.toml", "--quiet", "--set", "sph.spacing=1e-4", "--set", "time.end=1e-5", "--set", "expect=[]"];
    let run = meniscus(&short, folder.path());
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stderr.is_empty() && !run.stdout.is_empty(), "{}", text(&run.stderr));
    let refused = meniscus(&["-q", "check", "no-such-case.toml"], folder.path());
    assert!(refused.status.code() == Some(3) && text(&refused.stderr).contains("no-such-case.toml"));
}

#[test]
fn the_list_names_the_paper_and_completions_are_a_script() {
    let folder = tempfile::tempdir().unwrap();
    assert!(text(&meniscus(&["list"], folder.path()).stdout).contains("Huber et al. 2013"));
    assert!(text(&meniscus(&["completions", "bash"], folder.path()).stdout).contains("_meniscus"));
}
