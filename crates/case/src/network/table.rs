//! The table of `[network]`.

use std::path::PathBuf;

use super::measured::Measured;
use crate::fluid::{RawInterface, RawPhases};
use crate::rate::Rate;
use crate::side::SideName;
use crate::wetting::RawWetting;
use meniscus_core::input::tables::{Key, checked_tables, tables, words};

tables! {
    /// A pore network: pores and throats of the geometry, and a displacement through them.
    pub struct RawNetwork {
        /// Side where the invading phase enters; without it and `inlet-disc` nothing is displaced.
        pub inlet: SideName,
        /// Disc where the invading phase enters, a hole in the lid, in place of a side: it fills all pores of which the disc covers a part.
        pub inlet_disc: RawInletDisc,
        /// Opposite side where the defending phase leaves, with `inlet-disc` any side, or `sides`; without it none leaves and none is trapped.
        pub outlet: RawOutlet,
        /// The sides that are neither inlet nor outlet (default: walls).
        pub sides: RawNetworkSides,
        /// The fluids; viscosities count for conductances and `dynamic`, densities with `gravity` (default: 1 Pa s).
        pub phases: RawPhases,
        /// Interface between the fluids (required with an inlet).
        pub interface: RawInterface,
        /// `young`, `tadmor` or `hysteresis`, and patches without stripes (required with an inlet).
        pub wetting: RawWetting,
        /// Invading phase: non-wetting, wetting, or both in turn; in a cycle the wetting phase returns through the
        /// outlet (default `drainage`).
        pub process: RawProcess,
        /// Number of cycles (default 1).
        pub cycles: u32 => Key::within("a number of cycles", 1.0, 100.0),
        /// Traps defending regions without a path to the outlet; else films drain them (default true).
        pub trapping: bool,
        /// How films of the wetting phase in corners with floor and lid are connected, through which it leaves and enters, and which close throats where they
        /// meet; `rings` and `joined` need `geometry.depth` (default `rings` with a depth, where angles of walls and plates sum to less than 90 degrees).
        pub films: FilmModel,
        /// Burst, touch and overlap, or burst alone (invasion percolation) (default `all`).
        pub events: Events,
        /// Half width of a throat over the smaller inscribed radius, above which its pores are one (default 0.95).
        pub persistence: f64 => Key::within("a persistence ratio", 0.5, 1.0),
        /// Measured entry pressures: `measured.json` of `meniscus network verify` (default: those of the formula).
        pub measured: PathBuf,
        /// Contents of a file of measured entry pressures, in a resolved case.
        pub measured_throats: Measured,
        /// Criteria that end the displacement or each drainage of a cycle; the first one met counts.
        pub stop: RawStop,
        /// File with the initial state, of a network or a direct simulation; not with `dynamic` (default: full of the
        /// defending phase).
        pub initial: PathBuf,
        /// Displacement in time, with viscous flow (default: quasi-static).
        pub dynamic: RawDynamic,
        /// Acceleration of gravity along x and y in m/s², for a chip tilted by α the part g sin α in its plane; applied pressures are those in the middle of
        /// the inlet (default `[0.0, 0.0]`).
        pub gravity: [f64; 2],
        /// Region over which saturations and the porosity are taken; not with `dynamic` (default: the whole domain).
        pub region: RawRegion,
        /// What is found and written besides events, curve and measures of the displacement (default `all`).
        pub results: NetworkResults,
    }

    /// Region over which saturations and the porosity are taken: a rectangle, or the pack. Of a pore that crosses its boundary the part inside counts; pores
    /// open to the inlet or the outlet are manifold and have no saturation, so that the first saturation is that of the defending phase alone.
    pub struct RawRegion {
        /// Lower left corner in m.
        pub min: [f64; 2],
        /// Upper right corner in m.
        pub max: [f64; 2],
        /// `pack`: from the first to the last grain between inlet and outlet, across the whole domain; `domain`: all of it; instead of both corners.
        pub extent: RegionExtent,
    }

    /// The sides that are neither inlet nor outlet.
    pub struct RawNetworkSides {
        /// Kind of the side (default `wall`).
        pub left: RawNetworkSide,
        /// Kind of the side (default `wall`).
        pub right: RawNetworkSide,
        /// Kind of the side (default `wall`).
        pub bottom: RawNetworkSide,
        /// Kind of the side (default `wall`).
        pub top: RawNetworkSide,
    }

    /// What drives a displacement in time: a rate or a pressure drop.
    pub(crate) struct RawDynamic {
        /// Injected area of the invading phase per time in m²/s, with `geometry.depth` the volume in m³/s, or a text with the unit, as `"5 uL/min"` (required without `pressure-drop`).
        pub rate: Rate => Key::positive("a rate in m2/s"),
        /// Pressure at the inlet minus that at the outlet in Pa, 0 for spontaneous imbibition; with `gravity` without what the displaced phase at rest has
        /// (required without `rate`).
        pub pressure_drop: f64 => Key::not_negative("a pressure drop in Pa"),
        /// Largest inflow in one step, in pore volumes; at most half of the mean area of an element flows in (default 0.01).
        pub largest_step: f64 => Key::within("a share of the pore volume", 1.0e-6, 1.0),
        /// Initial saturation of the wetting phase: the invading phase fills part of the pores that are open at the inlet and completes them first (default:
        /// these pores are full).
        pub initial_saturation: f64 => Key::within("a saturation", 0.0, 1.0),
    }

    /// Criteria that end a displacement; the first one met counts.
    pub(crate) struct RawStop {
        /// Ends when the invading phase reaches the outlet (default false).
        pub breakthrough: bool,
        /// Final saturation of the wetting phase.
        pub saturation: f64 => Key::within("a saturation of the wetting phase", 0.0, 1.0),
        /// Final capillary pressure `p_n - p_w` in Pa; not with `dynamic`.
        pub capillary_pressure: f64,
        /// Injected pore volumes; only with `dynamic`.
        pub injected: f64 => Key::positive("a number of pore volumes"),
    }
}

checked_tables! {
    /// A disc where the invading phase enters, some of it in the pore space.
    pub struct RawInletDisc for InletDisc {
        /// Center in m.
        pub center: [f64; 2],
        /// Radius in m.
        pub radius: f64 => Key::positive("a length in m").example("radius = 1.0e-3 # m"),
    }
}

words! {
    /// What is found of a network besides events, curve and measures of the displacement.
    pub enum NetworkResults {
        /// Tables and VTK files of pores and throats, permeabilities, entry pressures of all throats, and the page.
        All,
        /// Nothing: for very many posts.
        Curve,
    }

    /// Where the defending phase leaves.
    pub enum RawOutlet {
        /// x = min.
        Left,
        /// x = max.
        Right,
        /// y = min.
        Bottom,
        /// y = max.
        Top,
        /// All sides for which `sides` gives no kind; with `inlet-disc`.
        Sides,
    }

    /// Kind of a side of a network.
    pub enum RawNetworkSide {
        /// A solid wall with the contact angle of all walls.
        Wall,
        /// Periodic with the opposite side.
        Periodic,
    }

    /// The invading phase.
    pub enum RawProcess {
        /// The non-wetting phase, into a pore space full of the wetting one.
        Drainage,
        /// The wetting phase, into a pore space full of the non-wetting one.
        Imbibition,
        /// Drainage from the inlet, then imbibition from the outlet, again and again.
        Cycle,
    }

    /// How films in corners are connected.
    pub enum FilmModel {
        /// No films.
        None,
        /// Those of each wall among themselves, and with others through the wetting phase that fills pores and throats.
        Rings,
        /// All of them: nothing is trapped in drainage.
        Joined,
    }

    /// A region defined by the geometry.
    pub enum RegionExtent {
        /// From the first to the last grain.
        Pack,
        /// The whole domain.
        Domain,
    }

    /// The events that move menisci.
    pub enum Events {
        /// Burst, touch and overlap.
        All,
        /// Burst only: invasion percolation, for comparison with other programs.
        Burst,
    }
}

impl RawNetwork {
    /// Whether there is an inlet, and so a displacement.
    pub(crate) fn has_inlet(&self) -> bool {
        self.inlet.is_some() || self.inlet_disc.is_some()
    }
}

impl RawOutlet {
    /// The number of the side; `None`: all of them.
    pub(crate) fn number(self) -> Option<usize> {
        (self != Self::Sides).then_some(self as usize)
    }
}

impl From<SideName> for RawOutlet {
    fn from(side: SideName) -> Self {
        [Self::Left, Self::Right, Self::Bottom, Self::Top][side.number()]
    }
}
