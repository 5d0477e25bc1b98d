//! The geometry module against closed forms and brute force.

mod corners;
mod curved;
mod distance;
mod files;
mod import;
mod masks;
mod measures;
mod noise;
mod offset_curves;
mod packs;
mod round_trip;
mod shapes;
mod sides;
mod written;
