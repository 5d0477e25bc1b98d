//! The plan: a subdomain for each throat, its cases, and their study, written into a folder.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::case_text::{self, Named};
use super::choose::{Chosen, touches_first};
use super::fluids::Fluids;
use super::subdomain::{Impossible, Subdomain};
use super::subject::Subject;
use meniscus_case::load;
use meniscus_core::input::Overrides;
use meniscus_network::conductance::conductances;
use meniscus_network::extract;
use meniscus_network::graph::Network;
use meniscus_network::permeability::{Drive, Paths, permeability};
use meniscus_output::checksum::fnv1a;
use meniscus_output::{FileError, atomic};

/// The study file of a folder.
pub(crate) const STUDY: &str = "verify.toml";
/// The folder of the study.
pub(crate) const RUNS: &str = "study";
/// The folder of the cases.
const CASES: &str = "cases";
/// Digests of the cases, by which changes of a user are detected.
const DIGESTS: &str = "digests.json";

/// A throat with its subdomain.
#[derive(Debug)]
pub struct Planned {
    /// The throat.
    pub chosen: Chosen,
    /// Its subdomain.
    pub subdomain: Result<Subdomain, Impossible>,
    /// Curvature in 1/m at which the meniscus touches another wall before its burst.
    pub touches: Option<f64>,
    /// Conductance in m² of the box by the formula of the network: flow per depth times viscosity over the total pressure drop.
    pub conductance: Option<f64>,
}

impl Planned {
    /// The subdomain of a throat.
    pub fn new(subject: &Subject, chosen: Chosen) -> Self {
        let Some((passage, ahead)) = subject.passage(chosen.throat, chosen.to) else {
            return Self { chosen, subdomain: Err(Impossible::NoMeniscus), touches: None, conductance: None };
        };
        let depth = subject.chip.map(|chip| chip.depth.distance());
        let subdomain =
            Subdomain::new(&passage, &ahead).and_then(|subdomain| match subject.has_network_films(subdomain.angle) {
                true => Ok(subdomain),
                false => Err(Impossible::Films),
            });
        let conductance = subdomain.as_ref().ok().and_then(|subdomain| conductance(subdomain, depth));
        Self { chosen, subdomain, touches: touches_first(&passage, &ahead), conductance }
    }
}

/// The conductance in m² of a subdomain by the network of its own bodies, of a depth in m.
fn conductance(subdomain: &Subdomain, depth: Option<f64>) -> Option<f64> {
    let geometry = subdomain.solids(true).ok()?;
    let network = Network { depth, ..extract(&geometry, [false; 4]).ok()? };
    let paths = Paths { conductance: &conductances(&network), holds: &vec![true; network.regions.len()] };
    let permeability = permeability(&network, paths, geometry.bounds(), Drive::Periodic(0)).ok()?;
    let size = geometry.bounds().size();
    Some(permeability * size.y / size.x).filter(|found| *found > 0.0)
}

/// The quantity that a case of a subdomain yields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The entry pressure.
    Entry,
    /// The conductance.
    Flow,
}

/// The name of a case of a throat without extension.
pub(crate) fn case_name(number: usize, kind: Kind, across: u32) -> String {
    match kind {
        Kind::Entry => format!("throat-{number}-entry-{across}"),
        Kind::Flow => format!("throat-{number}-flow-{across}"),
    }
}

/// The files written.
#[derive(Debug)]
pub struct Written {
    /// The study file; `None` if no throat has a subdomain.
    pub study: Option<PathBuf>,
    /// Cases changed by hand, which were kept.
    pub kept: Vec<PathBuf>,
    /// Throats, by index in the plan, whose case is invalid, and why.
    pub refused: Vec<(usize, String)>,
}

/// Why a plan was not written.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A case changed by hand belongs to another network.
    #[error("{} was changed by hand, and now belongs to another case or other options; choose another folder with --out DIR, or remove the file", .0.display())]
    Changed(PathBuf),
}

/// The plan of one network.
#[derive(Debug, Clone, Copy)]
pub struct Plan<'a> {
    /// The throats.
    pub throats: &'a [Planned],
    /// The fluids of all cases.
    pub fluids: &'a Fluids,
    /// Spacings across a throat.
    pub spacings: &'a [u32],
    /// The case of the network.
    pub network: &'a str,
}

impl Plan<'_> {
    /// Name and text of each case of a throat.
    fn of_throat(&self, one: &Planned) -> Vec<(String, String)> {
        let Ok(subdomain) = &one.subdomain else { return Vec::new() };
        let kinds =
            [Kind::Entry, Kind::Flow].into_iter().filter(|&kind| kind == Kind::Entry || one.conductance.is_some());
        let cases = kinds.flat_map(|kind| self.spacings.iter().map(move |&across| (kind, across)));
        let text = |(kind, across)| {
            let named = Named { number: one.chosen.number, network: self.network, across };
            let text = match kind {
                Kind::Flow => case_text::flow(subdomain, self.fluids, &named),
                Kind::Entry => case_text::entry(subdomain, self.fluids, &named),
            };
            (case_name(named.number, kind, across), text)
        };
        cases.map(text).collect()
    }
}

/// Writes the cases and the study.
pub fn write(folder: &Path, plan: &Plan) -> Result<Written, PlanError> {
    let cases = folder.join(CASES);
    atomic::make_folder(&cases)?;
    let digests_path = cases.join(DIGESTS);
    let digests = std::fs::read(&digests_path).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let mut writer = CaseWriter { cases, digests: digests.unwrap_or_default(), names: Vec::new(), kept: Vec::new() };
    let mut refused = Vec::new();
    for (index, one) in plan.throats.iter().enumerate() {
        refused.extend(writer.write(plan.of_throat(one))?.map(|why| (index, why)));
    }
    let CaseWriter { digests, names, kept, .. } = writer;
    // Writing names and digests cannot fail.
    atomic::write(&digests_path, &serde_json::to_vec_pretty(&digests).unwrap_or_default())?;
    let study = folder.join(STUDY);
    let is_empty = names.is_empty();
    if !is_empty {
        atomic::write(&study, study_text(&names, plan.network).as_bytes())?;
    }
    Ok(Written { study: (!is_empty).then_some(study), kept, refused })
}

/// Writes cases and records their digests.
struct CaseWriter {
    cases: PathBuf,
    digests: BTreeMap<String, String>,
    /// Names of the cases of the study.
    names: Vec<String>,
    /// Cases changed by hand.
    kept: Vec<PathBuf>,
}

impl CaseWriter {
    /// Writes the cases of one subdomain. If one is invalid, returns the message of the first and leaves all out of the study.
    fn write(&mut self, texts: Vec<(String, String)>) -> Result<Option<String>, PlanError> {
        let (mut refused, mut names) = (None, Vec::new());
        for (name, text) in texts {
            let name = format!("{name}.toml");
            let path = self.cases.join(&name);
            if !write_case(&path, &text, self.digests.get(&name))? {
                self.kept.push(path.clone());
            }
            self.digests.insert(name.clone(), digest(text.as_bytes()));
            if let Err(error) = load(&path, &Overrides::default()) {
                let first = error.mistakes.first().map_or(String::new(), |mistake| mistake.message.clone());
                refused = refused.or(Some(first));
            }
            names.push(name);
        }
        if refused.is_none() {
            self.names.extend(names);
        }
        Ok(refused)
    }
}

fn digest(bytes: &[u8]) -> String {
    format!("{:016x}", fnv1a(bytes))
}

/// Writes a case unless a user has changed it; returns whether it was written.
fn write_case(path: &Path, text: &str, before: Option<&String>) -> Result<bool, PlanError> {
    let there = std::fs::read(path).ok().map(|bytes| digest(&bytes));
    let (new, changed) = (digest(text.as_bytes()), there.is_some() && there.as_ref() != before);
    match (changed, before == Some(&new)) {
        (true, true) => Ok(false),
        (true, false) if there.as_ref() != Some(&new) => Err(PlanError::Changed(path.to_path_buf())),
        _ => {
            atomic::write(path, text.as_bytes())?;
            Ok(true)
        }
    }
}

fn study_text(names: &[String], network: &str) -> String {
    let mut text = format!(
        "# Throats of {network} by direct simulation: cut-outs.\n# meniscus study run {STUDY} --out {RUNS}\n\
         format = 1\ntitle = \"Throats of {network} by direct simulation\"\n\n[[axis]]\nname = \"cut-out\"\ncases = [\n"
    );
    for name in names {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "    \"{CASES}/{name}\",");
    }
    text += "]\n\n[report]\nmeasures = [\n";
    for measure in measures(names) {
        let _ = writeln!(text, "    \"{measure}\",");
    }
    text + "]\n"
}

/// The measures of the cases.
fn measures(names: &[String]) -> impl Iterator<Item = &'static str> {
    let has = |what: &str| names.iter().any(|name| name.contains(what));
    let (has_entry, has_flow) = (has("-entry-"), has("-flow-"));
    let all = [
        ("entry-pressure-Pa", has_entry),
        ("contact-angle-deg", has_entry),
        ("inflow-m2-per-s", has_flow),
        ("driving-pressure-drop-Pa", has_flow),
        ("area-drift", true),
        ("unknowns", true),
        ("steps", true),
        ("wall-time-s", true),
    ];
    all.into_iter().filter_map(|(measure, is_there)| is_there.then_some(measure))
}
