//! The geometry against closed forms and brute force.

mod corners;
mod curved;
mod distance;
mod measures;
mod offset_curves;
mod packs;
mod shapes;
mod sides;
