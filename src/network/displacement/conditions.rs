//! What displaces what: angles, open sides, and which events there are.

use crate::case::network::{Events, Trapping};

/// What displaces what.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// Contact angle in rad through the defending phase, one for each written shape and then for the walls at the left, right, bottom
    /// and top side.
    pub angle: Vec<f64>,
    /// Sides through which the invading phase comes: left, right, bottom, top.
    pub inlet: [bool; 4],
    /// Sides through which the defending phase leaves.
    pub outlet: [bool; 4],
    /// What is trapped.
    pub trapping: Trapping,
    /// Which events there are.
    pub events: Events,
    /// No event takes place above this curvature in 1/m.
    pub largest_curvature: f64,
    /// Bursts that were measured.
    pub measured: Vec<MeasuredBurst>,
    /// What films in corners do.
    pub films: CornerFilms,
}

/// What films of the wetting phase in the corners of a chip do to a displacement.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CornerFilms {
    /// There are none.
    #[default]
    Absent,
    /// The defending phase flows out through them: none of it is trapped.
    Drain,
    /// The invading phase flows in through them: all of it takes part, and it closes throats where films meet.
    Join {
        /// For each throat of the network the curvature in the plane (1/m, above 0 into the defending phase) at which its films meet; infinite where
        /// they do not.
        meeting: Vec<f64>,
    },
}

/// A burst that was measured, in place of that of the formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredBurst {
    /// The throat.
    pub throat: usize,
    /// Curvature by the formula in 1/m when it was measured: where the formula gives another one, as for another angle, it stays.
    pub formula: f64,
    /// Curvature in 1/m as measured.
    pub curvature: f64,
}

impl Conditions {
    /// The curvature in 1/m at which a meniscus bursts through a throat where the formula gives `formula`.
    pub(crate) fn burst(&self, throat: Option<usize>, formula: f64) -> f64 {
        /// Relative differences that come from rounding on another machine.
        const ROUNDING: f64 = 1e-9;
        let is_same = |one: &&MeasuredBurst| {
            Some(one.throat) == throat && (one.formula - formula).abs() <= ROUNDING * formula.abs()
        };
        self.measured.iter().find(is_same).map_or(formula, |one| one.curvature)
    }
}
