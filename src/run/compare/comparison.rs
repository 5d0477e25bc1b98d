//! What came out of a comparison.

use serde::Serialize;

/// What came out of one of both.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct Side {
    /// Saturations of the wetting phase.
    pub saturation: Vec<f64>,
    /// Capillary pressures p_n - p_w in Pa at them; none where there is no pressure.
    pub capillary_pressure_pa: Vec<Option<f64>>,
    /// Of displacements in time: times in s of these saturations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub time_s: Vec<f64>,
    /// Of displacements in time: pressures at the inlet less those at the outlet in Pa.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pressure_difference_pa: Vec<Option<f64>>,
    /// Of displacements in time: when the invading phase reached the outlet, in s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub breakthrough_time_s: Option<f64>,
    /// The largest capillary pressure of a drainage, or the smallest one of an imbibition, until the invading phase reached the outlet, in Pa, where it did.
    pub breakthrough_pressure_pa: Option<f64>,
    /// Saturation then.
    pub saturation_at_breakthrough: Option<f64>,
    /// Permeability along x in m²; none where it is not measured.
    pub permeability_m2: Option<f64>,
    /// Wall time in s.
    pub wall_time_s: f64,
    /// Processor time in s over all threads; none where the system does not tell.
    pub processor_time_s: Option<f64>,
    /// Pores, or particles.
    pub unknowns: usize,
    /// Events, or time steps.
    pub steps: u64,
    /// What a reader must know before trusting it.
    pub warnings: Vec<String>,
}

/// Both at one saturation.
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
    /// Whether both go in time.
    #[serde(skip)]
    pub(crate) is_in_time: bool,
    /// Spearman's rank correlation of the order in which elements were filled that both filled after the beginning; none for fewer than three.
    pub(crate) rank_correlation: Option<f64>,
    /// Number of these elements.
    pub(crate) elements_in_both: usize,
    /// Mean of the overlaps at all records of the direct simulation.
    pub(crate) mean_overlap: Option<f64>,
    /// Both at equal saturations.
    pub(crate) at_equal_saturation: Vec<AtSaturation>,
}
