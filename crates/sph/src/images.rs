//! Image particles behind mirror sides [Huber2013, Eqs. 32-34]: copies of the particles within the support.

use std::ops::Deref;

use crate::domain::{Domain, Mirror};
use meniscus_core::math::Vec2;

/// Values of all particles followed by those of their images. Only [`Images`] constructs it, so that the images are never missing.
#[derive(Debug, Clone, Default)]
pub struct Field<T>(Vec<T>);

/// The images at one step, numbered after the particles: image i has index `first + i` in every field.
#[derive(Debug, Clone, Default)]
pub struct Images {
    first: usize,
    source: Vec<u32>,
    /// Bit k: reflected at mirror k of the domain.
    via: Vec<u8>,
    mirrors: Vec<Mirror>,
}

impl Images {
    /// Finds all images within `support` (m) of the mirrors and appends their positions to `points` [Huber2013, Eqs. 32-34]. Corner images are images of
    /// images, so that a particle near two mirrors has three.
    pub fn append(points: &mut Vec<Vec2>, domain: &Domain, support: f64) -> Self {
        let first = points.len();
        let mut images = Self { first, mirrors: domain.mirrors.clone(), ..Self::default() };
        for (k, mirror) in domain.mirrors.iter().enumerate() {
            for i in 0..points.len() {
                if (points[i][mirror.axis] - mirror.at).abs() < support {
                    points.push(mirror.position(points[i]));
                    let (source, via) =
                        if i < first { (i as u32, 0) } else { (images.source[i - first], images.via[i - first]) };
                    images.source.push(source);
                    images.via.push(via | 1 << k);
                }
            }
        }
        images
    }

    /// The particle with index `b`, or the source of the image with that index.
    #[inline]
    pub(crate) fn source(&self, b: usize) -> usize {
        if b < self.first { b } else { self.source[b - self.first] as usize }
    }

    /// Position of index `b` in m, given those of the particles.
    #[inline]
    pub(crate) fn position(&self, b: usize, particles: &[Vec2]) -> Vec2 {
        let x = particles[self.source(b)];
        let Some(image) = b.checked_sub(self.first) else { return x };
        self.mirrors_of(self.via[image]).fold(x, |x, mirror| mirror.position(x))
    }

    fn mirrors_of(&self, via: u8) -> impl Iterator<Item = &Mirror> {
        self.mirrors.iter().enumerate().filter(move |(k, _)| via >> k & 1 == 1).map(|(_, mirror)| mirror)
    }

    /// Whether there are no images.
    pub(crate) fn is_empty(&self) -> bool {
        self.source.is_empty()
    }

    /// The field of a scalar, unchanged by reflection: p' = p [Huber2013, Eq. 34]. Particles beyond the end of `values` have zero.
    pub(crate) fn field<T: Copy + Default>(&self, values: Vec<T>) -> Field<T> {
        self.field_by(values, |_, value| value)
    }

    /// The field of a polar vector, such as a normal.
    pub(crate) fn reflected_field(&self, values: Vec<Vec2>) -> Field<Vec2> {
        self.field_by(values, Mirror::reflect)
    }

    /// The field of velocities: v' = −v on no-slip sides ([`Mirror::velocity`]).
    pub fn velocity_field(&self, values: Vec<Vec2>) -> Field<Vec2> {
        self.field_by(values, Mirror::velocity)
    }

    fn field_by<T: Copy + Default>(&self, mut values: Vec<T>, image: impl Fn(&Mirror, T) -> T) -> Field<T> {
        values.resize(self.first, T::default());
        for (&source, &via) in self.source.iter().zip(&self.via) {
            values.push(self.mirrors_of(via).fold(values[source as usize], |value, mirror| image(mirror, value)));
        }
        Field(values)
    }
}

impl<T> Deref for Field<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::ImageVelocity;
    use meniscus_core::math::Bounds;

    /// [Huber2013, Eqs. 32-34]
    #[test]
    fn a_particle_in_a_corner_of_two_mirrors_has_three_images() {
        let mirror = |axis, image| Mirror { axis, at: 0.0, image };
        let bounds = Bounds { min: Vec2::zeros(), max: Vec2::repeat(1.0) };
        let mirrors = vec![mirror(0, ImageVelocity::Mirrored), mirror(1, ImageVelocity::Reversed)];
        let domain = Domain::new(bounds, [false; 2], mirrors);
        let mut points = vec![Vec2::new(0.1, 0.05), Vec2::new(0.5, 0.5)];
        let images = Images::append(&mut points, &domain, 0.2);
        assert_eq!(points.len(), 5);
        assert!(points[4] == Vec2::new(-0.1, -0.05));
        let v = images.velocity_field(vec![Vec2::new(1.0, 2.0)]);
        assert_eq!(v[2], Vec2::new(-1.0, 2.0));
        assert_eq!(v[3], Vec2::new(-1.0, -2.0));
        assert_eq!(v[4], Vec2::new(1.0, -2.0));
        assert_eq!(images.source(4), 0);
    }
}
