//! Movies of finished, unfinished and damaged runs.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::program::{assert_code, folder_with_small_case, meniscus, stderr, stdout};

/// A folder with the run `drop` of the small case, which has three frames.
fn folder_with_drop() -> tempfile::TempDir {
    let folder = folder_with_small_case();
    assert_code(&meniscus(folder.path(), &["run", "drop.toml", "--threads", "1", "--out", "drop"]), 0);
    folder
}

fn network(folder: &Path, out: &str, more: &[&str]) -> Output {
    let chip = concat!(env!("CARGO_MANIFEST_DIR"), "/geometries/chip.svg");
    let options = ["--inlet", "bottom", "--outlet", "top", "--angle-deg", "40", "--tension", "0.0728", "--out", out];
    let output = meniscus(folder, &[&["network", chip], &options[..], more].concat());
    assert_code(&output, 0);
    output
}

/// The number of frames that `movie` tells, without a warning.
fn frames(folder: &Path, arguments: &[&str]) -> usize {
    let output = meniscus(folder, &[&["movie"], arguments].concat());
    assert_code(&output, 0);
    assert!(!stderr(&output).contains("WARNING"), "{}", stderr(&output));
    let told = stdout(&output);
    let words: Vec<&str> = told.split_whitespace().collect();
    words.iter().position(|word| *word == "frames,").and_then(|at| words[at - 1].parse().ok()).expect(&told)
}

#[test]
fn a_direct_run_gives_a_movie_of_all_its_frames_whether_it_has_ended_or_not() {
    let folder = folder_with_drop();
    let at = folder.path();
    assert_eq!(frames(at, &["drop"]), 3);
    let gif = fs::read(at.join("drop/movie.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a"));
    assert_eq!(frames(at, &["drop", "--out", "again.gif", "--threads", "1"]), 3);
    assert_eq!(fs::read(at.join("again.gif")).unwrap(), gif, "the same whatever the number of threads");
    assert_eq!(frames(at, &["drop", "--out", "drop.apng", "--rate", "3"]), 3);
    assert!(fs::read(at.join("drop.apng")).unwrap().windows(4).any(|name| name == b"acTL"));
    // Resuming needs nothing that a movie changes.
    let longer = ["run", "drop.toml", "--set", "time.end=6e-4", "--resume", "--threads", "1", "--out", "drop"];
    assert_code(&meniscus(at, &longer), 0);
    assert_eq!(frames(at, &["drop"]), 5);
    fs::remove_file(at.join("drop/report.json")).unwrap();
    assert_eq!(frames(at, &["drop"]), 5);
}

#[test]
fn a_network_shows_its_events_one_after_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let events = |out: &str| fs::read_to_string(at.join(out).join("events.csv")).unwrap().lines().count() - 1;
    for (out, more) in [("drainage", &[][..]), ("cycle", &["--process", "cycle"])] {
        network(at, out, more);
        // Events at one pressure may come between two frames.
        let (events, found) = (events(out), frames(at, &[out]));
        assert!(2 * found > events && found <= events + 2, "{found} frames of {events} events");
    }
    let path = at.join("drainage/report.json");
    let report = fs::read_to_string(&path).unwrap();
    let other = report.replacen("\"steps\": ", "\"steps\": 1", 1);
    assert_ne!(report, other);
    fs::write(path, other).unwrap();
    let output = meniscus(at, &["movie", "drainage"]);
    assert_code(&output, 0);
    assert!(stderr(&output).contains("not the same as in the folder"), "{}", stderr(&output));
}

#[test]
fn a_network_in_time_comes_to_the_same_bits_again() {
    let folder = tempfile::tempdir().unwrap();
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/network/dynamic.toml");
    assert_code(&meniscus(folder.path(), &["run", case, "--out", "in-time"]), 0);
    assert!(frames(folder.path(), &["in-time"]) > 40);
}

#[test]
fn what_has_no_movie_is_told_with_a_way_out() {
    let folder = folder_with_drop();
    let at = folder.path();
    let refused = |arguments: &[&str], words: &[&str]| {
        let output = meniscus(at, &[&["movie"], arguments].concat());
        assert_code(&output, 2);
        let told = stderr(&output);
        assert!(words.iter().all(|word| told.contains(word)), "{told}");
    };
    refused(&["nowhere"], &["no folder nowhere", "output folder of a run"]);
    refused(&["drop", "--out", "movie.mp4"], &["movie.mp4", ".gif", "ffmpeg"]);
    refused(&["drop", "--rate", "0"], &["--rate", "1..=50"]);
    fs::create_dir(at.join("empty")).unwrap();
    refused(&["empty"], &["empty holds no frames", "particles.pvd"]);
    network(at, "network", &[]);
    fs::remove_file(at.join("network/report.json")).unwrap();
    refused(&["network"], &["network has no report.json", "Ctrl-C"]);
    let chip = concat!(env!("CARGO_MANIFEST_DIR"), "/geometries/chip.svg");
    assert_code(&meniscus(at, &["network", chip, "--out", "still"]), 0);
    refused(&["still"], &["nothing moves", "inlet"]);

    let frame = at.join("drop/particles/particles-000001.vtu");
    let bytes = fs::read(&frame).unwrap();
    fs::write(&frame, &bytes[..bytes.len() / 2]).unwrap();
    refused(&["drop"], &["particles-000001.vtu", "damaged"]);
    fs::remove_file(&frame).unwrap();
    refused(&["drop"], &["particles-000001.vtu", "no such file"]);
    let list = at.join("drop/particles.pvd");
    let text = fs::read_to_string(&list).unwrap();
    let first: Vec<&str> = text.lines().filter(|line| !line.contains("00001") && !line.contains("00002")).collect();
    fs::write(&list, first.join("\n")).unwrap();
    refused(&["drop"], &["single frame", "output.vtk.every-time"]);
    fs::write(at.join("drop/report.json"), "{").unwrap();
    refused(&["drop"], &["report.json", "--resume"]);
}
