//! The two forms of the surface force, behind one seam.
//!
//! [`SurfaceForce::Csf`](crate::case::SurfaceForce) is the paper's: a volume force in a band, with the contact line force beside it. In
//! [`SurfaceForce::PressureJump`](crate::case::SurfaceForce) the jump σκ enters the pressure differences across the interface, as in the ghost fluid method
//! (Fedkiw et al. 1999; Kang et al. 2000), and the wetting law is the angle at which the interface meets the wall.
//!
//! A chain, each link of which knows those before it: `points` of the interface between particles; `stencils`, the points around one place;
//! `contact_points`, where the interface meets a wall; `detected_lines`, its contact lines; `pinned_lines`, those at edges of walls; `fit`, its
//! curvature; `jump`, which carries that to the pairs. The geometry of the circles is in [`interface`](crate::interface).

mod contact_points;
pub(crate) mod detected_lines;
pub(crate) mod fit;
pub(crate) mod jump;
pub(crate) mod pinned_lines;
pub(crate) mod points;
pub(crate) mod stencils;
