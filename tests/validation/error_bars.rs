//! Bars of contact angles that still move: small drops from 90 degrees to other angles, stopped on their way, at turning points and at rest.

use std::path::Path;

use crate::support::program::{SMALL, assert_code, meniscus, report};

/// Angle, bar and mark of a drop of `angle` degrees that is stopped at `end` (s).
fn stopped(folder: &Path, angle: f64, end: f64) -> (f64, f64, bool) {
    let name = format!("{angle}-{end}");
    let set = [
        format!("--set=sph.wetting.young.contact-angle-deg={angle:?}"),
        format!("--set=time.end={end:e}"),
        format!("--set=output.series.every-time={:e}", end / 50.0),
        "--set=geometry={ min = [0.0, 0.0], max = [1.4e-3, 6.0e-4] }".to_owned(),
        "--set=sph.initial.wetting=[{ disc = { center = [7.0e-4, 0.0], radius = 2.8e-4 } }]".to_owned(),
    ];
    let mut arguments = vec!["run", "small.toml", "--threads", "1", "--out", &name];
    arguments.extend(set.iter().map(String::as_str));
    assert_code(&meniscus(folder, &arguments), 0);
    let report = report(&folder.join(&name));
    let found = &report["measures"]["contact-angle-deg"];
    let number = |key: &str| found[key].as_f64().unwrap_or(f64::NAN);
    (number("value"), number("uncertainty"), found.get("not-at-rest").is_some())
}

/// Angle in degrees and end in s of each run: on the way, near turning points, near rest.
const RUNS: [(f64, f64); 8] = [
    (30.0, 1.0e-3),
    (30.0, 2.5e-3),
    (50.0, 2.5e-3),
    (50.0, 4.0e-3),
    (90.0, 1.0e-3),
    (90.0, 2.5e-3),
    (130.0, 2.5e-3),
    (130.0, 8.0e-3),
];

#[test]
fn bars_cover_angles_that_move_and_those_at_rest() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("small.toml"), SMALL).unwrap();
    let (mut cases, mut covered) = (0, 0);
    for (angle, end) in RUNS {
        let (found, bar, is_marked) = stopped(folder.path(), angle, end);
        let error = (found - angle).abs();
        cases += 1;
        covered += usize::from(error <= 2.0 * bar);
        // Farther off than the method is at 7 spacings in the radius: the drop still moves, and says so.
        assert!(error < 1.2 || is_marked, "{angle} degrees, {end} s: {found} +- {bar}");
        // A bar that covers anything says nothing: the drop of 90 degrees rests all the time.
        assert!(
            angle != 90.0 || (bar < 0.9 && error < 0.2 && !is_marked),
            "{angle} degrees, {end} s: {found} +- {bar}"
        );
    }
    // Two bars cover 95 of 100 cases.
    assert!(covered + 1 >= cases, "{covered} of {cases}");
}
