//! Common to all flows of a case: lattice, method and domain, and the initial phase at each point.

use super::error::SetupError;
use super::method::method;
use super::walls::mirrors;
use crate::domain::Domain;
use crate::fill::{self, Lattice, Region};
use crate::method::Method;
use crate::particles::Phase;
use meniscus_case::Sph;
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;

/// Lattice, method and domain of a case.
pub(super) struct Ground {
    pub(super) lattice: Lattice,
    pub(super) method: Method,
    pub(super) domain: Domain,
}

impl Ground {
    pub(super) fn new(geometry: &Geometry, sph: &Sph) -> Result<Self, SetupError> {
        let ground = Self::of(geometry, sph);
        let support = ground.method.kernel.support();
        if !fill::fits(&ground.domain, support) {
            let (size, needed) = (geometry.bounds().size(), fill::PERIODIC_SUPPORTS * support);
            return Err(SetupError::PeriodTooShort { needed, width: size.x, height: size.y });
        }
        Ok(ground)
    }

    /// [`Ground::new`] if the periods are known to be long enough.
    pub(super) fn of(geometry: &Geometry, sph: &Sph) -> Self {
        let bounds = geometry.bounds();
        let sides = sph.sides.each();
        let lattice = Lattice::fitting(bounds, sph.spacing);
        let method = method(sph, geometry, &lattice);
        Self { lattice, method, domain: Domain::new(bounds, geometry.periodic(), mirrors(bounds, sides)) }
    }
}

/// The phase at `x` at time zero.
pub(super) fn start_phase(sph: &Sph, region: &Region, x: Vec2) -> Phase {
    let wetting = region.contains(x) != sph.initial.wetting_is_background;
    if wetting || sph.non_wetting.is_none() { Phase::Wetting } else { Phase::NonWetting }
}
