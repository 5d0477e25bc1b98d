//! Ganglia: connected components of the particles of a phase, by union-find.
//!
//! Two particles of the phase are connected if they are nearer than [`LINK`] spacings: more than the diagonal of the lattice (1.41), less than the second
//! neighbor (2).

use meniscus_core::math::root;

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

/// Connected components of the particles with `member`, largest first; `volumes` in m², `linked(a)` the particles connected to a, of which those
/// below a suffice.
pub fn blobs<I: Iterator<Item = usize>>(volumes: &[f64], member: &[bool], linked: impl Fn(usize) -> I) -> Vec<Blob> {
    let members = || (0..volumes.len()).filter(|&a| member[a]);
    let mut parent: Vec<usize> = (0..volumes.len()).collect();
    for a in members() {
        for b in linked(a).filter(|&b| b < a && member[b]) {
            let (ra, rb) = (root(&mut parent, a), root(&mut parent, b));
            // The lower index becomes the root, so the result depends on the particles alone.
            parent[ra.max(rb)] = ra.min(rb);
        }
    }
    let mut of_root: Vec<Option<Blob>> = vec![None; volumes.len()];
    for a in members() {
        let r = root(&mut parent, a);
        let blob = of_root[r].get_or_insert(Blob { count: 0, area: 0.0, first: a });
        blob.count += 1;
        blob.area += volumes[a];
    }
    let mut found: Vec<Blob> = of_root.into_iter().flatten().collect();
    found.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.first.cmp(&b.first)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::cells::Cells;
    use crate::interface::lattice::Lattice;
    use meniscus_core::math::Vec2;

    fn blobs_of(points: &[Vec2], member: &[bool], link: f64, period: [Option<f64>; 2]) -> Vec<Blob> {
        let cells = Cells::new(points, link, period);
        blobs(&vec![0.01; points.len()], member, |a| {
            let mut near = Vec::new();
            cells.for_each_near(points[a], link, |b, _| near.push(b));
            near.into_iter()
        })
    }

    #[test]
    fn two_drops_and_a_satellite_are_three_blobs() {
        let points = Lattice::open(Vec2::zeros(), Vec2::repeat(0.1), [60, 30]).nodes();
        let drop = |p: &Vec2, x: f64, y: f64, r: f64| (p - Vec2::new(x, y)).norm() < r;
        let inside = |p: &Vec2| drop(p, 1.0, 1.0, 0.7) || drop(p, 3.0, 1.5, 0.9) || drop(p, 5.0, 2.0, 0.12);
        let member: Vec<bool> = points.iter().map(inside).collect();
        let found = blobs_of(&points, &member, LINK * 0.1, [None, None]);
        assert_eq!(found.len(), 3);
        assert!(found[0].area > found[1].area && found[2].count <= 5);
        assert_eq!(found.iter().map(|blob| blob.count).sum::<usize>(), member.iter().filter(|m| **m).count());
    }

    #[test]
    fn a_drop_across_a_periodic_side_is_one_blob() {
        let points = Lattice::open(Vec2::repeat(0.05), Vec2::repeat(0.1), [20, 20]).nodes();
        let member: Vec<bool> = points.iter().map(|p| p.x < 0.4 || p.x > 1.6).collect();
        assert_eq!(blobs_of(&points, &member, 0.16, [None, None]).len(), 2);
        assert_eq!(blobs_of(&points, &member, 0.16, [Some(2.0), None]).len(), 1);
    }

    #[test]
    fn no_particle_makes_no_blob() {
        assert!(blobs_of(&[], &[], 1.0, [None, None]).is_empty());
    }
}
