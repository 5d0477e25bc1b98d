//! Contours of drawings: lines, elliptic arcs, Bezier curves and splines, transformed exactly by nested maps and only then converted to rings of segments and
//! circular arcs.
//!
//! An elliptic arc is represented by two conjugate radii, which any affine map transforms to two others: a circle stays an exact circle as long as the
//! composed map rotates, scales and mirrors it. All other curves become biarcs.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::affine::Affine;
use super::biarc::{self, SmoothCurve};
use super::spline::BSpline;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::cross;

/// Relative tolerance for conjugate radii of a circle, equal and orthogonal: rounding of nested transforms.
const CIRCULAR: f64 = 1e-9;

/// A smooth part of a contour, from one point to another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Piece {
    /// A straight line between two points.
    Line([Vec2; 2]),
    /// A piece of an ellipse.
    Ellipse(EllipticArc),
    /// A cubic Bezier curve by its control points.
    Cubic([Vec2; 4]),
    /// A B-spline.
    Spline(Box<BSpline>),
}

/// The points center + radii\[0\] cos t + radii\[1\] sin t from `start` over the signed angle `sweep`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EllipticArc {
    /// First and last point, exactly as in the file.
    pub(crate) ends: [Vec2; 2],
    pub(crate) center: Vec2,
    /// Two conjugate radii.
    pub(crate) radii: [Vec2; 2],
    /// Angle t of the first point in rad.
    pub(crate) start: f64,
    /// Angle t from the first point to the last in rad, at most 2π in magnitude.
    pub(crate) sweep: f64,
}

impl EllipticArc {
    /// The arc by center, radii and angles.
    pub(crate) fn new(center: Vec2, radii: [Vec2; 2], start: f64, sweep: f64) -> Self {
        let at = |t: f64| center + radii[0] * t.cos() + radii[1] * t.sin();
        let first = at(start);
        let last = if sweep.abs() >= TAU { first } else { at(start + sweep) };
        Self { ends: [first, last], center, radii, start, sweep }
    }

    /// A full circle.
    pub(crate) fn circle(center: Vec2, radius: f64) -> Self {
        Self::new(center, [Vec2::new(radius, 0.0), Vec2::new(0.0, radius)], 0.0, TAU)
    }

    /// The circular arc between two points with a bulge; `None` if it is straight.
    pub(crate) fn from_bulge([a, b]: [Vec2; 2], bulge: f64) -> Option<Self> {
        let (center, radius) = circle_of_bulge([a, b], bulge)?;
        let from = a - center;
        let radii = [Vec2::new(radius, 0.0), Vec2::new(0.0, radius)];
        let (start, sweep) = (from.y.atan2(from.x), 4.0 * bulge.atan());
        Some(Self { ends: [a, b], center, radii, start, sweep })
    }

    pub(super) fn is_circular(&self) -> bool {
        let [u, v] = self.radii;
        let (uu, vv) = (u.norm_squared(), v.norm_squared());
        (uu - vv).abs() <= CIRCULAR * uu && u.dot(&v).abs() <= CIRCULAR * uu
    }

    /// The radius of the circle of the same area.
    pub(super) fn mean_radius(&self) -> f64 {
        cross(self.radii[0], self.radii[1]).abs().sqrt()
    }

    pub(super) fn append(&self, vertices: &mut Vec<[f64; 3]>) {
        if !self.is_circular() {
            let parts = (self.sweep.abs() / FRAC_PI_2 * (1.0 - CIRCULAR)).ceil().max(1.0);
            let size = 2.0 * (self.radii[0].norm_squared() + self.radii[1].norm_squared()).sqrt();
            let at = |k: f64| self.start + self.sweep * (k / parts);
            let first = vertices.len();
            for k in 0..parts as usize {
                biarc::append(self, at(k as f64), at(k as f64 + 1.0), size, vertices);
            }
            vertices[first][..2].copy_from_slice(self.ends[0].as_slice());
            return;
        }
        let parts = if self.sweep.abs() > PI * (1.0 + CIRCULAR) { 2.0 } else { 1.0 };
        let bulge = (0.25 * self.sweep / parts).tan() * cross(self.radii[0], self.radii[1]).signum();
        vertices.push([self.ends[0].x, self.ends[0].y, bulge]);
        if parts == 2.0 {
            let middle = self.point(self.start + 0.5 * self.sweep);
            vertices.push([middle.x, middle.y, bulge]);
        }
    }
}

impl SmoothCurve for EllipticArc {
    fn point(&self, t: f64) -> Vec2 {
        self.center + self.radii[0] * t.cos() + self.radii[1] * t.sin()
    }

    fn tangent(&self, t: f64, _: f64) -> Vec2 {
        let derivative = (self.radii[1] * t.cos() - self.radii[0] * t.sin()) * self.sweep.signum();
        derivative.try_normalize(0.0).unwrap_or_else(Vec2::zeros)
    }
}

impl SmoothCurve for [Vec2; 4] {
    fn point(&self, t: f64) -> Vec2 {
        let [a, b, c, d] = *self;
        let s = 1.0 - t;
        // Exact ends keep neighbors connected.
        if t == 1.0 { d } else { a * (s * s * s) + (b * s + c * t) * (3.0 * s * t) + d * (t * t * t) }
    }

    fn tangent(&self, t: f64, side: f64) -> Vec2 {
        let [a, b, c, d] = *self;
        let s = 1.0 - t;
        let (first, second, third) = (b - a, c - b, d - c);
        let size = first.norm() + second.norm() + third.norm();
        let speed = first * (s * s) + second * (2.0 * s * t) + third * (t * t);
        let bend = ((second - first) * s + (third - second) * t) * side;
        let twist = (third - second) - (second - first);
        // Where the first derivative vanishes the next one gives the direction.
        let rounding = 1e-12 * size;
        [speed, bend, twist].into_iter().find(|v| v.norm() > rounding).map_or_else(Vec2::zeros, |v| v.normalize())
    }
}

impl Piece {
    /// The quadratic Bezier curve with these control points.
    pub(crate) fn quadratic([a, b, c]: [Vec2; 3]) -> Self {
        Self::Cubic([a, a + (b - a) * (2.0 / 3.0), c + (b - c) * (2.0 / 3.0), c])
    }

    /// An edge with a bulge.
    pub(crate) fn from_bulge(ends: [Vec2; 2], bulge: f64) -> Self {
        EllipticArc::from_bulge(ends, bulge).map_or(Self::Line(ends), Self::Ellipse)
    }

    /// First and last point.
    pub(crate) fn ends(&self) -> [Vec2; 2] {
        match self {
            Self::Line(ends) => *ends,
            Self::Ellipse(arc) => arc.ends,
            Self::Cubic([a, _, _, b]) => [*a, *b],
            Self::Spline(spline) => match spline.spans()[..] {
                [[from, _], .., [_, to]] | [[from, to]] => [spline.point(from), spline.point(to)],
                [] => [Vec2::zeros(); 2],
            },
        }
    }

    /// An interior point, to distinguish pieces with the same ends.
    pub(crate) fn middle(&self) -> Vec2 {
        match self {
            Self::Line([a, b]) => 0.5 * (a + b),
            Self::Ellipse(arc) => arc.point(arc.start + 0.5 * arc.sweep),
            Self::Cubic(points) => points.point(0.5),
            Self::Spline(spline) => {
                let spans = spline.spans();
                spans.get(spans.len() / 2).map_or_else(Vec2::zeros, |[from, to]| spline.point(0.5 * (from + to)))
            }
        }
    }

    /// The image under a map.
    pub(crate) fn mapped(&self, map: &Affine) -> Self {
        match self {
            Self::Line(ends) => Self::Line(ends.map(|end| map.apply(end))),
            Self::Ellipse(arc) => Self::Ellipse(EllipticArc {
                ends: arc.ends.map(|end| map.apply(end)),
                center: map.apply(arc.center),
                radii: arc.radii.map(|radius| map.turn(radius)),
                ..*arc
            }),
            Self::Cubic(points) => Self::Cubic(points.map(|point| map.apply(point))),
            Self::Spline(spline) => Self::Spline(Box::new(spline.mapped(map))),
        }
    }

    /// The same points in reverse order.
    pub(crate) fn reversed(&self) -> Self {
        match self {
            Self::Line([a, b]) => Self::Line([*b, *a]),
            Self::Ellipse(arc) => Self::Ellipse(EllipticArc {
                ends: [arc.ends[1], arc.ends[0]],
                start: arc.start + arc.sweep,
                sweep: -arc.sweep,
                ..*arc
            }),
            Self::Cubic([a, b, c, d]) => Self::Cubic([*d, *c, *b, *a]),
            Self::Spline(spline) => Self::Spline(Box::new(spline.reversed())),
        }
    }

    /// Whether all its numbers are in range.
    pub(crate) fn is_in_range(&self) -> bool {
        let is_in_range = super::limits::is_in_range;
        match self {
            Self::Line(ends) => ends.iter().all(|&end| is_in_range(end)),
            Self::Ellipse(arc) => {
                [arc.ends[0], arc.ends[1], arc.center, arc.radii[0], arc.radii[1]].into_iter().all(is_in_range)
                    && arc.start.is_finite()
                    && arc.sweep.is_finite()
            }
            Self::Cubic(points) => points.iter().all(|&point| is_in_range(point)),
            Self::Spline(spline) => spline.points.iter().all(|&point| is_in_range(point)),
        }
    }

    pub(super) fn append(&self, vertices: &mut Vec<[f64; 3]>) {
        match self {
            Self::Line([a, _]) => vertices.push([a.x, a.y, 0.0]),
            Self::Ellipse(arc) => arc.append(vertices),
            Self::Cubic(points) => {
                let [a, b, c, d] = *points;
                let size = (a.sup(&b).sup(&c).sup(&d) - a.inf(&b).inf(&c).inf(&d)).norm();
                biarc::append(points, 0.0, 1.0, size, vertices);
            }
            Self::Spline(spline) => {
                let size = spline.extent();
                for [from, to] in spline.spans() {
                    biarc::append(spline.as_ref(), from, to, size, vertices);
                }
            }
        }
    }
}

/// Center and radius of the arc between two points; `None` if it is straight.
pub(super) fn circle_of_bulge([a, b]: [Vec2; 2], bulge: f64) -> Option<(Vec2, f64)> {
    let chord = b - a;
    let length = chord.norm();
    if !(bulge != 0.0 && length > 0.0) {
        return None;
    }
    let radius = 0.25 * length * (bulge + bulge.recip()).abs();
    let center = 0.5 * (a + b) + perpendicular(chord) * (0.25 * (bulge.recip() - bulge));
    (radius.is_finite()).then_some((center, radius))
}

#[cfg(test)]
mod tests {
    use super::super::closing::{Closed, area, close};
    use super::super::drawing::Ring;
    use super::*;

    fn ring(pieces: &[Piece]) -> Ring {
        match close(pieces, 0.0) {
            Closed::Ring(ring) => ring,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn an_ellipse_keeps_its_area_with_few_arcs() {
        for ratio in [1.01, 1.5, 2.0, 5.0, 30.0] {
            let arc = EllipticArc::new(Vec2::new(7.0, -3.0), [Vec2::new(ratio, 0.0), Vec2::y()], 0.0, TAU);
            let ring = ring(&[Piece::Ellipse(arc)]);
            let error = area(&ring.vertices) / (PI * ratio) - 1.0;
            // At most the tolerance along the whole circumference; a tenth of that, as the chain lies on both sides.
            assert!(error.abs() < 0.1 * 4.0 * ratio * 2.0 * biarc::TOLERANCE, "{ratio}: {error:e}");
            assert!(ring.vertices.len() <= 120);
        }
    }

    #[test]
    fn a_circle_stays_one_under_turns_and_becomes_an_ellipse_under_stretching() {
        let piece = Piece::Ellipse(EllipticArc::circle(Vec2::new(1.0, 2.0), 3.0));
        let turned = Affine::rotation_deg(27.0).after(&Affine::scaling(-2.0, 2.0));
        let Closed::Circle { center, radius, is_clockwise } = close(&[piece.mapped(&turned)], 0.0) else {
            panic!("no circle")
        };
        assert!(is_clockwise, "the map mirrors");
        assert!((center - turned.apply(Vec2::new(1.0, 2.0))).norm() < 1e-14);
        assert!((radius - 6.0).abs() < 1e-14);
        let stretched = ring(&[piece.mapped(&Affine::scaling(1.0, 2.0))]);
        assert!((area(&stretched.vertices) / (18.0 * PI) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn arcs_of_one_circle_are_a_circle_and_others_are_not() {
        let points = [Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)];
        let half = |bulge| Piece::from_bulge(points, bulge);
        let back = |bulge| Piece::from_bulge([points[1], points[0]], bulge);
        assert!(
            matches!(close(&[half(1.0), back(1.0)], 0.0), Closed::Circle { radius, .. } if (radius - 1.0).abs() < 1e-15)
        );
        let lens = ring(&[half(0.5), back(0.5)]);
        let (angle, radius) = (4.0 * 0.5f64.atan(), 1.25);
        assert!((area(&lens.vertices) - radius * radius * (angle - angle.sin())).abs() < 1e-14);
        assert_eq!(close(&[half(1.0), back(-1.0)], 0.0), Closed::Empty);
    }

    #[test]
    fn a_contour_run_through_backwards_has_the_opposite_area() {
        let a = [Vec2::zeros(), Vec2::new(1.0, -2.0), Vec2::new(4.0, 3.0), Vec2::new(3.0, 1.0)];
        let arc = EllipticArc::new(Vec2::new(1.0, 1.0), [Vec2::new(2.0, 0.0), Vec2::new(0.5, 0.5)], 0.0, 2.0);
        let pieces = [Piece::Cubic(a), Piece::Line([a[3], arc.ends[0]]), Piece::Ellipse(arc)];
        let backwards: Vec<Piece> = pieces.iter().rev().map(Piece::reversed).collect();
        let (forth, back) = (area(&ring(&pieces).vertices), area(&ring(&backwards).vertices));
        assert!((forth + back).abs() < 1e-4 * forth.abs() && forth.abs() > 0.1);
    }

    #[test]
    fn a_bezier_curve_with_a_cusp_and_one_that_begins_without_speed_are_read() {
        let p = Vec2::new;
        // The cusp at (1/2, 3/4): the derivative vanishes there. Area by Green's theorem on the polynomial.
        for points in
            [[p(0.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(1.0, 0.0)], [p(0.0, 0.0), p(0.0, 0.0), p(0.0, 1.0), p(1.0, 0.0)]]
        {
            let [a, b, c, d] = points;
            let exact = 0.05
                * (6.0 * cross(a, b)
                    + 3.0 * cross(a, c)
                    + cross(a, d)
                    + 3.0 * cross(b, c)
                    + 3.0 * cross(b, d)
                    + 6.0 * cross(c, d))
                + 0.5 * cross(d, a);
            let ring = ring(&[Piece::Cubic(points)]);
            assert!((area(&ring.vertices) - exact).abs() < 3e-5, "{} {exact}", area(&ring.vertices));
            assert!(ring.vertices.len() < 200, "{}", ring.vertices.len());
        }
    }
}
