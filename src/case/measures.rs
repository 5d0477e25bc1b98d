//! The groups of measures that a case can ask for; each is a table `[sph.measure.NAME]`.

use super::raw::{Empty, RawMeasures};

/// The set of groups, and its way from a case file and back into one.
macro_rules! groups {
    ($($(#[$doc:meta])* $group:ident,)*) => {
        /// Named groups of measures a case can ask for; each is a table `[sph.measure.NAME]`.
        #[derive(Debug, Clone, PartialEq, Default, serde::Serialize)]
        pub struct MeasureSet {
            $($(#[$doc])* pub $group: bool,)*
        }

        impl MeasureSet {
            /// The groups whose tables are there.
            pub(super) fn from_raw(raw: &RawMeasures) -> Self {
                Self { $($group: raw.$group.is_some(),)* }
            }

            /// A table for each group that is asked for.
            pub(super) fn to_raw(&self) -> RawMeasures {
                RawMeasures { $($group: self.$group.then_some(Empty {}),)* }
            }
        }
    };
}

groups! {
    /// `base-m`, `height-m` and their ratios to the exact ones of a drop on a straight wall.
    sessile_drop,
    /// `laplace-jump-ratio`, `parasitic-capillary-number` of a free drop.
    laplace_drop,
    /// `velocity-l2-error` against plane Poiseuille flow driven by gravity.
    poiseuille,
    /// `decay-rate-error` against the Taylor-Green vortex.
    taylor_green,
    /// `filling-angle-deg`, `neck-half-width-m`, `capillary-pressure-ratio` of a bridge between two discs.
    capillary_bridge,
    /// `interface-curvature-ratio`, `capillary-pressure-ratio` of the menisci between four discs.
    four_discs,
    /// Wetted part and height of a drop on a disc.
    drop_on_disc,
    /// Period and decay of a free drop that oscillates between two ellipses.
    oscillating_drop,
    /// Amplitude of a standing wave on a flat interface.
    capillary_wave,
    /// Height, speed and roundness of a bubble (the wetting phase) that rises.
    rising_bubble,
    /// Deformation of a drop between two moving walls.
    shear_drop,
    /// Velocity and flow rates of two layers between plates.
    layered_poiseuille,
    /// Extreme velocities on the center lines of a lid-driven cavity.
    cavity,
    /// Drag on the solids of a periodic cell that a body force drives fluid through.
    cylinder_array,
    /// Capillary pressure over the entry pressure of the throat between two discs.
    throat_entry,
    /// Difference of the mean levels on both sides of a plate.
    jurin,
    /// Angles, speeds and forces of a drop that moves or is held on a wall.
    moving_drop,
    /// Exponent of a drop that spreads.
    spreading,
    /// Filled length of a slit between two open sides.
    slit_filling,
    /// Height of the meniscus that rises from an open side.
    capillary_rise,
}
