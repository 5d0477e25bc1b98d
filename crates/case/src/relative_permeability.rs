//! Checks of `[sph.measure.relative-permeability]`: two phases, walls at rest without slip, and a force along one axis with periodic sides.

use super::case_file::Model;
use super::initial::InitialVelocity;
use super::measure_groups::MeasureSet;
use super::output::Output;
use super::permeability::{few_records, no_side_is_driven};
use super::side::{SIDES, Side};
use super::sph::Sph;
use meniscus_core::input::Checker;

/// Consecutive flows: of the whole pore and of each phase.
const FLOWS: f64 = 3.0;

const TABLE: &str = "sph.measure.relative-permeability";

/// Checks the requirements of the measure on the model.
pub(super) fn relative_permeability(checker: &mut Checker, model: Option<&Model>) {
    let Some(sph) = measured(model) else { return };
    if sph.non_wetting.is_none() {
        checker.refuse(
            TABLE,
            "a relative permeability needs two phases, and there is one fluid",
            "add [sph.phases.non-wetting], [sph.interface] and [[sph.initial.wetting]], or measure [sph.measure.permeability]",
        );
    }
    let alone = MeasureSet { relative_permeability: true, ..MeasureSet::default() };
    if sph.measure != alone {
        checker.refuse(
            TABLE,
            "the interface is frozen, and three flows are computed in turn: other measures need a single flow",
            "leave out the other tables of [sph.measure]; their measures need a run of their own",
        );
    }
    if sph.walls.slip_length > 0.0 {
        checker.refuse(
            "sph.walls.slip-length",
            "walls slip, and the frozen interface counts as a wall",
            "leave this out: there is no slip on walls and interface",
        );
    }
    if sph.initial.velocity != InitialVelocity::Rest {
        checker.refuse("sph.initial.velocity", "each of the three flows begins at rest", "leave this out");
    }
    if no_side_is_driven(checker, sph) {
        force(checker, sph);
    }
}

/// Refuses a force that is incompatible with the sides.
fn force(checker: &mut Checker, sph: &Sph) {
    let along: Vec<usize> = (0..2).filter(|&axis| sph.gravity[axis] != 0.0).collect();
    let [axis] = along[..] else {
        checker.refuse(
            "sph.gravity",
            format!(
                "the flows are driven along one axis, and the force acts along {}",
                if along.is_empty() { "none" } else { "both" }
            ),
            "give one component, along an axis with periodic sides, such as gravity = [0.1, 0.0] # m/s2",
        );
        return;
    };
    let kinds = [sph.sides.left, sph.sides.bottom];
    if kinds[axis] != Side::Periodic {
        let (name, [one, other]) = (["x", "y"][axis], [SIDES[2 * axis], SIDES[2 * axis + 1]]);
        checker.refuse(
            "sph.gravity",
            format!("a force along {name} drives nothing through the closed sides `{one}` and `{other}`"),
            format!("set {one} and {other} to \"periodic\" in [sph.sides], or give the component along the other axis"),
        );
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
    let (Some(_), Some(end)) = (measured(model), end) else { return };
    if is_steady {
        checker.refuse(
            "time.steady",
            "three flows are computed in turn, and a run that ends early has no relative permeability",
            "leave this out; unsteady-share shows how steady the flows are",
        );
    }
    few_records(checker, output, end / FLOWS, "of each of the three flows");
}

/// The direct simulation whose relative permeabilities are requested.
fn measured(model: Option<&Model>) -> Option<&Sph> {
    match model {
        Some(Model::Sph(sph)) if sph.measure.relative_permeability => Some(sph),
        _ => None,
    }
}
