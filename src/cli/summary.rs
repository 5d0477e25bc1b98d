//! The printed summary of a run: prescribed and measured contact angle, measures, numbers, files.

use super::output::{duration, readable, readable_within};
use crate::run::execute::Finished;
use crate::run::numbers::Number;
use crate::run::report::{Reading, Report, Status, Verdict};
use crate::run::steady::Steadiness;
use meniscus_case::{Case, Model};
use meniscus_core::solver::Clock;

/// Name of the measure that is printed next to the prescribed angle.
const ANGLE: &str = "contact-angle-deg";

/// The summary of a run as lines of text.
pub(crate) fn summary(finished: &Finished) -> String {
    let report = &finished.report;
    let row = |name: &str, value: &str| format!("  {name:<11} {value}");
    let show = |name: &str| finished.folder.join(name).display().to_string();
    let picture = match &finished.picture {
        Ok(path) => path.display().to_string(),
        Err(error) => format!("none: {error}"),
    };
    let frames = if matches!(report.case.model, Model::Network(_)) { "regions.pvd" } else { "particles.pvd" };
    let frames = Some(frames).filter(|_| !report.case.is_curve_alone());
    let mut lines = vec![report.case.title.clone(), ending(report)];
    lines.extend(angles(report));
    lines.extend(measures(report));
    lines.extend(report.expectations.iter().map(expectation));
    lines.extend(numbers(report));
    lines.extend(report.depth.iter().map(|depth| row("depth", depth)));
    lines.extend(report.warnings.iter().map(|warning| row("WARNING", warning)));
    lines.extend(frames.map(|frames| row("ParaView", &show(frames))));
    lines.push(row("picture", &picture));
    lines.extend(finished.page.iter().map(|page| match page {
        Ok(path) => row("page", &path.display().to_string()),
        Err(too_many) => row("page", &format!("none: {too_many}")),
    }));
    lines.extend([
        row("series", &show("series.csv")),
        row("report", &show("report.json")),
        row("wall time", &duration(report.wall_time_s.total)),
    ]);
    lines.join("\n") + "\n"
}

fn ending(report: &Report) -> String {
    let Clock { symbol, unit, .. } = report.clock.clock;
    let at = format!("{symbol} = {} {unit}, step {}", readable(report.clock.value), report.steps);
    // A run that became steady but continued has reached its end.
    let reached = match &report.steady {
        Some(steady) if steady.at_s == Some(report.clock.value) => format!("steady at {at}"),
        Some(Steadiness { at_s: Some(since), .. }) => format!("done at {at}, steady since {}", readable(*since)),
        Some(steady) if !steady.quantities.is_empty() => format!("done at {at}, not steady: {}", steady.unsettled()),
        Some(_) => format!("done at {at}, too early to tell whether it is steady"),
        None => format!("done at {at}"),
    };
    match report.status {
        Status::Done => reached,
        Status::ExpectationFailed => format!("{reached}; not as expected"),
        Status::Interrupted => format!("interrupted at {at}; continue with --resume"),
        Status::Failed => format!("FAILED at {at}; the last good state is in the output folder"),
    }
}

/// The contact angle that the case prescribes, or the two angles of hysteresis, in degrees.
fn requested_angle(case: &Case) -> Option<String> {
    let [smallest, largest] = match &case.model {
        Model::Sph(sph) => sph.wetting_model?.hysteresis_range(),
        Model::ThinFilm(film) => [film.contact_angle?; 2],
        // A network has the angle exactly: there is nothing to measure.
        Model::Network(_) => return None,
    }
    .map(f64::to_degrees);
    Some(if smallest == largest { format!("{smallest:.1}") } else { format!("{smallest:.1} to {largest:.1}") })
}

/// First words of the methods of angle measurement, and their short names.
const METHODS: [(&str, &str); 3] = [
    ("circles fitted", " by circles"),
    ("arcs of Young and Laplace fitted", " by Young-Laplace arcs"),
    ("angle of the tangent", " by the steepest tangent"),
];

/// A short name of the method of a contact angle; empty if it has none.
fn short_method(method: &str) -> &'static str {
    METHODS.iter().find(|(start, _)| method.starts_with(start)).map_or("", |(_, name)| name)
}

fn with_uncertainty(reading: &Reading) -> String {
    let Some(value) = reading.value else { return format!("not measured ({})", reading.method) };
    // A count, such as that of ganglia.
    if reading.unit.is_empty() && reading.uncertainty.is_none() && value.fract() == 0.0 {
        return format!("{value:.0}");
    }
    let uncertainty = reading.uncertainty.map_or(String::new(), |u| format!(" +- {}", readable(u)));
    let motion = reading.not_at_rest.as_ref();
    let motion = motion.map_or(String::new(), |m| format!(", not at rest: {} {}", readable(m.rate), m.unit));
    let found = format!("{}{uncertainty} {}", readable(value), reading.unit);
    found.trim_end().to_owned() + short_method(&reading.method) + &motion
}

fn angles(report: &Report) -> Option<String> {
    let requested = requested_angle(&report.case)?;
    let measured = match report.measures.get(ANGLE) {
        Some(reading) if reading.value.is_some() => format!("measured {}", with_uncertainty(reading)),
        Some(reading) => with_uncertainty(reading),
        None => "not measured".into(),
    };
    Some(format!("  contact angle through the wetting phase: requested {requested} deg, {measured}"))
}

fn measures(report: &Report) -> impl Iterator<Item = String> {
    let is_requested = requested_angle(&report.case).is_some();
    let width = report.measures.keys().map(String::len).max().unwrap_or(0);
    let shown = report.measures.iter().filter(move |(name, _)| !(is_requested && *name == ANGLE));
    shown.map(move |(name, reading)| format!("  {name:<width$}  {}", with_uncertainty(reading)))
}

fn expectation(verdict: &Verdict) -> String {
    let word = match verdict.pass {
        Some(true) => "met   ",
        Some(false) => "MISSED",
        None => "open  ",
    };
    let within = |value: f64| readable_within(value, verdict.tolerance);
    let measured = verdict.measured.map_or("not measured".to_owned(), within);
    let (value, tolerance) = (within(verdict.value), readable(verdict.tolerance));
    format!("  {word}  {}: expected {value} +- {tolerance}, measured {measured}", verdict.measure)
}

fn numbers(report: &Report) -> Option<String> {
    let number = |number: &Number| {
        let asked = number.asked.map_or(String::new(), |asked| format!(" (asked {})", readable(asked)));
        format!("{} {}{asked}", number.symbol, readable(number.value))
    };
    let (numbers, length) =
        (report.numbers.iter().map(number).collect::<Vec<_>>().join("  "), report.length_of_numbers.name);
    let of = match report.case.model {
        Model::Network(_) => String::new(),
        Model::Sph(_) | Model::ThinFilm(_) => format!("  (L: {length}, U: fastest speed recorded)"),
    };
    (!numbers.is_empty()).then(|| format!("  {numbers}{of}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::execute::{Job, Mode, execute};
    use crate::run::mock::{MockSolver, case};
    use crate::run::report::Motion;
    use crate::run::simulation::Unwatched;
    use meniscus_wetting::{Wetting, Young};

    #[test]
    fn the_summary_shows_both_angles_measures_and_files() {
        let mut case = case();
        let Model::Sph(sph) = &mut case.model else { panic!("the mock case is one of SPH") };
        sph.wetting_model = Some(Wetting::Young(Young { contact_angle_deg: 40.0 }));
        let folder = tempfile::tempdir().unwrap();
        let job = Job { case: &case, resolved: "", folder: folder.path().to_path_buf(), mode: Mode::New };
        let never = std::sync::atomic::AtomicBool::new(false);
        let mut finished = execute(&job, &mut MockSolver::new(), &never, &mut Unwatched).unwrap();
        assert!(summary(&finished).contains("requested 40.0 deg, not measured\n"));
        let reading = |value, unit: &str, uncertainty, method: &str| Reading {
            value,
            unit: unit.into(),
            uncertainty,
            method: method.into(),
            not_at_rest: None,
        };
        finished.report.measures.insert(ANGLE.into(), reading(None, "deg", None, "no line"));
        assert!(summary(&finished).contains("requested 40.0 deg, not measured (no line)\n"));
        let mut angle = reading(Some(41.3), "deg", Some(1.2), "circles fitted to the contour");
        angle.not_at_rest = Some(Motion { rate: -7.0, unit: "deg/s".into() });
        finished.report.warnings.push("three particles fly alone".into());
        finished.report.measures.insert(ANGLE.into(), angle);
        finished.report.measures.insert("blobs".into(), reading(Some(2.0), "", None, "counted"));
        let text = summary(&finished);
        for words in [
            "Particles on circles\ndone at t = 1.000 s, step 50",
            "requested 40.0 deg, measured 41.30 +- 1.200 deg by circles, not at rest: -7.000 deg/s",
            "  WARNING     three particles fly alone\n",
            "radius-m           0.3333 +- 1.000e-9 m",
            "blobs              2\n",
            "missing-angle-deg  not measured (there is no contact line)",
            "met     radius-m: expected 0.3333",
            "particles.pvd",
            "picture.png",
            "wall time",
        ] {
            assert!(text.contains(words), "`{words}` is missing in\n{text}");
        }
    }
}
