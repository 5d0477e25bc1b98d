//! The diagrams of a film: height as a function of position and time, particle trajectories, the contact line, the self-similar shape, the equilibrium shape
//! and the Cox-Voinov law: Figs. 3 to 6 and 9 to 12 of Pang and Ó Náraigh 2022, for any film. SI units, except where both axes are powers or ratios.

use super::history::{COX_VOINOV, CoxVoinov};
use super::observed::ObservedFilm;
use super::similarity::{EXPONENT, fit, shoot};
use meniscus_core::diagram::{Axis, Diagram, Map, Stroke, Trace};

/// Number of profiles plotted in one diagram.
const SHAPES: usize = 6;
/// Profiles later than this fraction of the run no longer depend on the initial shape.
const FORGETTING: f64 = 1.0e-3;
/// Number of points of the self-similar shape.
const SIMILARITY_POINTS: i32 = 200;

const POSITION: &str = "x (m)";
const TIME: &str = "time (s)";

/// All diagrams for which there are data.
pub(crate) fn all(observed: &ObservedFilm) -> Vec<Diagram> {
    let found = [
        Some(space_time(observed)),
        trajectories(observed),
        Some(contact_line(observed)),
        similarity(observed),
        rest(observed),
        cox_voinov(observed),
    ];
    found.into_iter().flatten().collect()
}

fn trace(name: impl Into<String>, stroke: Stroke, points: impl IntoIterator<Item = [f64; 2]>) -> Trace {
    Trace { name: name.into(), stroke, points: points.into_iter().collect() }
}

/// Height as a function of position and time, with the contact line.
fn space_time(observed: &ObservedFilm) -> Diagram {
    let (scales, history) = (observed.surroundings.scales, &observed.history);
    let map = Map {
        quantity: Axis::linear("height (m)"),
        x: observed.frame_positions().iter().map(|x| x * scales.length).collect(),
        y: history.frames.iter().map(|frame| frame.time * scales.time).collect(),
        values: history.frames.iter().flat_map(|frame| frame.heights.iter().map(|h| h * scales.height)).collect(),
        range: None,
        ringed: ("", Vec::new()),
    };
    let line = history.records.iter().map(|record| [record.position * scales.length, record.time * scales.time]);
    let traces = vec![trace("contact line", Stroke::Full, line)];
    let axes = [Axis::linear(POSITION), Axis::logarithmic(TIME)];
    Diagram { map: Some(map), ..Diagram::new("space-time", "Height over position and time", axes, traces) }
}

/// Tanner's law through the last point.
fn tanner(points: &[[f64; 2]], exponent: f64, name: &str) -> Option<Trace> {
    let last = points.last()?;
    let law = points.iter().map(|point| [point[0], last[1] * (point[0] / last[0]).powf(exponent)]);
    Some(trace(name, Stroke::Dashed, law))
}

fn trajectories(observed: &ObservedFilm) -> Option<Diagram> {
    let (scales, frames) = (observed.surroundings.scales, &observed.history.frames);
    let count = frames.first()?.particles.len();
    let trajectory = |i: usize| {
        frames.iter().filter_map(move |frame| Some([frame.time * scales.time, frame.particles.get(i)? * scales.length]))
    };
    let last: Vec<[f64; 2]> = trajectory(count.checked_sub(1)?).collect();
    let mut traces: Vec<Trace> = (0..count - 1).map(|i| trace("", Stroke::Thin, trajectory(i))).collect();
    if observed.surroundings.rest.is_none() {
        traces.extend(tanner(&last, EXPONENT, "Tanner's law, 1/7"));
    }
    traces.push(trace("last particle", Stroke::Full, last));
    let axes = [TIME, POSITION].map(Axis::logarithmic);
    Some(Diagram::new("trajectories", "Paths of particles right of the middle", axes, traces))
}

fn contact_line(observed: &ObservedFilm) -> Diagram {
    let surroundings = &observed.surroundings;
    let scales = surroundings.scales;
    let line: Vec<[f64; 2]> =
        observed.history.records.iter().map(|r| [r.time * scales.time, r.position * scales.length]).collect();
    let mut traces = Vec::new();
    if surroundings.rest.is_none() {
        let (exponent, name) = match surroundings.about_axis {
            true => (0.1, "Tanner's law, 1/10"),
            false => (EXPONENT, "Tanner's law, 1/7"),
        };
        traces.extend(tanner(&line, exponent, name));
    }
    if let Some(droplet) = surroundings.equilibrium {
        let at_rest = (surroundings.right + droplet.contact_line()) * scales.length;
        traces.push(trace("at rest", Stroke::Dashed, line.iter().map(|point| [point[0], at_rest])));
    }
    traces.push(trace("contact line", Stroke::Full, line));
    Diagram::new("contact-line", "The contact line over time", [TIME, POSITION].map(Axis::logarithmic), traces)
}

/// Profiles in self-similar variables, in which they collapse, and the solution of the equation without regularization.
fn similarity(observed: &ObservedFilm) -> Option<Diagram> {
    if !observed.surroundings.is_self_similar {
        return None;
    }
    let (profile, time, line) = (observed.profile(), observed.film.time(), observed.contact_line()?);
    let shape = fit(&profile, time, line.position)?;
    let frames: Vec<_> = observed.history.frames.iter().filter(|frame| frame.time > FORGETTING * time).collect();
    let step = frames.len().div_ceil(SHAPES).max(1);
    let positions = observed.frame_positions();
    let mut traces: Vec<Trace> = frames
        .iter()
        .rev()
        .step_by(step)
        .map(|frame| {
            let stretch = frame.time.powf(EXPONENT);
            let points = positions.iter().zip(&frame.heights).filter(|(x, _)| **x >= 0.0);
            let name = format!("{} s", two_digits(frame.time * observed.surroundings.scales.time));
            trace(name, Stroke::Full, points.map(|(x, h)| [x / stretch, h * stretch]))
        })
        .collect();
    let end = line.position / time.powf(EXPONENT);
    let eta: Vec<f64> =
        (0..=SIMILARITY_POINTS).map(|i| 1.2 * end * f64::from(i) / f64::from(SIMILARITY_POINTS)).collect();
    let mut law = shoot(shape.height, shape.curvature, &eta);
    // It never touches down: beyond its minimum it rises again, where there is no droplet any more.
    let lowest = (1..law.len()).find(|&i| law[i] > law[i - 1]).unwrap_or(law.len());
    law.truncate(lowest);
    traces.push(trace("f''' = eta/(7 f^2)", Stroke::Dashed, eta.iter().zip(law).map(|(eta, f)| [*eta, f])));
    // Beyond the droplet there is only the wall.
    traces.iter_mut().for_each(|trace| trace.points.retain(|point| point[0] < 1.6 * end));
    let labels = ["eta = x t^(-1/7), scaled", "t^(1/7) h, scaled"];
    Some(Diagram::linear("similarity", "Profiles in similarity variables", labels, traces))
}

fn rest(observed: &ObservedFilm) -> Option<Diagram> {
    let surroundings = &observed.surroundings;
    let (droplet, scales) = (surroundings.equilibrium?, surroundings.scales);
    let profile = observed.profile();
    let found = profile.x.iter().zip(&profile.height).map(|(x, h)| [x * scales.length, h * scales.height]);
    let known = profile.x.iter().map(|x| [x * scales.length, droplet.height(x - surroundings.right) * scales.height]);
    // A few hundred points per line keep the file small enough for a browser.
    let every = profile.x.len().div_ceil(800).max(1);
    let traces = vec![
        trace("at the end", Stroke::Full, found.step_by(every)),
        trace("closed form", Stroke::Dashed, known.step_by(every)),
    ];
    Some(Diagram::linear("rest", "The droplet at rest", [POSITION, "height (m)"], traces))
}

fn cox_voinov(observed: &ObservedFilm) -> Option<Diagram> {
    let surroundings = &observed.surroundings;
    let rest = surroundings.rest.filter(|_| surroundings.cap_sides.is_none())?;
    let (CoxVoinov { factor, length, .. }, points) = observed.history.cox_voinov(rest)?;
    let across = |[speed, position, _]: &[f64; 3]| COX_VOINOV * speed * (position / length).ln();
    let mut law: Vec<f64> = points.iter().map(across).collect();
    law.sort_by(f64::total_cmp);
    let measured = points.iter().map(|point| [across(point), point[2] / rest.powi(3)]);
    let fitted = law.iter().map(|x| [*x, 1.0 + factor / COX_VOINOV * x / rest.powi(3)]);
    let traces = vec![
        trace("found", Stroke::Dots, measured),
        trace(format!("{:.3} of the theory", factor / COX_VOINOV), Stroke::Dashed, fitted),
    ];
    let labels = ["9 Ca ln(x/d), scaled", "cubed slope over that at rest"];
    Some(Diagram::linear("cox-voinov", "The law of Cox and Voinov", labels, traces))
}

/// A number with two significant digits.
fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    if (1.0e-3..1.0e5).contains(&rounded) { format!("{rounded}") } else { format!("{rounded:e}") }
}
