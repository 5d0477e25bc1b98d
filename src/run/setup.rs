//! From a checked case to its solver: the only module that depends on both.

use super::memory::{self, InsufficientMemory};
use super::slips::slips;
use meniscus_case::{Case, Facts, Model, Side, Sph, check_against};
use meniscus_core::diagram::{Frame, Through};
use meniscus_core::input::Problem;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::solver::{Series, Solver};
use meniscus_geometry::Geometry;

/// Why no solver can be made for a case.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The direct simulation cannot be set up.
    #[error("{0}")]
    Sph(#[from] meniscus_sph::setup::SetupError),
    /// The thin film cannot be set up.
    #[error("{0}")]
    ThinFilm(#[from] meniscus_film::setup::SetupError),
    /// The network cannot be set up.
    #[error("{0}")]
    Network(#[from] meniscus_network::setup::SetupError),
    /// The direct simulation needs more memory than available.
    #[error("{0}")]
    Memory(#[from] InsufficientMemory),
}

impl SetupError {
    /// The mistakes of the case, each at the key that a user would change.
    pub fn problems(&self) -> Vec<Problem> {
        let key = match self {
            Self::Sph(meniscus_sph::setup::SetupError::Geometry(error))
            | Self::Network(meniscus_network::setup::SetupError::Geometry(error)) => return error.problems_of_case(),
            Self::Sph(error) => error.key(),
            Self::ThinFilm(error) => error.key(),
            Self::Network(error) => error.key(),
            Self::Memory(_) => "sph.spacing".to_owned(),
        };
        vec![Problem::of_text(key, &self.to_string())]
    }
}

/// The solver of a case, in its initial state.
pub fn build(case: &Case) -> Result<Box<dyn Solver>, SetupError> {
    solver(case, true, &mut |_| {})
}

/// The solver of a case, in its initial state; `packed` receives the progress of the packing of particles, if there is one.
pub fn build_watched(case: &Case, packed: &mut dyn FnMut(f64)) -> Result<Box<dyn Solver>, SetupError> {
    solver(case, true, packed)
}

/// The solver of a case that is about to restore a saved state: the particles are not packed.
pub fn build_to_resume(case: &Case) -> Result<Box<dyn Solver>, SetupError> {
    solver(case, false, &mut |_| {})
}

fn solver(case: &Case, is_packed: bool, packed: &mut dyn FnMut(f64)) -> Result<Box<dyn Solver>, SetupError> {
    match &case.model {
        Model::Sph(sph) => {
            memory(case, sph)?;
            let solver = meniscus_sph::setup::solver(case, sph, is_packed, packed)?;
            Ok(Box::new(solver.measuring(meniscus_validation::requested_groups(&sph.measure))))
        }
        Model::ThinFilm(film) => Ok(Box::new(meniscus_film::setup::build(case, film)?)),
        Model::Network(network) => Ok(meniscus_network::setup::build(case, network)?),
    }
}

/// Whether there is memory for the particles of a case, as far as the system reports it.
fn memory(case: &Case, sph: &Sph) -> Result<(), SetupError> {
    let Some(available) = memory::available() else { return Ok(()) };
    let size = Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min);
    let area = size.x * size.y;
    // The pore is measured only if the whole domain would not fit.
    if memory::check(area, sph.spacing, available).is_err() {
        let porosity = meniscus_sph::setup::geometry(case, sph)?.porosity().value;
        memory::check(porosity * area, sph.spacing, available)?;
    }
    Ok(())
}

/// What is wrong with a case for its actual geometry: unresolved throats, phases inside the solid, open sides without an opening.
pub fn problems(case: &Case) -> Vec<Problem> {
    let Model::Sph(sph) = &case.model else { return Vec::new() };
    let geometry = match meniscus_sph::setup::checked_geometry(case, sph) {
        Ok(geometry) => geometry,
        Err(error) => return SetupError::from(error).problems(),
    };
    let region = |shape| meniscus_sph::setup::region(case, std::slice::from_ref(shape));
    let regions: Vec<_> = sph.initial.wetting.iter().map(region).collect();
    let facts = Facts {
        throat: geometry.narrowest_throat().map(|throat| (throat.width, throat.center)),
        wall_distance: &|x| geometry.signed_distance(x),
        in_initial_shape: &|index, x| regions[index].signed_distance(x) < 0.0,
    };
    check_against(case, &facts)
}

/// The geometry of a case with its sides, as in its solver; a thin film has only the shapes of its case.
///
/// # Errors
/// [`SetupError`] if the shapes are not usable.
pub fn geometry(case: &Case) -> Result<Geometry, SetupError> {
    match &case.model {
        Model::Sph(sph) => Ok(meniscus_sph::setup::geometry(case, sph)?),
        Model::Network(network) => Ok(meniscus_network::setup::geometry(case, network)?),
        Model::ThinFilm(_) => Ok(Geometry::new(&case.geometry).map_err(meniscus_sph::setup::SetupError::from)?),
    }
}

/// The domain of a case and its sides, for pictures; `None` for a film on a wall.
pub(super) fn frame(case: &Case) -> Option<Frame> {
    let sides = case.model.sides()?;
    let through = |side: Side| match side {
        Side::Inlet => Some(Through::In),
        Side::Outlet => Some(Through::Out),
        _ => None,
    };
    Some(Frame {
        bounds: [case.geometry.min, case.geometry.max],
        open: sides.each().map(through),
        periodic: sides.periodic(),
    })
}

/// What a reader must know before trusting a run of the case, from the case and from the present state of its solver with the rows so far.
pub fn warnings(case: &Case, solver: &dyn Solver, series: &Series) -> Vec<String> {
    let of_case = match &case.model {
        Model::ThinFilm(film) => film.notes(case.end),
        Model::Sph(sph) => {
            let of_depth = sph
                .depth
                .and_then(|_| geometry(case).ok())
                .map(|geometry| meniscus_sph::setup::notes_on_depth(sph, &geometry));
            coarse_throat(case, sph).into_iter().chain(not_at_rest(sph)).chain(of_depth.unwrap_or_default()).collect()
        }
        Model::Network(_) => Vec::new(),
    };
    slips(case).into_iter().chain(of_case).chain(solver.warnings(series)).collect()
}

/// Spacings across a throat below which its menisci and their angles have errors of several degrees.
const ACROSS_THROAT: f64 = 8.0;

/// Parts of the initial state that are not at rest.
fn not_at_rest(sph: &Sph) -> Vec<String> {
    let Some(start) = sph.initial.network.as_ref().filter(|_| sph.acting_tension() > 0.0) else { return Vec::new() };
    /// Angles in degrees that differ by less are equal up to rounding in a file.
    const SAME: f64 = 1e-6;
    let mut found = Vec::new();
    let angles = sph.wetting_model.map(|model| model.hysteresis_range().map(f64::to_degrees));
    let [smallest, largest] = start.state.contact_angles_deg;
    if sph.wetting_patches.is_empty()
        && let Some([receding, advancing]) = angles.filter(|it| it[0] > largest + SAME || it[1] < smallest - SAME)
    {
        found.push(format!(
            "the menisci of sph.initial.network meet the walls at {smallest:.1} to {largest:.1} degrees, and this case has {receding:.1} to \
             {advancing:.1}: they will move at once"
        ));
    }
    let chords = start.state.menisci.iter().filter(|meniscus| meniscus.curvature_per_m.is_none()).count();
    if chords > 0 {
        found.push(format!(
            "{chords} menisci of sph.initial.network are unknown and replaced by chords: they are not at rest"
        ));
    }
    found
}

/// A throat that an interface must pass with few particles across.
fn coarse_throat(case: &Case, sph: &Sph) -> Option<String> {
    let width = throat(case).filter(|_| sph.acting_tension() > 0.0)?;
    let across = width / sph.spacing;
    // A smaller difference is rounding of the positions of shapes.
    (across < (1.0 - 1e-9) * ACROSS_THROAT).then(|| {
        format!(
            "{across:.1} particles across the narrowest throat: entry pressures hold from {ACROSS_THROAT:.0}, angles measured there from 16; \
             use sph.spacing = {:.2e}",
            width / ACROSS_THROAT
        )
    })
}

/// Nodes along each axis at which the fluids of the initial state are sampled.
const NODES: usize = 160;

/// Area in m² of the initial drop or bubble: of the phase with the smaller area, unless it reaches from one side of the domain to the opposite one.
pub(crate) fn drop_area(case: &Case) -> Option<f64> {
    let Model::Sph(sph) = &case.model else { return None };
    if sph.initial.wetting.is_empty() {
        return None;
    }
    let pore = meniscus_sph::setup::geometry(case, sph).ok()?;
    let region = meniscus_sph::setup::region(case, &sph.initial.wetting);
    let (min, max) = (Vec2::from(case.geometry.min), Vec2::from(case.geometry.max));
    let cell = (max - min) / NODES as f64;
    let mut found = [(0, Bounds { min: max, max: min }); 2];
    for (i, j) in (0..NODES).flat_map(|i| (0..NODES).map(move |j| (i, j))) {
        let x = min + cell.component_mul(&Vec2::new(i as f64 + 0.5, j as f64 + 0.5));
        if pore.signed_distance(x) > 0.0 {
            let is_wetting = (region.signed_distance(x) < 0.0) != sph.initial.wetting_is_background;
            let (count, around) = &mut found[usize::from(is_wetting)];
            *count += 1;
            *around = Bounds { min: around.min.inf(&x), max: around.max.sup(&x) };
        }
    }
    let (count, around) = if found[0].0 < found[1].0 { found[0] } else { found[1] };
    let spans = [0, 1].map(|k| around.min[k] < min[k] + cell[k] && around.max[k] > max[k] - cell[k]);
    (count > 0 && spans == [false; 2]).then(|| count as f64 * cell.x * cell.y)
}

/// Width of the narrowest throat of a case in m; `None` if there is no throat, or no usable geometry.
pub(crate) fn throat(case: &Case) -> Option<f64> {
    let Model::Sph(sph) = &case.model else { return None };
    let geometry = meniscus_sph::setup::geometry(case, sph).ok()?;
    geometry.narrowest_throat().map(|throat| throat.width)
}
