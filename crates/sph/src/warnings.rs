//! Warnings about results of a flow that its resolution does not support.

use crate::flow::Flow;
use crate::observe::Observation;
use crate::unresolved::SMALLEST_PIECE;
use meniscus_core::math::Vec2;
use meniscus_core::solver::Series;
use meniscus_geometry::interface::cap::cap;
use meniscus_geometry::interface::contact::ContactLine;

/// Fraction of the smaller phase in thin parts above which a warning is issued: the wedges at contact lines remain below it.
const LARGEST_THIN_SHARE: f64 = 0.01;

/// Spacings required across a drop or a film.
const ENOUGH: f64 = 8.0;

/// Films on floor and lid thinner than this fraction of the depth are not reported: both together leave less than 1 % of the pore behind.
const LEAST_FILM: f64 = 5e-3;

/// Cosine between the wall normals at both contact lines of a drop on a plane.
const SAME_WALL: f64 = 0.9;

/// Distance of an angle from 0 or 180 degrees, in degrees, within which the position of the interface depends on it to second order only.
const LIMITING_ANGLE: f64 = 10.0;

/// Speed over sqrt(tension / (density R)) above which currents in a drop at rest are reported.
const LARGEST_CURRENT: f64 = 5e-3;

/// Largest relative change of the length of the interface of a drop that keeps its shape.
const SAME_SHAPE: f64 = 2e-3;

/// Minimum number of records in the last fifth of the run.
const FEWEST: usize = 5;

/// Rounding tolerance of angles, in degrees and in rad.
const ROUNDING: f64 = 1e-9;

/// The warnings about the present flow.
pub(crate) fn warnings(flow: &Flow, observed: &Observation, series: &Series) -> Vec<String> {
    if flow.config.method.tension == 0.0 {
        return Vec::new();
    }
    let found = [
        films_left(flow),
        pieces_and_films(flow, observed, series),
        low_drop(flow, observed),
        limiting_angle(flow),
        parasitic_currents(flow, observed, series),
    ];
    found.into_iter().flatten().collect()
}

/// The warning if menisci are so fast that the receding wetting phase leaves films on floor and lid. The speed is the mean in the pore: the larger of
/// that of the given flow and that of the particles.
fn films_left(flow: &Flow) -> Option<String> {
    let (m, p) = (&flow.config.method, &flow.state.particles);
    let plates = m.plates?;
    let (open, size) = (&flow.config.open, flow.config.domain.bounds.size());
    let given = open
        .sides
        .iter()
        .chain(&open.through)
        .map(|side| side.flow_rate().abs() * size[side.axis()] / (p.fluids as f64 * m.volume));
    let mean = p.velocity[..p.fluids].iter().map(|v| v.norm()).sum::<f64>() / p.fluids as f64;
    let number = m.wetting_fluid.viscosity * given.fold(mean, f64::max) / m.tension;
    plates.depth.film_left(number).filter(|film| *film >= LEAST_FILM).map(|film| {
        format!(
            "at Ca = {number:.1e} of the wetting phase and an angle of {:.0} degrees receding menisci leave films on floor and lid (Bretherton 1961: {film:.1e} \
             of the depth each), which are not modeled: in reality less of the wetting phase is displaced",
            plates.depth.wettest().to_degrees()
        )
    })
}

/// The warning about ganglia and films below the resolution, now or at any earlier record.
fn pieces_and_films(flow: &Flow, observed: &Observation, series: &Series) -> Option<String> {
    let (share, small_pieces) = (observed.thin(flow).share, observed.small_pieces);
    let most = most_small_pieces(series);
    let before = most.filter(|(most, _)| *most > small_pieces as f64);
    if small_pieces == 0 && before.is_none() && share < LARGEST_THIN_SHARE {
        return None;
    }
    let (percent, half) = (100.0 * share, 0.5 * flow.config.method.spacing);
    let any_pieces = small_pieces > 0 || before.is_some();
    let before = before.map(|(most, time)| format!(" ({most} at t = {time:.4e} s)")).unwrap_or_default();
    let pieces = if any_pieces {
        format!("{small_pieces} pieces of fewer than {SMALLEST_PIECE} particles{before}, and ")
    } else {
        String::new()
    };
    Some(format!(
        "{pieces}films thinner than three particles with {percent:.1} % of the smaller phase, are not resolved: results that depend on them (numbers of pieces, \
         trapped fluid, angles next to them) are not reliable; compare with sph.spacing = {half:.4e}"
    ))
}

/// The largest number of ganglia below the resolution at any record, and the first time in s with that number.
pub(crate) fn most_small_pieces(series: &Series) -> Option<(f64, f64)> {
    let records = series.column("small_pieces").zip(series.column("time_s"));
    records.reduce(|most, record| if record.0 > most.0 { record } else { most })
}

/// The warning about parasitic currents in a free drop of low viscosity that is not driven and keeps its shape.
fn parasitic_currents(flow: &Flow, observed: &Observation, series: &Series) -> Option<String> {
    let (m, p) = (&flow.config.method, &flow.state.particles);
    let is_driven = m.gravity != Vec2::zeros()
        || !flow.config.open.sides.is_empty()
        || !flow.config.open.through.is_empty()
        || p.velocity[p.moving()..].iter().any(|v| *v != Vec2::zeros());
    let rows = series.rows.len();
    let late = rows - rows / 5;
    let last = |column: &str| series.column(column).skip(late).collect::<Vec<f64>>();
    let (lengths, speeds) = (last("interface_length_m"), last("max_relative_speed_m_per_s"));
    let (low, high) =
        lengths.iter().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), l| (low.min(*l), high.max(*l)));
    if is_driven || lengths.len() < FEWEST || !observed.contact_lines.is_empty() || high - low > SAME_SHAPE * high {
        return None;
    }
    let is_wetting = observed.areas.wetting < observed.areas.non_wetting;
    let (fluid, area) = if is_wetting {
        (m.wetting_fluid, observed.areas.wetting)
    } else {
        (m.other_fluid, observed.areas.non_wetting)
    };
    let radius = (area / std::f64::consts::PI).sqrt();
    let scale = (m.tension / (fluid.density * radius)).sqrt();
    // Currents persist; in an oscillation the speed falls to a small fraction twice in each period.
    let (lowest, speed) =
        speeds.into_iter().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
    (lowest > LARGEST_CURRENT * scale).then(|| {
        format!(
            "a drop of constant shape has parasitic currents of up to {speed:.1e} m/s, Ca = {:.1e}, {:.1} % of sqrt(tension / (density R)): the surface force \
             drives them in a liquid of low viscosity (Oh = {:.1e}), and slower motions are not resolved; compare with a larger viscosity",
            fluid.viscosity * speed / m.tension,
            100.0 * speed / scale,
            fluid.viscosity / (fluid.density * m.tension * radius).sqrt()
        )
    })
}

/// The warning if a drop with the requested angle on a plane is only a few spacings high.
fn low_drop(flow: &Flow, observed: &Observation) -> Option<String> {
    let angle = flow.config.method.wetting?.static_angle();
    let areas = observed.areas;
    let is_wetting = areas.wetting < areas.non_wetting;
    let (area, through) =
        if is_wetting { (areas.wetting, angle) } else { (areas.non_wetting, std::f64::consts::PI - angle) };
    // A meniscus between two walls is not a drop.
    let [a, b] = &observed.contact_lines[..] else { return None };
    let normal = |line: &ContactLine| (flow.config.wall)(line.position).1;
    if normal(a).dot(&normal(b)) < SAME_WALL || area <= 0.0 {
        return None;
    }
    if through < ROUNDING {
        return Some("at this angle the drop spreads to a film, which no spacing resolves: use a thin film".to_owned());
    }
    let across = cap(area, through).height / flow.config.method.spacing;
    let spacing = flow.config.method.spacing * across / ENOUGH;
    (across < ENOUGH).then(|| {
        format!(
            "a drop of this area at this angle is {across:.1} spacings high on a plane, and {ENOUGH:.0} are needed: use \
             sph.spacing = {spacing:.3e} or a thin film"
        )
    })
}

/// Whether an angle in degrees is within [`LIMITING_ANGLE`] of 0 or 180, inclusive.
fn is_limiting(angle: f64) -> bool {
    angle.min(180.0 - angle) <= LIMITING_ANGLE + ROUNDING
}

fn limiting_angle(flow: &Flow) -> Option<String> {
    let angle = flow.config.method.wetting?.static_angle().to_degrees();
    is_limiting(angle).then(|| {
        format!(
            "at an angle of {angle:.1} degrees pressures and positions are those requested if 12 spacings lie across a throat, but an angle measured from the \
             interface has an error bar of some degrees: within {LIMITING_ANGLE:.0} degrees of complete wetting or drying it hardly changes the shape"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_of_limiting_angles_is_within_them() {
        let limiting = [0.0, 5.0, 10.0, 10.0_f64.to_radians().to_degrees(), 170.0, 180.0];
        assert!(limiting.into_iter().all(is_limiting));
        assert!(![10.1, 90.0, 169.9].into_iter().any(is_limiting));
    }
}
