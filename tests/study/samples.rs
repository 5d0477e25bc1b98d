//! Uncertain values: samples of networks within one process, and what is told of them.

use std::path::Path;
use std::process::Output;

use crate::support::program::{assert_code, command, meniscus, stderr, stdout};

/// A throat 8e-5 m wide between two blocks with sharp corners, behind which the walls open by 10 degrees each.
const THROAT: &str = r#"
format = 1
title = "A throat of straight walls"
[geometry]
min = [0.0, 0.0] # m
max = [2.0e-3, 1.0e-3] # m
[[geometry.shapes]]
polygon = { outer = [[5e-4, -1e-4], [1.5e-3, -1e-4], [1.5e-3, 3.894692077e-4], [1.1e-3, 4.6e-4], [9e-4, 4.6e-4], [5e-4, 3.894692077e-4]] } # m
[[geometry.shapes]]
polygon = { outer = [[5e-4, 1.1e-3], [5e-4, 6.105307923e-4], [9e-4, 5.4e-4], [1.1e-3, 5.4e-4], [1.5e-3, 6.105307923e-4], [1.5e-3, 1.1e-3]] } # m
[network]
inlet = "left"
outlet = "right"
[network.interface]
tension = 0.02 # N/m
[network.wetting.young]
contact-angle-deg = 30.0 # degrees
"#;

/// Discs in a channel.
const PACK: &str = r#"
format = 1
title = "Drainage of a small pack"
[geometry]
min = [0.0, 0.0] # m
max = [1.2e-3, 8.0e-4] # m
[[geometry.shapes]]
random-pack = { seed = 3, porosity = 0.55, radius = 6.0e-5, radius-deviation = 0.2, gap = 1.5e-5, region = [[0.0, 0.0], [1.2e-3, 8.0e-4]] }
[network]
inlet = "left"
outlet = "right"
[network.interface]
tension = 0.0728 # N/m
[network.wetting.young]
contact-angle-deg = 40.0 # degrees
"#;

/// Angle and tension of a pack.
const UNCERTAIN: &str = r#"
format = 1
title = "How sure is the drainage of a small pack"
case = "case.toml"
[sampling]
count = 64
[[axis]]
name = "angle"
key = "network.wetting.young.contact-angle-deg"
distribution = { normal = { mean = 40.0, deviation = 5.0 } }
[[axis]]
key = "network.interface.tension"
distribution = { uniform = { from = 0.0692, to = 0.0764 } }
"#;

fn folder_with(case: &str, study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    std::fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

fn run(folder: &Path, out: &str, more: &[&str]) -> Output {
    meniscus(folder, &[&["study", "run", "study.toml", "--out", out], more].concat())
}

/// The rows of a table by the names of its columns.
fn table(path: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &std::collections::BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?}", row[column]))
}

/// Whether two study folders hold the same file.
#[track_caller]
fn assert_same(folder: &Path, file: &str, folders: [&str; 2]) {
    let [a, b] = folders.map(|out| std::fs::read_to_string(folder.join(out).join(file)).unwrap());
    let different = a.lines().zip(b.lines()).find(|(a, b)| a != b);
    assert!(a == b, "{file} of {folders:?}: {different:?}");
}

/// [SaltelliEtAl2010; Jansen1999]
#[test]
fn sobol_indices_of_a_throat_are_those_of_its_formula() {
    // p = 2 σ cos(θ - 10°)/w with w = 8e-5 m - 2 d: the meniscus waits at the corners until it has its angle with the walls behind them. Blocks that
    // shrink keep their corners.
    let study = r#"
format = 1
title = "Entry pressure of a throat"
case = "case.toml"
[sampling]
count = 512
indices = true
[[axis]]
name = "angle"
key = "network.wetting.young.contact-angle-deg"
distribution = { uniform = { from = 20.0, to = 60.0 } }
[[axis]]
key = "network.interface.tension"
distribution = { uniform = { from = 0.06, to = 0.08 } }
[[axis]]
name = "offset"
key = "geometry.etch-offset"
distribution = { uniform = { from = -2.0e-5, to = 0.0 } }
[report]
measures = ["largest-entry-pressure-Pa"]
"#;
    let folder = folder_with(THROAT, study);
    let path = folder.path().join("study.toml");
    assert_code(&run(folder.path(), "out", &[]), 0);
    let samples = table(&folder.path().join("out/samples.csv"));
    assert_eq!(samples.len(), 5 * 512, "{}", path.display());
    for sample in &samples {
        let width = 8.0e-5 - 2.0 * number(sample, "offset");
        let formula = 2.0 * number(sample, "tension") * (number(sample, "angle") - 10.0).to_radians().cos() / width;
        let found = number(sample, "largest-entry-pressure-Pa");
        assert!((found / formula - 1.0).abs() < 1e-6, "{sample:?}: {formula}");
    }
    // Mean and mean square of the factors: of the cosine, of σ, of 1/w.
    let [from, to] = [10.0_f64, 50.0].map(f64::to_radians);
    let cosine =
        [(to.sin() - from.sin()) / (to - from), 0.5 + 0.25 * ((2.0 * to).sin() - (2.0 * from).sin()) / (to - from)];
    let tension = [0.07, 0.07 * 0.07 + 0.02 * 0.02 / 12.0];
    let [low, high] = [0.8e-4_f64, 1.2e-4];
    let width = [(high / low).ln() / (high - low), 1.0 / (low * high)];
    let factors = [cosine, tension, width];
    let product = |of: &dyn Fn(usize) -> f64| (0..3).map(of).product::<f64>();
    let variance = product(&|k| factors[k][1]) - product(&|k| factors[k][0].powi(2));
    let indices = table(&folder.path().join("out/indices.csv"));
    assert_eq!(indices.len(), 3);
    for (k, row) in indices.iter().enumerate() {
        let own = factors[k][1] - factors[k][0].powi(2);
        let others = |power: usize| -> f64 {
            let factor = |l: usize| if power == 1 { factors[l][0].powi(2) } else { factors[l][1] };
            (0..3).filter(|l| *l != k).map(factor).product()
        };
        for (column, expected) in [("first-order", own * others(1) / variance), ("total", own * others(2) / variance)] {
            let found = number(row, column);
            assert!((found - expected).abs() < 0.02, "{row:?}: {column} {found}, expected {expected}");
        }
    }
}

/// [HyndmanFan1996]
#[test]
fn the_band_of_90_percent_holds_90_percent_of_other_draws() {
    let folder = folder_with(PACK, &UNCERTAIN.replace("count = 64", "count = 512"));
    assert_code(&run(folder.path(), "band", &[]), 0);
    let other = UNCERTAIN.replace("count = 64", "count = 256\nseed = 2");
    std::fs::write(folder.path().join("study.toml"), other).unwrap();
    assert_code(&run(folder.path(), "held-out", &[]), 0);
    let of = |measure: &str| {
        let rows = table(&folder.path().join("band/quantiles.csv"));
        let row = rows.iter().find(|row| row["measure"] == measure).unwrap_or_else(|| panic!("{measure}")).clone();
        [number(&row, "quantile-05"), number(&row, "quantile-95")]
    };
    let held_out = table(&folder.path().join("held-out/samples.csv"));
    assert_eq!(held_out.len(), 256);
    let [low, high] = of("breakthrough-pressure-Pa");
    let within = held_out.iter().filter(|row| (low..=high).contains(&number(row, "breakthrough-pressure-Pa"))).count();
    let share = within as f64 / held_out.len() as f64;
    assert!((share - 0.9).abs() < 0.03, "{share} of the draws lie within {low} to {high} Pa");
    // The band of the curve at each saturation that all samples reach is that of the pressures there.
    let bands = table(&folder.path().join("band/bands.csv"));
    let middle = bands.iter().find(|row| row["saturation"] == "0.5").unwrap();
    assert!(number(middle, "quantile-05-Pa") < number(middle, "quantile-50-Pa"));
    assert_eq!(number(middle, "share-with-pressure"), 1.0);
}

#[test]
fn samples_are_the_same_on_any_number_of_threads_and_after_an_interruption() {
    let folder = folder_with(PACK, UNCERTAIN);
    assert_code(&run(folder.path(), "two", &["--jobs", "2"]), 0);
    assert_code(&run(folder.path(), "one", &["--jobs", "1"]), 0);
    let files =
        ["samples.csv", "quantiles.csv", "convergence.csv", "bands.csv", "invasion.csv", "invasion.vtu", "band.svg"];
    let same = |other: &str| {
        for file in files {
            let [a, b] = ["two", other].map(|out| std::fs::read(folder.path().join(out).join(file)).unwrap());
            assert!(a == b, "{file} of {other}");
        }
    };
    same("one");
    // Half of the samples first, and the rest by the same command on the longer study.
    std::fs::write(folder.path().join("study.toml"), UNCERTAIN.replace("count = 64", "count = 32")).unwrap();
    assert_code(&run(folder.path(), "longer", &[]), 0);
    std::fs::write(folder.path().join("study.toml"), UNCERTAIN).unwrap();
    let told = stdout(&meniscus(folder.path(), &["study", "plan", "study.toml", "--out", "longer"]));
    assert!(told.contains("64 samples, 32 to do"), "{told}");
    assert_code(&run(folder.path(), "longer", &[]), 0);
    same("longer");
    for file in ["report.html", "breakthrough.svg", "invasion.png"] {
        assert!(folder.path().join("two").join(file).exists(), "{file}");
    }
    assert!(!folder.path().join("two/runs").exists());
}

#[test]
fn a_sample_has_the_measures_of_an_ordinary_run() {
    let folder = folder_with(PACK, &UNCERTAIN.replace("count = 64", "count = 4"));
    assert_code(&run(folder.path(), "within", &[]), 0);
    let apart = UNCERTAIN.replace("count = 64", "count = 4\nprocesses = true");
    std::fs::write(folder.path().join("study.toml"), apart).unwrap();
    assert_code(&run(folder.path(), "apart", &[]), 0);
    assert_same(folder.path(), "samples.csv", ["within", "apart"]);
    assert_same(folder.path(), "quantiles.csv", ["within", "apart"]);
    assert!(folder.path().join("apart/runs/sample=1/report.json").exists());
}

#[test]
fn samples_in_time_and_of_other_walls_are_run_within_the_process_too() {
    let rates = r#"
format = 1
title = "Rate and etch offset"
case = "case.toml"
set = [
    "network.phases.wetting.viscosity=1e-3", "network.phases.wetting.density=1000.0",
    "network.phases.non-wetting.viscosity=2e-3", "network.phases.non-wetting.density=1000.0",
    "network.stop.breakthrough=true", "time.end=10.0",
]
[sampling]
count = 8
[[axis]]
key = "network.dynamic.rate"
distribution = { lognormal = { median = 1e-7, geometric-deviation = 2.0 } }
[[axis]]
name = "offset"
key = "geometry.etch-offset"
distribution = { normal = { mean = 0.0, deviation = 1e-6, at-most = 5e-6 } }
"#;
    let folder = folder_with(PACK, rates);
    assert_code(&run(folder.path(), "within", &[]), 0);
    std::fs::write(folder.path().join("study.toml"), rates.replace("count = 8", "count = 8\nprocesses = true"))
        .unwrap();
    assert_code(&run(folder.path(), "apart", &[]), 0);
    assert_same(folder.path(), "samples.csv", ["within", "apart"]);
    assert!(folder.path().join("within/invasion.csv").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_goes_on_with_what_is_done() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let folder = folder_with(PACK, &UNCERTAIN.replace("count = 64", "count = 512"));
    let mut child = command(folder.path(), &["study", "run", "study.toml", "--out", "broken"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let clock = Instant::now();
    while !folder.path().join("broken/study.lock").exists() && clock.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(700));
    // It may have ended already on a fast machine: then nothing was broken.
    let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    let code = child.wait().unwrap().code();
    assert!(matches!(code, Some(0 | 130)), "{code:?}");
    assert_code(&run(folder.path(), "broken", &[]), 0);
    assert_eq!(table(&folder.path().join("broken/samples.csv")).len(), 512);
    let failed = run(folder.path(), "broken", &["--engine", "slurm"]);
    assert_code(&failed, 2);
    assert!(stderr(&failed).contains("set processes = true in [sampling]"), "{}", stderr(&failed));
}
