//! Input of the measures, and the groups of measures that a case can request.

use crate::flow::Flow;
use crate::observe::Observation;
use crate::stages::Stages;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::solver::{Measure, Series};
use meniscus_geometry::analysis::phases::PhaseAreas;

/// A disc of the geometry, for comparison with closed-form solutions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscOf {
    /// Center in m.
    pub center: Vec2,
    /// Radius in m.
    pub radius: f64,
}

/// Input of a measure.
pub struct Subject<'a> {
    /// The flow at its end.
    pub flow: &'a Flow,
    /// Interface, contact lines and phases observed in it.
    pub observed: &'a Observation,
    /// Areas of the phases at time zero.
    pub start: PhaseAreas,
    /// All records.
    pub series: &'a Series,
    /// The discs of the geometry.
    pub discs: &'a [DiscOf],
    /// The axis-aligned rectangles of the geometry.
    pub plates: &'a [Bounds],
    /// Speeds of the walls at the left, right, bottom and top side in m/s.
    pub wall_speeds: [f64; 4],
    /// The body forces, where they act one after the other.
    pub stages: Option<&'a Stages>,
    /// Whether they act on the flows with a frozen interface.
    pub is_frozen: bool,
}

/// Columns of the time series: name and value.
pub type Columns = Vec<(&'static str, f64)>;

/// Measures that a case can request in addition to those of every run, usually a benchmark.
#[derive(Clone, Copy)]
pub struct Group {
    /// Further columns of the time series, always the same in the same order.
    pub columns: fn(&Flow, &Observation) -> Columns,
    /// Measures at the end, from the flow, the time series or both.
    pub measures: fn(&Subject) -> Vec<Measure>,
    /// Warnings about the validity of the measures.
    pub warnings: fn(&Subject) -> Vec<String>,
}

impl Group {
    /// A group without columns of its own.
    pub fn of(measures: fn(&Subject) -> Vec<Measure>) -> Self {
        Self::with_columns(|_, _| Vec::new(), measures)
    }

    /// A group with columns of its own.
    pub fn with_columns(columns: fn(&Flow, &Observation) -> Columns, measures: fn(&Subject) -> Vec<Measure>) -> Self {
        Self { columns, measures, warnings: |_| Vec::new() }
    }
}
