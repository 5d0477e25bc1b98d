//! The network as a graph: links for flow between nodes of one pressure each.

use crate::displacement::{FrontId, Outflow};
use crate::laplacian::Laplacian;

/// The type of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LinkKind {
    /// A throat with one phase on both sides.
    Open,
    /// A gate with a meniscus.
    Meniscus(FrontId),
    /// From the invading to the defending phase in a filling element.
    FillingPore(usize),
    /// An opening of the inlet.
    Inlet,
    /// An opening of the outlet.
    Outlet,
}

/// A link with the elements that it joins; at an open side both are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Link {
    pub(crate) kind: LinkKind,
    pub(crate) elements: [usize; 2],
    /// Resistances in 1/m² on the side of each element.
    pub(crate) halves: [f64; 2],
}

/// The graph of a state, valid until the next event.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub(crate) laplacian: Laplacian,
    pub(crate) links: Vec<Link>,
    pub(crate) nodes: usize,
    /// The node of the inlet if a rate is given.
    pub(crate) inlet: Option<usize>,
    /// Paths of the displaced phase to the outlet.
    pub(crate) outflow: Outflow,
    /// By gate: the link of its meniscus.
    pub(crate) link_of: Vec<Option<usize>>,
}
