//! Results of a comparison.

use serde::Serialize;

/// Results of one of the two cases.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct Side {
    /// Wetting saturations.
    pub saturation: Vec<f64>,
    /// Capillary pressures p_n - p_w in Pa at them; `None` where there is no pressure.
    pub capillary_pressure_pa: Vec<Option<f64>>,
    /// Of displacements in time: times in s of these saturations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub time_s: Vec<f64>,
    /// Of displacements in time: inlet pressures minus outlet pressures in Pa.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pressure_difference_pa: Vec<Option<f64>>,
    /// Of displacements in time: when the invading phase reached the outlet, in s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub breakthrough_time_s: Option<f64>,
    /// Largest capillary pressure of a drainage, or smallest one of an imbibition, until breakthrough, in Pa, if there is one.
    pub breakthrough_pressure_pa: Option<f64>,
    /// Saturation of the invading phase at breakthrough.
    pub saturation_at_breakthrough: Option<f64>,
    /// Why there is no breakthrough, or no pressure of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_breakthrough: Option<String>,
    /// Permeability along x in m²; `None` if not measured.
    pub permeability_m2: Option<f64>,
    /// Wall time in s.
    pub wall_time_s: f64,
    /// Processor time in s over all threads; `None` if the system does not report it.
    pub processor_time_s: Option<f64>,
    /// Pores, or particles.
    pub unknowns: usize,
    /// Events, or time steps.
    pub steps: u64,
    /// What a reader must know before trusting the results.
    pub warnings: Vec<String>,
}

/// Both at equal saturation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct AtSaturation {
    /// Saturations of the network and of the direct simulation.
    pub(crate) saturation: [f64; 2],
    /// Area that both have invaded over the area that either has.
    pub(crate) overlap: f64,
    /// The picture as SVG.
    #[serde(skip)]
    pub(crate) picture: String,
}

/// The comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Comparison {
    /// Titles of both cases.
    pub(crate) titles: [String; 2],
    /// The network.
    pub(crate) network: Side,
    /// The direct simulation.
    pub(crate) direct: Side,
    /// Whether both displacements are in time.
    #[serde(skip)]
    pub(crate) is_in_time: bool,
    /// Spearman's rank correlation of the filling order of the elements that both filled after the start; `None` for fewer than three.
    pub(crate) rank_correlation: Option<f64>,
    /// Number of these elements.
    pub(crate) elements_in_both: usize,
    /// Mean of the overlaps at all records of the direct simulation.
    pub(crate) mean_overlap: Option<f64>,
    /// Both at equal saturations.
    pub(crate) at_equal_saturation: Vec<AtSaturation>,
}
