//! The part of a network that depends on the geometry alone and is shared by cases of the same geometry: regions, throats and pores.

use std::sync::{Arc, OnceLock};
use std::time::Instant;

use super::displacement::{Division, Events, OpenDisc};
use super::graph::{Network, Pores};
use super::model::Derived;
use super::setup_error::SetupError;
use meniscus_case::network::PoreNetwork;
use meniscus_case::{Case, SIDES, Side};
use meniscus_core::snapshot::Lines;
use meniscus_geometry::Geometry;

/// Largest error of the walls in pictures, over the longer side of the domain: far below visible.
const OUTLINE_ERROR: f64 = 1e-5;

/// The solids of a case for its network: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] if the shapes are invalid.
pub fn geometry(case: &Case, network: &PoreNetwork) -> Result<Geometry, SetupError> {
    let sides = network.sides.each();
    let periodic = [sides[0] == Side::Periodic, sides[2] == Side::Periodic];
    let walls = sides.map(|side| side == Side::Wall);
    Ok(Geometry::new(&case.geometry)?.with_sides(periodic, walls))
}

/// An extracted network without fluids.
pub struct Ground {
    /// The walls.
    pub(crate) geometry: Geometry,
    /// The network at the depth of the case for which it was extracted.
    pub(crate) network: Arc<Network>,
    /// Its regions joined to pores.
    pub(crate) pores: Arc<Pores>,
    /// The walls, for pictures.
    pub(crate) outline: Arc<Lines<'static>>,
    /// The hash of the geometry in hexadecimal digits.
    pub(crate) hash: String,
    /// Wall time of the extraction in s.
    pub(crate) seconds: f64,
    is_shared: bool,
    /// What follows from the network at that depth.
    pub(crate) derived: Arc<Derived>,
    divisions: [OnceLock<Division>; 2],
}

impl Ground {
    /// The network of a case.
    ///
    /// # Errors
    /// [`SetupError`] if extraction fails, or an open side is closed by solids.
    pub fn of(case: &Case, wanted: &PoreNetwork) -> Result<Self, SetupError> {
        let clock = Instant::now();
        let geometry = geometry(case, wanted)?;
        let sides = wanted.sides.each();
        let open = sides.map(|side| matches!(side, Side::Inlet | Side::Outlet));
        let network = Network { depth: case.depth, ..super::extract(&geometry, open)? };
        if network.regions.is_empty() {
            return Err(SetupError::NoPore);
        }
        for (side, kind) in sides.into_iter().enumerate() {
            let role = match kind {
                Side::Inlet => "inlet",
                Side::Outlet => "outlet",
                _ => continue,
            };
            if network.openings.iter().all(|opening| opening.side != side) {
                return Err(SetupError::NoOpening { side: SIDES[side], role });
            }
        }
        let pores = Pores::merged(&network, wanted.persistence);
        let outline = geometry.outline_within(OUTLINE_ERROR * geometry.bounds().size().max());
        Ok(Self {
            hash: format!("{:016x}", geometry.hash()),
            geometry,
            network: Arc::new(network),
            pores: Arc::new(pores),
            outline: Arc::new(outline),
            seconds: clock.elapsed().as_secs_f64(),
            is_shared: false,
            derived: Arc::default(),
            divisions: [const { OnceLock::new() }; 2],
        })
    }

    /// The same for many cases: derived quantities of the geometry are cached.
    pub fn shared(self) -> Self {
        let shared = Self { is_shared: true, ..self };
        // By all threads: cases that run at a time would wait for it within each other.
        shared.division(Events::All);
        shared
    }

    /// The division of the pore space for these events, if cached.
    pub(crate) fn division(&self, events: Events) -> Option<&Division> {
        let find = || Division::of(&self.network, &self.pores, events);
        self.is_shared.then(|| self.divisions[usize::from(events == Events::All)].get_or_init(find))
    }

    /// The regions of which a disc covers a part.
    pub(crate) fn under(&self, disc: &OpenDisc) -> Vec<usize> {
        let find = |division: &Division| division.regions_under(disc);
        match self.division(Events::All) {
            Some(division) => find(division),
            None => find(&Division::of(&self.network, &self.pores, Events::All)),
        }
    }

    /// The network at a depth in m.
    pub(crate) fn with_depth(&self, depth: Option<f64>) -> Arc<Network> {
        if self.network.depth == depth {
            Arc::clone(&self.network)
        } else {
            Arc::new(Network { depth, ..self.network.as_ref().clone() })
        }
    }

    /// Number of walls: shapes and sides.
    pub(crate) fn walls(&self) -> usize {
        self.geometry.shape_count() as usize + SIDES.len()
    }
}
