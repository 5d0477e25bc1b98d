//! A displacement in time does not depend on which side is left.

use std::path::Path;

use crate::support::program::{assert_code, meniscus, report};

#[test]
fn polygons_and_discs_drain_in_time_like_their_mirror_image() {
    let folder = tempfile::tempdir().unwrap();
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/mirrored");
    let measured = ["as-drawn", "mirrored"].map(|name| {
        let case = cases.join(format!("{name}.toml"));
        assert_code(&meniscus(folder.path(), &["run", case.to_str().unwrap(), "--out", name]), 0);
        let measures = report(&folder.path().join(name))["measures"].clone();
        ["breakthrough-time-s", "saturation-at-breakthrough", "breakthrough-pressure-difference-Pa"]
            .map(|measure| measures[measure]["value"].as_f64().unwrap())
    });
    let [one, other] = measured;
    assert!(one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-6 * a.abs()), "{one:?} {other:?}");
}
