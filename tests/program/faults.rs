//! Runs that are killed, whose disk is full or whose files are damaged, and devices that take no results: nothing is lost in silence.
//!
//! `MENISCUS_KILLS=100 cargo test --release --test program faults` kills as many runs.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::support::program::{
    assert_code, assert_same_files, command, files, folder_with_small_case, meniscus, stderr,
};
use meniscus::run::setup;
use meniscus_case::load;
use meniscus_core::input::Overrides;

/// A drop with many records of every kind, some tenths of a second long.
const RUN: [&str; 8] = [
    "run",
    "drop.toml",
    "--set=time.end=4e-4",
    "--set=output.series.every-time=1e-5",
    "--set=output.vtk.every-time=2e-5",
    "--set=output.restart.every-time=3e-5",
    "--threads=1",
    "--out",
];

fn run(folder: &Path, out: &str, more: &[&str]) -> Output {
    meniscus(folder, &[&RUN[..], &[out], more].concat())
}

fn start(folder: &Path, out: &str, more: &[&str]) -> Child {
    let arguments = [&RUN[..], &[out], more].concat();
    command(folder, &arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until a run has written a file.
fn wait_for(path: &Path, child: &mut Child) {
    while !path.exists() {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before it wrote {}", path.display());
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A folder with a run that was killed in the middle, `broken`, and one that was not, `unbroken`.
fn folder_with_killed_run() -> tempfile::TempDir {
    let folder = folder_with_small_case();
    assert_code(&run(folder.path(), "unbroken", &[]), 0);
    let mut child = start(folder.path(), "broken", &[]);
    wait_for(&folder.path().join("broken/particles/particles-000012.vtu"), &mut child);
    child.kill().unwrap();
    child.wait().unwrap();
    folder
}

fn copy(from: &Path, to: &Path) {
    for (name, bytes) in files(from) {
        std::fs::create_dir_all(to.join(&name).parent().unwrap()).unwrap();
        std::fs::write(to.join(&name), bytes).unwrap();
    }
}

/// Goes on with a run, or begins it anew where it was killed before it saved a state.
fn go_on(folder: &Path, out: &str) -> Child {
    let path = folder.join(out);
    if path.join("restart/state.bin").exists() {
        return start(folder, out, &["--resume"]);
    }
    // A run may be killed before there is a folder.
    let _ = std::fs::remove_dir_all(path);
    start(folder, out, &[])
}

#[test]
fn a_run_that_is_killed_at_any_moment_and_resumed_leaves_the_same_bytes() {
    let kills: u32 = std::env::var("MENISCUS_KILLS").ok().and_then(|count| count.parse().ok()).unwrap_or(10);
    let folder = folder_with_small_case();
    let clock = Instant::now();
    assert_code(&run(folder.path(), "unbroken", &[]), 0);
    let length = clock.elapsed();
    let mut killed = 0;
    for number in 0..kills {
        let out = format!("killed-{number}");
        // The golden ratio spreads moments evenly, however many there are; the second kill is early after the first.
        let moment = (f64::from(number) * 0.618_033_988_75 + 0.3).fract();
        for share in [moment, 0.25 * moment] {
            let mut child = go_on(folder.path(), &out);
            std::thread::sleep(length.mul_f64(share));
            killed += u32::from(child.try_wait().unwrap().is_none());
            child.kill().unwrap();
            child.wait().unwrap();
        }
        let output = go_on(folder.path(), &out).wait_with_output().unwrap();
        assert_code(&output, 0);
        assert_same_files(&folder.path().join(&out), &folder.path().join("unbroken"));
        std::fs::remove_dir_all(folder.path().join(&out)).unwrap();
    }
    assert!(killed >= kills, "only {killed} runs were still going on when they were killed");
}

#[test]
fn a_damaged_or_missing_file_is_refused_by_its_name_or_changes_nothing() {
    let folder = folder_with_killed_run();
    let (broken, unbroken) = (folder.path().join("broken"), folder.path().join("unbroken"));
    let names: Vec<PathBuf> = files(&broken).into_keys().collect();
    // One of the frames of each kind is enough, and all other files.
    let names = names.into_iter().filter(|name| {
        let name = name.display().to_string();
        !name.contains("-0000") || name.contains("-000003.")
    });
    let (mut refused, mut harmless) = (0, 0);
    for (number, name) in names.enumerate() {
        for damage in ["flipped", "cut", "missing"] {
            let out = format!("{damage}-{number}");
            let folder_of_run = folder.path().join(&out);
            copy(&broken, &folder_of_run);
            let (file, mut bytes) = (folder_of_run.join(&name), std::fs::read(broken.join(&name)).unwrap());
            match damage {
                "missing" => std::fs::remove_file(&file).unwrap(),
                "cut" => std::fs::write(&file, &bytes[..bytes.len() / 3]).unwrap(),
                _ => {
                    let place = bytes.len() / 3;
                    bytes.get_mut(place).into_iter().for_each(|byte| *byte ^= 4);
                    std::fs::write(&file, bytes).unwrap();
                }
            }
            let output = run(folder.path(), &out, &["--resume"]);
            let (message, what) = (stderr(&output), format!("{} {damage}", name.display()));
            if output.status.code() == Some(0) {
                let same = files(&folder_of_run) == files(&unbroken);
                assert!(same, "{what}: the run was resumed to another result");
                harmless += 1;
            } else {
                assert_code(&output, 2);
                assert!(message.contains(&name.display().to_string()), "{what} is not named: {message}");
                assert!(message.contains("--out") || message.contains("without --resume"), "{what}: {message}");
                refused += 1;
            }
            std::fs::remove_dir_all(folder_of_run).unwrap();
        }
    }
    // State, series, list and the frames of three kinds cannot be made again; what names or describes them can.
    assert!(refused >= 15 && harmless >= 9, "{refused} refused, {harmless} harmless");
}

#[test]
fn a_file_that_does_not_fit_ends_the_run_with_its_name_and_the_run_can_be_taken_up() {
    let folder = folder_with_small_case();
    assert_code(&run(folder.path(), "unbroken", &[]), 0);
    let mut told = std::collections::BTreeSet::new();
    for kilobytes in [1, 2, 4, 8, 12, 16, 24, 32, 48] {
        let out = format!("full-{kilobytes}");
        let script = format!("trap '' XFSZ; ulimit -f {kilobytes}; exec \"$@\"");
        let output = Command::new("bash")
            .args(["-c", &script, "-", env!("CARGO_BIN_EXE_meniscus")])
            .args([&RUN[..], &[&out]].concat())
            .current_dir(folder.path())
            .output()
            .unwrap();
        let message = stderr(&output);
        assert!(!message.contains("bug in meniscus"), "{message}");
        if output.status.code() != Some(0) {
            assert_code(&output, 2);
            let file = message.split("cannot write ").nth(1).and_then(|rest| rest.split(": ").next());
            let file = file.unwrap_or_else(|| panic!("no file is named: {message}"));
            assert!(message.contains("is larger than the system allows; free some space"), "{message}");
            told.insert(file.rsplit('/').next().unwrap().to_owned());
        }
        let output = go_on(folder.path(), &out).wait_with_output().unwrap();
        assert_code(&output, 0);
        assert_same_files(&folder.path().join(&out), &folder.path().join("unbroken"));
    }
    assert!(told.len() >= 3, "too few kinds of files were tried: {told:?}");
}

#[test]
fn a_folder_in_which_a_run_is_going_on_is_refused_until_that_run_is_killed() {
    let folder = folder_with_small_case();
    let mut child = start(folder.path(), "out", &["--set=time.end=1.0"]);
    wait_for(&folder.path().join("out/restart/state.bin"), &mut child);
    for more in [&[][..], &["--resume"]] {
        let output = run(folder.path(), "out", &[&["--set=time.end=1.0"], more].concat());
        assert_code(&output, 2);
        let process = format!("(process {} on ", child.id());
        for words in ["a run is in progress in", &process, "--out DIR"] {
            assert!(stderr(&output).contains(words), "`{words}` is missing: {}", stderr(&output));
        }
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let output = run(folder.path(), "out", &["--resume"]);
    assert!(stderr(&output).contains("another case"), "{}", stderr(&output));
}

#[test]
fn sigterm_and_sighup_save_the_state_as_an_interrupt_does() {
    let folder = folder_with_small_case();
    assert_code(&run(folder.path(), "unbroken", &[]), 0);
    for signal in ["TERM", "HUP"] {
        let mut child = start(folder.path(), signal, &[]);
        wait_for(&folder.path().join(signal).join("particles/particles-000005.vtu"), &mut child);
        assert!(Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_code(&output, 130);
        assert!(stderr(&output).contains(&format!("interrupted by SIG{signal}: finishing")), "{}", stderr(&output));
        assert_eq!(crate::support::program::report(&folder.path().join(signal))["status"], "interrupted");
        assert_code(&run(folder.path(), signal, &["--resume"]), 0);
        assert_same_files(&folder.path().join(signal), &folder.path().join("unbroken"));
    }
    // With nohup a closed terminal does not matter.
    let script = "trap '' HUP; exec \"$@\"";
    let mut child = Command::new("bash")
        .args(["-c", script, "-", env!("CARGO_BIN_EXE_meniscus")])
        .args([&RUN[..], &["nohup"]].concat())
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for(&folder.path().join("nohup/particles/particles-000005.vtu"), &mut child);
    assert!(Command::new("kill").args(["-s", "HUP", &child.id().to_string()]).status().unwrap().success());
    assert_code(&child.wait_with_output().unwrap(), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_printed_are_an_error_and_a_closed_pipe_is_none() {
    let folder = folder_with_small_case();
    for arguments in [
        &["list"][..],
        &["schema"],
        &["--help"],
        &["--version"],
        &["completions", "bash"],
        &["check", "drop.toml"],
        &["run", "drop.toml", "--set=time.end=1e-5"],
    ] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(folder.path(), arguments).stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_code(&output, 2);
        assert!(
            stderr(&output).contains("cannot print the results: No space left"),
            "{arguments:?}: {}",
            stderr(&output)
        );
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = command(folder.path(), arguments).stdout(writer).stderr(Stdio::piped()).output().unwrap();
        assert_code(&output, 0);
        assert!(!stderr(&output).contains("error"), "{arguments:?}: {}", stderr(&output));
    }
    // Not even the message can be printed: the exit code still tells.
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let status = command(folder.path(), &["list"]).stdout(full()).stderr(full()).status().unwrap();
    assert_eq!(status.code(), Some(2));
}

/// Cases whose particles are packed to walls and to an interface, one of them with a given flow.
#[test]
fn a_solver_that_takes_up_a_state_packs_nothing_and_goes_on_with_the_same_bits() {
    let none = meniscus_core::solver::Series::default();
    for (name, spacing) in [("drop-on-disc", 3.0), ("four-discs", 1.5), ("detachment", 2.0)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
        let given = load(&path, &Overrides::default()).unwrap().case;
        let meniscus_case::Model::Sph(sph) = &given.model else { panic!("{name}") };
        let coarse = format!("sph.spacing={:e}", spacing * sph.spacing);
        let case = load(&path, &Overrides::parse(&[coarse]).unwrap()).unwrap().case;
        let mut told = 0;
        let mut unbroken = setup::build_watched(&case, &mut |_| told += 1).unwrap();
        let mut resumed = setup::build_to_resume(&case).unwrap();
        assert!(told > 0 && unbroken.state() != resumed.state(), "{name}: nothing was packed");
        for _ in 0..2 {
            unbroken.step(case.end).unwrap();
        }
        resumed.restore(&unbroken.state()).unwrap();
        for solver in [&mut unbroken, &mut resumed] {
            solver.step(case.end).unwrap();
        }
        assert!(unbroken.state() == resumed.state(), "{name}: the states differ");
        // Drifts are counted from time zero, which the resumed solver has not seen.
        let values = |solver: &dyn meniscus_core::solver::Solver| {
            solver
                .measures(&none)
                .iter()
                .map(|measure| (measure.name.clone(), measure.value.to_bits()))
                .collect::<Vec<_>>()
        };
        assert_eq!(values(unbroken.as_ref()), values(resumed.as_ref()), "{name}");
    }
}
