//! Observation of a flow at one time: interface, contact lines, phases, pressures. Computed per record, not per step.

use std::sync::OnceLock;

use crate::flow::Flow;
use crate::particles::Phase;
use crate::unresolved::{ThinParts, ganglia, small_pieces};
use meniscus_core::math::Vec2;
use meniscus_geometry::analysis::blobs::Blob;
use meniscus_geometry::analysis::near_level::nodes_near_level;
use meniscus_geometry::analysis::phases::{CapillaryPressure, PhaseAreas, PressureSamples, capillary_pressure};
use meniscus_geometry::analysis::resample::{Samples, Stencils};
use meniscus_geometry::interface::contact::{AngleSummary, ContactLine, ContactSettings, contact_lines, summarize};
use meniscus_geometry::interface::contour::contour;
use meniscus_geometry::interface::lattice::Lattice;
use meniscus_geometry::interface::lengths::{WallSample, interface_length, wetted_length};
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_geometry::interface::wall::WallPoint;
use meniscus_geometry::interface::wall::clip;

/// Grid nodes beyond a wall side, so that the contour extends to the wall, where it is clipped.
const MARGIN: usize = 2;

/// Interface, contact lines and phases at one time.
#[derive(Debug, Clone)]
pub struct Observation {
    /// The c = 0.5 contour in the pore, wetting phase on its left.
    pub interface: Vec<Polyline>,
    /// Contact lines with their angles.
    pub contact_lines: Vec<ContactLine>,
    /// Areas of the phases.
    pub areas: PhaseAreas,
    /// Mean pressure of the non-wetting phase minus that of the wetting phase.
    pub capillary_pressure: CapillaryPressure,
    /// Length of wall in contact with the wetting phase in m.
    pub wetted_length: f64,
    /// Ganglia (connected parts) of the wetting phase, the largest first.
    pub wetting_blobs: Vec<Blob>,
    /// Number of ganglia of either phase below the resolution.
    pub small_pieces: usize,
    /// Where a phase is thin, computed on first use: most records do not need it.
    thin: OnceLock<ThinParts>,
}

impl Observation {
    /// The contact lines with a measured angle: those of pockets of a few particles at the wall have none.
    pub fn lines_with_angle(&self) -> impl Iterator<Item = &ContactLine> {
        self.contact_lines.iter().filter(|line| line.angle_deg.is_finite())
    }

    /// Observes the flow; `wall` samples as from `interface::lengths::wall_samples`.
    pub fn of(flow: &Flow, wall: &[WallSample]) -> Self {
        let fluids = flow.state.particles.fluids;
        // Interpolation near open sides needs their buffers; areas do not.
        let all = sharp_color(flow);
        let (volumes, color) = (&flow.fields.bulk.volume[..fluids], &all[..fluids]);
        let areas = PhaseAreas::new(volumes, color);
        let wall_point = |x: Vec2| WallPoint::from((flow.config.wall)(x));
        let two_phases = flow.config.method.tension > 0.0 && areas.wetting > 0.0 && areas.non_wetting > 0.0;
        let (interface, wall_color) = interface_and_walls(flow, &all, two_phases, wall, &wall_point);
        let settings = ContactSettings::for_smoothing_length(flow.config.method.kernel.h)
            .under(flow.config.method.curvature_gradient());
        let pressures = pressures_at_interface(flow, &interface);
        let samples = PressureSamples {
            points: &flow.state.particles.position[..fluids],
            pressures: &pressures,
            colors: color,
            smoothing_length: flow.config.method.kernel.h,
            period: flow.config.domain.periods(),
        };
        let wetting_blobs = ganglia(flow, Phase::Wetting);
        Self {
            contact_lines: contact_lines(&interface, &wall_point, &settings),
            areas,
            capillary_pressure: capillary_pressure(&samples, &interface, &wall_point),
            wetted_length: wetted_length(wall, &wall_color).wetting,
            small_pieces: small_pieces(flow, &wetting_blobs),
            thin: OnceLock::new(),
            wetting_blobs,
            interface,
        }
    }

    /// Where a phase is thinner than about three particles; `flow` is the observed flow.
    pub(crate) fn thin(&self, flow: &Flow) -> &ThinParts {
        self.thin.get_or_init(|| ThinParts::of(flow))
    }

    /// Mean contact angle with its spread over the contact lines.
    pub(crate) fn angle(&self) -> AngleSummary {
        summarize(&self.contact_lines)
    }

    /// Length of the interface in m.
    pub(crate) fn interface_length(&self) -> f64 {
        interface_length(&self.interface)
    }
}

/// Pressures in Pa of the fluid particles, each without the hydrostatic pressure of its phase relative to the mean position of the interface.
fn pressures_at_interface(flow: &Flow, interface: &[Polyline]) -> Vec<f64> {
    let (p, m) = (&flow.state.particles, &flow.config.method);
    let vertices: Vec<Vec2> = interface.iter().flat_map(|line| &line.points).copied().collect();
    let pressures = &p.pressure[..p.fluids];
    if m.gravity == Vec2::zeros() || vertices.is_empty() {
        return pressures.to_vec();
    }
    let middle = vertices.iter().sum::<Vec2>() / vertices.len() as f64;
    let weight = |a: usize| m.fluid(p.phase[a]).density * m.gravity.dot(&(p.position[a] - middle));
    pressures.iter().enumerate().map(|(a, pressure)| pressure - weight(a)).collect()
}

/// Color of fluid and buffer particles: 1 in the wetting phase, else 0.
pub fn sharp_color(flow: &Flow) -> Vec<f64> {
    flow.state.particles.phase[..flow.state.particles.moving()].iter().map(|p: &Phase| p.color()).collect()
}

/// Fluid and buffer particles as samples for interpolation.
pub fn fluid_samples(flow: &Flow) -> Samples<'_> {
    let moving = flow.state.particles.moving();
    Samples {
        points: &flow.state.particles.position[..moving],
        volumes: &flow.fields.bulk.volume[..moving],
        smoothing_length: flow.config.method.kernel.h,
        period: flow.config.domain.periods(),
    }
}

/// Nodes about `spacing` (m) apart over the domain, a little beyond its walls.
pub(crate) fn nodes(flow: &Flow, spacing: f64) -> Lattice {
    let (domain, size) = (&flow.config.domain, flow.config.domain.bounds.size());
    let mut lattice = Lattice::open(domain.bounds.min, Vec2::zeros(), [0; 2]);
    lattice.periodic = domain.periodic;
    for i in 0..2 {
        let cells = (size[i] / spacing).round().max(1.0) as usize;
        lattice.spacing[i] = size[i] / cells as f64;
        let mirrored = domain.mirrors.iter().any(|m| m.axis == i);
        if domain.periodic[i] {
            lattice.counts[i] = cells;
        } else {
            let is_open = |number| flow.config.open.sides.iter().any(|side| side.number == number);
            let [below, above] = [0, 1].map(|end| if mirrored || is_open(2 * i + end) { 0 } else { MARGIN });
            lattice.counts[i] = cells + 1 + below + above;
            lattice.origin[i] -= below as f64 * lattice.spacing[i];
        }
    }
    lattice
}

/// The interface, and the smoothed color on the walls. The color is interpolated only to nodes near the interface, so that the work scales
/// with its length and not with the area.
fn interface_and_walls(
    flow: &Flow,
    color: &[f64],
    two_phases: bool,
    walls: &[WallSample],
    wall: &dyn Fn(Vec2) -> WallPoint,
) -> (Vec<Polyline>, Vec<f64>) {
    let (samples, lattice) = (fluid_samples(flow), nodes(flow, flow.config.method.spacing));
    let near = if two_phases { nodes_near_level(&lattice, &samples, color, 0.5) } else { Vec::new() };
    let on_nodes = near.iter().map(|&node| lattice.position(node % lattice.counts[0], node / lattice.counts[0]));
    let points: Vec<Vec2> = on_nodes.chain(walls.iter().map(|sample| sample.point)).collect();
    let mut found = Stencils::new(&samples, &points).scalar(color);
    let on_walls = found.split_off(near.len());
    if !two_phases {
        return (vec![], on_walls);
    }
    let mut values = vec![f64::NAN; lattice.len()];
    near.iter().zip(found).for_each(|(&node, value)| values[node] = value);
    let level = clip(&contour(&lattice, &values, 0.5), wall);
    (level.iter().map(|line| line.on_interface(flow.config.method.kernel.h)).collect(), on_walls)
}
