//! The geometry module against closed forms and brute force.

mod corners;
mod curved;
mod distance;
mod files;
mod import;
mod measures;
mod shapes;
mod shells;
mod sides;
