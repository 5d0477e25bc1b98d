//! `meniscus compare`: two cases of one geometry become a page and a JSON file; cases that do not fit are refused.

use std::path::Path;

use crate::support::program::{assert_code, meniscus, stderr};

fn repository(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name).display().to_string()
}

/// Both cases of the demonstration in a folder, the direct one coarser and a hundredth as long.
fn cases(folder: &Path) {
    let text = |name: &str| std::fs::read_to_string(repository(name)).unwrap();
    let pack = format!("file = {:?}", repository("geometries/wide-pack.toml"));
    let network = text("cases/network/compare.toml").replace("file = \"../../geometries/wide-pack.toml\"", &pack);
    let direct = text("cases/compare.toml").replace("file = \"../geometries/wide-pack.toml\"", &pack);
    // Filled as far as the network is at its first event.
    let direct = direct.replace("size = [2.0e-4, 2.0e-3]", "size = [9.0e-4, 2.0e-3]");
    let direct = direct.replace("spacing = 1.0e-5", "spacing = 1.6e-5").replace("end = 0.01", "end = 1.0e-4");
    std::fs::write(folder.join("network.toml"), network).unwrap();
    std::fs::write(folder.join("direct.toml"), direct).unwrap();
}

#[test]
fn two_cases_of_one_geometry_become_a_page_and_numbers() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let arguments = ["compare", "network.toml", "direct.toml", "--records", "5", "--out", "both", "--threads", "1"];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let page = std::fs::read_to_string(folder.path().join("both/compare.html")).unwrap();
    for resource in ["src=", "href=", "url(", "@import"] {
        assert!(!page.contains(resource), "{resource}");
    }
    assert!(page.contains("capillary pressure") && page.matches("<svg").count() >= 2);
    // It is coarser than menisci in throats need.
    assert!(page.contains("<li>direct simulation: ") && page.contains("across the narrowest throat"), "{page}");
    let text = std::fs::read_to_string(folder.path().join("both/compare.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["direct"]["saturation"].as_array().unwrap().len(), 6);
    assert!(found["network"]["breakthrough_pressure_pa"].as_f64().unwrap() > 100.0);
    assert!(found["direct"]["breakthrough_pressure_pa"].is_null(), "it ends long before");
    let again = meniscus(folder.path(), &arguments);
    assert_code(&again, 2);
    assert!(stderr(&again).contains("is not empty"), "{}", stderr(&again));
}

#[test]
fn cases_of_two_geometries_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let other = repository("cases/network/hand-over.toml");
    let output = meniscus(folder.path(), &["compare", &other, "direct.toml", "--out", "both"]);
    assert_code(&output, 3);
    assert!(stderr(&output).contains("not of one geometry"), "{}", stderr(&output));
    let no_network = meniscus(folder.path(), &["compare", "direct.toml", "direct.toml", "--out", "none"]);
    assert_code(&no_network, 3);
    assert!(stderr(&no_network).contains("the first case has no displacement"), "{}", stderr(&no_network));
}
