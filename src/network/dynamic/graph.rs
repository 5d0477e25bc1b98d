//! The network as conductors: ways for fluid between the parts of the pore space that share a pressure.

use crate::network::displacement::FrontId;
use crate::network::laplacian::Laplacian;

/// A way for fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// A throat with one phase on both sides.
    Open,
    /// A gate with a meniscus.
    Meniscus(FrontId),
    /// From the body of invading phase in an element that is being filled to the defending phase in it.
    FillingPore(usize),
    /// An opening of the inlet.
    Inlet,
    /// An opening of the outlet.
    Outlet,
}

/// A conductor with the elements that it joins; one at an open side has its element twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Link {
    pub(crate) way: Way,
    pub(crate) elements: [usize; 2],
    /// Resistances in 1/m² on the side of each element.
    pub(crate) halves: [f64; 2],
}

/// All conductors of a state, until an event changes it.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub(crate) laplacian: Laplacian,
    pub(crate) links: Vec<Link>,
    pub(crate) nodes: usize,
    /// The node of the inlet, where a rate is given.
    pub(crate) inlet: Option<usize>,
    /// By gate: the link of its meniscus.
    pub(crate) link_of: Vec<Option<usize>>,
}
