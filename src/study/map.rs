//! The maps of a study: a measure over two parameters, one map for each combination of the others.

use super::apart::Apart;
use super::convergence::spacing;
use super::definition::{MapPlan, Study};
use super::raw::RawScale;
use super::results::{RUN_NUMBERS, RunResult, grouped};
use super::values::{ascending, is_geometric, numbers};
use super::wording::Wording;
use meniscus_core::diagram::{Axis, Diagram, Map};
use meniscus_output::diagram::{DiagramError, Layout, svg_with};

/// The size of a map and of its title in pixels.
const LAYOUT: Layout = Layout { size: (640, 480), title: 18, x_positions: Vec::new() };

/// Fewest values of an axis that has a map without being asked for.
const FEWEST: usize = 3;

/// The maps that a study asks for; else, if exactly two numbers vary, those of the measures of its curves, or of the first measure of its table.
pub(crate) fn plans(study: &Study) -> Vec<MapPlan> {
    let [x, y] = match &axes(study)[..] {
        [x, y] if study.report.maps.is_empty() => [x, y].map(|name| (*name).to_owned()),
        _ => return study.report.maps.clone(),
    };
    let is_parameter = |name: &str| study.parameters().any(|column| column.name == name);
    let curves = study.report.curves.iter().filter(|curve| !curve.error).map(|curve| &curve.y);
    let table = study.report.measures.iter().flatten().take(usize::from(study.report.curves.is_empty()));
    let mut measures: Vec<&String> = Vec::new();
    for name in curves.chain(table).filter(|name| !is_parameter(name) && !RUN_NUMBERS.contains(&name.as_str())) {
        if !measures.contains(&name) {
            measures.push(name);
        }
    }
    let scale = |name: &str| match study.parameters().find(|column| column.name == name) {
        Some(column) if is_geometric(&numbers(&column.values)) => RawScale::Logarithmic,
        _ => RawScale::Linear,
    };
    let plan = |measure: &String| MapPlan {
        title: None,
        measure: measure.clone(),
        x_scale: scale(&x),
        y_scale: scale(&y),
        x: x.clone(),
        y: y.clone(),
        scale: RawScale::Linear,
    };
    measures.into_iter().map(plan).collect()
}

/// The parameters of the axes that vary if these are numbers with three values or more; none of a study of samples or spacings, which are not for maps.
fn axes(study: &Study) -> Vec<&str> {
    if study.sampling.is_some() || spacing(study).is_some() {
        return Vec::new();
    }
    let varying: Vec<_> =
        study.axes.iter().filter(|axis| axis.len() > 1).filter_map(|axis| axis.columns.first()).collect();
    let is_wide = varying.iter().all(|column| {
        let numbers = numbers(&column.values);
        numbers.len() >= FEWEST && numbers.len() == column.values.len()
    });
    varying.into_iter().filter(|_| is_wide).map(|column| column.name.as_str()).collect()
}

/// Draws a map for each combination of the other parameters; those without a value yet are left out.
pub(crate) fn svgs(
    plan: &MapPlan,
    study: &Study,
    results: &[RunResult],
    wording: &Wording,
) -> Result<Vec<String>, DiagramError> {
    let maps = diagrams(plan, study, results, wording);
    let drawn: Result<Vec<Option<String>>, _> = maps.iter().map(|map| svg_with(map, &LAYOUT)).collect();
    Ok(drawn?.into_iter().flatten().collect())
}

fn diagrams(plan: &MapPlan, study: &Study, results: &[RunResult], wording: &Wording) -> Vec<Diagram> {
    let is_sampled = |name: &str| study.sampling.as_ref().is_some_and(|sampling| sampling.has(name));
    let others = Apart { shown: &[&plan.x, &plan.y], results }.names(Vec::new(), |name| !is_sampled(name));
    let labels = [&plan.x, &plan.y, &plan.measure].map(|name| wording.label(name));
    let title = plan.title.clone().unwrap_or_else(|| {
        let [x, y, measure] = [0, 1, 2].map(|k| labels[k].words.as_str());
        format!("{measure} over {x} and {y}")
    });
    let axis =
        |k: usize, scale| Axis { label: labels[k].to_string().into(), logarithmic: scale == RawScale::Logarithmic };
    let axes = [axis(0, plan.x_scale), axis(1, plan.y_scale)];
    let quantity = axis(2, plan.scale);
    let values =
        results.iter().filter_map(|result| result.number(&plan.measure)).filter(|value| quantity.shows(*value));
    // The same colors in all maps.
    let range = values.fold(None, |range: Option<[f64; 2]>, value| {
        Some(range.map_or([value, value], |[low, high]| [low.min(value), high.max(value)]))
    });
    let groups =
        grouped(results.iter(), |result| wording.values(&result.run, |name| others.iter().any(|other| other == name)));
    let diagram = |(of, runs): (String, Vec<&RunResult>)| {
        let title = if of.is_empty() { title.clone() } else { format!("{title}, {of}") };
        let map = Map { range, ..map(plan, &axes, quantity.clone(), &runs) };
        Diagram { map: Some(map), ..Diagram::new("map", title, axes.clone(), Vec::new()) }
    };
    groups.into_iter().map(diagram).collect()
}

/// The map of some runs; a cell with several runs, which are samples, has their mean.
fn map(plan: &MapPlan, axes: &[Axis; 2], quantity: Axis, runs: &[&RunResult]) -> Map {
    let positions = |name: &str, axis: &Axis| {
        ascending(runs.iter().filter_map(|run| run.number(name)).filter(|position| axis.shows(*position)))
    };
    let (x, y) = (positions(&plan.x, &axes[0]), positions(&plan.y, &axes[1]));
    let mut sums = vec![(0.0, 0_usize); x.len() * y.len()];
    let mut ringed = Vec::new();
    for run in runs {
        let index = |name: &str, positions: &[f64]| {
            let value = run.number(name)?;
            positions.iter().position(|position| *position == value)
        };
        let (Some(column), Some(row)) = (index(&plan.x, &x), index(&plan.y, &y)) else { continue };
        let cell = row * x.len() + column;
        if let Some(value) = run.number(&plan.measure).filter(|value| quantity.shows(*value)) {
            sums[cell] = (sums[cell].0 + value, sums[cell].1 + 1);
            if run.motion(&plan.measure).is_some() && !ringed.contains(&cell) {
                ringed.push(cell);
            }
        }
    }
    // 0/0 is NaN: no value.
    let values = sums.into_iter().map(|(sum, count)| sum / count as f64).collect();
    Map { quantity, x, y, values, range: None, ringed: ("not at rest", ringed) }
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, number, set_moving, study};
    use super::super::results::RunState;
    use super::*;

    const AXES: &str =
        "[[axis]]\nkey = 'angle'\nvalues = [30, 60, 90]\n[[axis]]\nkey = 'rate'\nvalues = [1.0, 10.0, 100.0, 1000.0]\n";

    #[test]
    fn a_map_has_a_cell_for_each_run_and_shows_what_failed_and_what_moves() {
        let study =
            study(&format!("{AXES}[[report.map]]\nx = 'rate'\ny = 'angle'\nmeasure = 'm'\nx-scale = 'logarithmic'\n"));
        let mut results = complete(&study, |run| number(run, "angle") - number(run, "rate"));
        set_moving(&mut results[2], 0.5);
        results[5].state = RunState::Partial;
        let wording = Wording::of(&study, &results);
        let maps = diagrams(&study.report.maps[0], &study, &results, &wording);
        let map = maps[0].map.as_ref().unwrap();
        assert_eq!((maps.len(), &*maps[0].title), (1, "m over rate and angle"));
        assert_eq!((&map.x[..], &map.y[..]), (&[1.0, 10.0, 100.0, 1000.0][..], &[30.0, 60.0, 90.0][..]));
        assert_eq!((map.values[0], map.values[11], map.ringed.1.as_slice()), (29.0, -910.0, &[2][..]));
        assert_eq!(
            map.values.iter().map(|value| value.is_nan()).collect::<Vec<_>>(),
            (0..12).map(|k| k == 5).collect::<Vec<_>>()
        );
        let drawn = svgs(&study.report.maps[0], &study, &results, &wording).unwrap();
        assert!(["m (degrees)", "no value", "not at rest", "-910"].iter().all(|word| drawn[0].contains(word)));
        results.iter_mut().for_each(|result| result.state = RunState::New);
        assert!(svgs(&study.report.maps[0], &study, &results, &wording).unwrap().is_empty());
    }

    #[test]
    fn each_combination_of_the_other_parameters_has_a_map_in_the_same_colors() {
        let study = study(&format!(
            "{AXES}[[axis]]\nkey = 'films'\nvalues = ['none', 'rings']\n[[report.map]]\nx = 'rate'\ny = 'angle'\nmeasure = 'm'\ntitle = 'T'\n"
        ));
        let results = complete(&study, |run| run.index as f64);
        let maps = diagrams(&study.report.maps[0], &study, &results, &Wording::of(&study, &results));
        assert_eq!(maps.iter().map(|map| &*map.title).collect::<Vec<_>>(), ["T, films = none", "T, films = rings"]);
        assert!(maps.iter().all(|map| map.map.as_ref().unwrap().range == Some([1.0, 24.0])));
    }

    #[test]
    fn a_cell_of_samples_has_their_mean() {
        let study = study(&format!(
            "{AXES}[[axis]]\nkey = 'tension'\ndistribution = {{ uniform = {{ from = 1, to = 2 }} }}\n[sampling]\ncount = 4\n\
             [[report.map]]\nx = 'rate'\ny = 'angle'\nmeasure = 'm'\n"
        ));
        let results = complete(&study, |run| number(run, "angle") + number(run, "sample"));
        let maps = diagrams(&study.report.maps[0], &study, &results, &Wording::of(&study, &results));
        let first = results.iter().take(4).map(|result| number(&result.run, "sample")).sum::<f64>() / 4.0;
        assert_eq!((maps.len(), maps[0].map.as_ref().unwrap().values[0]), (1, 30.0 + first));
    }

    #[test]
    fn two_axes_of_numbers_have_the_map_of_their_curves_or_of_the_first_measure() {
        let of =
            |text: &str| plans(&study(text)).into_iter().map(|plan| (plan.measure, plan.y_scale)).collect::<Vec<_>>();
        let curve = |y: &str| format!("[[report.curve]]\nx = 'angle'\ny = '{y}'\n");
        let one = |measure: &str| vec![(measure.to_owned(), RawScale::Logarithmic)];
        assert_eq!(of(&format!("{AXES}[report]\nmeasures = ['m', 'n']\n")), one("m"));
        assert_eq!(of(&format!("{AXES}{}{}{}", curve("n"), curve("n"), curve("cpu-s"))), one("n"));
        assert!(of(AXES).is_empty());
        let spacing = AXES.replace("'rate'", "'sph.spacing'");
        let three = format!("{AXES}[[axis]]\nkey = 'c'\nvalues = [1, 2, 3]\n");
        let narrow = AXES.replace("[30, 60, 90]", "[30, 60]");
        for axes in [spacing, three, narrow] {
            assert!(of(&format!("{axes}[report]\nmeasures = ['m']\n")).is_empty(), "{axes}");
        }
    }
}
