//! Studies from outside: many small runs, killed, interrupted, failed and changed on their way, and what is told of them.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::support::program::{assert_code, assert_same_files, command, meniscus, report, stderr, stdout};

/// A small drop, 24 times: eight angles and three tensions.
const STUDY: &str = r#"
format = 1
title = "Small drops"
case = "drop.toml"
set = ["time.end=7.5e-4", "output.series.every-time=7.5e-5", "output.vtk.every-time=3.75e-4"]

[[axis]]
key = "sph.wetting.young.contact-angle-deg"
name = "angle"
range = { from = 40, to = 110, count = 8 }

[[axis]]
key = "sph.interface.tension"
values = [0.01, 0.02, 0.03]

[[report.curve]]
x = "angle"
y = "contact-angle-deg"
series = "tension"
reference = "angle"
"#;

/// A fresh folder with the small case and a study of it.
fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = crate::support::program::folder_with_small_case();
    std::fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// `meniscus study run study.toml --out OUT` as the leader of a group of processes.
#[cfg(unix)]
fn start(folder: &Path, out: &str) -> Child {
    use std::os::unix::process::CommandExt;
    command(folder, &["study", "run", "study.toml", "--out", out, "--jobs", "3"])
        .process_group(0)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Sends a signal to a process, or to its whole group.
#[cfg(unix)]
fn signal(name: &str, child: &Child, group: bool) {
    let target = format!("{}{}", if group { "-" } else { "" }, child.id());
    assert!(Command::new("kill").args([name, "--", &target]).status().unwrap().success());
}

fn run_study(folder: &Path, out: &str) -> Output {
    meniscus(folder, &["study", "run", "study.toml", "--out", out, "--jobs", "3"])
}

/// Waits until `found` says so.
fn wait_for(what: &str, mut found: impl FnMut() -> bool) {
    let clock = Instant::now();
    while !found() {
        assert!(clock.elapsed() < Duration::from_secs(60), "{what} did not come");
        std::thread::sleep(Duration::from_millis(3));
    }
}

/// Number of runs that left a report.
fn reports(out: &Path) -> usize {
    let runs = std::fs::read_dir(out.join("runs")).into_iter().flatten();
    runs.filter(|run| run.as_ref().is_ok_and(|run| run.path().join("report.json").exists())).count()
}

#[cfg(unix)]
#[test]
fn a_study_that_is_killed_five_times_ends_with_the_same_files_as_an_unbroken_one() {
    let folder = folder_with(STUDY);
    let clock = Instant::now();
    assert_code(&run_study(folder.path(), "unbroken"), 0);
    let whole = clock.elapsed();
    let broken = folder.path().join("broken");
    // Numbers that look random and are the same each time, between 0 and 1.
    let mut state: u64 = 20_131;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for kill in 0..5 {
        let mut child = start(folder.path(), "broken");
        // Four runs further on each time, in the middle of the next ones.
        let target = (4.0 * (f64::from(kill) + random())) as usize;
        wait_for("progress", || reports(&broken) >= target);
        std::thread::sleep(whole.mul_f64(random() / 24.0));
        assert!(child.try_wait().unwrap().is_none(), "the study ended before it was killed");
        signal("-KILL", &child, true);
        child.wait().unwrap();
    }
    let before = reports(&broken);
    assert!((1..24).contains(&before), "{before} runs complete after five kills: nothing was tested");
    let output = run_study(folder.path(), "broken");
    assert_code(&output, 0);
    for name in ["table.csv", "table.md", "curve-1.svg", "map-1.svg", "report.html"] {
        assert_eq!(read(&broken.join(name)), read(&folder.path().join("unbroken").join(name)), "{name}");
    }
    assert_eq!(read(&broken.join("table.csv")).lines().count(), 25);
    assert_same_files(&broken.join("runs"), &folder.path().join("unbroken/runs"));

    // Once more: nothing is left to do, and no run is begun.
    let reported = || {
        let runs = std::fs::read_dir(broken.join("runs")).unwrap().map(|run| run.unwrap().path());
        let time = |run: &Path| std::fs::metadata(run.join("report.json")).ok()?.modified().ok();
        let mut times: Vec<_> = runs.filter_map(|run| time(&run).map(|time| (run, time))).collect();
        times.sort();
        times
    };
    let before = reported();
    assert_eq!(before.len(), 24);
    let output = run_study(folder.path(), "broken");
    assert_code(&output, 0);
    assert!(!stderr(&output).contains("done in"), "{}", stderr(&output));
    assert_eq!(reported(), before);
}

#[cfg(unix)]
#[test]
fn runs_of_a_study_whose_process_dies_alone_save_their_state_and_end() {
    let folder = folder_with(&STUDY.replace("time.end=7.5e-4", "time.end=1.5e-2"));
    let out = folder.path().join("out");
    let mut child = start(folder.path(), "out");
    wait_for("a saved state", || {
        std::fs::read_dir(out.join("runs"))
            .into_iter()
            .flatten()
            .any(|run| run.unwrap().path().join("restart/state.bin").exists())
    });
    signal("-KILL", &child, false);
    child.wait().unwrap();
    wait_for("the report of an interrupted run", || reports(&out) > 0);
    for run in std::fs::read_dir(out.join("runs")).unwrap() {
        let path = run.unwrap().path();
        if path.join("report.json").exists() {
            assert_eq!(report(&path)["status"], "interrupted", "{}", path.display());
        }
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_leaves_runs_that_can_be_taken_up() {
    let folder = folder_with(&STUDY.replace("time.end=7.5e-4", "time.end=1.5e-2"));
    let child = start(folder.path(), "out");
    let runs = folder.path().join("out/runs");
    // Its state is saved at time zero; a second row of the series says that it steps.
    let steps = |run: &Path| std::fs::read_to_string(run.join("series.csv")).is_ok_and(|rows| rows.lines().count() > 2);
    wait_for("a run that steps", || {
        std::fs::read_dir(&runs).into_iter().flatten().any(|run| steps(&run.unwrap().path()))
    });
    // A second study in the same folder is refused while the first one is at work.
    let second = run_study(folder.path(), "out");
    assert_code(&second, 2);
    assert!(stderr(&second).contains(&format!("(process {})", child.id())), "{}", stderr(&second));
    signal("-INT", &child, true);
    let output = child.wait_with_output().unwrap();
    assert_code(&output, 130);
    let states: Vec<String> = std::fs::read_dir(&runs)
        .unwrap()
        .map(|run| run.unwrap().path())
        // On a busy machine a run may be told to stop before it has begun to step; it has nothing to tell then.
        .filter(|run| run.join("report.json").exists())
        .map(|run| report(&run)["status"].as_str().unwrap().to_owned())
        .collect();
    assert!(states.iter().any(|state| state == "interrupted"), "{states:?}");
    let plan = stdout(&meniscus(folder.path(), &["study", "plan", "study.toml", "--out", "out"]));
    assert!(plan.contains("partial") && plan.contains("to do"), "{plan}");
}

#[test]
fn a_study_goes_on_after_a_run_that_fails_and_says_which() {
    // Blown along the floor at nearly the largest speed that is accepted, the drop ends the run within 120 steps.
    let study = r#"
format = 1
title = "One fails"
case = "drop.toml"
[[axis]]
name = "speed"
key = "sph.initial.velocity.uniform"
values = [[0.0, -1e-3], [404.0, -10.0], [0.0, -2e-3]]
"#;
    // The sharp surface force would end it at once.
    let study = &study.replace("[[axis]]", "set = [\"sph.surface-force.csf={}\"]\n[[axis]]");
    let folder = folder_with(study);
    let output = meniscus(folder.path(), &["study", "run", "study.toml", "--out", "out", "--jobs", "1"]);
    assert_code(&output, 4);
    assert!(stderr(&output).contains("run 2 of 3, speed=404.0,-10.0: FAILED: "), "{}", stderr(&output));
    assert!(stdout(&output).contains("FAILED run 2") || stdout(&output).contains("FAILED      run 2"));
    let table = read(&folder.path().join("out/table.csv"));
    let states: Vec<&str> =
        table.lines().skip(1).map(|line| if line.contains(",failed,") { "failed" } else { "done" }).collect();
    assert_eq!(states, ["done", "failed", "done"], "{table}");
    assert!(read(&folder.path().join("out/report.html")).contains("Failed runs"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_study_goes_on_after_the_process_of_a_run_is_killed_and_says_which() {
    let folder =
        folder_with(&STUDY.replace("[0.01, 0.02, 0.03]", "[0.02]").replace("time.end=7.5e-4", "time.end=3e-3"));
    let study = start(folder.path(), "out");
    let children = format!("/proc/{0}/task/{0}/children", study.id());
    let state = |run: std::fs::DirEntry| run.path().join("restart/state.bin").exists();
    let runs = folder.path().join("out/runs");
    wait_for("a saved state", || std::fs::read_dir(&runs).into_iter().flatten().any(|run| run.is_ok_and(state)));
    let victim = read(Path::new(&children)).split_whitespace().next().unwrap().to_owned();
    assert!(Command::new("kill").args(["-KILL", &victim]).status().unwrap().success());
    let output = study.wait_with_output().unwrap();
    assert_code(&output, 4);
    let told = stderr(&output);
    assert!(told.contains("FAILED: its process ended with signal: 9") && told.contains("1 of 8 runs failed"), "{told}");
    assert_eq!(reports(&folder.path().join("out")), 7);
    // The same command takes it up.
    assert_code(&run_study(folder.path(), "out"), 0);
    assert_eq!(reports(&folder.path().join("out")), 8);
}

#[test]
fn a_changed_case_is_run_again_and_an_unchanged_one_is_not() {
    let study = r#"
format = 1
title = "Two drops"
case = "drop.toml"
[[axis]]
key = "sph.spacing"
values = [5e-5, 4e-5]
"#;
    let folder = folder_with(study);
    assert_code(&run_study(folder.path(), "out"), 0);
    let begun = |name: &str| read(&folder.path().join(format!("out/logs/spacing={name}.log"))).matches(" -> ").count();
    // Another value beside the first one: only that one is new, though its number is that of the old one.
    std::fs::write(folder.path().join("study.toml"), study.replace("4e-5]", "4.5e-5, 4e-5]")).unwrap();
    assert_code(&run_study(folder.path(), "out"), 0);
    assert_eq!((begun("5e-5"), begun("4e-5")), (1, 1));
    // What the base case expects is no part of the runs: the study has expectations of its own.
    let mut expecting = read(&folder.path().join("drop.toml"));
    expecting.push_str("\n[[expect]]\nmeasure = \"wetting-blobs\"\nvalue = 7.0\ntolerance = 0.5\n");
    std::fs::write(folder.path().join("drop.toml"), expecting).unwrap();
    assert_code(&run_study(folder.path(), "out"), 0);
    assert_eq!((begun("5e-5"), begun("4e-5")), (1, 1));
    // Another case: all are done again.
    let case = read(&folder.path().join("drop.toml")).replace("tension = 0.02", "tension = 0.021");
    std::fs::write(folder.path().join("drop.toml"), case).unwrap();
    assert_code(&run_study(folder.path(), "out"), 0);
    assert_eq!((begun("5e-5"), begun("4e-5")), (2, 2));
    let resolved = report(&folder.path().join("out/runs/spacing=5e-5"))["resolved-case"].as_str().unwrap().to_owned();
    assert!(resolved.contains("tension = 0.021"), "{resolved}");
}

#[test]
fn expectations_name_parameters_and_a_missed_one_ends_with_its_code() {
    let study = r#"
format = 1
title = "Expected"
case = "drop.toml"
[[axis]]
key = "sph.spacing"
values = [5e-5, 4e-5]
[[axis]]
pair = [
    { key = "sph.wetting.young.contact-angle-deg", name = "angle", values = [60, 90] },
    { name = "width", values = [90.0, 1e-6] },
]
[[expect]]
measure = "contact-angle-deg"
value = "angle"
tolerance = "width"
[[expect]]
measure = "area-drift"
value = 0.0
tolerance = 0.1
where = { angle = 60 }
[[trend]]
measure = "contact-angle-deg"
reference = "angle"
along = "spacing"
order = 50.0
"#;
    let folder = folder_with(study);
    let output = run_study(folder.path(), "out");
    assert_code(&output, 5);
    let text = stdout(&output);
    // Met: the wide angle in two runs, the drift in two. Missed: the narrow angle in two, and the order in both groups.
    assert!(text.contains("4 met, 4 missed, 0 open"), "{text}");
    assert!(text.contains("order at least 50"), "{text}");
    let judged = read(&folder.path().join("out/expectations.csv"));
    assert_eq!(judged.lines().next().unwrap(), "run,measure,expected,found,verdict");
    assert_eq!([",met", ",missed"].map(|end| judged.lines().filter(|line| line.ends_with(end)).count()), [4, 4]);
    let page = read(&folder.path().join("out/report.html"));
    // The area drift is expected at one angle and reported at both, the angle by its trend.
    assert_eq!(text.matches("of area-drift along spacing").count(), 2, "{text}");
    assert!(
        page.contains("<h2>Convergence</h2>") && page.contains("class=\"met\"") && page.contains("class=\"missed\"")
    );
    assert!(!page.contains("http"), "the page must open without a network");
    for picture in page.split("src=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(folder.path().join("out").join(picture).is_file(), "{picture}");
    }
    assert_code(&meniscus(folder.path(), &["study", "report", "study.toml", "--out", "out"]), 5);
}

#[test]
fn a_plan_tells_what_each_run_takes_and_writes_nothing() {
    let folder = folder_with(STUDY);
    let output = meniscus(folder.path(), &["study", "plan", "study.toml", "--jobs", "2"]);
    assert_code(&output, 0);
    let text = stdout(&output);
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| run"))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 24, "{text}");
    assert_eq!(&rows[4][1..4], ["5", "50", "0.02"]);
    assert!(rows.iter().all(|row| row[4].parse::<usize>().unwrap() > 300 && row[8] == "to do"), "{text}");
    assert!(text.contains("24 runs, 24 to do") && text.contains("2 at once on 1 thread each"), "{text}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "a plan writes nothing");
}

#[test]
fn several_studies_run_one_after_the_other_each_into_its_own_folder() {
    const TWO: &str = "format = 1\ntitle = \"Two\"\ncase = \"drop.toml\"\nset = [\"time.end=1.5e-4\"]\n[[axis]]\n\
                       key = \"sph.interface.tension\"\nvalues = [0.01, 0.02]\n";
    let folder = folder_with(TWO);
    let at = |name: &str| folder.path().join(name);
    // The second one expects what does not come; the third is done nevertheless.
    std::fs::write(
        at("missed.toml"),
        format!("{TWO}[[expect]]\nmeasure = \"contact-angle-deg\"\nvalue = 1.0\ntolerance = 0.1\n"),
    )
    .unwrap();
    std::fs::write(at("third.toml"), TWO).unwrap();
    let all = ["study.toml", "missed.toml", "third.toml"];
    let study = |command: &str, files: &[&str], more: &[&str]| {
        meniscus(folder.path(), &[&["study", command], files, more].concat())
    };
    let planned = study("plan", &all, &[]);
    assert_code(&planned, 0);
    assert_eq!(stdout(&planned).matches("2 runs, 2 to do").count(), 3, "{}", stdout(&planned));
    let run = study("run", &all, &["--out", "all"]);
    assert_code(&run, 5);
    for name in ["study", "missed", "third"] {
        assert_eq!(reports(&at(&format!("all/study-{name}"))), 2, "{name}");
        assert!(at(&format!("all/study-{name}/report.html")).is_file(), "{name}");
    }
    assert_code(&study("report", &all, &["--out", "all"]), 5);
    assert_code(&study("report", &["study.toml", "third.toml"], &["--out", "all"]), 0);
    // Without a folder each has its own below `out`.
    assert_code(&study("run", &["study.toml", "third.toml"], &[]), 0);
    assert_eq!(reports(&at("out/study-third")), 2);

    std::fs::create_dir(at("other")).unwrap();
    std::fs::write(at("other/third.toml"), TWO.replace("drop.toml", "../drop.toml")).unwrap();
    let twice = study("run", &["third.toml", "other/third.toml"], &[]);
    assert_code(&twice, 2);
    assert!(stderr(&twice).contains("two studies named third"), "{}", stderr(&twice));
    let indexed = study("run", &all, &["--index", "1"]);
    assert_code(&indexed, 2);
    assert!(stderr(&indexed).contains("name that study alone"), "{}", stderr(&indexed));
    // All files are read before anything starts.
    std::fs::write(at("wrong.toml"), "format = 1\n").unwrap();
    assert_code(&study("run", &["study.toml", "wrong.toml"], &["--out", "none"]), 3);
    assert!(!at("none").exists());
}

#[test]
fn a_folder_that_holds_something_else_is_left_alone() {
    let folder = folder_with(STUDY);
    let output = meniscus(folder.path(), &["study", "run", "study.toml", "--out", "."]);
    assert_code(&output, 2);
    assert!(stderr(&output).contains("contains no study"), "{}", stderr(&output));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    let output = meniscus(folder.path(), &["study", "report", "study.toml", "--out", "nowhere"]);
    assert_code(&output, 2);
    let output = meniscus(folder.path(), &["study", "run", "study.toml", "--index", "25", "--out", "x"]);
    assert_code(&output, 2);
    assert!(stderr(&output).contains("the study has 24 runs, there is no run 25"), "{}", stderr(&output));
}
