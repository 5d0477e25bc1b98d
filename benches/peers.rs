//! The same sessile drop by this program and by others, one after the other on one thread: time per particle or cell and step, and what
//! it takes until the angle has settled, with its error.
//!
//! `cargo bench --bench peers` needs Python 3.11 or later with venv, and makes an environment of its own from
//! `benches/peers/requirements.txt`. A drop without gravity, 20 particles or cells per radius, goes from 90 to 60 and to 120 degrees in 20
//! capillary times √(ρR³/σ), or as many as `-- --capillary-times 5` says, Ohnesorge number 0.035. Settled: from then on within a degree of the mean of the last fifth of the run.
//!
//! The other program is lbmpy, with kernels compiled for the processor. PySPH is not here: of its latest version there are sources only,
//! whose build did not end within half an hour.
//!
//! `benches/peers/cost_to_error.py` has what a given error costs, by this program, lbmpy and peclet.

#[path = "../tests/support/python.rs"]
mod python;

use std::path::Path;
use std::process::Command;

use python::{peers_interpreter, root, run};

/// The run in capillary times.
const LENGTH: f64 = 20.0;

/// The capillary time of `cases/sessile-drop.toml` in s: √(ρR³/σ) with 1000 kg/m³, 0.8 mm and 0.025 N/m.
const CAPILLARY_TIME: f64 = 4.525_483_4e-3;

/// A settled angle stays within this of its end, in degrees.
const SETTLED: f64 = 1.0;

/// A run: size, steps, CPU seconds in all, and records of capillary times, CPU seconds so far and angle in degrees.
struct Drop {
    unknowns: f64,
    steps: f64,
    cpu_s: f64,
    records: Vec<[f64; 3]>,
}

impl Drop {
    /// The mean angle of the last fifth of the run in degrees.
    fn end(&self) -> f64 {
        let length = self.records.last().map_or(0.0, |record| record[0]);
        let last: Vec<f64> = self.records.iter().filter(|record| record[0] > 0.8 * length).map(|r| r[2]).collect();
        last.iter().sum::<f64>() / last.len() as f64
    }

    /// Capillary times and CPU seconds until the angle has settled.
    fn settled(&self) -> [f64; 2] {
        let end = self.end();
        // An angle that was not measured has not settled.
        let away = |r: &[f64; 3]| !((r[2] - end).abs() <= SETTLED);
        let first = self.records.iter().rposition(away).map_or(0, |last| last + 1);
        self.records.get(first).map_or([f64::NAN; 2], |r| [r[0], r[1]])
    }

    fn print(&self, program: &str, angle: f64) {
        let [time, cpu_s] = self.settled();
        println!(
            "{program:>10} {angle:>6.0} {:>9.0} {:>7.0} {:>13.3} {:>8.1} {time:>9.1} {cpu_s:>9.1} {:>8.2} {:>7.2}",
            self.unknowns,
            self.steps,
            1e6 * self.cpu_s / (self.unknowns * self.steps),
            self.cpu_s,
            self.end(),
            self.end() - angle
        );
    }
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// The drop by lbmpy.
fn lbmpy(angle: f64, length: f64) -> Drop {
    let mut command = Command::new(peers_interpreter());
    command.arg(root().join("benches/peers/lbmpy_drop.py")).arg(angle.to_string());
    command.args(["--capillary-times", &length.to_string()]).env("OMP_NUM_THREADS", "1");
    let printed = run(&mut command, "the drop by lbmpy must run");
    let found = json(printed.lines().last().unwrap_or_default());
    let records = found["records"].as_array().expect("records");
    Drop {
        unknowns: number(&found["unknowns"]),
        steps: number(&found["steps"]),
        cpu_s: number(&found["cpu_s"]),
        records: records.iter().map(|record| [0, 1, 2].map(|i| number(&record[i]))).collect(),
    }
}

/// The drop by this program, output included but for VTK files.
fn ours(angle: f64, length: f64) -> Drop {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("out");
    let end = length * CAPILLARY_TIME;
    let mut command = Command::new(env!("CARGO_BIN_EXE_meniscus"));
    command.arg("run").arg(root().join("cases/sessile-drop.toml")).args(["--threads", "1", "--out"]).arg(&out);
    command.arg("--set").arg(format!("sph.wetting.young.contact-angle-deg={angle:?}"));
    command.arg("--set").arg(format!("time.end={end:?}"));
    command.args(["--set", "expect=[]", "--set", "output.vtk.every-time=1e3", "--set", "time.steady.stop=false"]);
    run(&mut command, "the drop must run");
    let report = json(&text(&out.join("report.json")));
    let (steps, cpu_s) = (number(&report["steps"]), number(&report["cpu-s"]));
    let series = text(&out.join("series.csv"));
    let mut lines = series.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |name: &str| names.iter().position(|found| *found == name).expect("a column of the series");
    let columns = ["time_s", "step", "contact_angle_deg"].map(column);
    let record = |line: &str| {
        let words: Vec<&str> = line.split(',').collect();
        let [time, step, angle] = columns.map(|column| words[column].parse().unwrap_or(f64::NAN));
        [time / CAPILLARY_TIME, cpu_s * step / steps, angle]
    };
    Drop { unknowns: number(&report["solver"]["unknowns"]), steps, cpu_s, records: lines.map(record).collect() }
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn main() {
    let given = std::env::args().skip_while(|argument| argument != "--capillary-times").nth(1);
    let length = given.map_or(LENGTH, |word| word.parse().expect("--capillary-times takes a number"));
    println!(
        "{:>10} {:>6} {:>9} {:>7} {:>13} {:>8} {:>9} {:>9} {:>8} {:>7}",
        "program", "asked", "unknowns", "steps", "us/unknown/st", "CPU s", "settled", "CPU s", "angle", "error"
    );
    for angle in [60.0, 120.0] {
        lbmpy(angle, length).print("lbmpy", angle);
        ours(angle, length).print("meniscus", angle);
    }
    println!(
        "\nunknowns: particles with those of walls, or cells; settled: in capillary times, then the CPU seconds until then"
    );
}
