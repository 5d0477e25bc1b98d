//! The flow as written to output: particles, grid and interface with the documented field names.

use std::borrow::Cow;
use std::ops::Range;

use rayon::prelude::*;

use crate::equivalent_forces::volume_forces;
use crate::flow::Flow;
use crate::observe::{Observation, fluid_samples, nodes};
use crate::unresolved::ThinParts;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Cloud, Field, Grid, Lines, Snapshot, Values};
use meniscus_geometry::analysis::resample::Stencils;
use meniscus_geometry::interface::polyline::Polyline;

/// Range of the circle fit for the curvature along the interface, over h.
const CURVATURE_REACH: f64 = 2.5;

/// Number of grid nodes per batch of the interpolation.
const NODES_AT_ONCE: usize = 1 << 15;

/// The state for output; `grid_spacing` in m.
pub(crate) fn snapshot(flow: &Flow, observation: &Observation, grid_spacing: f64) -> Snapshot<'static> {
    let mut particles = particles(flow, observation.thin(flow));
    let grid = grid(flow, &particles, grid_spacing);
    without(&mut particles, flow.state.particles.buffer());
    Snapshot {
        time: flow.state.time,
        step: flow.state.steps,
        particles,
        grid: Some(grid),
        interface: Some(interface(&observation.interface, flow.config.method.kernel.h)),
    }
}

/// Removes the points of `range`: the buffers of open sides are not part of the flow.
fn without(cloud: &mut Cloud<'static>, range: Range<usize>) {
    cloud.points.to_mut().drain(range.clone());
    for field in &mut cloud.fields {
        match &mut field.values {
            Values::Scalar(values) => drop(values.to_mut().drain(range.clone())),
            Values::Vector(values) => drop(values.to_mut().drain(range.clone())),
            Values::Integer(values) => drop(values.to_mut().drain(range.clone())),
        }
    }
}

/// Distance and normal of the nearest wall; the distance is at most the diagonal of the box, so that files contain finite numbers.
fn wall(flow: &Flow, x: Vec2) -> (f64, Vec2) {
    let (distance, normal) = (flow.config.wall)(x);
    (distance.min(flow.config.domain.bounds.size().norm()), normal)
}

fn particles(flow: &Flow, thin: &ThinParts) -> Cloud<'static> {
    let (p, f, n) = (&flow.state.particles, &flow.fields, flow.state.particles.len());
    let on_fluid =
        |values: &[Vec2]| values.iter().copied().chain(std::iter::repeat(Vec2::zeros())).take(n).collect::<Vec<_>>();
    let (distance, normal): (Vec<_>, Vec<_>) = p.position.par_iter().map(|&x| wall(flow, x)).unzip();
    let [surface_force, line_force] = volume_forces(flow);
    let (driving, from) = (flow.view().driving_gradient(), flow.config.domain.bounds.min);
    let pressure = p.pressure.iter().zip(&p.position).map(|(p, x)| p - driving.dot(&(x - from)));
    let profile = flow.config.method.profile();
    let fields = vec![
        Field::integer("id", p.id.iter().map(|&id| i64::from(id))),
        Field::integer("below-resolution", below_resolution(flow, thin)),
        Field::integer("phase", p.phase.iter().map(|phase| phase.number())),
        Field::vector("velocity", "m/s", p.velocity.clone()),
        Field::scalar("pressure", "Pa", pressure),
        Field::scalar("density", "kg/m^3", f.bulk.density[..n].iter().map(|density| density / profile)),
        Field::scalar("volume", "m^2", f.bulk.volume[..n].to_vec()),
        Field::scalar("color", "", f.interface.color[..n].to_vec()),
        Field::vector("normal", "1/m", f.interface.normal[..n].to_vec()),
        Field::scalar("curvature", "1/m", f.interface.curvature.clone()),
        Field::vector("surface-force", "N/m^3", on_fluid(&surface_force)),
        Field::vector("line-force", "N/m^3", on_fluid(&line_force)),
        Field::scalar("wall-distance", "m", distance),
        Field::vector("wall-normal", "", normal),
    ];
    Cloud { points: Cow::Owned(p.position.clone()), fields }
}

/// 1 where a phase is thinner than about three particles, else 0.
fn below_resolution(flow: &Flow, thin: &ThinParts) -> Vec<i64> {
    let mut thin: Vec<i64> = thin.is_thin.iter().copied().map(i64::from).collect();
    thin.resize(flow.state.particles.len(), 0);
    thin
}

/// The particles' fields on a regular grid over the box, with the signed distance; zero where no fluid is near.
fn grid(flow: &Flow, particles: &Cloud, spacing: f64) -> Grid<'static> {
    let mut lattice = nodes(flow, spacing);
    for i in 0..2 {
        // The grid covers the box: without the nodes beyond walls, and with the last node of a period.
        let cells = (flow.config.domain.bounds.size()[i] / lattice.spacing[i]).round() as usize;
        lattice.counts[i] = cells + 1;
        lattice.origin[i] = flow.config.domain.bounds.min[i];
    }
    lattice.periodic = [false; 2];
    let points = lattice.nodes();
    let interpolated =
        |field: &&Field| !matches!(field.name, "wall-distance" | "wall-normal" | "id" | "phase" | "below-resolution");
    let given: Vec<&Field> = particles.fields.iter().filter(interpolated).collect();
    let empty = |field: &&Field| match field.values {
        Values::Vector(_) => Field::vector(field.name, field.unit, Vec::with_capacity(points.len())),
        _ => Field::scalar(field.name, field.unit, Vec::with_capacity(points.len())),
    };
    let mut fields: Vec<Field> = given.iter().map(empty).collect();
    let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
    let samples = fluid_samples(flow);
    let cells = samples.cells();
    // The weights of all nodes at once would take more memory than the flow.
    for batch in points.chunks(NODES_AT_ONCE) {
        let stencils = Stencils::in_cells(&samples, &cells, batch);
        for (field, given) in fields.iter_mut().zip(&given) {
            match (&mut field.values, &given.values) {
                (Values::Scalar(to), Values::Scalar(of)) => {
                    to.to_mut().extend(stencils.scalar(of).into_iter().map(finite));
                }
                (Values::Vector(to), Values::Vector(of)) => {
                    to.to_mut().extend(stencils.vector(of).iter().map(|v| v.map(finite)));
                }
                _ => {}
            }
        }
    }
    let (distance, normal): (Vec<_>, Vec<_>) = points.par_iter().map(|&x| wall(flow, x)).unzip();
    fields.push(Field::scalar("wall-distance", "m", distance));
    fields.push(Field::vector("wall-normal", "", normal));
    lattice.grid(fields)
}

fn interface(lines: &[Polyline], h: f64) -> Lines<'static> {
    let (mut points, mut curvature, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for line in lines {
        let first = points.len() as u32;
        let count = line.points.len() as u32;
        points.extend_from_slice(&line.points);
        curvature.extend(line.curvature(CURVATURE_REACH * h).into_iter().map(|k| if k.is_finite() { k } else { 0.0 }));
        indices.push((first..first + count).chain(line.closed.then_some(first)).collect());
    }
    Lines { points: Cow::Owned(points), lines: indices, fields: vec![Field::scalar("curvature", "1/m", curvature)] }
}
