//! Runs of the program on small cases: files, threads, interrupts, failures and messages.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::program::{
    all_at_once, assert_code, assert_same_files, command, folder_with_small_case, meniscus, meniscus_coarsely, report,
    shipped, stderr, stdout,
};
use crate::support::python::{interpreter, root, run};

/// The part of each case that is run: some steps.
const PART: f64 = 3000.0;

/// Records of the series in a part beside the first: two of each of three flows that follow one another.
const RECORDS: f64 = 6.0;

/// Frames and saved states in a part beside the first: few, as steps end at them.
const FRAMES: f64 = 2.0;

/// What of a case is run, as options: a part of its time, with few records.
fn part(case: &toml::Table) -> Vec<String> {
    let end = case.get("time").and_then(|time| time.get("end")?.as_float());
    let Some(end) = end.map(|end| end / PART) else {
        return vec![format!("--set=output.vtk.every-pore-volume={:e}", 1.0 / FRAMES)];
    };
    let every = |table: &str, records: f64| format!("--set=output.{table}.every-time={:e}", end / records);
    vec![format!("--set=time.end={end:e}"), every("series", RECORDS), every("vtk", FRAMES), every("restart", FRAMES)]
}

#[test]
fn every_case_runs_and_its_files_keep_the_output_contract_and_are_the_same_to_all_readers() {
    let folder = tempfile::tempdir().unwrap();
    let cases: Vec<PathBuf> =
        ["cases", "cases/network", "cases/thin-film"].into_iter().flat_map(|part| shipped(part, &["toml"])).collect();
    let direct = root().join("cases");
    let out = |case: &PathBuf| {
        let name = case.strip_prefix(&direct).unwrap().with_extension("");
        folder.path().join(name.display().to_string().replace(['/', '\\'], "-"))
    };
    all_at_once(&cases, |case| {
        let options = part(&std::fs::read_to_string(case).unwrap().parse().unwrap());
        let (name, out) = (case.display(), out(case));
        let options: Vec<&str> = options.iter().map(String::as_str).chain(["--out", out.to_str().unwrap()]).collect();
        let (output, factor) = meniscus_coarsely(folder.path(), "run", case, &options);
        // A case that is stopped this early may miss what it expects of its end, but nothing else.
        let code = output.status.code();
        assert!(code == Some(0) || code == Some(5), "{name}: {code:?}\n{}", stderr(&output));
        if case.parent() == Some(&direct) {
            let particles = report(&out)["solver"]["unknowns"].as_f64().unwrap();
            assert!((100.0..100_000.0).contains(&(factor * factor * particles)), "{name}: {particles}");
        }
    });
    let folders: Vec<PathBuf> = cases.iter().map(out).collect();
    assert_eq!(folders.iter().collect::<BTreeSet<_>>().len(), cases.len(), "two cases have one folder");
    let readers = [
        ("check_output.py", None, "the output of every case must keep the contract"),
        ("tests/same_arrays.py", Some("--apart"), "pyvista, VTK and meshio must read the same arrays of every case"),
    ];
    all_at_once(&readers, |(script, option, what)| {
        let mut read = Command::new(interpreter());
        read.arg(root().join("postprocess").join(script)).args(*option).args(&folders);
        let told = run(&mut read, what);
        assert_eq!(told.lines().count(), folders.len(), "{told}");
    });
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = folder_with_small_case();
    // Some thousand particles, so that there is more than one task per loop.
    let common = ["run", "drop.toml", "--set=sph.spacing=1.2e-5", "--set=time.end=2e-5", "--out"];
    for threads in ["1", "2", "3"] {
        let arguments = [&common[..], &[threads, "--threads", threads]].concat();
        assert_code(&meniscus(folder.path(), &arguments), 0);
    }
    assert_same_files(&folder.path().join("2"), &folder.path().join("1"));
    assert_same_files(&folder.path().join("3"), &folder.path().join("1"));
}

#[cfg(unix)]
#[test]
fn an_interrupted_and_resumed_run_leaves_the_same_bytes_as_an_unbroken_one() {
    let folder = folder_with_small_case();
    let run = ["run", "drop.toml", "--set=sph.spacing=2e-5", "--set=time.end=1e-3", "--out"];
    let unbroken = [&run[..], &["unbroken"]].concat();
    assert_code(&meniscus(folder.path(), &unbroken), 0);
    let mut child = command(folder.path(), &[&run[..], &["broken"]].concat())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The third of six frames after the first one.
    let written =
        ["restart/state.bin", "particles/particles-000003.vtu"].map(|name| folder.path().join("broken").join(name));
    while !written.iter().all(|file| file.exists()) {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before it was interrupted");
        std::thread::sleep(Duration::from_millis(1));
    }
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupt.success() && child.try_wait().unwrap().is_none(), "the run ended before it was interrupted");
    let output = child.wait_with_output().unwrap();
    assert_code(&output, 130);
    assert!(stderr(&output).contains("interrupted: finishing the step and saving the state"), "{}", stderr(&output));
    assert!(stdout(&output).contains("continue with --resume"), "{}", stdout(&output));
    let broken = folder.path().join("broken");
    let report_of_broken = report(&broken);
    assert_eq!(report_of_broken["status"], "interrupted");
    let time = report_of_broken["time-s"].as_f64().unwrap();
    assert!(time > 0.0 && time < 1.0e-3, "{time}");

    assert_code(&meniscus(folder.path(), &[&run[..], &["broken", "--resume"]].concat()), 0);
    assert_same_files(&broken, &folder.path().join("unbroken"));
    assert_eq!(report(&broken)["measures"], report(&folder.path().join("unbroken"))["measures"]);

    // Once more: there is nothing left to do, and nothing is changed.
    let output = meniscus(folder.path(), &[&run[..], &["broken", "--resume"]].concat());
    assert_code(&output, 0);
    assert!(stderr(&output).contains("already at its end"), "{}", stderr(&output));
    assert_same_files(&broken, &folder.path().join("unbroken"));
}

#[test]
fn a_run_that_is_steady_ends_and_says_so_and_one_that_is_not_says_what_changes() {
    let folder = folder_with_small_case();
    // A row every 0.1 ms and hundred times the time of the case, which a drop at rest does not need.
    let until_steady = ["run", "drop.toml", "--set=time.steady={}", "--set=time.end=3e-2", "--out"];
    let output = meniscus(folder.path(), &[&until_steady[..], &["rest"]].concat());
    assert_code(&output, 0);
    let rest = report(&folder.path().join("rest"));
    let time = rest["measures"]["steady-at-s"]["value"].as_f64().unwrap();
    assert!(time < 2.0e-2 && rest["time-s"].as_f64() == Some(time), "{time}");
    assert!(stdout(&output).contains("steady at t = "), "{}", stdout(&output));
    // What was left to change by then is within the tolerance: 0.3 degrees.
    let to_the_end = ["--set=time.steady.stop=false", "--set=time.end=3e-2"];
    let output = meniscus(folder.path(), &[&["run", "drop.toml", "--out", "end"], &to_the_end[..]].concat());
    assert_code(&output, 0);
    let end = report(&folder.path().join("end"));
    assert_eq!(end["measures"]["steady-at-s"], rest["measures"]["steady-at-s"]);
    assert!(stdout(&output).contains(", steady since "), "{}", stdout(&output));
    let angle = |report: &serde_json::Value| report["measures"]["contact-angle-deg"]["value"].as_f64().unwrap();
    assert!((angle(&rest) - angle(&end)).abs() < 0.3, "{} {}", angle(&rest), angle(&end));

    let early = ["--set=time.steady={}", "--set=output.series.every-time=1e-5", "--out", "early"];
    let output = meniscus(folder.path(), &[&["run", "drop.toml"], &early[..]].concat());
    assert_code(&output, 0);
    assert!(stdout(&output).contains("not steady: "), "{}", stdout(&output));
    assert!(stdout(&output).contains("kinetic_energy_J_per_m, "), "{}", stdout(&output));
}

#[test]
fn a_run_that_blows_up_says_when_and_where_and_keeps_its_last_good_state() {
    let folder = folder_with_small_case();
    // Blown along the floor in a light gas, some particles get past it; whether they do depends on the last digits of every step.
    let arguments = [
        "run",
        "drop.toml",
        "--out",
        "out",
        "--set=sph.initial.velocity.uniform=[60.0, -11.0]",
        "--set=sph.surface-force.csf={}",
        "--set=sph.phases.non-wetting.density=1.0",
    ];
    let output = meniscus(folder.path(), &arguments);
    assert_code(&output, 4);
    let message = stderr(&output);
    assert!(message.contains("error: ") && message.contains(" at time ") && message.contains("(step "), "{message}");
    assert!(message.contains("at (") && message.contains(") m"), "{message}");
    assert!(stdout(&output).contains("the last good state is in the output folder"), "{}", stdout(&output));
    let out = folder.path().join("out");
    let report = report(&out);
    assert_eq!(report["status"], "failed");
    let error = report["error"].as_str().unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(message.contains(&error), "{error}");
    assert!(out.join("restart/state.bin").is_file() && out.join("picture.png").is_file());
    let last = std::fs::read_to_string(out.join("particles.pvd")).unwrap();
    let time = report["time-s"].as_f64().unwrap();
    assert!(time > 0.0, "it must fail on its way, not at its start");
    // The reader of JSON rounds the last digit as it likes.
    let of_last = last.split("timestep=\"").filter_map(|rest| rest.split('"').next()?.parse::<f64>().ok()).last();
    assert!(
        of_last.is_some_and(|t| (t / time - 1.0).abs() < 1e-12),
        "no particles of the last good time {time:?} in\n{last}"
    );
    let mut check = Command::new(interpreter());
    check.arg(root().join("postprocess/check_output.py")).arg(&out);
    run(&mut check, "the output of a failed run must keep the contract");
}

#[test]
fn a_missed_expectation_has_an_exit_code_of_its_own() {
    let folder = folder_with_small_case();
    let case = folder.path().join("drop.toml");
    let text = std::fs::read_to_string(&case).unwrap()
        + "\n[[expect]]\nmeasure = \"saturation\"\nvalue = 0.9\ntolerance = 0.01\n";
    std::fs::write(&case, text).unwrap();
    let output = meniscus(folder.path(), &["run", "drop.toml", "--set=time.end=1e-5"]);
    assert_code(&output, 5);
    assert!(
        stdout(&output).contains("MISSED  saturation: expected 0.9000 +- 0.01000, measured 0.2"),
        "{}",
        stdout(&output)
    );
    assert_eq!(report(&folder.path().join("out/drop"))["status"], "expectation-failed");
}

#[test]
fn a_folder_that_was_named_and_is_in_use_is_refused_with_ways_out() {
    let folder = folder_with_small_case();
    let arguments = ["run", "drop.toml", "--set=time.end=1e-5", "--out", "mine"];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let before = crate::support::program::files(&folder.path().join("mine"));
    let output = meniscus(folder.path(), &arguments);
    assert_code(&output, 2);
    for way in ["is not empty", "--out", "--resume", "delete"] {
        assert!(stderr(&output).contains(way), "`{way}` is missing: {}", stderr(&output));
    }
    assert!(crate::support::program::files(&folder.path().join("mine")) == before);
}

#[test]
fn a_drawing_in_place_of_a_case_is_refused_with_the_commands_that_read_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("chip.svg"), "<svg xmlns='http://www.w3.org/2000/svg'/>").unwrap();
    for command in ["run", "check"] {
        let output = meniscus(folder.path(), &[command, "chip.svg"]);
        assert_code(&output, 3);
        let lines = stderr(&output);
        assert!(
            lines.contains("this is a drawing")
                && lines.contains("meniscus network")
                && lines.matches("Error:").count() == 1,
            "{lines}"
        );
    }
}

#[test]
fn without_a_named_folder_each_run_has_a_new_one_and_resume_takes_the_last() {
    let folder = folder_with_small_case();
    let arguments = ["run", "drop.toml", "--set=time.end=1e-5"];
    for name in ["out/drop", "out/drop-2", "out/drop-3"] {
        let output = meniscus(folder.path(), &arguments);
        assert_code(&output, 0);
        assert!(stdout(&output).contains(&format!("{name}/particles.pvd")), "{}", stdout(&output));
        assert!(folder.path().join(name).join("report.json").is_file());
    }
    let output = meniscus(folder.path(), &[&arguments[..], &["--resume"]].concat());
    assert_code(&output, 0);
    assert!(stderr(&output).contains("out/drop-3"), "{}", stderr(&output));
    assert!(stdout(&meniscus(folder.path(), &["run", "--help"])).contains("NAME-2"));
}

#[test]
fn resuming_another_case_or_nothing_is_refused() {
    let folder = folder_with_small_case();
    let output = meniscus(folder.path(), &["run", "drop.toml", "--resume"]);
    assert_code(&output, 2);
    assert!(stderr(&output).contains("no run to resume"), "{}", stderr(&output));
    assert_code(&meniscus(folder.path(), &["run", "drop.toml", "--out", "a", "--set=time.end=1e-5"]), 0);
    let later = ["run", "drop.toml", "--out", "a", "--set=time.end=2e-5", "--resume"];
    let output = meniscus(folder.path(), &[&later[..], &["--set=sph.gravity=[0.0, -1.0]"]].concat());
    assert_code(&output, 2);
    assert!(stderr(&output).contains("another case"), "{}", stderr(&output));
    // The same case goes on to a later end.
    assert_code(&meniscus(folder.path(), &later), 0);
    assert_eq!(report(&folder.path().join("a"))["time-s"], 2e-5);
}

#[test]
fn wrong_files_and_keys_are_told_with_their_place_and_a_way_out() {
    let folder = folder_with_small_case();
    let wrong_key = ["check", "drop.toml", "--set", "sph.interface.tenson=0.02"];
    std::fs::write(folder.path().join("broken.toml"), "format = 1\n[sph\n").unwrap();
    std::fs::write(folder.path().join("picture.png"), [0x89, 0x50, 0x4e, 0x47, 0xff, 0x00]).unwrap();
    for (arguments, words) in [
        (&wrong_key[..], &["unknown key `tenson`", "did you mean `tension`?"][..]),
        (&["run", "drop.tml"], &["there is no file", "drop.tml"]),
        (&["run", "broken.toml"], &["broken.toml:2"]),
        (&["run", "picture.png"], &["picture.png"]),
        (&["geometry", "broken.toml"], &["broken.toml:2"]),
        (&["network", "picture.png"], &["picture.png"]),
    ] {
        let output = meniscus(folder.path(), arguments);
        assert_code(&output, 3);
        for word in words {
            assert!(stderr(&output).contains(word), "`{word}` is missing: {}", stderr(&output));
        }
        assert!(!folder.path().join("out").exists());
    }
}
