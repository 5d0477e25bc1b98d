//! Small cases to change: those of the project with all defaults and shapes written out, as coarse as their checks allow.

use std::path::Path;

use meniscus::run::setup;
use meniscus_case::Loaded;
use meniscus_case::{Case, Model};
use meniscus_core::input::Overrides;
use meniscus_wetting::{LawTable, laws};

/// Particles or nodes that a case is to have, the fewest first.
const TARGETS: [f64; 4] = [300.0, 600.0, 1000.0, 1600.0];
/// Most particles or nodes of a case that is run, and most shapes of one with a network.
const MOST_UNKNOWNS: f64 = 2500.0;
const MOST_SHAPES: usize = 16;

/// The tables of all wetting laws, with the examples of their parameters, for a drop on a wall.
fn wetting() -> Vec<String> {
    let table = |law: LawTable| {
        let value = |example: &str| example.split(" #").next().unwrap_or_default().to_owned();
        let keys: Vec<String> = law.keys.iter().filter_map(|(_, key)| key.example).map(value).collect();
        format!("{{ {} = {{ {} }} }}", law.key, keys.join(", "))
    };
    laws().into_iter().map(table).collect()
}

/// A case as text.
pub struct Seed {
    pub name: String,
    pub text: String,
}

/// The cases of the project that are small, or become so by a coarser spacing.
pub fn seeds() -> Vec<Seed> {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for folder in ["cases", "cases/network", "cases/thin-film"] {
        let mut files: Vec<_> =
            std::fs::read_dir(project.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
        files.sort();
        for path in files {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            found.extend(small(&path, &[]).map(|text| Seed { name, text }));
        }
    }
    for model in wetting() {
        let text = small(&project.join("cases/sessile-drop.toml"), &[format!("sph.wetting={model}")]);
        found.push(Seed { text: text.expect(&model), name: model });
    }
    found
}

/// A case with all that is filled in and with `more` values, with as coarse a spacing as it takes.
fn small(path: &Path, more: &[String]) -> Option<String> {
    let fine = meniscus_case::load(path, &Overrides::default()).ok()?;
    if matches!(fine.case.model, Model::Network(_)) {
        return is_small(&fine.case).then_some(fine.resolved);
    }
    let key = if matches!(fine.case.model, Model::Sph(_)) { "sph.spacing" } else { "thin-film.spacing" };
    TARGETS.iter().find_map(|&count| {
        let spacing = format!("{key}={:e}", spacing(&fine.case, count));
        let overrides = Overrides::parse(&[more, &[spacing]].concat()).ok()?;
        let loaded: Loaded = meniscus_case::load(path, &overrides).ok()?;
        (setup::problems(&loaded.case).is_empty() && is_small(&loaded.case)).then_some(loaded.resolved)
    })
}

fn size(case: &Case) -> [f64; 2] {
    [0, 1].map(|axis| case.geometry.max[axis] - case.geometry.min[axis])
}

/// The spacing that gives so many particles or nodes.
fn spacing(case: &Case, count: f64) -> f64 {
    let [width, height] = size(case);
    if matches!(case.model, Model::Sph(_)) { (width * height / count).sqrt() } else { width / count }
}

/// Whether a case may be run: its size is known before anything is built.
pub fn is_small(case: &Case) -> bool {
    let [width, height] = size(case);
    match &case.model {
        // A layer of walls and of open sides stands around the domain.
        Model::Sph(sph) => (width / sph.spacing + 12.0) * (height / sph.spacing + 12.0) < 2.0 * MOST_UNKNOWNS,
        Model::ThinFilm(film) => width / film.spacing < MOST_UNKNOWNS,
        Model::Network(_) => case.geometry.shapes.len() <= MOST_SHAPES,
    }
}
