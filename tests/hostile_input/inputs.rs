//! The files that are changed, and how each kind of them is read and checked.

use std::path::{Path, PathBuf};

use meniscus::run::setup;
use meniscus::study::load::load as load_study;
use meniscus::study::runs::runs;
use meniscus_case::Loaded;
use meniscus_core::input::{InputError, Overrides};
use meniscus_drawings::import::Options;
use meniscus_geometry::Geometry;
use meniscus_output::restart::{self, Saved};

use crate::mutation::{Random, changed};
use crate::places::without_place;

/// Longest report of mistakes in bytes.
const LONGEST_REPORT: usize = 200_000;

/// Most shapes of a geometry that is measured: the time is that of the network and not of the reader.
const MOST_SHAPES: usize = 200;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Case,
    Shapes,
    Study,
    /// The state of a network that a case begins with.
    Start,
    /// A saved state of a run.
    State,
}

/// What became of an input.
pub enum Outcome {
    Accepted,
    Refused,
    Wrong(String),
}

/// A changed file.
pub struct Input {
    pub seed: PathBuf,
    pub change: String,
    pub bytes: usize,
    kind: Kind,
    /// What the file was before.
    before: Vec<u8>,
    unit: Option<&'static str>,
}

/// A copy of the project's inputs in which one file after the other is changed.
pub struct Bench {
    root: PathBuf,
    seeds: Vec<(PathBuf, Kind)>,
}

impl Bench {
    pub fn new(root: &Path) -> Self {
        let project = Path::new(env!("CARGO_MANIFEST_DIR"));
        let _ = std::fs::remove_dir_all(root);
        let mut bench = Self { root: root.to_path_buf(), seeds: Vec::new() };
        for (folder, kind) in [
            ("cases", Kind::Case),
            ("cases/network", Kind::Case),
            ("cases/thin-film", Kind::Case),
            ("cases/states", Kind::Start),
            ("geometries", Kind::Shapes),
            ("crates/drawings/tests/drawings", Kind::Shapes),
            ("studies", Kind::Study),
            ("studies/thin-film", Kind::Study),
            ("studies/validation", Kind::Study),
        ] {
            bench.copy(project, Path::new(folder), kind);
        }
        std::fs::write(root.join("cases/good.toml"), include_str!("../bad-input/good-case.toml")).unwrap();
        std::fs::write(root.join("cases/shapes.toml"), SHAPES).unwrap();
        bench.seeds.extend(["cases/good.toml", "cases/shapes.toml"].map(|name| (name.into(), Kind::Case)));
        let (series, frames) = Default::default();
        let saved = Saved { case_hash: 7, time: 0.25, step: 12, series, frames, state: (0..=255).collect() };
        restart::save(root, &saved).unwrap();
        bench.seeds.push((restart::path(Path::new("")), Kind::State));
        bench.seeds.sort_by(|a, b| a.0.cmp(&b.0));
        bench
    }

    fn copy(&mut self, project: &Path, folder: &Path, kind: Kind) {
        std::fs::create_dir_all(self.root.join(folder)).unwrap();
        for entry in std::fs::read_dir(project.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() || ["py", "rs", "md", "txt"].contains(&ending.as_str()) {
                continue;
            }
            let name = folder.join(path.file_name().unwrap());
            std::fs::copy(&path, self.root.join(&name)).unwrap();
            let is_side_file = ["dbf", "prj", "shx"].contains(&ending.as_str())
                || name.ends_with("reference.json")
                || name.ends_with("ruff.toml");
            if !is_side_file {
                self.seeds.push((name, kind));
            }
        }
    }

    /// Changes one of the files.
    pub fn write(&self, random: &mut Random) -> Input {
        let (seed, kind) = random.one_of(&self.seeds).clone();
        let before = std::fs::read(self.root.join(&seed)).unwrap();
        let (bytes, change) = changed(&before, random);
        std::fs::write(self.root.join(&seed), &bytes).unwrap();
        let unit = *random.one_of(&[None, Some("mm"), Some("um"), Some("px"), Some("km")]);
        Input { seed, change, bytes: bytes.len(), kind, before, unit }
    }

    /// Keeps a changed file for a look.
    pub fn keep(&self, input: &Input, number: u64) {
        let name = format!("bad-{number}-{}", input.seed.file_name().unwrap_or_default().to_string_lossy());
        let kept = self.root.join(name);
        let _ = std::fs::rename(self.root.join("changed"), kept);
    }

    /// Reads and checks a changed file, and puts back what it was before.
    pub fn read(&self, input: &Input) -> Outcome {
        let path = self.root.join(&input.seed);
        let back = Back { path: &path, changed: self.root.join("changed"), before: &input.before };
        let outcome = match input.kind {
            Kind::State => match restart::load(&self.root) {
                Ok(saved) if saved.state.len() == 256 => Outcome::Accepted,
                Ok(_) => Outcome::Wrong("a state that was never saved".to_owned()),
                // Its checksum is that of the whole file: there is no place in it.
                Err(error) if error.to_string().contains("state.bin has unexpected content: ") => Outcome::Refused,
                Err(error) => Outcome::Wrong(format!("refused without its file: {error}")),
            },
            Kind::Study => study(&path, &self.root),
            Kind::Start => start(&path, &self.root),
            Kind::Case => case(&path, &self.root),
            Kind::Shapes => shapes(&path, input.unit, &self.root),
        };
        drop(back);
        outcome
    }
}

/// Puts a file back, also where its reader panics.
struct Back<'a> {
    path: &'a Path,
    changed: PathBuf,
    before: &'a [u8],
}

impl Drop for Back<'_> {
    fn drop(&mut self) {
        let _ = std::fs::rename(self.path, &self.changed);
        let _ = std::fs::write(self.path, self.before);
    }
}

/// What becomes of a refusal, which is to name a file of the folder `root` and a place in it, and to be short.
fn refused(error: InputError, root: &Path) -> Outcome {
    if let Some(why) = without_place(&error, root) {
        return Outcome::Wrong(why);
    }
    let plain = error.render().len();
    let fancy = format!("{:?}", miette::Report::new(error)).len();
    if plain.max(fancy) > LONGEST_REPORT {
        return Outcome::Wrong(format!("a report of {} bytes", plain.max(fancy)));
    }
    Outcome::Refused
}

fn study(path: &Path, root: &Path) -> Outcome {
    let path = path.with_extension("toml");
    match load_study(&path) {
        Err(error) => refused(error, root),
        Ok(study) => {
            let runs = runs(&study);
            match runs.first().map(|run| run.plan(&study)) {
                Some(Err(error)) => refused(error, root),
                _ => Outcome::Accepted,
            }
        }
    }
}

/// What a state of a network with values that do not fit is told by: these values, as their lines are not known any more.
const OF_STATES: [&str; 4] = [
    "expected format",
    "expected the four numbers of a segment or the five of an arc",
    "a meniscus borders on element",
    "belongs to another geometry",
];

/// The state of a network, as the direct simulation of its geometry that begins with it reads it.
fn start(path: &Path, root: &Path) -> Outcome {
    let name = path.file_name().unwrap().to_string_lossy();
    let file = match &*name {
        "couple.json" => "couple.toml",
        "hand-over.json" => "from-network.toml",
        _ => "breakthrough.toml",
    };
    let set = Overrides::parse(&[format!("sph.initial.network=\"states/{name}\"")]).unwrap();
    let case = path.parent().unwrap().with_file_name(file);
    match meniscus_case::load(&case, &set) {
        Err(error) => {
            // The place of the mistake is that of the key; the message tells the line in the file. A message that is cut ends in dots.
            let has_line = |text: &str| {
                text.contains("line ") || text.ends_with("...") || OF_STATES.iter().any(|what| text.contains(what))
            };
            let messages: Vec<String> = error.mistakes.iter().map(|mistake| mistake.message.clone()).collect();
            match messages.iter().find(|text| text.contains(&*name) && !has_line(text)) {
                Some(text) => Outcome::Wrong(format!("refused without a line: {text}")),
                None => refused(error, root),
            }
        }
        Ok(loaded) => checked(&loaded, &case, root),
    }
}

fn case(path: &Path, root: &Path) -> Outcome {
    match meniscus_case::load(path, &Overrides::default()) {
        Err(error) => refused(error, root),
        Ok(loaded) => checked(&loaded, path, root),
    }
}

fn checked(loaded: &Loaded, path: &Path, root: &Path) -> Outcome {
    let again = path.with_file_name("again.toml");
    std::fs::write(&again, &loaded.resolved).unwrap();
    match meniscus_case::load(&again, &Overrides::default()) {
        Err(error) => return Outcome::Wrong(format!("resolved, it does not load: {}", error.render())),
        Ok(again) if again.resolved != loaded.resolved => {
            return Outcome::Wrong("resolved twice, it differs".to_owned());
        }
        Ok(_) => {}
    }
    match loaded.refuse(setup::problems(&loaded.case)) {
        Err(error) => refused(error, root),
        Ok(()) => Outcome::Accepted,
    }
}

fn shapes(path: &Path, unit: Option<&str>, root: &Path) -> Outcome {
    let is_mask = path.extension().is_some_and(|ending| ending == "png" || ending == "tif");
    let options = if is_mask {
        Options { pixel_size: Some(1e-6), ..Options::default() }
    } else {
        Options { unit: unit.map(str::to_owned), ..Options::default() }
    };
    let spec = match meniscus_case::load_shapes(path, &options) {
        Err(error) => return refused(error, root),
        Ok(read) => read.spec,
    };
    if spec.shapes.len() > MOST_SHAPES {
        return Outcome::Accepted;
    }
    match Geometry::new(&spec) {
        Err(_) => Outcome::Wrong("its shapes were accepted and are refused as a geometry".to_owned()),
        Ok(geometry) => {
            let porosity = geometry.porosity().value;
            if (0.0..=1.0 + 1e-9).contains(&porosity) && geometry.specific_surface().is_finite() {
                Outcome::Accepted
            } else {
                Outcome::Wrong(format!("a porosity of {porosity}, a surface of {}", geometry.specific_surface()))
            }
        }
    }
}

/// A case with every shape.
const SHAPES: &str = r#"format = 1
title = "every shape"
[geometry]
min = [0.0, 0.0]
max = [1.0e-3, 1.0e-3]
shapes = [
    { disc = { center = [2.0e-4, 2.0e-4], radius = 5.0e-5 } },
    { rectangle = { center = [5.0e-4, 2.0e-4], size = [1.0e-4, 5.0e-5], rotation-deg = 30.0 } },
    { capsule = { ends = [[8.0e-4, 2.0e-4], [8.5e-4, 3.0e-4]], radius = 4.0e-5 } },
    { polygon = { outer = [[2.0e-4, 5.0e-4], [3.0e-4, 5.0e-4], [2.5e-4, 6.0e-4]] } },
    { curved-polygon = { outer = [[5.0e-4, 5.0e-4, 0.5], [6.0e-4, 5.0e-4, 0.0], [5.5e-4, 6.0e-4, 0.2]] } },
    { array = { arrangement = "hexagonal", radius = 2.0e-5, gap = 2.0e-5, region = [[7.0e-4, 7.0e-4], [9.0e-4, 9.0e-4]] } },
    { random-pack = { porosity = 0.8, radius = 1.5e-5, gap = 1.0e-5, region = [[1.0e-4, 7.0e-4], [3.0e-4, 9.0e-4]] } },
    { throat-discs = { center = [5.0e-4, 8.0e-4], radii = [3.0e-5, 4.0e-5], gap = 5.0e-5 } },
    { half-plane = { point = [0.0, 1.0e-5] } },
]
[sph]
spacing = 1.0e-5
[sph.phases.wetting]
preset = "water"
[sph.phases.non-wetting]
preset = "air"
[sph.interface]
tension = 0.07
[sph.wetting.young]
contact-angle-deg = 60.0
[sph.sides]
left = "periodic"
right = "periodic"
[[sph.initial.wetting]]
rectangle = { center = [5.0e-4, 3.0e-4], size = [2.0e-3, 2.0e-4] }
[[sph.initial.wetting]]
throat-cosine = { center = [5.0e-4, 5.0e-4], width = 8.0e-4, throat = 2.0e-4, length = 6.0e-4 }
[[sph.initial.wetting]]
channel = { center = [5.0e-4, 5.0e-4], width = 8.0e-4 }
[time]
end = 0.01
[output.vtk]
every-time = 1.0e-3
"#;
