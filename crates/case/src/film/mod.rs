//! `[thin-film]`: droplets on a flat wall.

mod bounds;
mod droplets;
mod equation;
mod lattice;
mod method;
mod model;
mod resolution;
mod thin_film;
mod thinness;

pub use droplets::{FilmDroplet, FilmSymmetry};
pub use equation::{FilmEquation, Geometric, Precursor, Slip};
pub use method::{FilmGrid, FilmIntegrator, FilmMethod, FilmParticles, FilmSums, LatticeEnergy};
pub use model::{FilmWeights, ThinFilm};
pub(super) use thin_film::{RawThinFilm, thin_film};
