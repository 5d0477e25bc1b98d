//! `[sph.measure]`: groups of measures that a case can request; each is a table `[sph.measure.NAME]`.
//!
//! The comment above a name is its meaning in `docs/reference/measures.md`.

use meniscus_core::input::tables::{Empty, name, tables};

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

/// The set of groups, and the table of a case file.
macro_rules! groups {
    ($(#[doc = $doc:literal] pub $group:ident: [$($name:literal,)*],)*) => {
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
        }
    };
}

groups! {
    /// Base and height of a drop on a straight wall.
    pub sessile_drop: [
        // Distance of the contact points; half a drop beside a symmetry side counts with its image
        "base-m",
        // Largest distance of the interface from the line through the contact points
        "height-m",
        // Base and height over those of a drop of the same area and the requested angle; with gravity, on a level floor, over those of the [exact
        // profile](../validation/angles-at-rest.md#sessile-drop-under-gravity)
        "base-ratio",
        "height-ratio",
    ],
    /// Pressure jump and parasitic currents of a free drop.
    pub laplace_drop: [
        // Pressure jump over `σ/R`, with `R` from the area
        "laplace-jump-ratio",
        // Viscosity of the drop times the largest speed in the last tenth of the run, over the tension
        "parasitic-capillary-number",
        // Standard deviation over mean of the distance of the interface from the center
        "radius-scatter-ratio",
    ],
    /// Speed of what should not move about a drop.
    pub parasitic_currents: [
        // Median over the records of the last half of the largest speed in both fluids relative to their mean velocity
        "parasitic-speed-m-per-s",
    ],
    /// Velocity error against plane Poiseuille flow.
    pub poiseuille: [
        // Relative L2 norm of the velocity error; the exact velocity includes start-up and slip
        "velocity-l2-error",
        // Steady flow: slip length of the best fitting parabola
        "slip-length-m",
    ],
    /// Decay rate of Taylor-Green vortices.
    pub taylor_green: [
        // Decay rate over the exact one, minus 1
        "decay-rate-error",
    ],
    /// Filling angle, neck and pressure of a bridge between two discs.
    pub capillary_bridge: [
        // Angle of the contact points from the line of centers, seen from the center of a disc
        "filling-angle-deg",
        // Smallest distance of the interface from the line of centers
        "neck-half-width-m",
        // Capillary pressure and filling angle over those of a bridge of the same area and the requested angle
        "capillary-pressure-ratio",
        "filling-angle-ratio",
    ],
    /// Curvature of the menisci between four discs.
    pub four_discs: [
        // Mean curvature of the menisci, negative where the wetting liquid is concave
        "interface-curvature-per-m",
        // Mean curvature and capillary pressure over those of menisci between discs that enclose the same area, at the requested angle
        "interface-curvature-ratio",
        "capillary-pressure-ratio",
    ],
    /// Wetted part and height of a drop on a disc.
    pub drop_on_disc: [
        // Half of the angle between the contact points, seen from the center of the disc
        "half-angle-deg",
        // Half angle over that of a drop of the same area and the requested angle
        "half-angle-ratio",
        // Height above the disc over that of a drop of the same area and the requested angle
        "height-ratio",
    ],
    /// Period and decay of a free drop that oscillates.
    pub oscillating_drop: [
        // Period of a damped oscillation fitted to the elongation
        "period-s",
        // Decay rate of that oscillation in 1/s
        "decay-rate",
        // Period and decay rate over those of the linear viscous solution of two equal fluids
        "period-ratio",
        "decay-rate-ratio",
    ],
    /// Amplitude of a standing wave against the linear viscous solution.
    pub capillary_wave: [
        // Root mean square error of the amplitude over all records, over the first amplitude; exact for infinitely deep fluids, or in a box with `symmetry` at the
        // bottom and at the top
        "wave-rms-error",
    ],
    /// Height, speed and roundness of a bubble, which is the wetting phase.
    pub rising_bubble: [
        // Final height of the center of the wetting phase
        "rise-center-m",
        // Largest mean speed against gravity in m/s, by a parabola through three records
        "max-rise-velocity",
        // Smallest circumference of the circle of equal area over the interface length, by a parabola through three records
        "min-circularity",
    ],
    /// Deformation of a drop between two moving walls.
    pub shear_drop: [
        // Deformation `(L − B)/(L + B)` at the end
        "deformation",
        // That deformation over the capillary number of the shear
        "deformation-ratio",
    ],
    /// Velocity and flow rates of two layers between plates.
    pub layered_poiseuille: [
        // Wetting phase as the lower layer, equal densities: relative L2 norm of the velocity error
        "layered-velocity-l2-error",
        // Wetting phase as the lower layer, equal densities: flow rate of the layer over the exact one
        "wetting-flow-rate-ratio",
        "non-wetting-flow-rate-ratio",
    ],
    /// Extreme velocities on the center lines of a lid-driven cavity.
    pub cavity: [
        // Smallest velocity along the lid on the vertical center line, over that of the lid
        "u-min",
        // Largest and smallest upward velocity on the horizontal center line, over the velocity of the lid
        "v-max",
        "v-min",
    ],
    /// Drag on the solids of a periodic cell.
    pub cylinder_array: [
        // Drag per cell over viscosity and mean velocity, without friction on walls at the sides
        "drag-over-mu-u",
        // Velocity along the body force averaged over the cell, solids included as at rest
        "mean-velocity-m-per-s",
        // Viscosity times that velocity over the force per volume
        "permeability-m2",
        // Final rate of change of the momentum over the body force
        "unsteady-share",
    ],
    /// Permeability tensor of a periodic cell.
    pub permeability: [],
    /// Relative permeability of both phases with a frozen interface.
    pub relative_permeability: [
        // Permeability of the whole pore: viscosity times the mean velocity over the force per volume
        "permeability-m2",
        // Permeability of the phase, the other one a part of the solid, over that of the whole pore
        "relative-permeability-wetting",
        "relative-permeability-non-wetting",
        // Share of the wetting phase in the pore
        "saturation",
        // Largest rate of change of the momentum over the body force at the end of a flow
        "unsteady-share",
    ],
    /// Capillary pressure of a meniscus in the throat between two bodies.
    pub throat_entry: [
        // Final capillary pressure: the entry pressure if the meniscus passes its largest curvature, as in [`meniscus network
        // verify`](../network/verify.md)
        "entry-pressure-Pa",
        // Two discs: final capillary pressure over the exact entry pressure
        "entry-pressure-ratio",
        // Two discs: fitted curvature of the meniscus over the exact one
        "entry-curvature-ratio",
    ],
    /// Difference of the mean levels on both sides of a plate.
    pub jurin: [
        // Mean level left of the first plate minus that right of it
        "rise-difference-m",
        // Difference of the mean levels over that of Jurin's law
        "rise-ratio",
    ],
    /// Angles, speeds and forces of a drop that moves or is pinned on a wall.
    pub moving_drop: [
        // Apparent angles
        "advancing-angle-deg",
        "receding-angle-deg",
        // Speeds of the contact lines in the direction ahead, relative to the wall
        "advancing-speed-m-per-s",
        "receding-speed-m-per-s",
        // Displacements of the contact lines in the direction ahead per time, not relative to the wall
        "advancing-way-m-per-s",
        "receding-way-m-per-s",
        // Viscosity of the drop times the speeds relative to the wall, over the tension
        "advancing-capillary-number",
        "receding-capillary-number",
        // Angles at the wall that the wetting model imposes
        "advancing-wall-angle-deg",
        "receding-wall-angle-deg",
        // Tension times the cosine of the static angle: tension of the dry minus that of the wetted wall
        "adhesion-tension-N-per-m",
        // Tension times (cosine of the receding minus cosine of the advancing angle), with the apparent angles
        "retention-N-per-m",
        // Tension times (cosine of the receding minus cosine of the advancing angle), with the angles at the wall
        "wall-retention-N-per-m",
        // Pressure minus buoyancy, and friction, of the other fluid on the drop
        "stream-drag-N-per-m",
        // Body force minus buoyancy, plus wall friction and drag of the stream, minus the change of momentum
        "net-drag-N-per-m",
        // Net drag over the retention with the apparent angles
        "drag-over-retention",
        // Net drag over the retention with the angles at the wall; 1 if the momentum balances
        "drag-over-wall-retention",
        // Net drag over the largest retention, tension times (cosine of the receding minus cosine of the advancing angle) of the hysteresis: the share of its
        // strength at which a drop holds, 1 where it lets go
        "drag-over-largest-retention",
        // Net drag minus the retention with the angles at the wall, over the tension
        "momentum-balance-error",
        // First time at which no particle of the largest connected part of the wetting phase was within a spacing of a wall
        "detachment-time-s",
        // Viscosity of the other phase times the prescribed mean velocity at that time, over the tension
        "detachment-capillary-number",
        // The same at the first time with more connected parts of the wetting phase of at least 20 particles than at time zero
        "break-up-capillary-number",
        // Share of the largest connected part in the wetting phase at the end
        "largest-part-share",
    ],
    /// Exponent of the base width of a spreading drop.
    pub spreading: [
        // Slope of log base over log time in the last decade of the run
        "spreading-exponent",
    ],
    /// Filled length of a slit between two open sides.
    pub slit_filling: [
        // Final area of the wetting phase over the width
        "filled-length-m",
        // Displacement of the meniscus over the exact one, with the slip length of the plates; none with a depth
        "filling-ratio",
        // Largest error of the filled length over all records, over the total displacement
        "filling-error",
    ],
    /// Height of a meniscus that rises from an open side.
    pub capillary_rise: [
        // Largest distance of the apex of the meniscus from the side where the wetting phase enters
        "peak-apex-m",
        // Time of that largest distance
        "peak-time-s",
        // Smallest distance of the apex after the largest
        "minimum-apex-m",
        // Time of that smallest distance
        "minimum-time-s",
        // Final distance of the apex
        "final-apex-m",
    ],
}
