//! Checks of `[sph.measure.permeability]`: one fluid, periodic sides, and a force along each periodic axis.

use super::case_file::Model;
use super::output::Output;
use super::side::{SIDES, Side};
use super::sph::Sph;
use meniscus_core::input::Checker;
use meniscus_geometry::spec::GeometrySpec;

/// Fewest records under each force: the last two show whether the flow is steady.
const FEWEST_RECORDS: f64 = 2.0;

/// Checks the requirements of the measure on the model.
pub(super) fn permeability(checker: &mut Checker, model: Option<&Model>, geometry: Option<&GeometrySpec>) {
    let Some(sph) = measured(model) else { return };
    if sph.non_wetting.is_some() {
        checker.refuse(
            "sph.phases.non-wetting",
            "a permeability is measured with one fluid, and there are two: their interface moves or resists the flow",
            "leave out the second phase with its interface and wetting, or measure [sph.measure.relative-permeability] with a frozen interface",
        );
    }
    if sph.measure.cylinder_array || sph.measure.poiseuille {
        let other = if sph.measure.cylinder_array { "cylinder-array" } else { "poiseuille" };
        checker.refuse(
            "sph.measure.permeability",
            format!("the force acts along x and y in turn, and [sph.measure.{other}] needs a single force"),
            "keep one of both",
        );
    }
    if no_side_is_driven(checker, sph) {
        force(checker, sph);
    }
    let has_walls = sph.sides.each().contains(&Side::Wall);
    if geometry.is_some_and(|geometry| geometry.shapes.is_empty()) && !has_walls {
        checker.refuse("sph.measure.permeability", "there are no solids that resist the flow", "add [geometry] shapes");
    }
}

/// Whether no side is open, driven or moving; refuses those that are.
pub(super) fn no_side_is_driven(checker: &mut Checker, sph: &Sph) -> bool {
    let kinds = sph.sides.each();
    let before = checker.problems.len();
    for (i, side) in SIDES.iter().enumerate() {
        let is_driven = sph.open[i].is_some() || matches!(kinds[i], Side::Inlet | Side::Outlet);
        if is_driven {
            let opposite = SIDES[i ^ 1];
            checker.refuse(
                if kinds[i] == Side::Periodic { format!("sph.sides.open.{side}") } else { format!("sph.sides.{side}") },
                format!(
                    "fluid is driven through the side `{side}`, and a permeability is measured with sph.gravity alone"
                ),
                format!("set {side} and {opposite} to \"periodic\" with no table in [sph.sides.open]"),
            );
        }
        if sph.wall_speeds[i] != 0.0 {
            let help = "leave the speed out, or [sph.measure.permeability]";
            checker.refuse(
                format!("sph.sides.speed.{side}"),
                "a moving wall drives the flow in addition to sph.gravity",
                help,
            );
        }
    }
    checker.problems.len() == before
}

/// Refuses a force that is incompatible with the sides.
fn force(checker: &mut Checker, sph: &Sph) {
    let is_periodic = sph.sides.periodic();
    if is_periodic == [false; 2] {
        checker.refuse(
            "sph.measure.permeability",
            "nothing can flow through: no side is periodic",
            "set left and right, or bottom and top, to \"periodic\" in [sph.sides]",
        );
        return;
    }
    for axis in 0..2 {
        let (name, force) = (["x", "y"][axis], sph.gravity[axis]);
        let [one, other] = [SIDES[2 * axis], SIDES[2 * axis + 1]];
        if is_periodic[axis] && force == 0.0 {
            checker.refuse(
                "sph.gravity",
                format!("the sides `{one}` and `{other}` are periodic, and the force along {name} is 0"),
                "give a component along each axis with periodic sides, in m/s2; they act one after the other",
            );
        } else if !is_periodic[axis] && force != 0.0 {
            checker.refuse(
                "sph.gravity",
                format!("a force along {name} drives nothing through the closed sides `{one}` and `{other}`"),
                format!("set its component along {name} to 0: the tensor then has the column of the other axis; or make these sides periodic"),
            );
        }
    }
}

/// Checks the records and the end; `end` in s is missing if it was wrong.
pub(super) fn records(
    checker: &mut Checker,
    model: Option<&Model>,
    end: Option<f64>,
    is_steady: bool,
    output: &Output,
) {
    let (Some(sph), Some(end)) = (measured(model), end) else { return };
    let forces = (0..2).filter(|&axis| sph.gravity[axis] != 0.0).count().max(1) as f64;
    if is_steady && forces > 1.0 {
        checker.refuse(
            "time.steady",
            "sph.gravity turns from x to y at half the time, and a run that ends early has no second column",
            "leave this out; unsteady-share-x and unsteady-share-y show how steady both flows are",
        );
    }
    few_records(checker, output, end / forces, "under each force");
}

/// Refuses a series with too few records in a flow of `length` (s), which the message calls `named`.
pub(super) fn few_records(checker: &mut Checker, output: &Output, length: f64, named: &str) {
    let most = length / FEWEST_RECORDS;
    if output.series_every > most {
        checker.refuse(
            "output.series.every-time",
            format!("{:?} s leaves fewer than {FEWEST_RECORDS} records {named}", output.series_every),
            format!("a row every {most:.2e} s or more often would do"),
        );
    }
}

/// The direct simulation whose permeability is requested.
fn measured(model: Option<&Model>) -> Option<&Sph> {
    match model {
        Some(Model::Sph(sph)) if sph.measure.permeability => Some(sph),
        _ => None,
    }
}
