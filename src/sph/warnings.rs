//! What of a flow is out of the reach of its resolution, in words for the reader of its measures.

use crate::interface::cap::cap;
use crate::interface::contact::ContactLine;
use crate::interface::wall::{WallPoint, is_edge_between};
use crate::math::{Vec2, perpendicular};
use crate::solver::Series;
use crate::sph::flow::Flow;
use crate::sph::observe::Observation;
use crate::sph::unresolved::SMALLEST_PIECE;

/// Share of the smaller phase in thin parts from which a reader must know: the wedges at contact lines stay below it.
const LARGEST_THIN_SHARE: f64 = 0.01;

/// Spacings across a drop or a film that its measures need.
const ENOUGH: f64 = 8.0;

/// Cosine between the wall normals at both contact lines of a drop on a plane.
const SAME_WALL: f64 = 0.9;

/// Angles as near as this to 0 or 180 degrees are told apart by the place of the interface to the second order only, in degrees.
const LIMITING_ANGLE: f64 = 10.0;

/// Differences of angles that are rounding, in degrees and in rad.
const ROUNDING: f64 = 1e-9;

/// Ohnesorge number below which interfaces that end at an edge have been seen to swing (docs/validation/pillar.md).
const THIN_LIQUID: f64 = 0.01;

/// The warnings that a flow asks for now.
#[must_use]
pub fn warnings(flow: &Flow, seen: &Observation, series: &Series) -> Vec<String> {
    if flow.setting.method.tension == 0.0 {
        return Vec::new();
    }
    [
        pieces_and_films(flow, seen, series),
        low_drop(flow, seen),
        limiting_angle(flow),
        thin_liquid_at_edge(flow, seen, series),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Pieces and films below the resolution, now or at any record before.
fn pieces_and_films(flow: &Flow, seen: &Observation, series: &Series) -> Option<String> {
    let (share, small_pieces) = (seen.thin(flow).share, seen.small_pieces);
    let most = most_small_pieces(series);
    let before = most.filter(|(most, _)| *most > small_pieces as f64);
    if small_pieces == 0 && before.is_none() && share < LARGEST_THIN_SHARE {
        return None;
    }
    let (percent, half) = (100.0 * share, 0.5 * flow.setting.method.spacing);
    let before = before.map(|(most, time)| format!(" ({most} at t = {time:.4e} s)")).unwrap_or_default();
    Some(format!(
        "{small_pieces} pieces of fewer than {SMALLEST_PIECE} particles{before}, and films thinner than three particles with {percent:.1} % of \
         the smaller phase, are not resolved: what hangs on them (pieces counted, trapped fluid, angles beside them) is not a result; compare \
         with sph.spacing = {half:.4e}"
    ))
}

/// The most pieces below the resolution of all records, and when there were so many first, in s.
pub fn most_small_pieces(series: &Series) -> Option<(f64, f64)> {
    let records = series.column("small_pieces").zip(series.column("time_s"));
    records.reduce(|most, record| if record.0 > most.0 { record } else { most })
}

/// A drop on a plane of the asked-for angle that is only a few spacings high.
fn low_drop(flow: &Flow, seen: &Observation) -> Option<String> {
    let angle = flow.setting.method.wetting?.static_angle();
    let areas = seen.areas;
    let is_wetting = areas.wetting < areas.non_wetting;
    let (area, through) =
        if is_wetting { (areas.wetting, angle) } else { (areas.non_wetting, std::f64::consts::PI - angle) };
    // A meniscus between two walls is no drop.
    let [a, b] = &seen.contact_lines[..] else { return None };
    let normal = |line: &ContactLine| (flow.setting.wall)(line.position).1;
    if normal(a).dot(&normal(b)) < SAME_WALL || area <= 0.0 {
        return None;
    }
    if through < ROUNDING {
        return Some("at this angle the drop spreads to a film, which no spacing resolves: use a thin film".to_owned());
    }
    let across = cap(area, through).height / flow.setting.method.spacing;
    let spacing = flow.setting.method.spacing * across / ENOUGH;
    (across < ENOUGH).then(|| {
        format!(
            "a drop of this area at this angle is {across:.1} spacings high on a plane, and {ENOUGH:.0} are needed: use \
             sph.spacing = {spacing:.3e} or a thin film"
        )
    })
}

/// A contact line at an edge of a wall, or with edges before it at the start, in a liquid too thin to damp what the step feeds.
fn thin_liquid_at_edge(flow: &Flow, seen: &Observation, series: &Series) -> Option<String> {
    let m = &flow.setting.method;
    let length = seen.areas.wetting.min(seen.areas.non_wetting).sqrt();
    let ohnesorge = m.wetting_fluid.viscosity / (m.wetting_fluid.density * m.tension * length).sqrt();
    // Without an interface the length is 0.
    if !(ohnesorge < THIN_LIQUID && length > 0.0) {
        return None;
    }
    let wall = |x: Vec2| WallPoint::from((flow.setting.wall)(x));
    let is_at_edge = |line: &ContactLine| {
        let along = m.kernel.h * perpendicular(wall(line.position).normal);
        is_edge_between(&wall, line.position - along, line.position + along)
    };
    let what = if seen.lines_with_angle().any(is_at_edge) {
        format!("a contact line stands at an edge in a thin liquid (Oh = {ohnesorge:.4})")
    } else if m.wetting.is_some() && series.rows.is_empty() && has_convex_edge(flow) {
        format!("an edge of a wall may be reached by a contact line of a thin liquid (Oh = {ohnesorge:.4})")
    } else {
        return None;
    };
    Some(format!(
        "{what}: long steps make the interface swing there; sph.numerics.time-step-factor = 0.1 makes the swings small"
    ))
}

/// Whether fluid stands at a convex edge of a wall.
fn has_convex_edge(flow: &Flow) -> bool {
    let (p, h) = (&flow.state.particles, flow.setting.method.kernel.h);
    let wall = |x: Vec2| WallPoint::from((flow.setting.wall)(x));
    p.position[..p.fluids].iter().any(|&x| {
        let here = wall(x);
        here.distance < h && is_convex_edge(&wall, x - here.distance * here.normal, h)
    })
}

/// Whether a wall has a convex edge within `reach` (m) of its point `x` (m).
fn is_convex_edge(wall: &dyn Fn(Vec2) -> WallPoint, x: Vec2, reach: f64) -> bool {
    let along = reach * perpendicular(wall(x).normal);
    let (behind, ahead) = (x - along, x + along);
    // Normals open outward where the solid is convex, and close in a corner of the pore.
    is_edge_between(wall, behind, ahead) && (wall(ahead).normal - wall(behind).normal).dot(&along) > 0.0
}

/// Whether an angle in degrees is within [`LIMITING_ANGLE`] of 0 or 180, the bound included.
fn is_limiting(angle: f64) -> bool {
    angle.min(180.0 - angle) <= LIMITING_ANGLE + ROUNDING
}

fn limiting_angle(flow: &Flow) -> Option<String> {
    let angle = flow.setting.method.wetting?.static_angle().to_degrees();
    is_limiting(angle).then(|| {
        format!(
            "at an angle of {angle:.1} degrees pressures and places are those asked for, but an angle measured from the interface has an \
             error bar of some degrees: within {LIMITING_ANGLE:.0} degrees of complete wetting or drying it hardly changes the shape"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall from the floor y = 0, x < 0 to a face x = 0: down it with the solid below (convex), or up it with the solid beside (a corner).
    fn bent(convex: bool) -> impl Fn(Vec2) -> WallPoint {
        move |x| {
            let (floor, face) = (x.y, if convex { x.x } else { -x.x });
            let normal = if convex { Vec2::x() } else { -Vec2::x() };
            let at_face = if convex { face > floor } else { face < floor };
            if at_face {
                WallPoint { distance: face, normal }
            } else {
                WallPoint { distance: floor, normal: Vec2::y() }
            }
        }
    }

    #[test]
    fn convex_edges_are_told_from_corners_and_flat_walls() {
        for at in [-0.05, -0.02] {
            let x = Vec2::new(at, 0.0);
            assert!(is_convex_edge(&bent(true), x, 0.1), "an edge near {at}");
            assert!(!is_convex_edge(&bent(false), x, 0.1), "a corner near {at}");
        }
        assert!(!is_convex_edge(&bent(true), Vec2::new(-1.0, 0.0), 0.1), "a flat wall");
    }

    #[test]
    fn the_bound_of_limiting_angles_is_within_them() {
        let limiting = [0.0, 5.0, 10.0, 10.0_f64.to_radians().to_degrees(), 170.0, 180.0];
        assert!(limiting.into_iter().all(is_limiting));
        assert!(![10.1, 90.0, 169.9].into_iter().any(is_limiting));
    }
}
