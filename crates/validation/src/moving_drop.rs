//! A drop that moves along a wall or is pinned (C11 and C12 of the benchmarks): angles, positions and speeds of its contact lines, and forces.
//!
//! *Ahead* is the direction in which the drop is driven, constant during a run: that of the body force along the wall, less buoyancy; else of the prescribed
//! stream relative to the wall; else of the displacement of its lines once that reaches a spacing. Lines whose ν_ns points ahead are the advancing ones. For
//! the momentum of the drop along a flat wall, d(P)/dt = body force less buoyancy + friction of the wall + drag of the other fluid − σ (cos θ_R − cos θ_A):
//! see `force_balance`.

use super::force_balance;
use super::series::{LAST_QUARTER, last, last_mean};
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, Series, measure};
use meniscus_geometry::interface::contact::ContactSettings;
use meniscus_geometry::interface::meniscus_ends::{MeniscusEnd, ends_under_force};
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_geometry::interface::wall::WallPoint;
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject, stream};
use meniscus_sph::observe::Observation;
use meniscus_sph::particles::Phase;
use meniscus_sph::unresolved::{resolved_parts, wetted_by_largest_part};
use meniscus_sph::wetting::lines::{TrackedLine, nearest};

/// Fraction of the contour next to a line that is fitted, if the drop has advancing and receding lines, which the flow bends differently. A meniscus that
/// moves as a whole is fitted as a whole.
const WINDOW: f64 = 0.5;

/// Measured lines are identified with tracked ones within this distance over h.
const SAME_LINE: f64 = 6.0;

/// A body force or a stream whose part along the wall is below this fraction does not define the direction ahead.
const DRIVEN: f64 = 1e-3;

/// Means over the advancing and over the receding lines.
struct Ends {
    ahead: Vec2,
    /// Apparent angle in degrees, displacement in m, speed in m/s and angle at the wall in degrees of the advancing and of the receding lines.
    lines: [[f64; 4]; 2],
}

/// Unit vector along the wall in which the drop is driven; `None` if neither a force nor a stream is given and the lines have not moved.
fn ahead(flow: &Flow, lines: &[TrackedLine]) -> Option<Vec2> {
    let along = lines.first()?.outward;
    let m = &flow.config.method;
    let weight = (m.wetting_fluid.density - m.other_fluid.density) * m.gravity;
    let wall = lines.iter().map(|line| flow.config.wall_velocity(line.position)).sum::<Vec2>() / lines.len() as f64;
    let given = [weight, stream::given(flow, wall)].into_iter();
    let driving = given.chain(flow.state.gone).find(|by| by.dot(&along).abs() > DRIVEN * by.norm())?;
    Some(along * driving.dot(&along).signum())
}

fn ends(flow: &Flow, observation: &Observation) -> Option<Ends> {
    let lines = &flow.lines;
    let ahead = ahead(flow, lines)?;
    let mut sums = [[0.0; 4]; 2];
    let mut counts = [[0.0; 4]; 2];
    let mut add = |end: usize, what: usize, value: f64| {
        if value.is_finite() {
            sums[end][what] += value;
            counts[end][what] += 1.0;
        }
    };
    for line in lines {
        let end = usize::from(line.outward.dot(&ahead) < 0.0);
        add(end, 1, line.travel);
        add(end, 2, line.speed);
        add(end, 3, line.angle.to_degrees());
    }
    let reach = SAME_LINE * flow.config.method.kernel.h;
    let forward = lines.iter().filter(|line| line.outward.dot(&ahead) > 0.0).count();
    let window = if forward == 0 || forward == lines.len() { f64::INFINITY } else { WINDOW };
    for found in fitted(flow, observation, window) {
        let same = |outward: Vec2| nearest(lines, &flow.config.domain, found.position, outward, reach);
        let distance = |line: &&TrackedLine| flow.config.domain.separation(line.position, found.position).norm();
        let near = [ahead, -ahead].into_iter().filter_map(same).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(line) = near {
            add(usize::from(line.outward.dot(&ahead) < 0.0), 0, found.angle_deg);
        }
    }
    let lines = [0, 1].map(|end| [0, 1, 2, 3].map(|what| sums[end][what] / counts[end][what]));
    Some(Ends { ahead, lines })
}

/// The ends of the interface, by fits to the fraction `window` of the contour next to each.
fn fitted(flow: &Flow, observation: &Observation, window: f64) -> Vec<MeniscusEnd> {
    let m = &flow.config.method;
    let wall = |x: Vec2| WallPoint::from((flow.config.wall)(x));
    let force = (m.wetting_fluid.density - m.other_fluid.density) / m.tension * m.gravity;
    let fit = |contour: &Polyline| {
        let window = window * contour.length();
        let settings = ContactSettings { window, ..ContactSettings::for_smoothing_length(m.kernel.h) };
        ends_under_force(std::slice::from_ref(contour), &wall, &settings, force)
    };
    observation.interface.iter().flat_map(fit).collect()
}

/// Body force on the drop less buoyancy, and viscous force of the walls on it, in N/m.
fn forces(flow: &Flow) -> [Vec2; 2] {
    let (p, f, m) = (&flow.state.particles, &flow.fields.bulk, &flow.config.method);
    let is_drop = |a: usize| a < p.fluids && p.phase[a] == Phase::Wetting;
    let area: f64 = (0..p.fluids).filter(|&a| is_drop(a)).map(|a| f.volume[a]).sum();
    let drive = (m.wetting_fluid.density - m.other_fluid.density) * area * m.gravity;
    [drive, -flow.view().friction(|a, _| is_drop(a))]
}

/// Angles, displacements and speeds of both ends, and the forces on the drop along the wall.
pub(super) fn columns(flow: &Flow, observation: &Observation) -> Columns {
    let nan = f64::NAN;
    let ends = ends(flow, observation).unwrap_or(Ends { ahead: Vec2::repeat(nan), lines: [[nan; 4]; 2] });
    let [[advancing, travel, speed, at_wall], [receding, travel_behind, speed_behind, at_wall_behind]] = ends.lines;
    let (p, m) = (&flow.state.particles, &flow.config.method);
    let mass = m.wetting_fluid.density * m.volume;
    let drop = (0..p.fluids).filter(|&a| p.phase[a] == Phase::Wetting);
    let momentum = mass * drop.map(|a| p.velocity[a]).sum::<Vec2>();
    let [drive, friction] = forces(flow);
    let stream = stream::along(flow, observation, ends.ahead);
    vec![
        ("advancing_angle_deg", advancing),
        ("receding_angle_deg", receding),
        ("advancing_line_m", travel),
        ("receding_line_m", travel_behind),
        ("advancing_speed_m_per_s", speed),
        ("receding_speed_m_per_s", speed_behind),
        ("advancing_wall_angle_deg", at_wall),
        ("receding_wall_angle_deg", at_wall_behind),
        ("drive_N_per_m", drive.dot(&ends.ahead)),
        ("wall_friction_N_per_m", friction.dot(&ends.ahead)),
        ("stream_pressure_N_per_m", stream.pressure),
        ("stream_friction_N_per_m", stream.friction),
        ("drop_momentum_kg_per_m_s", momentum.dot(&ends.ahead)),
        ("largest_part_at_wall_m", wetted_by_largest_part(flow)),
        ("resolved_parts", resolved_parts(&observation.wetting_blobs) as f64),
    ]
}

/// Mean rate of change of a column over the last part of the records.
fn last_slope(series: &Series, column: &str) -> f64 {
    let points = last(series, column, LAST_QUARTER);
    let count = points.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / count;
    let (t, y) = (mean(|p| p.0), mean(|p| p.1));
    let (up, down) =
        points.iter().fold((0.0, 0.0), |(up, down), p| (up + (p.0 - t) * (p.1 - y), down + (p.0 - t).powi(2)));
    up / down
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let m = &s.flow.config.method;
    let fit = "static meniscus under the body force fitted to the half of the contour next to the line (a meniscus that moves as a \
               whole: to all of it), 2h from the wall left out; mean over the last quarter of the records";
    let (advancing, advancing_scatter) = last_mean(s.series, "advancing_angle_deg");
    let (receding, receding_scatter) = last_mean(s.series, "receding_angle_deg");
    let mut found = vec![
        measure("advancing-angle-deg", advancing, "deg").by(fit).with_uncertainty(advancing_scatter),
        measure("receding-angle-deg", receding, "deg").by(fit).with_uncertainty(receding_scatter),
    ];
    // Speeds are along ν_ns, which points backwards at the receding end; here ahead is positive.
    let front = last_mean(s.series, "advancing_speed_m_per_s");
    let back = last_mean(s.series, "receding_speed_m_per_s");
    let speeds = [last_slope(s.series, "advancing_line_m"), -last_slope(s.series, "receding_line_m")];
    let from_velocity = "speed of the line ahead relative to its wall, from the normal velocity of the interface next to it; mean over the last \
                         quarter of the records";
    let from_positions = "slope in time of the position of the line ahead, not relative to the wall, over the last quarter of the records";
    let capillary = |speed: f64| speed * m.wetting_fluid.viscosity / m.tension;
    let over = "viscosity of the wetting phase times the speed of the line over the tension";
    found.extend([
        measure("advancing-speed-m-per-s", front.0, "m/s").by(from_velocity).with_uncertainty(front.1),
        measure("receding-speed-m-per-s", -back.0, "m/s").by(from_velocity).with_uncertainty(back.1),
        measure("advancing-way-m-per-s", speeds[0], "m/s").by(from_positions),
        measure("receding-way-m-per-s", speeds[1], "m/s").by(from_positions),
        measure("advancing-capillary-number", capillary(front.0), "").by(over).with_uncertainty(capillary(front.1)),
        measure("receding-capillary-number", -capillary(back.0), "").by(over).with_uncertainty(capillary(back.1)),
    ]);
    found.extend(force_balance::measures(s));
    found.extend(detachment(s));
    found
}

/// When the drop leaves the wall or breaks, and the capillary number of the stream then.
fn detachment(s: &Subject) -> [Measure; 4] {
    let (m, open) = (&s.flow.config.method, &s.flow.config.open);
    let stream = |time: f64| {
        let velocities = open.sides.iter().chain(&open.through).filter_map(|side| side.velocity_at(time));
        m.other_fluid.viscosity * velocities.reduce(f64::max).unwrap_or(f64::NAN) / m.tension
    };
    let first = |column: &str, is_met: &dyn Fn(f64) -> bool| {
        let found = s.series.column("time_s").zip(s.series.column(column)).find(|(_, value)| is_met(*value));
        found.map_or(f64::NAN, |(time, _)| time)
    };
    let parts = s.series.column("resolved_parts").next().unwrap_or(f64::NAN);
    let (gone, broken) =
        (first("largest_part_at_wall_m", &|length| length == 0.0), first("resolved_parts", &|now| now > parts));
    let off = "first record at which no particle of the largest connected part of the wetting phase lies within a spacing of a wall; not measured: \
               the drop stays on the wall";
    let over = "viscosity of the other phase times the given mean velocity at that record over the tension";
    let of_all = s.observed.wetting_blobs.iter().map(|part| part.count).sum::<usize>() as f64;
    let largest = s.observed.wetting_blobs.iter().map(|part| part.count).max().unwrap_or(0) as f64;
    [
        measure("detachment-time-s", gone, "s").by(off),
        measure("detachment-capillary-number", stream(gone), "").by(format!("{over}, {off}")),
        measure("break-up-capillary-number", stream(broken), "").by(format!(
            "{over}, the first with more connected parts of the wetting phase of at least 20 particles than at time zero; not measured: there is none"
        )),
        measure("largest-part-share", largest / of_all, "")
            .by("particles of the largest connected part of the wetting phase over all of them, at the end"),
    ]
}
