//! `picture.png`: particles in a pore, the profile of a film, or a map of areas.

mod canvas;
mod film;
mod particles;
mod region_map;
mod style;
mod view;

pub use canvas::PictureError;
pub use region_map::region_map_picture;
pub use style::{PORE, length_text, round_length};

use self::film::{film_picture, is_film};
use self::particles::particle_picture;
use meniscus_core::diagram::Frame;
use meniscus_core::snapshot::{Lines, Snapshot};

/// Draws a snapshot and the outline of its solids as a PNG file; `frame` is that of a domain with sides.
pub fn picture(
    snapshot: &Snapshot<'_>,
    outline: &Lines<'_>,
    title: &str,
    frame: Option<&Frame>,
) -> Result<Vec<u8>, PictureError> {
    if is_film(snapshot) { film_picture(snapshot, title) } else { particle_picture(snapshot, outline, title, frame) }
}
