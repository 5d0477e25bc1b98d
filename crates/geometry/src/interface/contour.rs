//! Contours of a field on a regular grid by marching squares, joined into ordered polylines.
//!
//! The high side of the field (the wetting phase, if the field is the color) lies on the left of each polyline. Contours end at nodes without a value (NaN).
//! Vertices lie on grid edges, at the root of the cubic through four nodes where these exist, else of the linear interpolation. Saddles are resolved by the
//! mean of the four nodes (Lorensen and Cline 1987; Nielson and Hamann 1991). On periodic axes contours continue across the seam, so a polyline may leave the
//! box; periodic images are chosen nearest to its first vertex.

use super::lattice::Lattice;
use super::polyline::Polyline;
use meniscus_core::math::{Vec2, halved, nearest_image};

/// An edge of the grid from node (i, j) to the next node along `axis`.
#[derive(Debug, Clone, Copy)]
struct Edge {
    i: usize,
    j: usize,
    axis: usize,
}

/// Vertices closer to each other than this fraction of the spacing coincide: the level passes through a node.
const SAME_VERTEX: f64 = 1e-9;

/// Marks an edge at which no segment starts.
const NO_EDGE: usize = usize::MAX;

/// Contours of `values` (one per node of `lattice`, NaN where there is none) at `level` \[Lorensen1987; Nielson1991\].
///
/// Open lines come before closed ones, each group in grid order. A line that spans a periodic axis is open, its last vertex the image of the first.
pub fn contour(lattice: &Lattice, values: &[f64], level: f64) -> Vec<Polyline> {
    let tracer = Tracer { lattice, values, level };
    let mut next = vec![NO_EDGE; 2 * lattice.len()];
    let mut is_end = vec![false; 2 * lattice.len()];
    let cells =
        [0, 1].map(|a| if lattice.periodic[a] { lattice.counts[a] } else { lattice.counts[a].saturating_sub(1) });
    for j in 0..cells[1] {
        for i in 0..cells[0] {
            for (from, to) in tracer.segments_of_cell(i, j).into_iter().flatten() {
                next[from] = to;
                is_end[to] = true;
            }
        }
    }
    let mut lines = Vec::new();
    for open in [true, false] {
        for edge in 0..next.len() {
            if next[edge] != NO_EDGE && (!open || !is_end[edge]) {
                lines.extend(tracer.walk(edge, &mut next));
            }
        }
    }
    lines
}

struct Tracer<'a> {
    lattice: &'a Lattice,
    values: &'a [f64],
    level: f64,
}

impl Tracer<'_> {
    fn value(&self, i: isize, j: isize) -> Option<f64> {
        let value = self.values[self.lattice.index(i, j)?];
        value.is_finite().then_some(value - self.level)
    }

    /// Up to two segments of the cell whose lower left node is (i, j), as pairs of edge numbers, the high side on the left.
    fn segments_of_cell(&self, i: usize, j: usize) -> [Option<(usize, usize)>; 2] {
        let corner = |di: isize, dj: isize| self.value(i as isize + di, j as isize + dj);
        let (Some(v0), Some(v1), Some(v2), Some(v3)) = (corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)) else {
            return [None, None];
        };
        let [x, y] = self.lattice.counts;
        let number = |i: usize, j: usize, axis: usize| 2 * (i % x + x * (j % y)) + axis;
        let (bottom, right, top, left) = (number(i, j, 0), number(i + 1, j, 1), number(i, j + 1, 0), number(i, j, 1));
        let high = |v: f64, bit: usize| if v >= 0.0 { bit } else { 0 };
        let middle_is_high = v0 + v1 + v2 + v3 >= 0.0;
        match high(v0, 1) | high(v1, 2) | high(v2, 4) | high(v3, 8) {
            1 => [Some((bottom, left)), None],
            2 => [Some((right, bottom)), None],
            3 => [Some((right, left)), None],
            4 => [Some((top, right)), None],
            5 if middle_is_high => [Some((bottom, right)), Some((top, left))],
            5 => [Some((bottom, left)), Some((top, right))],
            6 => [Some((top, bottom)), None],
            7 => [Some((top, left)), None],
            8 => [Some((left, top)), None],
            9 => [Some((bottom, top)), None],
            10 if middle_is_high => [Some((left, bottom)), Some((right, top))],
            10 => [Some((right, bottom)), Some((left, top))],
            11 => [Some((right, top)), None],
            12 => [Some((left, right)), None],
            13 => [Some((bottom, right)), None],
            14 => [Some((left, bottom)), None],
            _ => [None, None],
        }
    }

    /// Follows the segments from `first`, removing them from `next`.
    fn walk(&self, first: usize, next: &mut [usize]) -> Option<Polyline> {
        let period = self.lattice.period();
        let mut points: Vec<Vec2> = vec![self.vertex(first)];
        let mut at = first;
        while next[at] != NO_EDGE {
            let to = std::mem::replace(&mut next[at], NO_EDGE);
            if let Some(&last) = points.last() {
                points.push(last + nearest_image(self.vertex(to) - last, period));
            }
            at = to;
        }
        let tiny = SAME_VERTEX * self.lattice.spacing.norm();
        let closed = at == first && points.len() > 2 && (points[points.len() - 1] - points[0]).norm() <= tiny;
        if closed {
            points.pop();
        }
        points.dedup_by(|b, a| (*b - *a).norm() <= tiny);
        (points.len() > 1).then_some(Polyline { points, closed })
    }

    /// Position of the level on an edge, in m.
    fn vertex(&self, edge: usize) -> Vec2 {
        let node = edge / 2;
        let edge = Edge { i: node % self.lattice.counts[0], j: node / self.lattice.counts[0], axis: edge % 2 };
        let mut shift = Vec2::zeros();
        shift[edge.axis] = self.lattice.spacing[edge.axis] * self.fraction(edge);
        self.lattice.position(edge.i, edge.j) + shift
    }

    /// Fraction of an edge at which the level is crossed.
    fn fraction(&self, edge: Edge) -> f64 {
        let along = |k: isize| {
            let step = if edge.axis == 0 { (k, 0) } else { (0, k) };
            self.value(edge.i as isize + step.0, edge.j as isize + step.1)
        };
        match (along(-1), along(0), along(1), along(2)) {
            (Some(before), Some(a), Some(b), Some(after)) => cubic_root([before, a, b, after]),
            (_, Some(a), Some(b), _) if a != b => a / (a - b),
            _ => 0.5,
        }
    }
}

/// The root in [0, 1] of the cubic through the values at -1, 0, 1, 2, where those at 0 and 1 have opposite signs.
fn cubic_root(values: [f64; 4]) -> f64 {
    let [before, a, b, after] = values;
    let cubic = |t: f64| {
        -before * t * (t - 1.0) * (t - 2.0) / 6.0 + a * (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0
            - b * (t + 1.0) * t * (t - 2.0) / 2.0
            + after * (t + 1.0) * t * (t - 1.0) / 6.0
    };
    // Bisection keeps the vertex on its edge whatever the cubic does; 40 halvings are far below the rounding of the field.
    let [low, high] = halved([0.0, 1.0], 40, |t| (cubic(t) >= 0.0) == (a >= 0.0));
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(lattice: &Lattice, f: impl Fn(Vec2) -> f64) -> Vec<f64> {
        lattice.nodes().into_iter().map(f).collect()
    }

    fn box_of(n: usize) -> Lattice {
        Lattice::open(Vec2::repeat(-1.0), Vec2::repeat(2.0 / n as f64), [n + 1, n + 1])
    }

    #[test]
    fn a_smooth_disc_is_closed_counter_clockwise_and_on_its_circle() {
        let lattice = box_of(40);
        let dx = lattice.spacing.x;
        let values = field(&lattice, |x| 0.5 - 0.5 * ((x.norm() - 0.5) / (1.5 * dx)).tanh());
        let lines = contour(&lattice, &values, 0.5);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed && lines[0].signed_area() > 0.0);
        let off = lines[0].points.iter().map(|p| (p.norm() - 0.5).abs()).fold(0.0, f64::max);
        assert!(off < 0.02 * dx, "off by {} dx", off / dx);
    }

    /// [Lorensen1987; Nielson1991]
    #[test]
    fn curvature_of_a_disc_is_one_over_its_radius_and_of_a_hole_its_negative() {
        let lattice = box_of(40);
        for sign in [1.0, -1.0] {
            let values = field(&lattice, |x| sign * (0.5 - x.norm()));
            let line = &contour(&lattice, &values, 0.0)[0];
            for kappa in line.curvature(0.2) {
                assert!((kappa - sign * 2.0).abs() < 0.02, "curvature {kappa}");
            }
        }
    }

    #[test]
    fn missing_nodes_cut_the_line_with_the_high_side_on_its_left() {
        let lattice = box_of(40);
        let values = field(&lattice, |x| if x.y < 0.0 { f64::NAN } else { 0.5 - x.norm() });
        let lines = contour(&lattice, &values, 0.0);
        assert_eq!(lines.len(), 1);
        assert!(!lines[0].closed);
        // On a floor, with the drop on its left, the contour runs from the right contact point over the top to the left one.
        assert!(lines[0].points[0].x > 0.4 && lines[0].points[lines[0].points.len() - 1].x < -0.4);
    }

    #[test]
    fn a_disc_across_a_periodic_seam_is_one_closed_line() {
        let n = 40;
        let lattice =
            Lattice { periodic: [true; 2], ..Lattice::open(Vec2::zeros(), Vec2::repeat(1.0 / n as f64), [n, n]) };
        let values = field(&lattice, |x| 0.3 - nearest_image(x - Vec2::new(0.95, 0.02), [Some(1.0); 2]).norm());
        let lines = contour(&lattice, &values, 0.0);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed);
        // The polygon inscribed in the circle is a little smaller.
        assert!((lines[0].signed_area() - 0.09 * std::f64::consts::PI).abs() < 0.002);
    }

    #[test]
    fn a_flat_interface_round_a_periodic_axis_has_the_length_of_the_period() {
        let lattice = Lattice { periodic: [true, false], ..Lattice::open(Vec2::zeros(), Vec2::repeat(0.05), [20, 20]) };
        let lines = contour(&lattice, &field(&lattice, |x| 0.42 - x.y), 0.0);
        assert_eq!(lines.len(), 1);
        assert!((lines[0].length() - 1.0).abs() < 1e-12, "length {}", lines[0].length());
    }

    /// [Lorensen1987; Nielson1991]
    #[test]
    fn a_uniform_field_has_no_contour() {
        let lattice = box_of(4);
        assert!(contour(&lattice, &vec![1.0; lattice.len()], 0.5).is_empty());
        assert!(contour(&lattice, &vec![f64::NAN; lattice.len()], 0.5).is_empty());
    }
}
