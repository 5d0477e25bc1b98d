//! The parts of both phases below the resolution of the particles: small ganglia, thin films.

use crate::flow::Flow;
use crate::particles::Phase;
use meniscus_geometry::analysis::blobs::{Blob, LINK, blobs};
use meniscus_geometry::analysis::resolution::thin_parts;

/// Number of particles, five across, below which the curvature of a ganglion cannot be fitted.
pub(crate) const SMALLEST_PIECE: usize = 20;

/// Where a phase is thinner than about three particles.
#[derive(Debug, Clone)]
pub(crate) struct ThinParts {
    /// Whether the phase is that thin around each fluid particle.
    pub(crate) is_thin: Vec<bool>,
    /// Number of thin particles over that of all particles of the smaller phase.
    pub(crate) share: f64,
}

impl ThinParts {
    /// The thin parts in a flow.
    pub(crate) fn of(flow: &Flow) -> Self {
        let (is_wetting, smaller) = (is_of(flow, Phase::Wetting), smaller_phase(flow));
        if smaller == 0 {
            return Self { is_thin: vec![false; is_wetting.len()], share: 0.0 };
        }
        let points = &flow.state.particles.position[..is_wetting.len()];
        let is_thin = thin_parts(points, &is_wetting, flow.config.method.spacing, flow.config.domain.periods());
        let share = is_thin.iter().filter(|thin| **thin).count() as f64 / smaller as f64;
        Self { is_thin, share }
    }
}

/// The ganglia of a phase, the largest first.
pub(crate) fn ganglia(flow: &Flow, phase: Phase) -> Vec<Blob> {
    parts(flow, &flow.fields.bulk.volume[..flow.state.particles.fluids], phase)
}

/// The ganglia of a phase with the sums of `volumes` over their particles, the largest first.
fn parts(flow: &Flow, volumes: &[f64], phase: Phase) -> Vec<Blob> {
    let (view, link) = (&flow.view(), LINK * flow.config.method.spacing);
    blobs(volumes, &is_of(flow, phase), |a| {
        // An image is never nearer than its source.
        let below = flow.neighborhood.pairs.of(a).map(|ab| ab.b).filter(move |&b| b < a);
        below.filter(move |&b| view.separation(a, b).norm_squared() < link * link)
    })
}

/// Length in m of the row of particles of the largest ganglion of the wetting phase that lie within a spacing of a wall; 0 for a drop off the walls.
pub fn wetted_by_largest_part(flow: &Flow) -> f64 {
    let (p, spacing) = (&flow.state.particles, flow.config.method.spacing);
    let lengths = (0..p.fluids).map(|a| if flow.fields.bulk.wall_distance[a] < spacing { spacing } else { 0.0 });
    let lengths: Vec<f64> = lengths.collect();
    // Their sum over each ganglion is what it has instead of an area.
    parts(flow, &lengths, Phase::Wetting).iter().max_by_key(|part| part.count).map_or(0.0, |largest| largest.area)
}

/// Number of ganglia of the wetting phase with enough particles for a curvature.
pub fn resolved_parts(wetting_pieces: &[Blob]) -> usize {
    wetting_pieces.iter().filter(|ganglion| ganglion.count >= SMALLEST_PIECE).count()
}

/// Number of ganglia of either phase with too few particles for a curvature; `wetting_pieces` are the ganglia of the wetting phase.
pub(crate) fn small_pieces(flow: &Flow, wetting_pieces: &[Blob]) -> usize {
    if smaller_phase(flow) == 0 {
        return 0;
    }
    let others = ganglia(flow, Phase::NonWetting);
    wetting_pieces.iter().chain(&others).filter(|ganglion| ganglion.count < SMALLEST_PIECE).count()
}

/// Whether each fluid particle is of the phase.
fn is_of(flow: &Flow, phase: Phase) -> Vec<bool> {
    let p = &flow.state.particles;
    p.phase[..p.fluids].iter().map(|own| *own == phase).collect()
}

/// Number of particles of the smaller phase; 0 without an interface.
fn smaller_phase(flow: &Flow) -> usize {
    if flow.config.method.tension == 0.0 {
        return 0;
    }
    let wetting = is_of(flow, Phase::Wetting).into_iter().filter(|is_wetting| *is_wetting).count();
    wetting.min(flow.state.particles.fluids - wetting)
}
