//! What of a network follows from the geometry alone, so that cases of the same geometry share it: regions, throats and pores.

use std::sync::{Arc, OnceLock};
use std::time::Instant;

use super::conductance::conductances;
use super::displacement::{Division, Events};
use super::graph::{Network, Pores};
use super::setup_error::SetupError;
use crate::case::network::PoreNetwork;
use crate::case::{Case, SIDES, Side};
use crate::geometry::Geometry;
use crate::snapshot::Lines;

/// Largest distance of the drawn walls from the walls, over the longer side of the domain: far below what a picture shows.
const OUTLINE_ERROR: f64 = 1e-5;

/// The solids of a case as its network sees them: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] with what is wrong with the shapes.
pub(crate) fn geometry(case: &Case, network: &PoreNetwork) -> Result<Geometry, SetupError> {
    let sides = network.sides.each();
    let periodic = [sides[0] == Side::Periodic, sides[2] == Side::Periodic];
    let walls = sides.map(|side| side == Side::Wall);
    Ok(Geometry::new(&case.geometry)?.with_sides(periodic, walls))
}

/// A network that was extracted, with nothing in it.
pub(crate) struct Ground {
    /// The walls.
    pub(crate) geometry: Geometry,
    /// The network at the depth of the case that it was extracted for.
    pub(crate) network: Arc<Network>,
    /// Its regions joined to pores.
    pub(crate) pores: Arc<Pores>,
    /// The walls, for pictures.
    pub(crate) outline: Arc<Lines<'static>>,
    /// The hash of the geometry in hexadecimal digits.
    pub(crate) hash: String,
    /// Time that the extraction took, in s.
    pub(crate) seconds: f64,
    is_shared: bool,
    conductances: OnceLock<Vec<f64>>,
    permeabilities: OnceLock<[f64; 2]>,
    divisions: [OnceLock<Division>; 2],
}

impl Ground {
    /// The network of a case.
    ///
    /// # Errors
    /// [`SetupError`] where the pores cannot be told apart, or an open side is closed.
    pub(crate) fn of(case: &Case, wanted: &PoreNetwork) -> Result<Self, SetupError> {
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
            conductances: OnceLock::new(),
            permeabilities: OnceLock::new(),
            divisions: [const { OnceLock::new() }; 2],
        })
    }

    /// The same for many cases: what any of them finds of the geometry is kept.
    pub(crate) fn shared(self) -> Self {
        Self { is_shared: true, ..self }
    }

    /// The pore space as these events fill it, where it is kept.
    pub(crate) fn division(&self, events: Events) -> Option<&Division> {
        let find = || Division::of(&self.network, &self.pores, events);
        self.is_shared.then(|| self.divisions[usize::from(events == Events::All)].get_or_init(find))
    }

    /// Permeabilities along x and y at the depth of the case that it was extracted for, as `find` finds them.
    pub(crate) fn permeabilities(&self, find: impl FnOnce() -> [f64; 2]) -> [f64; 2] {
        *self.permeabilities.get_or_init(find)
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

    /// The conductances of all throats at the depth of the case that it was extracted for.
    pub(crate) fn conductances(&self) -> &[f64] {
        self.conductances.get_or_init(|| conductances(&self.network))
    }
}
