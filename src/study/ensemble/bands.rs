//! Bands of capillary pressure over saturation, the distribution of the saturation at breakthrough, and invasion probability maps.

use std::path::Path;

use super::engine::Engine;
use super::statistics::{Group, SHARE_HEADS, SHARES, full};
use super::store::Done;
use crate::run::ensemble::{Map, Observed, SATURATIONS, write_map};
use crate::run::pressure_curves::{LABELS, TITLE};
use crate::study::definition::Sampling;
use crate::study::table::Table;
use meniscus_core::diagram::{Diagram, Stroke, Trace};
use meniscus_geometry::analysis::samples::{mean, quantile};
use meniscus_output::diagram::svg;
use meniscus_output::{FileError, atomic};

/// The figures of a group on the page.
#[derive(Debug, Clone, Default)]
pub(crate) struct Figures {
    /// The values along the other axes; empty if there are none.
    pub(crate) name: String,
    /// Diagrams as SVG.
    pub(crate) diagrams: Vec<String>,
    /// The file of the map in the study folder.
    pub(crate) map: Option<String>,
}

/// The measure whose distribution is drawn.
const AT_BREAKTHROUGH: &str = "saturation-at-breakthrough";

/// Capillary pressures of the samples of a group at a saturation.
struct Level {
    saturation: f64,
    pressures: Vec<f64>,
}

impl Level {
    /// The quantiles; infinite ones are NaN.
    fn quantiles(&self) -> [f64; 5] {
        SHARES.map(|probability| {
            Some(quantile(&self.pressures, probability)).filter(|it| it.is_finite()).unwrap_or(f64::NAN)
        })
    }

    /// Fraction of the samples that have a pressure.
    fn reached(&self) -> f64 {
        let finite = self.pressures.iter().filter(|pressure| pressure.is_finite()).count();
        finite as f64 / self.pressures.len() as f64
    }

    /// The mean, if all samples have a pressure.
    fn mean(&self) -> f64 {
        if self.reached() == 1.0 { mean(&self.pressures) } else { f64::NAN }
    }
}

/// The complete draws of a group.
fn draws<'d>(engine: &'d Engine<'_>, group: usize, sampling: &Sampling) -> Vec<&'d Observed> {
    let of_group = engine.ensemble.samples.iter().zip(&engine.done).filter(|(sample, _)| sample.group == group);
    let kept: Vec<Option<&Observed>> = of_group.map(|(_, done)| done.as_ref().and_then(Done::observed)).collect();
    kept.chunks(sampling.rows()).flat_map(|rows| rows.iter().take(sampling.draws()).flatten().copied()).collect()
}

/// The pressures of a half cycle at each saturation.
fn levels(kept: &[&Observed], half_cycle: usize) -> Vec<Level> {
    let level = |k: usize| {
        let mut pressures: Vec<f64> = kept
            .iter()
            .filter_map(|kept| kept.curves.get(half_cycle)?.get(k).copied())
            .filter(|it| !it.is_nan())
            .collect();
        pressures.sort_by(f64::total_cmp);
        Level { saturation: k as f64 / (SATURATIONS - 1) as f64, pressures }
    };
    (0..SATURATIONS).map(level).filter(|level| !level.pressures.is_empty()).collect()
}

/// Writes the files of each group and returns the figures for the page. With several groups, file names end in the number of the group.
///
/// # Errors
/// [`FileError`] with the path and a remedy.
pub(crate) fn write(engine: &Engine<'_>, maps: &[Map], folder: &Path) -> Result<Vec<Figures>, FileError> {
    let Some(sampling) = &engine.study.sampling else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for (number, (group, map)) in engine.ensemble.groups.iter().zip(maps).enumerate() {
        let suffix = if maps.len() > 1 { format!("-{}", number + 1) } else { String::new() };
        let kept = draws(engine, number, sampling);
        let mut figures = Figures { name: group.name.clone(), ..Figures::default() };
        if kept.is_empty() {
            all.push(figures);
            continue;
        }
        let halves: Vec<Vec<Level>> = (0..map.processes().len()).map(|half| levels(&kept, half)).collect();
        if halves.iter().any(|levels| !levels.is_empty()) {
            let table = table(map.processes(), &halves);
            atomic::write(&folder.join(format!("bands{suffix}.csv")), &table.csv()?)?;
            if let Some(text) = drawn(&diagram(map.processes(), &halves), folder, &format!("band{suffix}"))? {
                figures.diagrams.push(text);
            }
        }
        if map.len() > 0 {
            let invaded_fraction =
                |part: usize| kept.iter().filter(|kept| kept.is_invaded(part)).count() as f64 / kept.len() as f64;
            let probability: Vec<f64> = (0..map.len()).map(invaded_fraction).collect();
            let values = if group.name.is_empty() { String::new() } else { format!(", {}", group.name) };
            let note = format!("{}, {} samples{values}", map.moment(), kept.len());
            write_map(map, &probability, folder, &suffix, &engine.study.title, note)?;
            figures.map = Some(format!("invasion{suffix}.png"));
        }
        all.push(figures);
    }
    Ok(all)
}

/// Draws the distributions of the saturation at breakthrough, a line for each group, as `breakthrough.svg`; `None` if no run has it.
///
/// # Errors
/// [`FileError`] with the path and a remedy.
pub(crate) fn distribution(sampling: &Sampling, groups: &[Group], folder: &Path) -> Result<Option<String>, FileError> {
    let trace = |group: &Group| {
        let values = group.values(sampling, AT_BREAKTHROUGH, sampling.count);
        let count = values.len() as f64;
        // A step at each sample.
        let step = |(k, value): (usize, f64)| [[value, k as f64 / count], [value, (k + 1) as f64 / count]];
        let points = values.into_iter().enumerate().flat_map(step).collect();
        Trace { name: group.name.clone(), stroke: Stroke::Full, points }
    };
    let labels = ["saturation of the invading phase at breakthrough", "share of the samples below"];
    let traces = groups.iter().map(trace).collect();
    let diagram = Diagram::linear("breakthrough", "Saturation at breakthrough", labels, traces);
    drawn(&diagram, folder, "breakthrough")
}

fn drawn(diagram: &Diagram, folder: &Path, name: &str) -> Result<Option<String>, FileError> {
    let path = folder.join(format!("{name}.svg"));
    let text = svg(diagram).map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
    if let Some(text) = &text {
        atomic::write(&path, text.as_bytes())?;
    }
    Ok(text)
}

fn table(processes: &[&'static str], halves: &[Vec<Level>]) -> Table {
    let mut heads = ["half-cycle", "process", "saturation"].map(str::to_owned).to_vec();
    heads.extend(SHARE_HEADS.map(|head| format!("{head}-Pa")));
    heads.extend(["mean-Pa", "share-with-pressure"].map(str::to_owned));
    let mut rows = Vec::new();
    for (half, (process, levels)) in processes.iter().zip(halves).enumerate() {
        rows.extend(levels.iter().map(|level| {
            let mut row = vec![(half + 1).to_string(), (*process).to_owned(), full(level.saturation)];
            row.extend(level.quantiles().into_iter().chain([level.mean(), level.reached()]).map(full));
            row
        }));
    }
    Table { heads, rows }
}

/// The bands of each half cycle: between the outer quantiles, on top of it between the inner ones, and the median.
fn diagram(processes: &[&'static str], halves: &[Vec<Level>]) -> Diagram {
    let mut traces = Vec::new();
    for (half, (process, levels)) in processes.iter().zip(halves).enumerate() {
        let name = if processes.len() > 2 { format!("{process} {}", half / 2 + 1) } else { (*process).to_owned() };
        let quantiles: Vec<(f64, [f64; 5])> =
            levels.iter().map(|level| (level.saturation, level.quantiles())).collect();
        for ([low, high], percentage) in [([0, 4], "90 %"), ([1, 3], "50 %")] {
            let both = quantiles.iter().filter(|(_, q)| q[low].is_finite() && q[high].is_finite());
            let forth = both.clone().map(|(saturation, q)| [*saturation, q[low]]);
            let back = both.rev().map(|(saturation, q)| [*saturation, q[high]]);
            let points: Vec<[f64; 2]> = forth.chain(back).collect();
            traces.push(Trace { name: format!("{name}, {percentage} of the samples"), stroke: Stroke::Band, points });
        }
        let points = quantiles.iter().map(|(saturation, q)| [*saturation, q[2]]).collect();
        traces.push(Trace { name: format!("{name}, median"), stroke: Stroke::Full, points });
    }
    Diagram::linear("band", TITLE, LABELS, traces)
}
