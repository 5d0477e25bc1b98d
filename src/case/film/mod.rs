//! `[thin-film]`: droplets on a flat wall.

mod bounds;
mod droplets;
mod equation;
mod film;
mod lattice;
mod method;
mod resolution;
mod thin_film;
mod thinness;

pub use droplets::{FilmDroplet, FilmSymmetry};
pub use equation::{FilmEquation, Geometric, Precursor, Slip};
pub use film::{FilmWeights, ThinFilm};
pub use method::{FilmGrid, FilmIntegrator, FilmMethod, FilmParticles, FilmSums, LatticeEnergy};
pub(super) use thin_film::{RawThinFilm, raw, thin_film};
