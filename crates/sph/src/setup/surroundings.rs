//! Walls and solids for measures and output.

use super::to_network_state::state_export;
use crate::frozen::FLOWS;
use crate::measures::DiscOf;
use crate::method::Method;
use crate::solver::Surroundings;
use crate::stages::Stages;
use meniscus_case::{Case, Sph};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::snapshot::Lines;
use meniscus_geometry::Geometry;
use meniscus_geometry::interface::lengths::wall_samples;
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec};

/// The surroundings of the flow of a case.
pub(super) fn surroundings(case: &Case, sph: &Sph, geometry: &Geometry, method: &Method) -> Surroundings {
    let outline = geometry.outline();
    Surroundings {
        wall_samples: wall_samples(&polylines(&outline), 0.5 * sph.spacing),
        outline,
        discs: discs(&case.geometry),
        plates: plates(&case.geometry),
        has_edges: !case.geometry.shapes.is_empty(),
        wall_speeds: sph.wall_speeds,
        stages: stages(sph, case.end),
        stops_at_breakthrough: sph.stop_at_breakthrough,
        stops_at_detachment: sph.stop_at_detachment,
        grid_spacing: case.output.grid_ratio * sph.spacing,
        // With a frozen interface the state of the network does not change.
        state_export: (sph.initial.network.as_ref().filter(|_| !sph.measure.relative_permeability))
            .map(|start| state_export(start, sph.tension, method.plates.map(|plates| plates.depth))),
    }
}

/// The body forces that act one after the other until `end` (s), for measurements of permeability.
fn stages(sph: &Sph, end: f64) -> Option<Stages> {
    match &sph.measure {
        measure if measure.permeability => Stages::new(sph.gravity, end),
        measure if measure.relative_permeability => Stages::repeated(sph.gravity, FLOWS, end),
        _ => None,
    }
}

/// The axis-aligned rectangles among the solids.
fn plates(spec: &GeometrySpec) -> Vec<Bounds> {
    let plate = |shape: &ShapeSpec| match shape {
        ShapeSpec::Rectangle(r) if r.rotation_deg == 0.0 => {
            let (center, half) = (Vec2::from(r.center), 0.5 * Vec2::from(r.size));
            Some(Bounds { min: center - half, max: center + half })
        }
        _ => None,
    };
    spec.shapes.iter().filter_map(plate).collect()
}

fn discs(spec: &GeometrySpec) -> Vec<DiscOf> {
    let disc = |shape: &ShapeSpec| match shape {
        ShapeSpec::Disc(disc) => Some(DiscOf { center: Vec2::from(disc.center), radius: disc.radius }),
        _ => None,
    };
    spec.shapes.iter().filter_map(disc).collect()
}

fn polylines(outline: &Lines) -> Vec<Polyline> {
    let line = |line: &Vec<u32>| Polyline {
        points: line.iter().map(|&i| outline.points[i as usize]).collect(),
        closed: false,
    };
    outline.lines.iter().map(line).collect()
}
