//! Oriented circles in coordinates in which the conditions on a meniscus are linear.
//!
//! A circle of signed curvature k = 1/r and center C is represented by X = k C, Y = k |C|² − 1/k and k, with |X|² − k Y = 1 (the coordinates of Lie sphere
//! geometry). They stay finite where the circle degenerates to a line: k = 0, X its unit normal. In these coordinates
//! - meeting a circular wall of signed radius R about c at the angle θ, |C − c|² = R² + r² + 2 R r cos θ, reads −2 c·X + Y + k (|c|² − R²) = 2 R cos θ (R > 0
//!   where the solid is convex, R < 0 where it is concave, R = 0 at a vertex);
//! - meeting a straight wall through q with normal n at the angle θ, n·(C − q) = r cos θ, reads n·X − k n·q = cos θ;
//! - being tangent to a wall is the case θ = 0.
//!
//! A circle under three such conditions is therefore a root of one quadratic equation, whatever the walls.

use meniscus_core::math::Vec2;

/// A circle or a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Circle {
    /// Center times curvature; the unit normal of a line.
    pub(crate) x: Vec2,
    /// k |C|² − 1/k.
    pub(crate) y: f64,
    /// Signed curvature.
    pub(crate) k: f64,
}

impl Circle {
    /// The circle through `p` whose center lies in the direction of the unit vector `v` from `p` for k > 0.
    pub(crate) fn through(p: Vec2, v: Vec2, k: f64) -> Self {
        Self { x: p * k + v, y: k * p.norm_squared() + 2.0 * p.dot(&v), k }
    }
}

/// A linear condition: the scalar product of the first four numbers with (X, Y, k) equals the fifth.
pub(super) type Condition = [f64; 5];

/// The condition to meet a circular wall, or to pass through a vertex (`radius` 0).
pub(super) fn meets_round(center: Vec2, radius: f64, cos_angle: f64) -> Condition {
    let distance = center.norm();
    let power = (distance - radius.abs()) * (distance + radius.abs());
    [-2.0 * center.x, -2.0 * center.y, 1.0, power, 2.0 * radius * cos_angle]
}

/// The condition to meet the straight wall through `q`.
pub(super) fn meets_straight(q: Vec2, normal: Vec2, cos_angle: f64) -> Condition {
    [normal.x, normal.y, 0.0, -normal.dot(&q), cos_angle]
}

/// The condition to have the curvature `k`.
pub(super) fn has_curvature(k: f64) -> Condition {
    [0.0, 0.0, 0.0, 1.0, k]
}

/// The circles that satisfy three conditions; none if the conditions are linearly dependent.
pub(super) fn circles(conditions: [Condition; 3]) -> [Option<Circle>; 2] {
    let Some((start, along)) = line_of_solutions(conditions) else { return [None, None] };
    // |X|² − k Y = 1 on start + t along: a t² + 2 b t + c = 0.
    let a = product(&along, &along);
    let b = product(&start, &along);
    let c = product(&start, &start) - 1.0;
    let circle = |t: f64| {
        let z: [f64; 4] = std::array::from_fn(|i| start[i] + t * along[i]);
        z.iter().all(|z| z.is_finite()).then_some(Circle { x: Vec2::new(z[0], z[1]), y: z[2], k: z[3] })
    };
    // The discriminant of a double root may fall below zero by rounding.
    roots(a, b, c, 1e-12).map_or([None, None], |both| both.map(circle))
}

/// The roots of a t² + 2 b t + c = 0, not finite where there are fewer; `None` if its discriminant is below zero by more than `slack` of its terms.
pub(super) fn roots(a: f64, b: f64, c: f64, slack: f64) -> Option<[f64; 2]> {
    let square = b * b - a * c;
    if square < -slack * (b * b).max((a * c).abs()) {
        return None;
    }
    let sum = -(b + square.max(0.0).sqrt().copysign(b));
    Some([sum / a, if sum == 0.0 { sum / a } else { c / sum }])
}

/// The bilinear form whose square is |X|² − k Y.
fn product(z: &[f64; 4], w: &[f64; 4]) -> f64 {
    z[0] * w[0] + z[1] * w[1] - 0.5 * (z[2] * w[3] + z[3] * w[2])
}

/// A solution of three linear equations in four unknowns and the direction of the null space, by elimination with full pivoting.
fn line_of_solutions(mut rows: [Condition; 3]) -> Option<([f64; 4], [f64; 4])> {
    let mut columns = [0, 1, 2, 3];
    for step in 0..3 {
        let mut best = (0.0, step, step);
        for (row, entries) in rows.iter().enumerate().skip(step) {
            for column in step..4 {
                let size = entries[columns[column]].abs();
                if size > best.0 {
                    best = (size, row, column);
                }
            }
        }
        // Below this the remaining rows are rounding: the conditions are linearly dependent.
        if best.0 <= 1e-13 {
            return None;
        }
        rows.swap(step, best.1);
        columns.swap(step, best.2);
        let pivot = rows[step];
        for (row, target) in rows.iter_mut().enumerate() {
            if row != step {
                let share = target[columns[step]] / pivot[columns[step]];
                target.iter_mut().zip(pivot).for_each(|(t, p)| *t -= share * p);
                target[columns[step]] = 0.0;
            }
        }
    }
    let (mut start, mut along) = ([0.0; 4], [0.0; 4]);
    along[columns[3]] = 1.0;
    for step in 0..3 {
        let pivot = rows[step][columns[step]];
        start[columns[step]] = rows[step][4] / pivot;
        along[columns[step]] = -rows[step][columns[3]] / pivot;
    }
    Some((start, along))
}
