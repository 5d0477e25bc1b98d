//! The pore network of shapes whose network is known, of random packs, and of drawings.

#[allow(dead_code, reason = "the tests of drawings use the rest")]
#[path = "../../../drawings/tests/drawings"]
mod drawings {
    pub mod contents;
    pub mod files;
}
#[allow(dead_code, reason = "other test programs use the rest")]
#[path = "../../../../tests/support"]
mod support {
    pub mod dice;
    pub mod files;
    pub mod packs;
}

mod arrays;
mod ball_and_stick;
mod cases;
mod chambers;
mod channels;
mod corners;
mod dead_ends;
mod depth;
mod displacement;
mod drawings_network;
mod dynamic;
mod films;
mod generated;
mod gravity;
mod invariants;
mod kinds_of_networks;
mod lattice;
mod mask_images;
mod motion;
mod packs;
mod permeability;
mod playback;
mod pores;
mod radial;
mod region;
mod scenes;
mod symmetry;
