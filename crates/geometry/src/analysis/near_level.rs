//! The nodes near a level of a smoothed field: the cost of a contour grows with the length of the interface, not with the area.

use super::resample::{SUPPORT, Samples};
use crate::interface::lattice::Lattice;
use meniscus_core::math::Vec2;

/// The nodes of `lattice` that [`contour`](crate::interface::contour::contour) needs of a field smoothed from `values` of `samples`, in order: those with
/// values on both sides of `level` nearby. Elsewhere the smoothed field is on one side, so it may as well be missing (NaN).
pub fn nodes_near_level(lattice: &Lattice, samples: &Samples, values: &[f64], level: f64) -> Vec<usize> {
    /// Distance in spacings from a crossed edge within which a contour needs nodes.
    const BESIDE_EDGES: f64 = 2.0;
    const HIGH: u8 = 1;
    const LOW: u8 = 2;
    let reach = SUPPORT * samples.smoothing_length + (BESIDE_EDGES + 1.0) * lattice.spacing.max();
    // Squares no smaller than the support: all particles in the support of a node lie in the nine squares around it.
    let nodes =
        [0, 1].map(|i| if lattice.periodic[i] { lattice.counts[i] } else { lattice.counts[i].saturating_sub(1) });
    let extent = [0, 1].map(|i| nodes[i] as f64 * lattice.spacing[i]);
    let counts = extent.map(|extent| (extent / reach).floor().max(1.0) as usize);
    let square = |x: Vec2| {
        let [column, row] = [0, 1].map(|i| {
            let k = ((x[i] - lattice.origin[i]) / extent[i] * counts[i] as f64).floor();
            let k = if lattice.periodic[i] { k.rem_euclid(counts[i] as f64) } else { k };
            k.clamp(0.0, (counts[i] - 1) as f64) as usize
        });
        column + counts[0] * row
    };
    let mut sides = vec![0; counts[0] * counts[1]];
    for (&x, &value) in samples.points.iter().zip(values) {
        sides[square(x)] |= if value >= level { HIGH } else { LOW };
    }
    let squares = Lattice { counts, ..*lattice };
    let both = |at: usize| {
        let (i, j) = ((at % counts[0]) as isize, (at / counts[0]) as isize);
        let around = (-1..=1).flat_map(|dj| (-1..=1).filter_map(move |di| squares.index(i + di, j + dj)));
        around.fold(0, |found, square| found | sides[square]) == HIGH | LOW
    };
    let both: Vec<bool> = (0..sides.len()).map(both).collect();
    let position = |node: usize| lattice.position(node % lattice.counts[0], node / lattice.counts[0]);
    (0..lattice.len()).filter(|&node| both[square(position(node))]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::resample::Stencils;
    use crate::interface::contour::contour;

    #[test]
    fn a_contour_has_the_same_bits_with_the_nodes_near_the_level_alone() {
        let n = 80;
        let dx = 1.0 / n as f64;
        for periodic in [[false; 2], [true, false], [true; 2]] {
            let scatter =
                |i: usize| 0.4 * dx * Vec2::new((i as f64 * 0.754_877).fract(), (i as f64 * 0.569_84).fract());
            let points: Vec<Vec2> = Lattice::open(Vec2::repeat(0.2 * dx), Vec2::repeat(dx), [n, n]).nodes();
            let points: Vec<Vec2> = points.iter().enumerate().map(|(i, x)| x + scatter(i)).collect();
            // A void, a drop across a corner of the box, another one, and a single particle.
            let points: Vec<Vec2> = points.into_iter().filter(|x| (x - Vec2::new(0.5, 0.2)).norm() > 0.06).collect();
            let is_in = |x: &Vec2, (at, r): (Vec2, f64)| (x - at).norm() < r;
            let drops = [(Vec2::zeros(), 0.2), (Vec2::new(0.5, 0.27), 0.11), (Vec2::new(0.8, 0.7), 0.8 * dx)];
            let color: Vec<f64> = points.iter().map(|x| f64::from(drops.iter().any(|d| is_in(x, *d)))).collect();
            let volumes = vec![dx * dx; points.len()];
            let period = periodic.map(|periodic| periodic.then_some(1.0));
            let samples = Samples { points: &points, volumes: &volumes, smoothing_length: 1.5 * dx, period };
            let lattice = Lattice { periodic, ..Lattice::open(Vec2::zeros(), Vec2::repeat(dx), [n, n]) };
            let nodes = lattice.nodes();
            let all = Stencils::new(&samples, &nodes).scalar(&color);
            let near = nodes_near_level(&lattice, &samples, &color, 0.5);
            assert!(near.len() < nodes.len() / 2, "{} of {}", near.len(), nodes.len());
            let mut some = vec![f64::NAN; nodes.len()];
            near.iter().for_each(|&node| some[node] = all[node]);
            let lines = contour(&lattice, &all, 0.5);
            assert!(lines.len() > 1 && lines == contour(&lattice, &some, 0.5), "{periodic:?}");
        }
    }

    #[test]
    fn the_contour_of_the_smoothed_color_of_particles_is_the_shifted_circle() {
        let n = 60;
        let dx = 2.0 / n as f64;
        let points = Lattice::open(Vec2::repeat(-1.0 + 0.3 * dx), Vec2::repeat(dx), [n, n]).nodes();
        let color: Vec<f64> = points.iter().map(|p| f64::from(p.norm() < 0.5)).collect();
        let volumes = vec![dx * dx; points.len()];
        let h = 1.5 * dx;
        let samples = Samples { points: &points, volumes: &volumes, smoothing_length: h, period: [None, None] };
        let lattice = Lattice::open(Vec2::repeat(-1.0), Vec2::repeat(dx), [n + 1, n + 1]);
        let values = Stencils::new(&samples, &lattice.nodes()).scalar(&color);
        let lines = contour(&lattice, &values, 0.5);
        assert_eq!(lines.len(), 1, "a node in a corner of a lattice may lack particles, not the disc");
        let mean = lines[0].points.iter().map(|p| p.norm()).sum::<f64>() / lines[0].points.len() as f64;
        // The cut lattice scatters by a fraction of dx; the mean shift is h²/(7 R).
        assert!((mean - (0.5 - h * h / 3.5)).abs() < 0.05 * dx, "mean radius off by {} dx", (mean - 0.5) / dx);
    }
}
