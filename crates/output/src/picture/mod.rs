//! Pictures: particles in a pore, the profile of a film, or a map of areas. A [`Scene`] is what all pictures of a movie have in common.

mod canvas;
mod contact;
mod film;
mod particles;
mod region_map;
mod style;
mod view;

pub use canvas::{Picture, PictureError};
pub use region_map::{MapScene, region_map_picture};
pub use style::{PORE, length_text, round_length};

use self::film::{FilmScene, film_picture, is_film};
use self::particles::{ParticleScene, particle_picture};
use meniscus_core::diagram::Frame;
use meniscus_core::snapshot::{Lines, Snapshot};

/// What the pictures of several snapshots have in common, so that only their contents differ: section, scale and legend.
#[derive(Debug, Clone)]
pub struct Scene(Kind);

#[derive(Debug, Clone)]
enum Kind {
    Particles(ParticleScene),
    Film(FilmScene),
}

impl Scene {
    /// That of one snapshot; `frame` is that of a domain with sides.
    ///
    /// # Errors
    /// [`PictureError::Empty`] if there is nothing to draw.
    pub fn of(snapshot: &Snapshot<'_>, frame: Option<&Frame>) -> Result<Self, PictureError> {
        Ok(Self(if is_film(snapshot) {
            Kind::Film(FilmScene::of(snapshot)?)
        } else {
            Kind::Particles(ParticleScene::of(snapshot, frame)?)
        }))
    }

    /// That of the snapshots of both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self(match (self.0, other.0) {
            (Kind::Particles(one), Kind::Particles(other)) => Kind::Particles(one.with(&other)),
            (Kind::Film(one), Kind::Film(other)) => Kind::Film(one.with(&other)),
            (one, _) => one,
        })
    }

    /// Draws a snapshot and the outline of its solids.
    ///
    /// # Errors
    /// [`PictureError`] if there is nothing to draw.
    pub fn draw(
        &self,
        snapshot: &Snapshot<'_>,
        outline: &Lines<'_>,
        title: &str,
        frame: Option<&Frame>,
    ) -> Result<Picture, PictureError> {
        match &self.0 {
            Kind::Film(scene) => film_picture(scene, snapshot, title),
            Kind::Particles(scene) => particle_picture(scene, snapshot, outline, title, frame),
        }
    }
}

/// Draws a snapshot and the outline of its solids; `frame` is that of a domain with sides.
///
/// # Errors
/// [`PictureError`] if there is nothing to draw.
pub fn picture(
    snapshot: &Snapshot<'_>,
    outline: &Lines<'_>,
    title: &str,
    frame: Option<&Frame>,
) -> Result<Picture, PictureError> {
    Scene::of(snapshot, frame)?.draw(snapshot, outline, title, frame)
}
