//! The parts of both phases that the particles do not resolve: small pieces, thin films.

use crate::analysis::blobs::{Blob, LINK, blobs};
use crate::analysis::resolution::thin_parts;
use crate::sph::flow::Flow;
use crate::sph::particles::Phase;

/// Pieces of fewer particles than this, five across, have no curvature that a fit could find.
pub const SMALLEST_PIECE: usize = 20;

/// The parts of both phases that the particles do not resolve.
#[derive(Debug, Clone)]
pub struct Unresolved {
    /// Whether the phase around each fluid particle is thinner than about three particles.
    pub thin: Vec<bool>,
    /// Thin particles over the number of particles of the phase that has fewer.
    pub share: f64,
    /// Connected pieces of either phase with fewer particles than have a curvature.
    pub small_pieces: usize,
}

impl Unresolved {
    /// Looks at the fluid of a flow with the pieces of its wetting phase.
    #[must_use]
    pub fn of(flow: &Flow, wetting_pieces: &[Blob]) -> Self {
        let (p, fluids) = (&flow.state.particles, flow.state.particles.fluids);
        let (points, volumes, period) =
            (&p.position[..fluids], &flow.fields.volume[..fluids], flow.setting.domain.periods());
        let is_wetting: Vec<bool> = p.phase[..fluids].iter().map(|phase| *phase == Phase::Wetting).collect();
        let wetting = is_wetting.iter().filter(|wetting| **wetting).count();
        let smaller = wetting.min(fluids - wetting);
        if smaller == 0 || flow.setting.method.tension == 0.0 {
            return Self { thin: vec![false; fluids], share: 0.0, small_pieces: 0 };
        }
        let others: Vec<bool> = is_wetting.iter().map(|wetting| !wetting).collect();
        let other_pieces = blobs(points, volumes, &others, LINK * flow.setting.method.spacing, period);
        let small = |pieces: &[Blob]| pieces.iter().filter(|piece| piece.count < SMALLEST_PIECE).count();
        let thin = thin_parts(points, &is_wetting, flow.setting.method.spacing, period);
        let share = thin.iter().filter(|thin| **thin).count() as f64 / smaller as f64;
        Self { thin, share, small_pieces: small(wetting_pieces) + small(&other_pieces) }
    }
}
