//! Geometry of the interface and its contact lines, independent of solvers, particles and files.
//!
//! Lines: a field on the nodes of a [`lattice`] has a [`contour`], an ordered [`polyline`] with its curvature, clipped at a [`wall`]; [`lengths`] of
//! interface and wetted wall. Shapes: the [`circle`] and the Young-Laplace [`arc`] fitted to ordered points with standard errors, the [`weighted_circle`]
//! through a stencil of points, free or with a prescribed contact angle, the [`cap`] of a drop on a flat wall. Contact lines: [`contact`] has their angles
//! with error bars, [`meniscus_ends`] those of interfaces moving under a body force. [`menisci`] between two walls: position, burst, touch, overlap. A chip:
//! its [`depth`], and the [`films`] in its corners. Gravity: the hydrostatic [`head`] at a meniscus.

pub mod arc;
pub mod cap;
pub(crate) mod circle;
pub mod contact;
pub mod contour;
pub mod depth;
pub mod film_flow;
pub mod films;
pub mod head;
pub mod lattice;
pub mod lengths;
pub mod menisci;
pub mod meniscus_ends;
pub mod polyline;
pub mod wall;
pub mod weighted_circle;
