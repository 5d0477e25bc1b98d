//! A free drop deformed by shear between two walls (B5 of the benchmarks).

use super::moments::Moments;
use super::oscillating_drop::drop;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;

/// Deformation of a drop between walls moving in opposite directions.
pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (m, height) = (&s.flow.config.method, s.flow.config.domain.bounds.size().y);
    let [_, _, bottom, top] = s.wall_speeds;
    let rate = (top - bottom).abs() / height;
    let capillary = m.other_fluid.viscosity * rate * drop(s).radius / m.tension;
    let deformation = Moments::of_wetting_phase(s.flow).deformation();
    vec![
        measure("deformation", deformation, "")
            .by("(L - B)/(L + B) of the ellipse with the second moments of the wetting phase, at the end"),
        measure("deformation-ratio", deformation / capillary, "")
            .by("deformation over the capillary number viscosity x shear rate x radius / tension, its value for \
                 small drops in the plane"),
    ]
}
