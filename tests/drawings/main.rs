//! One pack and one drawing of grains as other programs write them: the same porosity, network and capillary pressures by every route,
//! and the network of an independent brute-force search. The files are told in `README.md` beside this file.

mod chips;
mod contents;
mod damage;
mod files;
mod formats;
mod invariance;
mod kinds;
mod kinds_of_networks;
mod mask_images;
mod network;
mod survival;
mod unions;
