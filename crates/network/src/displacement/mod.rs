//! Quasi-static displacement of one phase by another at rising applied pressure: the elements filled by each event.
//!
//! A meniscus advances through its gate until one of three events \[CieplakRobbins1988; CieplakRobbins1990\]: it passes its largest curvature (burst), touches
//! a wall ahead (touch), or meets the meniscus in the neighboring gate on the wall between them (overlap). The event of the lowest curvature comes first.
//! Events of equal curvature are simultaneous: all fill before trapping and new menisci are determined. An event fills the whole element ahead. Two menisci
//! that meet merge into one between their outer walls: within one element they fill it; if a grain ahead separates several elements, the merged meniscus fills
//! all of them when it bursts or touches, or meets its own neighbors until none is left. Pressures are given as curvatures, (p_invading − p_defending)/σ.
//!
//! Corner films of a chip let the wetting phase out and in along the walls (`rings`), and close throats when they meet (`snap_off`).
//!
//! Left out: areas swept by menisci between events.

mod conditions;
mod connected;
mod dead_ends;
mod divide;
mod division;
mod driven;
mod event;
mod fronts;
mod ganglia;
mod loops;
mod merged;
mod mesh;
mod outflow;
mod outline;
mod progress;
mod reachable;
mod rims;
mod rings;
mod sequence;
mod snap_off;
mod static_menisci;
mod trapping;
mod wall_chains;
mod walls;

pub use self::conditions::{Conditions, CornerFilms, FilmPaths, MeasuredBurst, OpenDisc};
pub(crate) use self::division::Division;
pub use self::division::Element;
pub(crate) use self::driven::{Advance, GateFacts};
pub use self::event::EventKind;
pub(crate) use self::mesh::FrontId;
pub(crate) use self::outflow::Outflow;
pub(crate) use self::outline::{centroid, contains, edges};
pub use self::progress::{Displacement, Phase};
pub(crate) use self::rims::RimCurve;
pub use self::sequence::Event;
pub(crate) use self::static_menisci::{Beginning, Interfaces, StaticMeniscus};
use super::graph::Region;
pub use meniscus_case::network::{Events, Trapping};
use meniscus_core::math::Vec2;

/// The boundary of a region as a polygon in m, arcs as chords, for pictures.
pub(crate) fn outline(region: &Region) -> Vec<Vec2> {
    outline::outline(&mesh::loop_of(region))
}
