//! From a checked case to its solver: the one place that knows both.

use crate::case::checked::{Case, Model};
use crate::case::{Facts, check_against};
use crate::geometry::Geometry;
use crate::input::Problem;
use crate::solver::Solver;
use crate::{network, sph, thin_film};

/// A case that no solver can be made for.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The direct simulation cannot be set up.
    #[error("{0}")]
    Sph(#[from] sph::setup::SetupError),
    /// The thin film cannot be set up.
    #[error("{0}")]
    ThinFilm(#[from] thin_film::setup::SetupError),
    /// The network cannot be set up.
    #[error("{0}")]
    Network(#[from] network::setup::SetupError),
}

/// The solver of a case, in its initial state.
///
/// # Errors
/// [`SetupError`].
pub fn build(case: &Case) -> Result<Box<dyn Solver>, SetupError> {
    build_watched(case, &mut |_| {})
}

/// The solver of a case, in its initial state; `packed` is told the share of the packing of particles that is done, where there is one.
///
/// # Errors
/// [`SetupError`].
pub fn build_watched(case: &Case, packed: &mut dyn FnMut(f64)) -> Result<Box<dyn Solver>, SetupError> {
    match &case.model {
        Model::Sph(sph) => Ok(Box::new(sph::setup::build_watched(case, sph, packed)?)),
        Model::ThinFilm(film) => Ok(Box::new(thin_film::setup::build(case, film)?)),
        Model::Network(network) => Ok(Box::new(network::setup::build(case, network)?)),
    }
}

/// What is wrong with a case on its real geometry: throats that are not resolved, phases inside the solid.
///
/// # Errors
/// [`SetupError`] where the shapes themselves are not usable.
pub fn problems(case: &Case) -> Result<Vec<Problem>, SetupError> {
    let Model::Sph(sph) = &case.model else { return Ok(Vec::new()) };
    let geometry = sph::setup::geometry(case, sph)?;
    let region = |shape| sph::setup::region(case, std::slice::from_ref(shape));
    let regions: Vec<_> = sph.initial.wetting.iter().map(region).collect();
    let facts = Facts {
        throat: geometry.narrowest_throat().map(|throat| (throat.width, throat.center)),
        wall_distance: &|x| geometry.signed_distance(x),
        in_initial_shape: &|index, x| regions[index].signed_distance(x) < 0.0,
    };
    Ok(check_against(case, &facts))
}

/// The geometry of a case with its sides, as its solver sees it; a thin film has the shapes of its case alone.
///
/// # Errors
/// [`SetupError`] where the shapes are not usable.
pub fn geometry(case: &Case) -> Result<Geometry, SetupError> {
    match &case.model {
        Model::Sph(sph) => Ok(sph::setup::geometry(case, sph)?),
        Model::Network(network) => Ok(network::setup::geometry(case, network)?),
        Model::ThinFilm(_) => Ok(Geometry::new(&case.geometry).map_err(sph::setup::SetupError::from)?),
    }
}

/// Width of the narrowest throat of a case in m; none where there is no throat, or no usable geometry.
#[must_use]
pub fn throat(case: &Case) -> Option<f64> {
    let Model::Sph(sph) = &case.model else { return None };
    let geometry = sph::setup::geometry(case, sph).ok()?;
    geometry.narrowest_throat().map(|throat| throat.width)
}
