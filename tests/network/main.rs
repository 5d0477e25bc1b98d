//! The pore network of shapes whose network is known, and of random packs.

mod arrays;
mod channels;
mod invariants;
mod packs;
mod permeability;
mod pores;
mod scenes;
