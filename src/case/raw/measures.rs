//! `[sph.measure]` and `[[expect]]`: what is measured at the end and what must come out.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Empty;

tables! {
    /// Groups of measures.
    pub struct RawMeasures {
        /// Base and height of a drop on a straight wall.
        pub sessile_drop: Empty,
        /// Pressure jump and parasitic currents of a free drop.
        pub laplace_drop: Empty,
        /// Velocity error against plane Poiseuille flow.
        pub poiseuille: Empty,
        /// Decay rate of Taylor-Green vortices.
        pub taylor_green: Empty,
        /// Filling angle, neck and pressure of a bridge between two discs.
        pub capillary_bridge: Empty,
        /// Curvature of the menisci between four discs.
        pub four_discs: Empty,
        /// Wetted part and height of a drop on a disc.
        pub drop_on_disc: Empty,
        /// Period and decay of a free drop that oscillates.
        pub oscillating_drop: Empty,
        /// Amplitude of a standing wave against the linear viscous solution.
        pub capillary_wave: Empty,
        /// Height, speed and roundness of a bubble, which is the wetting phase.
        pub rising_bubble: Empty,
        /// Deformation of a drop between two moving walls.
        pub shear_drop: Empty,
        /// Velocity and flow rates of two layers between plates.
        pub layered_poiseuille: Empty,
        /// Extreme velocities on the center lines of a lid-driven cavity.
        pub cavity: Empty,
        /// Drag on the solids of a periodic cell.
        pub cylinder_array: Empty,
        /// Permeability tensor of a periodic cell.
        pub permeability: Empty,
        /// Relative permeability of both phases beside a frozen interface.
        pub relative_permeability: Empty,
        /// Capillary pressure of a meniscus in the throat between two bodies.
        pub throat_entry: Empty,
        /// Difference of the mean levels on both sides of a plate.
        pub jurin: Empty,
        /// Angles, speeds and forces of a drop that moves or is held on a wall.
        pub moving_drop: Empty,
        /// Exponent of the base width of a spreading drop.
        pub spreading: Empty,
        /// Filled length of a slit between two open sides.
        pub slit_filling: Empty,
        /// Height of a meniscus that rises from an open side.
        pub capillary_rise: Empty,
    }

    /// A measure that must come out as said.
    pub struct RawExpectation {
        /// Name of a measure, such as `contact-angle-deg`.
        pub measure: String,
        /// Expected value in the unit of the measure.
        pub value: f64,
        /// Largest accepted deviation in the same unit.
        pub tolerance: f64,
    }
}
