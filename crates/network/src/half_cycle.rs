//! One drainage or imbibition: the invading phase, the conditions, and the end.

use super::displacement::{Conditions, CornerFilms};
use super::films::FilmTerms;
use super::graph::Network;
use meniscus_case::FluidPhase;
use meniscus_case::network::{FilmModel, Stop};
use meniscus_core::diagram::Through;

/// One drainage or imbibition.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfCycle {
    /// The invading phase.
    pub invading: FluidPhase,
    /// Angles, open sides and the largest applied curvature.
    pub conditions: Conditions,
    /// Its early end.
    pub(crate) stop: Stop,
    /// The corner films, if any.
    pub(crate) films: Option<FilmTerms>,
    /// Those that its corners can hold.
    pub(crate) corners: Option<FilmTerms>,
    /// Contact angle of each wall through the invading phase in rad if the displaced phase returned.
    pub(crate) returning: Vec<f64>,
    /// How they are connected.
    pub(crate) film_model: FilmModel,
}

impl HalfCycle {
    /// Direction of flow through each side: in through those that feed the invading phase, which change with the half cycle.
    pub(super) fn open_sides(&self) -> [Option<Through>; 4] {
        [0, 1, 2, 3].map(|side| match (self.conditions.inlet[side], self.conditions.outlet[side]) {
            (true, _) => Some(Through::In),
            (_, true) => Some(Through::Out),
            _ => None,
        })
    }

    /// The same with films that are connected in this way.
    pub(crate) fn with_films(&self, film_model: FilmModel, network: &Network) -> Self {
        let films = self.corners.clone().filter(|_| film_model != FilmModel::None);
        let paths = films.as_ref().map(|terms| terms.paths(network, self.invading, film_model));
        let films_of_conditions = match (paths, self.invading) {
            (None, _) => CornerFilms::Absent,
            (Some(paths), FluidPhase::NonWetting) => CornerFilms::Drain(paths),
            (Some(paths), FluidPhase::Wetting) => CornerFilms::Join(paths),
        };
        let conditions = Conditions { films: films_of_conditions, ..self.conditions.clone() };
        Self { conditions, films, film_model, ..self.clone() }
    }
}
