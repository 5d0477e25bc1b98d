//! The pore network of a geometry: pores are the local maxima of the wall distance, throats its saddles.
//!
//! Chords, the segments between the two wall contacts of a throat, cut the pore space into regions that tile it exactly, one around each
//! maximum: along a chord the distance falls to both walls at slope one, so that it is the watershed between both. The certificate of a
//! network is that every region holds exactly one maximum, that regions are simply connected, that their areas sum to that of the pore space and
//! that no throat is wider than its pores. Where it fails, the walls of the regions concerned are sampled more densely, in the end all their pairs are
//! looked at, and all is done again.
//!
//! At a side that is neither wall nor periodic the domain ends: regions end there with openings. The largest inscribed circle of such a region
//! may have its center on the side.

mod error;
mod loops;
mod moments;
mod openings;
mod regions;
mod sides;

pub use error::ExtractError;

use std::collections::BTreeSet;

use crate::case::SIDES;
use crate::geometry::Geometry;
use crate::geometry::critical::CriticalPoints;
use crate::geometry::critical::candidates::all_pairs;
use crate::geometry::critical::walls::{Sides, Walls};
use crate::network::extract::loops::Loops;
use crate::network::extract::regions::{Attempt, attempt};
use crate::network::extract::sides::Perimeter;
use crate::network::graph::Network;

/// How often the sampling is doubled where the certificate fails. A circle then has 24 * 2^8 samples.
const ROUNDS: usize = 8;

/// From this round on all pairs of the walls around a region are candidates: rounding can turn an edge of the triangulation of samples, however
/// dense they are.
const ALL_PAIRS_FROM: usize = 2;

/// Walls around a region, at most, whose pairs are all looked at.
const FEW: usize = 1000;

/// The network of all maxima. `open_sides` (left, right, bottom, top) are those through which fluids come and go; a side that is neither wall nor
/// periodic is cut in the same way whether it is open or not, and its openings are listed.
///
/// # Errors
/// An [`ExtractError`] where the geometry has no pore space or no walls, where a wall or periodic side is asked to be open, and where no
/// network with a certificate is found.
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
    let perimeter =
        Perimeter::new(&walls).map_err(|broken| ExtractError::Broken { at: broken.iter().map(|b| b.at).collect() })?;
    certified(&walls, &perimeter, 1.0)
}

/// The network of walls, their samples multiplied by `density`, and by more where the certificate fails.
fn certified(walls: &Walls, perimeter: &Perimeter, density: f64) -> Result<Network, ExtractError> {
    let mut density = vec![density; walls.walls.len()];
    let mut further = Vec::new();
    let mut round = 0;
    loop {
        let points = CriticalPoints::find(walls, &density, &further);
        let loops = Loops::trace(walls, &points.saddles, perimeter);
        match attempt(walls, &points, &loops) {
            Attempt::Certified(network) => return Ok(network),
            Attempt::Failed { places, .. } if round == ROUNDS => return Err(ExtractError::NoCertificate { places }),
            Attempt::Failed { images, .. } => {
                let walls_of: BTreeSet<usize> = images.iter().flatten().map(|image| image.0).collect();
                walls_of.into_iter().for_each(|wall| density[wall] *= 2.0);
                round += 1;
                if round >= ALL_PAIRS_FROM {
                    let few = images.iter().filter(|images| images.len() <= FEW);
                    further = few.flat_map(|images| all_pairs(walls, images)).collect();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::spec::{Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};

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
                    // Newton's method may begin elsewhere.
                    assert!((a.radius - b.radius).abs() < 1e-14 && (a.area - b.area).abs() < 1e-14);
                }
            }
        }
    }
}
