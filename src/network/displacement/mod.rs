//! Quasi-static displacement of one fluid by another: which part of the pore space is filled at which pressure.
//!
//! The applied pressure rises. Each meniscus advances through its gate until one of three events \[CieplakRobbins1988;
//! CieplakRobbins1990\]: it passes the place of largest curvature (burst), it touches a wall ahead (touch), or it meets the meniscus
//! in the neighboring gate on the wall between them (overlap). The event of the lowest curvature comes first. Events of equal curvature take
//! place at once: all of them fill before it is known what they trap and what follows. An event fills the whole element ahead. Two menisci that meet become one between the outer walls of both: within
//! one element they fill it; where several lie in between, a grain stands ahead, and the joined meniscus fills all of them once it
//! bursts or touches. Pressures are curvatures here: times the tension they are p_invading − p_defending.
//!
//! Films in the corners of a chip let the wetting phase out and in, and close throats where they meet (`snap_off`).
//!
//! Left out: areas swept by menisci between events, overlaps of a joined meniscus with a third one.

mod conditions;
mod dead_ends;
mod driven;
mod event;
mod fronts;
mod involved;
mod loops;
mod mesh;
mod outflow;
mod outline;
mod progress;
mod sequence;
mod snap_off;
mod standing;
mod trapping;
mod wall_chains;
mod walls;

pub use self::conditions::{Conditions, CornerFilms, MeasuredBurst};
pub(crate) use self::driven::{Advance, FrontId, GateFacts};
pub use self::event::EventKind;
pub(crate) use self::involved::{Place, Scene};
pub(crate) use self::progress::Division;
pub use self::progress::{Displacement, Element, Phase};
pub use self::sequence::Event;
pub(crate) use self::standing::{Beginning, Standing};
use super::graph::Region;
pub use crate::case::network::{Events, Trapping};
use crate::math::Vec2;

/// The boundary of a region as a polygon in m, arcs as chords, for pictures.
pub(crate) fn outline(region: &Region) -> Vec<Vec2> {
    outline::outline(&mesh::loop_of(region))
}
