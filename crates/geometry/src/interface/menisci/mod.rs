//! Static menisci between two walls: their positions, their burst, contact with a third wall, coalescence with a neighbor.
//!
//! Exact for walls of arcs, segments and edges and for any contact angles. Curvatures are in 1/m, above 0 where the meniscus bulges into the defending phase;
//! times the interfacial tension they are capillary pressures (invading minus defending).
//!
//! - [`Passage`]: both walls of a throat; [`Passage::burst`], [`Passage::at`], [`Passage::touch`];
//! - `overlap`: two menisci with a common wall;
//! - [`Meniscus`]: an arc with its contacts.
//!
//! The three events are those of Cieplak and Robbins (1988, 1990).

mod circle;
mod crossing;
mod extremes;
mod meniscus;
mod obstacle;
mod overlap;
mod passage;
mod path;
mod wall;

pub use meniscus::Meniscus;
pub use overlap::overlap;
pub use passage::Passage;
pub use wall::{Contact, Hand, Wall, WallPart};

#[cfg(test)]
mod tests;
