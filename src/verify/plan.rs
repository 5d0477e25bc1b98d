//! What will be run: a cut-out for each throat, its cases, and the study of them, written into a folder.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::case_text::{self, Fluids, Named};
use super::choose::{Chosen, touches_first};
use super::cut_out::{CutOut, Impossible};
use super::subject::Subject;
use crate::case::load;
use crate::input::Overrides;
use crate::io::checksum::fnv1a;
use crate::io::{FileError, atomic};
use crate::network::conductance::conductances;
use crate::network::extract;
use crate::network::permeability::{Drive, Paths, permeability};

/// The study file of a folder.
pub const STUDY: &str = "verify.toml";
/// The folder of the study.
pub const RUNS: &str = "study";
/// The folder of the cases.
const CASES: &str = "cases";
/// Tells which cases a user changed.
const DIGESTS: &str = "digests.json";

/// A throat with its cut-out.
#[derive(Debug)]
pub struct Planned {
    /// The throat.
    pub chosen: Chosen,
    /// Its cut-out.
    pub cut_out: Result<CutOut, Impossible>,
    /// Curvature in 1/m at which the meniscus touches another wall before its burst.
    pub touches: Option<f64>,
    /// Conductance in m² of the box by the formula of the network: flow per depth times viscosity over the pressure drop from end to end.
    pub conductance: Option<f64>,
}

impl Planned {
    /// The cut-out of a throat.
    #[must_use]
    pub fn new(subject: &Subject, chosen: Chosen) -> Self {
        let Some((passage, ahead)) = subject.passage(chosen.throat, chosen.to) else {
            return Self { chosen, cut_out: Err(Impossible::NoMeniscus), touches: None, conductance: None };
        };
        let cut_out = CutOut::new(&passage, &ahead);
        let conductance = cut_out.as_ref().ok().and_then(conductance);
        Self { chosen, cut_out, touches: touches_first(&passage, &ahead), conductance }
    }
}

/// The conductance of a cut-out by the network of its own bodies.
fn conductance(cut_out: &CutOut) -> Option<f64> {
    let geometry = cut_out.solids(true).ok()?;
    let network = extract(&geometry, [false; 4]).ok()?;
    let paths = Paths { conductance: &conductances(&network), holds: &vec![true; network.regions.len()] };
    let permeability = permeability(&network, paths, geometry.bounds(), Drive::Periodic(0)).ok()?;
    let size = geometry.bounds().size();
    Some(permeability * size.y / size.x).filter(|found| *found > 0.0)
}

/// What a case of a cut-out gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The entry pressure.
    Entry,
    /// The conductance.
    Flow,
}

/// The name of a case without its ending.
#[must_use]
pub fn case_name(number: usize, kind: Kind, across: u32) -> String {
    let kind = match kind {
        Kind::Entry => "entry",
        Kind::Flow => "flow",
    };
    format!("throat-{number}-{kind}-{across}")
}

/// What was written.
#[derive(Debug)]
pub struct Written {
    /// The study file; none where no throat has a cut-out.
    pub study: Option<PathBuf>,
    /// Cases that were changed by hand, and left so.
    pub kept: Vec<PathBuf>,
    /// Throats, by their place in the plan, whose case is refused, and why.
    pub refused: Vec<(usize, String)>,
}

/// A folder that cannot be written into.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A file.
    #[error(transparent)]
    File(#[from] FileError),
    /// A case that was changed by hand and is of another network.
    #[error("{} was changed by hand, and is of another case or other options now; choose another folder with --out DIR, or remove the file", .0.display())]
    Changed(PathBuf),
}

/// Writes the cases and the study.
///
/// # Errors
/// [`PlanError`].
pub fn write(
    folder: &Path,
    planned: &[Planned],
    fluids: &Fluids,
    spacings: &[u32],
    network: &str,
) -> Result<Written, PlanError> {
    let cases = folder.join(CASES);
    atomic::make_folder(&cases)?;
    let digests_path = cases.join(DIGESTS);
    let mut digests: BTreeMap<String, String> =
        std::fs::read(&digests_path).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
    let (mut names, mut kept, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for (place, one) in planned.iter().enumerate() {
        let Ok(cut_out) = &one.cut_out else { continue };
        let before = names.len();
        for kind in [Kind::Entry, Kind::Flow] {
            if kind == Kind::Flow && one.conductance.is_none() {
                continue;
            }
            for &across in spacings {
                let named = Named { number: one.chosen.number, network, across };
                let text = match kind {
                    Kind::Entry => case_text::entry(cut_out, fluids, &named),
                    Kind::Flow => case_text::flow(cut_out, fluids, &named),
                };
                let name = format!("{}.toml", case_name(one.chosen.number, kind, across));
                let path = cases.join(&name);
                if write_case(&path, &text, digests.get(&name))? == Case::Kept {
                    kept.push(path.clone());
                }
                digests.insert(name.clone(), digest(text.as_bytes()));
                if let Err(error) = load(&path, &Overrides::default()) {
                    let first = error.mistakes.first().map_or(String::new(), |mistake| mistake.message.clone());
                    refused.push((place, first));
                }
                names.push(name);
            }
        }
        if refused.last().is_some_and(|(last, _)| *last == place) {
            names.truncate(before);
        }
    }
    refused.dedup_by_key(|(place, _)| *place);
    // Names and digests can always be written.
    atomic::write(&digests_path, &serde_json::to_vec_pretty(&digests).unwrap_or_default())?;
    let study = folder.join(STUDY);
    if names.is_empty() {
        return Ok(Written { study: None, kept, refused });
    }
    atomic::write(&study, study_text(&names, network).as_bytes())?;
    Ok(Written { study: Some(study), kept, refused })
}

#[derive(PartialEq, Eq)]
enum Case {
    Written,
    Kept,
}

fn digest(bytes: &[u8]) -> String {
    format!("{:016x}", fnv1a(bytes))
}

/// Writes a case, unless a user has changed it since it was written.
fn write_case(path: &Path, text: &str, before: Option<&String>) -> Result<Case, PlanError> {
    let there = std::fs::read(path).ok().map(|bytes| digest(&bytes));
    let (new, changed) = (digest(text.as_bytes()), there.is_some() && there.as_ref() != before);
    match (changed, before == Some(&new)) {
        (true, true) => Ok(Case::Kept),
        (true, false) if there.as_ref() != Some(&new) => Err(PlanError::Changed(path.to_path_buf())),
        _ => {
            atomic::write(path, text.as_bytes())?;
            Ok(Case::Written)
        }
    }
}

fn study_text(names: &[String], network: &str) -> String {
    let mut text = format!(
        "# Throats of {network} by direct simulation: entry pressures and conductances of cut-outs.\n# meniscus study run {STUDY} --out {RUNS}\n\
         format = 1\ntitle = \"Throats of {network} by direct simulation\"\n\n[[axis]]\nname = \"cut-out\"\ncases = [\n"
    );
    for name in names {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "    \"{CASES}/{name}\",");
    }
    text + "]\n\n[report]\nmeasures = [\n    \"entry-pressure-Pa\",\n    \"contact-angle-deg\",\n    \"inflow-m2-per-s\",\n    \
            \"driving-pressure-drop-Pa\",\n    \"area-drift\",\n    \"unknowns\",\n    \"steps\",\n    \"wall-time-s\",\n]\n"
}
