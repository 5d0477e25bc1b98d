//! Conditions of a displacement: contact angles, open sides, and types of events.

use super::outline::{contains, edges};
use crate::gravity::Gravity;
use meniscus_case::network::{Events, InletDisc, Trapping};
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::head::Head;

/// Conditions of a displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// Contact angle in rad through the defending phase, one for each written shape and then for the walls at the left, right, bottom and top side.
    pub angle: Vec<f64>,
    /// Sides through which the invading phase enters: left, right, bottom, top.
    pub inlet: [bool; 4],
    /// Sides through which the defending phase leaves.
    pub outlet: [bool; 4],
    /// A disc open to a reservoir.
    pub disc: Option<OpenDisc>,
    /// The trapping rule.
    pub trapping: Trapping,
    /// The types of events.
    pub events: Events,
    /// No event takes place above this applied curvature in 1/m.
    pub largest_curvature: f64,
    /// Bursts that were measured.
    pub measured: Vec<MeasuredBurst>,
    /// The effect of corner films.
    pub films: CornerFilms,
    /// Gravity; `None`: all menisci are at the applied pressure.
    pub gravity: Option<Gravity>,
}

/// A disc open to a reservoir, such as a hole in the lid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenDisc {
    /// Center in m.
    pub center: Vec2,
    /// Radius in m.
    pub radius: f64,
    /// Whether the invading phase enters through it; otherwise the defending phase leaves.
    pub is_inlet: bool,
}

impl OpenDisc {
    /// That of a case, as the inlet.
    pub fn inlet(disc: InletDisc) -> Self {
        Self { center: disc.center.into(), radius: disc.radius, is_inlet: true }
    }

    /// Whether it covers a part of an outline in m.
    pub(super) fn covers(&self, outline: &[Vec2]) -> bool {
        let distance = |(a, b): (Vec2, Vec2)| (Curve::Segment { a, b }.project(self.center).point - self.center).norm();
        contains(outline, self.center) || edges(outline).any(|edge| distance(edge) < self.radius)
    }
}

/// Effect of corner films of the wetting phase in a chip on a displacement.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CornerFilms {
    /// No films.
    #[default]
    Absent,
    /// The defending phase drains through them.
    Drain(FilmPaths),
    /// The invading phase enters through them, and closes throats where films meet.
    Join(FilmPaths),
}

/// What corner films connect.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmPaths {
    /// For each throat of the network the curvature in the plane (1/m, positive into the defending phase) at which its films meet: below it when the wetting
    /// phase defends, from it on when it invades; infinite if they do not.
    pub meeting: Vec<f64>,
    /// For each written shape, and then for the four sides, whether its corners hold a film: each wall has a ring of its own. `None`: all films are joined.
    pub rings: Option<Vec<bool>>,
}

/// A measured burst, which replaces that of the formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredBurst {
    /// The throat.
    pub throat: usize,
    /// Curvature by the formula in 1/m at the time of measurement: if the formula gives another one, as for another angle, the formula is used.
    pub formula: f64,
    /// Curvature in 1/m as measured.
    pub curvature: f64,
}

impl Conditions {
    /// All events and no open sides; nothing is trapped.
    pub fn new(angle: Vec<f64>) -> Self {
        Self {
            angle,
            inlet: [false; 4],
            outlet: [false; 4],
            disc: None,
            trapping: Trapping::None,
            events: Events::All,
            largest_curvature: f64::INFINITY,
            measured: Vec::new(),
            films: CornerFilms::Absent,
            gravity: None,
        }
    }

    /// The hydrostatic head at a point in m.
    pub(crate) fn head(&self, at: Vec2) -> Head {
        self.gravity.map_or_else(Head::default, |gravity| gravity.head(at))
    }

    /// The curvature in 1/m at which a meniscus bursts through a throat, `formula` by the formula.
    pub(crate) fn burst(&self, throat: Option<usize>, formula: f64) -> f64 {
        /// Relative differences that come from rounding on another machine.
        const ROUNDING: f64 = 1e-9;
        let is_same = |one: &&MeasuredBurst| {
            Some(one.throat) == throat && (one.formula - formula).abs() <= ROUNDING * formula.abs()
        };
        self.measured.iter().find(is_same).map_or(formula, |one| one.curvature)
    }
}
