//! The measures of a network.

use super::cycles::{Cycles, FluidPhase};
use super::displacement::EventKind;
use super::flow::{along, drive, relative_at_end};
use super::model::{Configuration, Model};
use super::permeability::Drive;
use super::tables::{kept, length};
use super::warnings::notes_on_permeability;
use meniscus_case::network::FilmModel;
use meniscus_core::solver::{Measure, measure};

/// Measures that need the conductance of every throat.
const PERMEABILITIES: [&str; 4] =
    ["permeability-x-m2", "permeability-y-m2", "relative-permeability-wetting", "relative-permeability-non-wetting"];

/// Measures that need the entry pressure of every throat.
const ENTRY_PRESSURES: [&str; 3] =
    ["smallest-entry-pressure-Pa", "median-entry-pressure-Pa", "largest-entry-pressure-Pa"];

/// Measures that repeat the displacement with corner films that are connected otherwise.
const OTHER_FILMS: [&str; 3] =
    ["trapped-saturation-without-films", "trapped-saturation-with-rings", "trapped-saturation-with-joined-films"];

/// Which of the measures are found that take as long as the displacement itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Costly {
    /// Permeabilities, absolute and relative.
    pub permeabilities: bool,
    /// The distribution of the entry pressures.
    pub entry_pressures: bool,
    /// What corner films that are connected otherwise would trap.
    pub other_films: bool,
}

impl Costly {
    /// All of them.
    pub const ALL: Self = Self { permeabilities: true, entry_pressures: true, other_films: true };

    /// All of them, or none where only the curve is wanted.
    pub(crate) fn of(config: &Configuration) -> Self {
        let is_whole = config.is_whole();
        Self { permeabilities: is_whole, entry_pressures: is_whole, other_films: is_whole }
    }

    /// Those of which a name is wanted.
    pub fn wanted(is_wanted: impl Fn(&str) -> bool) -> Self {
        let any = |names: &[&str]| names.iter().any(|name| is_wanted(name));
        Self {
            permeabilities: any(&PERMEABILITIES),
            entry_pressures: any(&ENTRY_PRESSURES),
            other_films: any(&OTHER_FILMS),
        }
    }
}

/// All measures, without the costly ones that are left out.
pub(crate) fn all(model: &Model, costly: Costly) -> Vec<Measure> {
    let config = &model.config;
    let mut found = of_network(model, costly);
    found.extend(replaced(model));
    if let Some(cycles) = &model.cycles {
        found.extend(of_displacement(config, cycles));
        found.extend(front_width(config, cycles));
        if costly.other_films && cycles.is_done {
            found.extend(with_other_films(model));
        }
    }
    found
}

/// What the same displacement traps with corner films that are connected in the other two ways.
fn with_other_films(model: &Model) -> Vec<Measure> {
    let [without, with_rings, joined] = OTHER_FILMS;
    let name = |films: FilmModel| match films {
        FilmModel::None => without,
        FilmModel::Rings => with_rings,
        FilmModel::Joined => joined,
    };
    let method = "trapped-saturation of the same displacement with another network.films";
    let of = |&(films, trapped): &(FilmModel, f64)| measure(name(films), trapped, "").by(method);
    model.trapped_otherwise().iter().map(of).collect()
}

/// The measures without a displacement.
pub(crate) fn of_network(model: &Model, costly: Costly) -> Vec<Measure> {
    let mut found = of_geometry(&model.config);
    if costly.permeabilities {
        found.extend(permeabilities(model));
    }
    if costly.entry_pressures {
        found.extend(entry_pressures(model));
    }
    found.extend(bond_number(&model.config));
    found
}

fn of_geometry(config: &Configuration) -> Vec<Measure> {
    let pores = &config.pores;
    let ratio = pores.persistence;
    let widths = || kept(config).map(|throat| throat.width);
    let (narrowest, widest) =
        widths().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), width| (low.min(width), high.max(width)));
    let number = |value: f64| if value.is_finite() { value } else { f64::NAN };
    let porosity = match config.region {
        Some(_) => "area of the pore space in network.region in closed form over that of the region",
        None => "sum of the pore areas in closed form over the area of the domain",
    };
    vec![
        measure("porosity", config.porosity, "").by(porosity),
        measure("pores", pores.main_region.len() as f64, "")
            .by(format!("maxima of the wall distance, joined at a persistence ratio above {ratio}")),
        measure("throats", pores.throats.len() as f64, "")
            .by("saddles of the wall distance between pores, openings not counted"),
        measure("narrowest-throat-m", number(narrowest), "m").by("width of the narrowest throat that the merge left"),
        measure("widest-throat-m", number(widest), "m").by("width of the widest throat that the merge left"),
    ]
}

fn permeabilities(model: &Model) -> Vec<Measure> {
    let [x, y, of_wetting, of_other] = PERMEABILITIES;
    let config = &model.config;
    let of_axis = |axis: usize, name| {
        let method = match drive(config, axis) {
            Some(Drive::Periodic(_)) => "flow through all throats under a mean gradient, periodic sides joined",
            Some(Drive::Sides(_)) => "flow through all throats between the open sides",
            None => "both sides along this axis would have to be open or periodic",
        };
        let notes: String = notes_on_permeability(config, axis).iter().map(|note| format!("; {note}")).collect();
        measure(name, along(model, axis), "m2").by(format!("{method}{notes}"))
    };
    let mut found = vec![of_axis(0, x), of_axis(1, y)];
    if let Some([_, wetting, other]) = relative_at_end(model) {
        let method = "permeability of the throats between regions that the phase holds, and of rings of films, over that of all throats, at the end of the last half cycle";
        found.push(measure(of_wetting, wetting, "").by(method));
        found.push(measure(of_other, other, "").by(method));
    }
    found
}

fn entry_pressures(model: &Model) -> Vec<Measure> {
    let [smallest, median, largest] = ENTRY_PRESSURES;
    let config = &model.config;
    let Some(all) = model.entry_pressures() else { return Vec::new() };
    let mut pressures: Vec<f64> = config.pores.throats.iter().map(|&throat| all[throat]).collect();
    pressures.sort_by(f64::total_cmp);
    let at = |index: Option<usize>| index.and_then(|index| pressures.get(index)).copied().unwrap_or(f64::NAN);
    let last = pressures.len().checked_sub(1);
    let method = "entry pressures of all throats in drainage, at the receding angle";
    vec![
        measure(smallest, at(Some(0)), "Pa").by(format!("the smallest of the {method}")),
        // Of an even number, the mean of the two in the middle.
        measure(median, 0.5 * (at(last.map(|last| last / 2)) + at(last.map(|last| last.div_ceil(2)))), "Pa")
            .by(format!("the median of the {method}")),
        measure(largest, at(last), "Pa").by(format!("the largest of the {method}")),
    ]
}

/// The ratio of gravity to capillarity over the distance between two pores.
fn bond_number(config: &Configuration) -> Option<Measure> {
    let gravity = config.gravity.as_ref()?;
    let lengths = || kept(config).map(|throat| length(config, throat));
    let mean = lengths().sum::<f64>() / lengths().count() as f64;
    let acts = config.inlet.map_or("", |inlet| match gravity.stabilizes(inlet / 2, inlet.is_multiple_of(2)) {
        Some(true) => "; it delays the first invasion the more the farther this gets, so that its front is flat",
        Some(false) => "; it drives the first invasion on, which fingers",
        None => "; it acts across the flow",
    });
    let method = format!(
        "|rho_n - rho_w| g L^2/tension, g in the plane, L = {mean:.3e} m the mean distance between centers of neighboring pores{acts}"
    );
    Some(measure("bond-number", gravity.gradient.norm() * mean * mean, "").by(method))
}

/// With gravity: the width of the front at first breakthrough.
fn front_width(config: &Configuration, cycles: &Cycles) -> Option<Measure> {
    let axis = config.gravity.and(config.inlet)? / 2;
    let at: Vec<f64> = cycles
        .breakthrough()
        .map_or_else(Vec::new, |moment| moment.displacement.front().map(|point| point[axis]).collect());
    let mean = at.iter().sum::<f64>() / at.len() as f64;
    let variance = at.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / at.len() as f64;
    let method = "standard deviation of the places of menisci towards the displaced phase, without what is trapped, along the flow at first breakthrough";
    Some(measure("front-width-m", variance.sqrt(), "m").by(method))
}

/// Number of measured entry pressures, if any are given.
fn replaced(model: &Model) -> Option<Measure> {
    let first = model.cycles.as_ref().map(|cycles| &cycles.half_cycles()[0].conditions);
    let conditions = first.or(model.config.entry.as_ref()).filter(|conditions| !conditions.measured.is_empty())?;
    let given = conditions.measured.len();
    let method = format!(
        "throats whose entry pressure is the measured one in the first half cycle, of {given} that are given; the others are of another angle or have none"
    );
    Some(measure("measured-entry-pressures", model.measured_throats(conditions) as f64, "").by(method))
}

fn of_displacement(config: &Configuration, cycles: &Cycles) -> Vec<Measure> {
    let first = &cycles.half_cycles()[0];
    let (pressure, saturation) = cycles.record.outcomes[0].breakthrough.unwrap_or((f64::NAN, f64::NAN));
    let reached = if !config.has_outlet() {
        "there is no outlet"
    } else if saturation.is_nan() {
        "the invading phase did not reach the outlet"
    } else if pressure.is_nan() {
        "the outlet is reached through openings alone, which have no entry pressure"
    } else {
        "at the event by which the invading phase reached the outlet"
    };
    let (name, space) = (first.invading.process(), config.space());
    let films = match cycles.film_model() {
        Some(FilmModel::None) => "; no films in corners, although they hold some",
        Some(FilmModel::Rings) => "; films in corners as rings around each wall",
        Some(FilmModel::Joined) => "; all films in corners joined",
        None => "",
    };
    let invading = cycles.half_cycle().invading;
    let wetting = cycles.saturation();
    let (left, of) = match invading {
        FluidPhase::NonWetting => (wetting, "wetting"),
        FluidPhase::Wetting => (1.0 - wetting, "non-wetting"),
    };
    let ending = if cycles.is_done { "at the end" } else { "so far, as the displacement continues" };
    let largest = cycles.history().iter().filter(|entry| entry.half_cycle == 0);
    let applied = largest.map(|entry| entry.applied).chain(cycles.record.outcomes[0].last);
    let largest = applied.map(|applied| config.curvature(first.invading, applied));
    let largest = largest.fold(f64::NAN, |a, b| if a.abs() > b.abs() { a } else { b });
    let mut found = vec![
        measure("breakthrough-pressure-Pa", config.pressure(first.invading, pressure), "Pa")
            .by(format!("capillary pressure p_n - p_w of the first {name}, {reached}")),
        measure("saturation-at-breakthrough", saturation, "")
            .by(format!("share of the {space} that the invading phase of the first {name} holds, {reached}")),
        measure("residual-saturation", left, "")
            .by(format!("share of the {space} that the {of} phase, the displaced one, holds {ending}")),
        measure("trapped-saturation", cycles.trapped_saturation(), "")
            .by(format!("share of the {space} where the {of} phase has no path to the outlet, {ending}{films}")),
        measure("final-wetting-saturation", wetting, "")
            .by(format!("share of the {space} that the wetting phase holds, {ending}")),
        measure("largest-capillary-pressure-Pa", config.tension.unwrap_or(f64::NAN) * largest, "Pa")
            .by(format!("p_n - p_w applied at the end of the first {name}")),
        measure("events", cycles.history().len() as f64, "")
            .by("bursts, touches, overlaps, snap-offs and reconnections of all half cycles"),
    ];
    if let Some(movable) = cycles.movable_saturation() {
        let method = format!(
            "share of the {space} in trapped ganglia so tall that their own head would push them on through a throat; they stay in place here, {ending}"
        );
        found.push(measure("movable-trapped-saturation", movable, "").by(method));
    }
    if cycles.has_films() {
        let closed = cycles.history().iter().filter(|entry| entry.kind == EventKind::SnapOff).count();
        let share = format!("share of the {space} that films in corners hold");
        found.extend([
            measure("film-saturation", cycles.film_saturation(), "")
                .by(format!("{share}, a part of the wetting saturation, {ending}")),
            measure("snap-offs", closed as f64, "").by("throats that films in corners closed, in all half cycles"),
        ]);
    }
    found.extend(hysteresis(config, cycles));
    found
}

/// Work dissipated by a cycle of drainage and imbibition.
fn hysteresis(config: &Configuration, cycles: &Cycles) -> Option<Measure> {
    if cycles.half_cycles().len() < 2 || !cycles.is_done {
        return None;
    }
    let last = cycles.half_cycles().len() - 2;
    let work = if cycles.has_films() { work_on_curve(cycles, last) } else { work_of_events(config, cycles, last) };
    let value = config.tension? * work;
    Some(measure("hysteresis-work-J-per-m3", value, "J/m3").by(
        "integral of p_n - p_w over the saturation that events displaced along the last drainage and imbibition: \
             work per pore volume; what enters through openings at their beginnings takes no pressure and is left \
             out",
    ))
}

/// The integral of curvature over saturation in 1/m from a half cycle on, by the trapezoidal rule between the points of the curve.
fn work_on_curve(cycles: &Cycles, first: usize) -> f64 {
    let pairs = cycles.record.curve.windows(2).filter(|pair| pair[0].half_cycle >= first);
    let within = pairs.filter(|pair| pair[0].half_cycle == pair[1].half_cycle);
    -within
        .map(|pair| 0.5 * (pair[0].curvature + pair[1].curvature) * (pair[1].saturation - pair[0].saturation))
        .sum::<f64>()
}

/// The same if saturations change only at events.
fn work_of_events(config: &Configuration, cycles: &Cycles, last: usize) -> f64 {
    let mut work = 0.0;
    for (half, outcome) in cycles.record.outcomes.iter().enumerate().skip(last) {
        // The initial filling through openings needs no pressure.
        let mut before = outcome.first_saturation[1];
        for entry in cycles.history().iter().filter(|entry| entry.half_cycle == half) {
            work -= config.curvature(cycles.half_cycles()[half].invading, entry.applied) * (entry.saturation - before);
            before = entry.saturation;
        }
    }
    work
}
