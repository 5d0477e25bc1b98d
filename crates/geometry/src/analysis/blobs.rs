//! Ganglia: connected components of the particles of a phase, by union-find.
//!
//! Two particles of the phase are connected if they are nearer than [`LINK`] spacings: more than the diagonal of the lattice (1.41), less than the second
//! neighbor (2).

use super::cells::Cells;
use meniscus_core::math::{Vec2, root};

/// Largest distance of connected particles in particle spacings.
pub const LINK: f64 = 1.6;

/// A ganglion: a connected part of a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blob {
    /// Number of particles.
    pub count: usize,
    /// Area in m².
    pub area: f64,
    /// One of its particles, the one with the lowest index.
    pub first: usize,
}

/// Connected components of the particles with `member`, largest first.
///
/// `points` in m, `volumes` in m², `link` the largest distance of connected particles in m, `period` in m.
pub fn blobs(points: &[Vec2], volumes: &[f64], member: &[bool], link: f64, period: [Option<f64>; 2]) -> Vec<Blob> {
    let chosen: Vec<usize> = (0..points.len()).filter(|&i| member[i]).collect();
    let positions: Vec<Vec2> = chosen.iter().map(|&i| points[i]).collect();
    let cells = Cells::new(&positions, link, period);
    let mut parent: Vec<usize> = (0..positions.len()).collect();
    for (a, &position) in positions.iter().enumerate() {
        cells.for_each_near(position, link, |b, _| {
            if b < a {
                let (ra, rb) = (root(&mut parent, a), root(&mut parent, b));
                // The lower index becomes the root, so the result depends on the particles alone.
                parent[ra.max(rb)] = ra.min(rb);
            }
        });
    }
    let mut of_root: Vec<Option<Blob>> = vec![None; positions.len()];
    for i in 0..positions.len() {
        let r = root(&mut parent, i);
        let blob = of_root[r].get_or_insert(Blob { count: 0, area: 0.0, first: chosen[i] });
        blob.count += 1;
        blob.area += volumes[chosen[i]];
    }
    let mut found: Vec<Blob> = of_root.into_iter().flatten().collect();
    found.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.first.cmp(&b.first)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::lattice::Lattice;

    #[test]
    fn two_drops_and_a_satellite_are_three_blobs() {
        let points = Lattice::open(Vec2::zeros(), Vec2::repeat(0.1), [60, 30]).nodes();
        let drop = |p: &Vec2, x: f64, y: f64, r: f64| (p - Vec2::new(x, y)).norm() < r;
        let inside = |p: &Vec2| drop(p, 1.0, 1.0, 0.7) || drop(p, 3.0, 1.5, 0.9) || drop(p, 5.0, 2.0, 0.12);
        let member: Vec<bool> = points.iter().map(inside).collect();
        let found = blobs(&points, &vec![0.01; points.len()], &member, LINK * 0.1, [None, None]);
        assert_eq!(found.len(), 3);
        assert!(found[0].area > found[1].area && found[2].count <= 5);
        assert_eq!(found.iter().map(|blob| blob.count).sum::<usize>(), member.iter().filter(|m| **m).count());
    }

    #[test]
    fn a_drop_across_a_periodic_side_is_one_blob() {
        let points = Lattice::open(Vec2::repeat(0.05), Vec2::repeat(0.1), [20, 20]).nodes();
        let member: Vec<bool> = points.iter().map(|p| p.x < 0.4 || p.x > 1.6).collect();
        let volumes = vec![0.01; points.len()];
        assert_eq!(blobs(&points, &volumes, &member, 0.16, [None, None]).len(), 2);
        assert_eq!(blobs(&points, &volumes, &member, 0.16, [Some(2.0), None]).len(), 1);
    }

    #[test]
    fn no_particle_makes_no_blob() {
        assert!(blobs(&[], &[], &[], 1.0, [None, None]).is_empty());
    }
}
