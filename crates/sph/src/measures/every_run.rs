//! Measures of every run: contact angle, pressures, saturation, lengths, area drift and density errors.

use super::open;
use super::subject::Subject;
use crate::flow::Flow;
use crate::warnings::most_small_pieces;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::phases::{PhaseAreas, density_error};

pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let (config, particles, fluids) = (&s.flow.config, &s.flow.state.particles, s.flow.state.particles.fluids);
    let [rms, largest] = density_error(&s.flow.fields.bulk.volume[..fluids], config.method.volume);
    let mut found = vec![
        measure("density-error", rms, "").by("root mean square of V0/V - 1 over fluid particles at the end"),
        measure("largest-density-error", largest, "").by("largest |V0/V - 1| over fluid particles at the end"),
    ];
    let nearest = (0..fluids).map(|a| (config.wall)(particles.position[a]).0).fold(f64::INFINITY, f64::min);
    if nearest.is_finite() {
        let method = "signed distance of the fluid particle nearest to a wall; negative inside the wall";
        found.push(measure("smallest-wall-distance-m", nearest, "m").by(method));
    }
    let distance = smallest_distance(s.flow);
    if distance.is_finite() {
        let method = "smallest distance of two fluid particles over dx at the end; below 0.5 for paired particles";
        found.push(measure("smallest-particle-distance-ratio", distance, "").by(method));
    }
    if config.method.tension > 0.0 {
        found.extend(two_phases(s));
    }
    found
}

/// Smallest distance of two fluid particles over the spacing.
fn smallest_distance(flow: &Flow) -> f64 {
    let fluids = flow.state.particles.fluids;
    let among_fluids =
        |a: usize| flow.neighborhood.pairs.of(a).filter(|ab| flow.neighborhood.images.source(ab.b) < fluids);
    let view = &flow.view();
    let distances = (0..fluids).flat_map(|a| among_fluids(a).map(move |ab| view.separation(a, ab.b).norm()));
    distances.fold(f64::INFINITY, f64::min) / flow.config.method.spacing
}

impl Subject<'_> {
    /// Standard uncertainty in Pa of the capillary pressure. The contribution of floor and lid is exact.
    pub fn capillary_pressure_error(&self) -> f64 {
        let (method, pressure) = (&self.flow.config.method, &self.observed.capillary_pressure);
        let in_plane = method
            .plates
            .map_or(pressure.value, |plates| method.tension * plates.depth.plane(pressure.value / method.tension));
        let angle = (!self.observed.contact_lines.is_empty()).then(|| self.flattest_angle());
        pressure.uncertainty(in_plane, angle, method.tension, method.kernel.h)
    }

    /// The angle in degrees at which a phase meets walls, through the phase with the larger one, of the measured and the requested; 90 without one.
    fn flattest_angle(&self) -> f64 {
        let requested = self.flow.config.method.wetting.map_or(90.0, |model| model.static_angle().to_degrees());
        let through_either = |angle: f64| angle.max(180.0 - angle);
        through_either(requested).max(through_either(self.observed.angle().mean_deg))
    }
}

fn two_phases(s: &Subject) -> Vec<Measure> {
    // Inflow and outflow through open sides are not drift.
    let (net_inflow, areas) = (open::net(s.flow), s.observed.areas);
    let kept = PhaseAreas { wetting: areas.wetting - net_inflow[0], non_wetting: areas.non_wetting - net_inflow[1] };
    let drift = kept.drift_since(&s.start);
    let drift = drift.iter().map(|d| d.abs()).filter(|d| d.is_finite()).fold(0.0, f64::max);
    let (pressure, blobs) = (&s.observed.capillary_pressure, s.observed.wetting_blobs.len() as f64);
    let method = &s.flow.config.method;
    let most = most_small_pieces(s.series).map_or(f64::NAN, |(most, _)| most);
    let mut found = vec![
        measure("saturation", s.observed.areas.saturation(), "").by("area of the wetting phase over that of both"),
        measure("area-drift", drift, "")
            .by("larger relative change of the area of a phase since time zero, without the flow through open sides"),
        measure("capillary-pressure-Pa", pressure.value, "Pa")
            .by("mean pressure of non-wetting minus wetting particles farther than 3h from the interface, referred \
                 to the mean height of the interface")
            .with_uncertainty(s.capillary_pressure_error()),
        measure("interface-length-m", s.observed.interface_length(), "m").by("length of the c = 0.5 contour"),
        measure("wetted-length-m", s.observed.wetted_length, "m")
            .by("length of wall where the smoothed color is above 0.5"),
        measure("wetting-blobs", blobs, "").by("connected parts, links up to 1.6 dx"),
        measure("below-resolution-share", s.observed.thin(s.flow).share, "").by(
            "particles where their phase is thinner than about three particles, over the particles of the smaller \
                 phase",
        ),
        measure("small-pieces", s.observed.small_pieces as f64, "")
            .by("connected parts of either phase with fewer than 20 particles"),
        measure("most-small-pieces", most, "").by("largest number of small pieces at any record"),
    ];
    if method.wetting.is_some() {
        let angle = s.observed.angle();
        let models = s.observed.contact_lines.iter().filter_map(|line| s.flow.config.wetting_at(line.position));
        let angles: Vec<f64> = models.map(|model| model.static_angle().to_degrees()).collect();
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        found.extend([
            measure("contact-angle-deg", angle.mean_deg, "deg")
                .by(how_the_angle_was_measured(s))
                .with_uncertainty(angle.uncertainty_deg),
            measure("requested-angle-deg", mean, "deg")
                .by("mean over the contact lines of the static angle of the wetting model at their positions"),
            measure("line-slip-length-m", method.no_slip.line_slip_length, "m")
                .by("slip length of walls near contact lines; with a static angle the speed of a line depends on it"),
        ]);
    }
    found
}

/// How the contact angle was measured, or why it was not.
fn how_the_angle_was_measured(s: &Subject) -> String {
    let angle = s.observed.angle();
    if angle.measured > 0 {
        let shape = if s.flow.config.method.gravity == Vec2::zeros() { "circles" } else { "arcs of Young and Laplace" };
        return format!(
            "{shape} fitted to the c = 0.5 contour farther than 2h from walls, down to h for short menisci, and extrapolated to the wall; mean of {} contact lines ({} without a fit), spread {:.2} degrees",
            angle.measured, angle.failed, angle.spread_deg
        );
    }
    match s.observed.contact_lines.iter().find_map(|line| line.problem.as_ref()) {
        Some(problem) => format!("none of the {} contact lines has one: {problem}", angle.failed),
        None => "the interface meets no wall".into(),
    }
}
