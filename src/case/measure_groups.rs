//! `[sph.measure]`: groups of measures that a case can request; each is a table `[sph.measure.NAME]`.

use crate::input::tables::{Empty, name, tables};

/// Measures that come together, and what a case needs for them.
#[derive(Debug)]
pub struct Offer {
    /// Names.
    pub names: &'static [&'static str],
    /// What provides them, such as `[sph.measure.jurin]`.
    pub given_by: String,
    /// Whether the case has that.
    pub is_given: bool,
}

impl Offer {
    pub(super) fn new(names: &'static [&'static str], given_by: &str, is_given: bool) -> Self {
        Self { names, given_by: given_by.to_owned(), is_given }
    }
}

/// The set of groups, and its conversion from and to a case file.
macro_rules! groups {
    ($(#[doc = $doc:literal] pub $group:ident: [$($name:literal),*],)*) => {
        tables! {
            /// Groups of measures.
            pub(crate) struct RawMeasures { $(#[doc = $doc] pub $group: Empty,)* }
        }

        /// Named groups of measures a case can request; each is a table `[sph.measure.NAME]`.
        #[derive(Debug, Clone, PartialEq, Default, serde::Serialize)]
        pub struct MeasureSet {
            $(#[doc = $doc] pub $group: bool,)*
        }

        impl MeasureSet {
            /// The groups whose tables are present.
            pub(super) fn from_raw(raw: &RawMeasures) -> Self {
                Self { $($group: raw.$group.is_some(),)* }
            }

            /// The names of the measures of each group, and whether it is requested.
            pub(super) fn offers(&self) -> Vec<Offer> {
                vec![$(Offer {
                    names: &[$($name),*],
                    given_by: format!("[sph.measure.{}]", name(stringify!($group))),
                    is_given: self.$group,
                },)*]
            }

            /// A table for each requested group.
            pub(super) fn to_raw(&self) -> RawMeasures {
                RawMeasures { $($group: self.$group.then_some(Empty {}),)* }
            }
        }
    };
}

groups! {
    /// Base and height of a drop on a straight wall.
    pub sessile_drop: ["base-m", "height-m", "base-ratio", "height-ratio"],
    /// Pressure jump and parasitic currents of a free drop.
    pub laplace_drop: ["laplace-jump-ratio", "parasitic-capillary-number", "radius-scatter-ratio"],
    /// Velocity error against plane Poiseuille flow.
    pub poiseuille: ["velocity-l2-error", "slip-length-m"],
    /// Decay rate of Taylor-Green vortices.
    pub taylor_green: ["decay-rate-error"],
    /// Filling angle, neck and pressure of a bridge between two discs.
    pub capillary_bridge: ["filling-angle-deg", "neck-half-width-m", "capillary-pressure-ratio", "filling-angle-ratio"],
    /// Curvature of the menisci between four discs.
    pub four_discs: ["interface-curvature-per-m", "interface-curvature-ratio", "capillary-pressure-ratio"],
    /// Wetted part and height of a drop on a disc.
    pub drop_on_disc: ["half-angle-deg", "half-angle-ratio", "height-ratio"],
    /// Period and decay of a free drop that oscillates.
    pub oscillating_drop: ["period-s", "decay-rate", "period-ratio", "decay-rate-ratio"],
    /// Amplitude of a standing wave against the linear viscous solution.
    pub capillary_wave: ["wave-rms-error"],
    /// Height, speed and roundness of a bubble, which is the wetting phase.
    pub rising_bubble: ["rise-center-m", "max-rise-velocity", "min-circularity"],
    /// Deformation of a drop between two moving walls.
    pub shear_drop: ["deformation", "deformation-ratio"],
    /// Velocity and flow rates of two layers between plates.
    pub layered_poiseuille: ["layered-velocity-l2-error", "wetting-flow-rate-ratio", "non-wetting-flow-rate-ratio"],
    /// Extreme velocities on the center lines of a lid-driven cavity.
    pub cavity: ["u-min", "v-max", "v-min"],
    /// Drag on the solids of a periodic cell.
    pub cylinder_array: ["drag-over-mu-u", "mean-velocity-m-per-s", "permeability-m2", "unsteady-share"],
    /// Permeability tensor of a periodic cell.
    pub permeability: [],
    /// Relative permeability of both phases with a frozen interface.
    pub relative_permeability: ["permeability-m2", "relative-permeability-wetting", "relative-permeability-non-wetting", "saturation", "unsteady-share"],
    /// Capillary pressure of a meniscus in the throat between two bodies.
    pub throat_entry: ["entry-pressure-Pa", "entry-pressure-ratio", "entry-curvature-ratio"],
    /// Difference of the mean levels on both sides of a plate.
    pub jurin: ["rise-difference-m", "rise-ratio"],
    /// Angles, speeds and forces of a drop that moves or is pinned on a wall.
    pub moving_drop: ["advancing-angle-deg", "receding-angle-deg", "advancing-speed-m-per-s", "receding-speed-m-per-s", "advancing-way-m-per-s", "receding-way-m-per-s", "advancing-capillary-number", "receding-capillary-number", "advancing-wall-angle-deg", "receding-wall-angle-deg", "adhesion-tension-N-per-m", "retention-N-per-m", "wall-retention-N-per-m", "stream-drag-N-per-m", "net-drag-N-per-m", "drag-over-retention", "drag-over-wall-retention", "momentum-balance-error", "detachment-time-s"],
    /// Exponent of the base width of a spreading drop.
    pub spreading: ["spreading-exponent"],
    /// Filled length of a slit between two open sides.
    pub slit_filling: ["filled-length-m", "filling-ratio", "filling-error"],
    /// Height of a meniscus that rises from an open side.
    pub capillary_rise: ["peak-apex-m", "peak-time-s", "minimum-apex-m", "minimum-time-s", "final-apex-m"],
}
