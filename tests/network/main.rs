//! The pore network of shapes whose network is known, and of random packs.

#[path = "../support/mod.rs"]
mod support;

mod arrays;
mod cases;
mod channels;
mod corners;
mod dead_ends;
mod depth;
mod displacement;
mod dynamic;
mod films;
mod generated;
mod invariants;
mod mirrored;
mod motion;
mod packs;
mod permeability;
mod pores;
mod region;
mod scenes;
mod symmetry;
mod tutorial;
