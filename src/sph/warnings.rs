//! What of a flow is out of the reach of its resolution, in words for the reader of its measures.

use crate::analysis::blobs::{LINK, blobs};
use crate::analysis::laws::drops::cap;
use crate::analysis::resolution::thin_parts;
use crate::interface::contact::ContactLine;
use crate::interface::wall::{WallPoint, is_edge_between};
use crate::math::{Vec2, perpendicular};
use crate::sph::flow::Flow;
use crate::sph::observe::Observation;
use crate::sph::particles::Phase;

/// Pieces of fewer particles than this, five across, have no curvature that a fit could find.
const SMALLEST_PIECE: usize = 20;

/// Share of the smaller phase in thin parts from which a reader must know: the wedges at contact lines stay below it.
const LARGEST_THIN_SHARE: f64 = 0.01;

/// Spacings across a drop or a film that its measures need.
const ENOUGH: f64 = 8.0;

/// Cosine between the wall normals at both contact lines of a drop on a plane.
const SAME_WALL: f64 = 0.9;

/// Angles nearer than this to 0 or 180 degrees are told apart by the place of the interface to the second order only, in degrees.
const LIMITING_ANGLE: f64 = 10.0;

/// Ohnesorge number below which interfaces that end at an edge have been seen to swing (docs/validation/pillar.md).
const THIN_LIQUID: f64 = 0.01;

/// The parts of both phases that the particles do not resolve.
pub struct Unresolved {
    /// Whether the phase around each fluid particle is thinner than about three particles.
    pub thin: Vec<bool>,
    /// Thin particles over the number of particles of the phase that has fewer.
    pub share: f64,
    /// Connected pieces of either phase with fewer particles than have a curvature.
    pub small_pieces: usize,
}

impl Unresolved {
    /// Looks at the fluid of a flow.
    #[must_use]
    pub fn of(flow: &Flow) -> Self {
        let (p, fluids) = (&flow.state.particles, flow.state.particles.fluids);
        let (points, volumes, period) =
            (&p.position[..fluids], &flow.fields.volume[..fluids], flow.setting.domain.periods());
        let is_wetting: Vec<bool> = p.phase[..fluids].iter().map(|phase| *phase == Phase::Wetting).collect();
        let wetting = is_wetting.iter().filter(|wetting| **wetting).count();
        let smaller = wetting.min(fluids - wetting);
        if smaller == 0 || flow.setting.method.tension == 0.0 {
            return Self { thin: vec![false; fluids], share: 0.0, small_pieces: 0 };
        }
        let thin = thin_parts(points, &is_wetting, flow.setting.method.spacing, period);
        let small = |member: &[bool]| {
            let pieces = blobs(points, volumes, member, LINK * flow.setting.method.spacing, period);
            pieces.iter().filter(|piece| piece.count < SMALLEST_PIECE).count()
        };
        let others: Vec<bool> = is_wetting.iter().map(|wetting| !wetting).collect();
        let small_pieces = small(&is_wetting) + small(&others);
        let share = thin.iter().filter(|thin| **thin).count() as f64 / smaller as f64;
        Self { thin, share, small_pieces }
    }
}

/// The warnings that a flow asks for now.
#[must_use]
pub fn warnings(flow: &Flow, seen: &Observation) -> Vec<String> {
    if flow.setting.method.tension == 0.0 {
        return Vec::new();
    }
    [pieces_and_films(flow), low_drop(flow, seen), limiting_angle(flow), thin_liquid_at_edge(flow, seen)]
        .into_iter()
        .flatten()
        .collect()
}

fn pieces_and_films(flow: &Flow) -> Option<String> {
    let Unresolved { share, small_pieces, .. } = Unresolved::of(flow);
    if small_pieces == 0 && share < LARGEST_THIN_SHARE {
        return None;
    }
    let (percent, half) = (100.0 * share, 0.5 * flow.setting.method.spacing);
    Some(format!(
        "{small_pieces} pieces of fewer than {SMALLEST_PIECE} particles, and films thinner than three particles with {percent:.1} % of the \
         smaller phase, are not resolved: what hangs on them (pieces counted, trapped fluid, angles beside them) is not a result; compare \
         with sph.spacing = {half:.4e}"
    ))
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
    if normal(a).dot(&normal(b)) < SAME_WALL || !(area > 0.0 && through > 0.0) {
        return None;
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

/// A contact line at an edge of a wall in a liquid too thin to damp what the step feeds.
fn thin_liquid_at_edge(flow: &Flow, seen: &Observation) -> Option<String> {
    let m = &flow.setting.method;
    let length = seen.areas.wetting.min(seen.areas.non_wetting).sqrt();
    let ohnesorge = m.wetting_fluid.viscosity / (m.wetting_fluid.density * m.tension * length).sqrt();
    let wall = |x: Vec2| WallPoint::from((flow.setting.wall)(x));
    let is_at_edge = |line: &ContactLine| {
        let along = m.kernel.h * perpendicular(wall(line.position).normal);
        is_edge_between(&wall, line.position - along, line.position + along)
    };
    (ohnesorge < THIN_LIQUID && seen.lines_with_angle().any(is_at_edge)).then(|| {
        format!(
            "a contact line stands at an edge in a thin liquid (Oh = {ohnesorge:.4}): long steps make the interface swing there; \
             sph.numerics.time-step-factor = 0.1 makes the swings small"
        )
    })
}

fn limiting_angle(flow: &Flow) -> Option<String> {
    let angle = flow.setting.method.wetting?.static_angle().to_degrees();
    (!(LIMITING_ANGLE..=180.0 - LIMITING_ANGLE).contains(&angle)).then(|| {
        format!(
            "at an angle of {angle:.1} degrees pressures and places are those asked for, but an angle measured from the interface has an \
             error bar of some degrees: within {LIMITING_ANGLE:.0} degrees of complete wetting or drying it hardly changes the shape"
        )
    })
}
