//! Classification of rings as outer ones and holes, by containment, never by orientation alone.
//!
//! A ring bounds the filled area if the fill rule differs on its two sides. Containment is that of a point well inside the ring, in rings of larger area:
//! rings must not cross, but may touch and coincide along lines, wherever they start. Only the points of rings whose boxes lie in that of the ring are looked
//! at, sorted by x, so that a vertical ray from each is tested against the edges above and below it alone.

use crate::import::drawing::{FillRule, Ring};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::tree::Tree;

/// Relative tolerance of areas and of sides of boxes.
const SAME: f64 = 1e-9;

/// Position of the vertical line in the box of a ring over its width: off the symmetry axes, on which vertices lie.
const ACROSS: f64 = 0.4871;

/// An outer ring and its holes, as indices into the rings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Nested {
    /// The outer ring.
    pub(crate) outer: usize,
    /// The holes, by index.
    pub(crate) holes: Vec<usize>,
}

/// Groups rings that do not cross; rings inside a filled area are omitted under [`FillRule::NonZero`]. Ordered by outer ring.
pub(crate) fn nested(rings: &[Ring], rule: FillRule) -> Vec<Nested> {
    let containing = containing(rings);
    let sign = |i: usize| if rings[i].area() > 0.0 { 1 } else { -1 };
    let signs: Vec<i64> = (0..rings.len()).map(sign).collect();
    let is_filled = |around: &[usize], own: Option<usize>| {
        let all = around.iter().copied().chain(own);
        match rule {
            FillRule::EvenOdd => all.count() % 2 == 1,
            FillRule::NonZero => all.map(|i| signs[i]).sum::<i64>() != 0,
        }
    };
    // Whether the outside and the inside of each ring are filled.
    let sides: Vec<(bool, bool)> =
        (0..rings.len()).map(|i| (is_filled(&containing[i], None), is_filled(&containing[i], Some(i)))).collect();
    let mut found: Vec<Nested> = Vec::new();
    let mut index = vec![usize::MAX; rings.len()];
    for i in (0..rings.len()).filter(|&i| sides[i] == (false, true)) {
        index[i] = found.len();
        found.push(Nested { outer: i, holes: Vec::new() });
    }
    for i in (0..rings.len()).filter(|&i| sides[i] == (true, false)) {
        // The innermost enclosing outer ring: the one contained in most others.
        let parent =
            containing[i].iter().copied().filter(|&j| index[j] != usize::MAX).max_by_key(|&j| containing[j].len());
        if let Some(parent) = parent {
            found[index[parent]].holes.push(i);
        }
    }
    found
}

/// For each ring the indices of those that contain it.
pub(crate) fn containing(rings: &[Ring]) -> Vec<Vec<usize>> {
    let mut around = vec![Vec::new(); rings.len()];
    if rings.len() < 2 {
        return around;
    }
    let boxes: Vec<Bounds> = rings.iter().map(Ring::bounds).collect();
    let areas: Vec<f64> = rings.iter().map(|ring| ring.area().abs()).collect();
    let can_contain = |j: usize, i: usize| areas[j] > areas[i] * (1.0 + SAME) && encloses(&boxes[j], &boxes[i]);
    let starts: Vec<Option<Vec2>> = rings.iter().zip(&boxes).map(|(ring, bounds)| inner_point(ring, bounds)).collect();
    let tree = Tree::over(boxes.iter().copied());
    for (j, ring) in rings.iter().enumerate() {
        let inside = tree.near(widened(&boxes[j])).filter(|&i| i != j && can_contain(j, i));
        let mut inside: Vec<(Vec2, usize)> = inside.filter_map(|i| Some((starts[i]?, i))).collect();
        if inside.is_empty() {
            continue;
        }
        inside.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.cmp(&b.1)));
        // Parity of the edges of this ring below each start, toggled edge by edge.
        let mut toggled: Vec<usize> = Vec::new();
        for span in spans_of(ring) {
            let from = inside.partition_point(|start| start.0.x < span.x.0);
            let near = inside[from..].iter().take_while(|start| start.0.x < span.x.1);
            toggled.extend(near.filter(|(p, _)| span.height(p.x) < p.y).map(|(_, i)| *i));
        }
        toggled.sort_unstable();
        for same in toggled.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1) {
            around[same[0]].push(j);
        }
    }
    around
}

fn widened(bounds: &Bounds) -> Bounds {
    bounds.grown(SAME * bounds.size().max())
}

fn encloses(outer: &Bounds, inner: &Bounds) -> bool {
    let outer = widened(outer);
    (0..2).all(|i| outer.min[i] <= inner.min[i] && inner.max[i] <= outer.max[i])
}

/// A point inside a ring: the midpoint of its longest section on a vertical line through its box.
fn inner_point(ring: &Ring, bounds: &Bounds) -> Option<Vec2> {
    let x = bounds.min.x + ACROSS * bounds.size().x;
    let hit = spans_of(ring).filter(|span| span.x.0 <= x && x < span.x.1);
    let mut heights: Vec<f64> = hit.map(|span| span.height(x)).collect();
    heights.sort_by(f64::total_cmp);
    let longest = heights.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    Some(Vec2::new(x, 0.5 * (longest[0] + longest[1])))
}

/// The pieces of all edges of a ring.
fn spans_of(ring: &Ring) -> impl Iterator<Item = Span> {
    let next = ring.vertices.iter().cycle().skip(1);
    let edges = bulged_ring(&ring.vertices).zip(&ring.vertices).zip(next);
    edges.flat_map(|((curve, a), b)| spans(&curve, [a[0], b[0]]))
}

/// A piece of an edge over an interval of x, open on the right.
struct Span {
    x: (f64, f64),
    kind: Kind,
}

enum Kind {
    Line { from: Vec2, slope: f64 },
    Arc { center: Vec2, radius: f64, side: f64 },
}

impl Span {
    fn height(&self, x: f64) -> f64 {
        match self.kind {
            Kind::Line { from, slope } => from.y + slope * (x - from.x),
            Kind::Arc { center, radius, side } => {
                let dx = x - center.x;
                center.y + side * (radius * radius - dx * dx).max(0.0).sqrt()
            }
        }
    }
}

/// The pieces of a curve that are graphs over x. It starts and ends at `ends`, bitwise equal to those of its neighbors, so that there are no gaps.
fn spans(curve: &Curve, ends: [f64; 2]) -> Vec<Span> {
    match *curve {
        Curve::Segment { a, b } => {
            let x = (a.x.min(b.x), a.x.max(b.x));
            vec![Span { x, kind: Kind::Line { from: a, slope: (b.y - a.y) / (b.x - a.x) } }]
        }
        Curve::Arc { center, radius, start, sweep } => {
            use std::f64::consts::PI;
            // Cut at the leftmost and rightmost points, the angles k π.
            let (from, to) = (start.min(start + sweep), start.max(start + sweep));
            let mut cuts = vec![from];
            let mut k = (from / PI).floor() + 1.0;
            while k * PI < to {
                cuts.push(k * PI);
                k += 1.0;
            }
            cuts.push(to);
            let [first, last] = if sweep > 0.0 { ends } else { [ends[1], ends[0]] };
            let count = cuts.len() - 1;
            let x_of = |i: usize| match i {
                0 => first,
                i if i == count => last,
                i => center.x + radius * (cuts[i] / PI).round().rem_euclid(2.0).mul_add(-2.0, 1.0),
            };
            (0..count)
                .map(|i| {
                    let (a, b) = (x_of(i), x_of(i + 1));
                    let side = (0.5 * (cuts[i] + cuts[i + 1])).sin().signum();
                    Span { x: (a.min(b), a.max(b)), kind: Kind::Arc { center, radius, side } }
                })
                .collect()
        }
    }
}

/// A circle as a ring of two half circles.
pub(crate) fn circle(center: Vec2, radius: f64) -> Ring {
    Ring { vertices: vec![[center.x - radius, center.y, 1.0], [center.x + radius, center.y, 1.0]] }
}

/// An outer ring with its holes.
pub(crate) type Region = (Ring, Vec<Ring>);

/// The regions of rings that do not cross.
pub(crate) fn regions(rings: &[Ring], rule: FillRule) -> Vec<Region> {
    let take = |i: usize| rings[i].clone();
    nested(rings, rule).into_iter().map(|n| (take(n.outer), n.holes.into_iter().map(take).collect())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::drawing::seen::bar;

    fn square(center: [f64; 2], half: f64) -> Ring {
        bar(center[0] - half, center[1] - half, 2.0 * half, 2.0 * half)
    }

    fn disc(center: [f64; 2], radius: f64) -> Ring {
        circle(center.into(), radius)
    }

    #[test]
    fn holes_and_islands_are_told_by_containment_whatever_the_direction() {
        for flip in 0..16 {
            let rings: Vec<Ring> =
                [square([0.0; 2], 4.0), disc([0.0; 2], 3.0), square([0.0; 2], 1.0), disc([9.0, 0.0], 1.0)]
                    .into_iter()
                    .enumerate()
                    .map(|(i, ring)| if flip >> i & 1 == 1 { ring.reversed() } else { ring })
                    .collect();
            let expected = [(0, vec![1]), (2, vec![]), (3, vec![])];
            let found = nested(&rings, FillRule::EvenOdd);
            assert_eq!(found, expected.map(|(outer, holes)| Nested { outer, holes }), "{flip:04b}");
        }
    }

    #[test]
    fn by_the_rule_of_winding_only_rings_that_run_the_other_way_are_holes() {
        let rings = [square([0.0; 2], 4.0), disc([-2.0, 0.0], 1.0).reversed(), disc([2.0, 0.0], 1.0)];
        assert_eq!(nested(&rings, FillRule::NonZero), [Nested { outer: 0, holes: vec![1] }]);
        assert_eq!(nested(&rings, FillRule::EvenOdd), [Nested { outer: 0, holes: vec![1, 2] }]);
    }

    #[test]
    fn a_hole_that_touches_its_ring_is_one_wherever_it_begins_and_however_it_is_mirrored() {
        let outer = square([5.0, 5.0], 3.0);
        let holes: [&[[f64; 2]]; 3] = [
            &[[8.0, 5.0], [6.0, 4.0], [6.0, 6.0]],
            &[[2.0, 2.0], [4.0, 6.0], [6.0, 4.0]],
            &[[2.0, 4.0], [8.0, 4.0], [8.0, 6.0], [2.0, 6.0]],
        ];
        for (hole, start, turn) in
            holes.iter().flat_map(|h| (0..h.len()).flat_map(move |s| (0..16).map(move |t| (h, s, t))))
        {
            let moved = |ring: &Ring| Ring {
                vertices: ring
                    .vertices
                    .iter()
                    .map(|&[x, y, _]| {
                        let x = if turn & 1 == 1 { 10.0 - x } else { x };
                        if turn & 2 == 2 { [y, x, 0.0] } else { [x, y, 0.0] }
                    })
                    .collect(),
            };
            let mut vertices: Vec<[f64; 3]> = hole.iter().map(|&[x, y]| [x, y, 0.0]).collect();
            vertices.rotate_left(start);
            let inner = moved(&Ring { vertices });
            let rings = [moved(&outer), if turn & 4 == 4 { inner.reversed() } else { inner }];
            let (rings, first) = if turn & 8 == 8 { ([rings[1].clone(), rings[0].clone()], 1) } else { (rings, 0) };
            let found = nested(&rings, FillRule::EvenOdd);
            assert_eq!(found, [Nested { outer: first, holes: vec![1 - first] }], "{start} {turn}");
        }
    }

    #[test]
    fn a_small_ring_in_the_dent_of_an_arc_is_not_inside() {
        // The right side is an inward half circle.
        let dented = Ring { vertices: vec![[0.0, 0.0, 0.0], [4.0, 0.0, -1.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]] };
        assert_eq!(nested(&[dented.clone(), disc([3.0, 2.0], 0.1)], FillRule::EvenOdd).len(), 2);
        assert_eq!(nested(&[dented, disc([1.0, 2.0], 0.1)], FillRule::EvenOdd).len(), 1);
    }
}
