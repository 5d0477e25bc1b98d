//! The pore network of a geometry: pores are the local maxima of the wall distance, throats its saddles.
//!
//! Chords, the segments between the two wall contacts of a throat, cut the pore space into regions that tile it exactly, one around each maximum: along a chord
//! the distance falls towards both walls at slope one, so it is the watershed between two maxima. The certificate of a network: every region contains exactly
//! one maximum, regions are simply connected, their areas sum to that of the pore space, and no throat is wider than its pores. If it fails, the walls of the
//! regions concerned are sampled more densely, first these alone, then together with all others and with all their pairs considered, and extraction is repeated.
//!
//! At a side that is neither wall nor periodic the domain and its regions end with openings. The largest inscribed circle of such a region
//! may have its center on the side.

mod error;
mod loops;
mod moments;
mod openings;
mod regions;
mod sides;

pub use error::ExtractError;

use std::collections::BTreeSet;

use crate::extract::loops::Loops;
use crate::extract::regions::{Attempt, attempt};
use crate::extract::sides::Perimeter;
use crate::graph::Network;
use meniscus_case::SIDES;
use meniscus_geometry::Geometry;
use meniscus_geometry::critical::Unresolved;
use meniscus_geometry::critical::candidates::{Pair, Samples, all_pairs};
use meniscus_geometry::critical::clusters::Coincident;
use meniscus_geometry::critical::walls::{Sides, Walls};

/// Maximum number of times that the sampling is doubled if the certificate fails. A circle then has 24 * 2^8 samples.
const ROUNDS: usize = 8;

/// Number of samples beyond which they are not doubled, unless there are more than half as many from the beginning: a slit may need as many as it is longer
/// than wide.
const MOST_SAMPLES: usize = 4_000_000;

/// From this round on all pairs of the walls around a region are candidates: the triangulation of the samples can lack an edge by rounding, however
/// dense they are.
const ALL_PAIRS_FROM: usize = 2;

/// Maximum number of walls around a region whose pairs are all considered.
const FEW: usize = 1000;

/// The network of all maxima. `open_sides` (left, right, bottom, top) are those for inflow and outflow; a side that is neither wall nor
/// periodic is cut in the same way whether it is open or not, and its openings are listed.
///
/// # Errors
/// An [`ExtractError`] if the geometry has no pore space or no walls, if a wall or periodic side is to be open, or if no network with a certificate is found.
pub fn extract(geometry: &Geometry, open_sides: [bool; 4]) -> Result<Network, ExtractError> {
    for side in (0..4).filter(|&side| open_sides[side]) {
        if geometry.periodic()[side / 2] || geometry.wall_sides()[side] {
            return Err(ExtractError::NotOpen { side: SIDES[side], is_periodic: geometry.periodic()[side / 2] });
        }
    }
    let walls = Walls::new(geometry, Sides::Cut);
    if walls.walls.is_empty() {
        return Err(ExtractError::NoWalls { is_solid: geometry.is_solid(geometry.bounds().center()) });
    }
    let perimeter = Perimeter::new(&walls).map_err(|at| ExtractError::Broken { at })?;
    certified(&walls, &perimeter, 1.0)
}

/// The network of walls, their samples multiplied by `density`, and by more if the certificate fails.
fn certified(walls: &Walls, perimeter: &Perimeter, density: f64) -> Result<Network, ExtractError> {
    let mut density = vec![density; walls.walls.len()];
    let samples = Samples::new(walls, &density);
    let most = MOST_SAMPLES.max(2 * samples.count());
    let mut found = Unresolved::of_samples(walls, &samples, &[]);
    drop(samples);
    let mut round = 0;
    loop {
        let tried = |coincident: Coincident| {
            let points = found.resolved(walls, coincident);
            attempt(walls, &points, &Loops::trace(walls, &points.saddles, perimeter))
        };
        let first = tried(Coincident::Clusters);
        let is_certified = matches!(first, Attempt::Certified(_));
        let (images, near) = match if is_certified { first } else { tried(Coincident::Points).or(first) } {
            Attempt::Certified(network) => return Ok(network),
            Attempt::Failed { images, near } => (images, near),
        };
        round += 1;
        let walls_of: BTreeSet<usize> = images.iter().flatten().map(|image| image.0).collect();
        walls_of.iter().for_each(|&wall| density[wall] *= 2.0);
        if round < ALL_PAIRS_FROM {
            // As few regions fail, the walls around them are enough.
            found.add(walls, &Samples::of(walls, &density, &walls_of));
            continue;
        }
        let samples = Samples::new(walls, &density);
        if round > ROUNDS || samples.count() > most {
            return Err(ExtractError::NoCertificate { near });
        }
        let few = images.iter().filter(|images| images.len() <= FEW);
        let further: Vec<Pair> = few.flat_map(|images| all_pairs(walls, images)).collect();
        found = Unresolved::of_samples(walls, &samples, &further);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::spec::{Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};

    #[test]
    fn more_samples_change_nothing() {
        let mut shapes: Vec<ShapeSpec> =
            [[1.0, 1.2, 0.5], [2.4, 0.9, 0.7], [1.7, 2.5, 0.6], [3.2, 2.6, 0.4], [0.5, 3.1, 0.3]]
                .into_iter()
                .map(|[x, y, radius]| ShapeSpec::Disc(Disc { center: [x, y], radius }))
                .collect();
        let outer = vec![[2.2, 3.4], [3.1, 3.3], [2.9, 3.8], [2.5, 3.6]];
        shapes.push(ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 }));
        let spec = GeometrySpec { min: [0.0; 2], max: [4.0; 2], solid: SolidSide::Inside, shapes };
        let periodic = Geometry::new(&spec).unwrap().with_periodic([true, true]);
        let open = Geometry::new(&spec).unwrap();
        for geometry in [periodic, open] {
            let walls = Walls::new(&geometry, Sides::Cut);
            let perimeter = Perimeter::new(&walls).unwrap();
            let coarse = certified(&walls, &perimeter, 1.0).unwrap();
            assert!(coarse.throats.len() > 4);
            for density in [2.0, 7.0] {
                let fine = certified(&walls, &perimeter, density).unwrap();
                assert_eq!((fine.regions.len(), fine.throats.len()), (coarse.regions.len(), coarse.throats.len()));
                for (a, b) in fine.throats.iter().zip(&coarse.throats) {
                    assert_eq!((a.width, a.contacts, a.regions), (b.width, b.contacts, b.regions));
                }
                for (a, b) in fine.regions.iter().zip(&coarse.regions) {
                    // Newton's method may then start elsewhere.
                    assert!((a.radius - b.radius).abs() < 1e-14 && (a.area - b.area).abs() < 1e-14);
                }
            }
        }
    }
}
