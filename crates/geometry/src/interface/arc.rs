//! The shape of a static meniscus, fitted to points along it: a circle, or under a body force the arc that solves the Young-Laplace equation.
//!
//! Along a static meniscus the curvature is κ = κ_0 + (Δρ/σ) g·(x − x_0). The arc is integrated to both sides from the middle of the points, and its three
//! unknowns (curvature, direction and offset there) minimize the sum of squared distances by Gauss-Newton. The bending of a moving interface by the flow is
//! neglected.

use nalgebra::{Matrix3, Vector3};

use super::circle::{self, CircleError, CircleFit};
use meniscus_core::math::{Vec2, perpendicular};

/// Maximum number of Gauss-Newton steps; starting from the circle a few suffice.
const STEPS: usize = 20;

/// Maximum number of halvings of a step.
const HALVINGS: usize = 12;

/// The iteration has converged when a step changes no parameter by more than this fraction of the increment of the finite differences.
const SETTLED: f64 = 1e-4;

/// Nodes of an arc per fitted point.
const NODES_PER_POINT: f64 = 2.0;

/// Maximum number of nodes on each side of the middle.
const MOST_NODES: usize = 20_000;

/// The fitted shape of a meniscus.
#[derive(Debug, Clone, PartialEq)]
pub struct Arc {
    /// Curvature, direction and position in the middle of the points, with their covariance.
    pub middle: CircleFit,
    /// Δρ g/σ in 1/m².
    force: Vec2,
    /// Arc length to both sides of the middle, and between nodes, in m.
    lengths: [f64; 2],
    /// Nodes in the order of the points; empty for a circle, which has closed forms.
    nodes: Vec<Node>,
}

/// A node of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    x: Vec2,
    tangent: Vec2,
    curvature: f64,
}

impl Node {
    /// Signed distance (m) of `x`, positive on the side of the normal, and the arc length (m) from the node to the foot of the perpendicular.
    fn beside(&self, x: Vec2) -> (f64, f64) {
        let from = x - self.x;
        let along = from.dot(&self.tangent);
        (from.dot(&perpendicular(self.tangent)) - 0.5 * self.curvature * along * along, along)
    }
}

impl Arc {
    /// Fits `points` (m), given in order along the meniscus with the wetting phase on the left, under the `force` Δρ g/σ (1/m²), where Δρ is the density on
    /// the left minus that on the right. The arc extends by `beyond` (m) past both ends.
    ///
    /// # Errors
    /// As for [`circle::fit`].
    pub fn fit(points: &[Vec2], force: Vec2, beyond: f64) -> Result<Self, CircleError> {
        let circle = circle::fit(points)?;
        if force == Vec2::zeros() {
            return Ok(Self { middle: circle, force, lengths: [0.0; 2], nodes: Vec::new() });
        }
        let length: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let lengths = [length + beyond, length / (NODES_PER_POINT * points.len() as f64)];
        let mut best = Self::traced(circle, force, lengths);
        let natural = Vector3::new(1e-4 / length, 1e-4, 1e-4 * length);
        let mut residuals = best.distances(points);
        let cost = |residuals: &[f64]| residuals.iter().map(|r| r * r).sum::<f64>();
        for _ in 0..STEPS {
            let columns = [0, 1, 2].map(|k| {
                let mut change = Vector3::zeros();
                change[k] = natural[k];
                let moved = best.perturbed(change).distances(points);
                moved.iter().zip(&residuals).map(|(m, r)| (m - r) / natural[k]).collect::<Vec<f64>>()
            });
            let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (i, r) in residuals.iter().enumerate() {
                let row = Vector3::new(columns[0][i], columns[1][i], columns[2][i]);
                normal += row * row.transpose();
                right -= row * *r;
            }
            let inverse = normal.try_inverse().ok_or(CircleError::Degenerate)?;
            best.middle.covariance = inverse * circle::variance_of(&residuals);
            best.middle.rms = (cost(&residuals) / points.len() as f64).sqrt();
            // A step that raises the cost is halved.
            let changes = std::iter::successors(Some(inverse * right), |change| Some(0.5 * change)).take(HALVINGS);
            let trials = changes.map(|change| {
                let next = best.perturbed(change);
                let now = next.distances(points);
                (change, next, now)
            });
            let Some((change, next, now)) = trials.into_iter().find(|(.., now)| cost(now) < cost(&residuals)) else {
                break;
            };
            (best, residuals) = (next, now);
            if change.component_div(&natural).norm() < SETTLED {
                break;
            }
        }
        Ok(best)
    }

    /// The arc with direction and curvature of a circle at its middle point.
    fn traced(middle: CircleFit, force: Vec2, lengths: [f64; 2]) -> Self {
        let [reach, step] = lengths;
        let count = ((reach / step).ceil() as usize).min(MOST_NODES);
        let curvature = |x: Vec2| middle.curvature + force.dot(&(x - middle.at));
        let start = Node { x: middle.at, tangent: -perpendicular(middle.normal), curvature: middle.curvature };
        let side = |by: f64| {
            let next = move |node: &Node| {
                // By the midpoint rule.
                let half = node.x + 0.5 * by * turned(node.tangent, 0.25 * by * node.curvature);
                let kappa = curvature(half);
                let tangent = turned(node.tangent, by * kappa);
                let x = node.x + by * turned(node.tangent, 0.5 * by * kappa);
                Some(Node { x, tangent, curvature: curvature(x) })
            };
            std::iter::successors(Some(start), next).skip(1).take(count)
        };
        let mut nodes: Vec<Node> = side(-step).collect();
        nodes.reverse();
        nodes.push(start);
        nodes.extend(side(step));
        Self { middle, force, lengths, nodes }
    }

    /// Signed distances in m of points given in the order of the arc, positive on the side of the normal.
    fn distances(&self, points: &[Vec2]) -> Vec<f64> {
        let mut at = points.first().map_or(0, |x| self.nearest(*x));
        points
            .iter()
            .map(|x| {
                let away = |k: usize| (self.nodes[k].x - x).norm_squared();
                while at + 1 < self.nodes.len() && away(at + 1) <= away(at) {
                    at += 1;
                }
                self.nodes[at].beside(*x).0
            })
            .collect()
    }

    fn nearest(&self, x: Vec2) -> usize {
        let away = |k: &usize| (self.nodes[*k].x - x).norm_squared();
        (0..self.nodes.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// The arc with curvature, direction and offset in the middle changed by `change` (1/m, rad, m).
    pub(crate) fn perturbed(&self, change: Vector3<f64>) -> Self {
        let middle = self.middle.perturbed(change);
        if self.nodes.is_empty() {
            Self { middle, ..self.clone() }
        } else {
            Self::traced(middle, self.force, self.lengths)
        }
    }

    /// Unit normal at `x` (m, near the arc), on the left of the points in their order.
    pub fn normal_at(&self, x: Vec2) -> Vec2 {
        let Some(node) = self.nodes.get(self.nearest(x)) else { return self.middle.normal_at(x) };
        perpendicular(turned(node.tangent, node.curvature * node.beside(x).1))
    }

    /// The point of the arc at the arc length `length` (m) from the foot of `from`, in the order of the points; clamped to the ends of the arc.
    pub fn walk(&self, from: Vec2, length: f64) -> Vec2 {
        if self.nodes.is_empty() {
            return self.middle.walk(from, length);
        }
        let k = self.nearest(from);
        let step = self.lengths[1];
        let position = k as f64 + (self.nodes[k].beside(from).1 + length) / step;
        let node = position.round().clamp(0.0, (self.nodes.len() - 1) as f64);
        let rest = ((position - node) * step).clamp(-step, step);
        let Node { x, tangent, curvature } = self.nodes[node as usize];
        x + rest * turned(tangent, 0.5 * rest * curvature)
    }

    /// Curvature in 1/m at `x`, positive where the arc turns to the left in the order of the points.
    pub(crate) fn curvature_at(&self, x: Vec2) -> f64 {
        self.middle.curvature + self.force.dot(&(x - self.middle.at))
    }
}

/// The vector turned by a small angle in rad.
fn turned(v: Vec2, angle: f64) -> Vec2 {
    let (sine, cosine) = angle.sin_cos();
    cosine * v + sine * perpendicular(v)
}

/// Points in m and directions in rad along the meniscus that starts at (1, 0) in the direction `phi`, in steps of 1e-3.
#[cfg(test)]
pub(super) fn steps_along(phi: f64, kappa: f64, force: Vec2) -> impl Iterator<Item = (Vec2, f64)> {
    const STEP: f64 = 1e-3;
    std::iter::successors(Some((Vec2::x(), phi)), move |&(x, phi)| {
        let turn = kappa + force.dot(&(x - Vec2::x()));
        let half = phi + 0.5 * STEP * turn;
        Some((x + STEP * Vec2::new(half.cos(), half.sin()), phi + STEP * turn))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point at every thirtieth of two thousand steps.
    fn meniscus(phi: f64, kappa: f64, force: Vec2) -> Vec<Vec2> {
        steps_along(phi, kappa, force).take(2001).step_by(30).map(|(x, _)| x).collect()
    }

    #[test]
    fn an_arc_of_young_and_laplace_is_found_and_goes_on_beyond_its_points() {
        for force in [Vec2::new(0.0, -1.5), Vec2::new(0.8, 0.4), Vec2::new(0.0, 1e-9)] {
            let points = meniscus(2.0, 0.9, force);
            let inner = &points[8..60];
            let arc = Arc::fit(inner, force, 1.0).unwrap();
            assert!(arc.middle.rms < 1e-5, "{force:?}: {:e}", arc.middle.rms);
            assert!((arc.curvature_at(Vec2::x()) - 0.9).abs() < 2e-3, "{}", arc.curvature_at(Vec2::x()));
            let back = arc.walk(inner[0], -0.24);
            assert!((back - points[0]).norm() < 1e-3, "{force:?}: {back:?}");
            let tangent = -perpendicular(arc.normal_at(back));
            assert!((tangent.y.atan2(tangent.x) - 2.0).abs() < 3e-3, "{force:?}");
        }
    }

    #[test]
    fn without_a_force_it_is_the_circle() {
        let points = meniscus(2.0, 0.9, Vec2::zeros());
        let (arc, circle) = (Arc::fit(&points, Vec2::zeros(), 1.0).unwrap(), circle::fit(&points).unwrap());
        assert_eq!(arc.middle, circle);
        assert_eq!(arc.walk(points[0], -0.3), circle.walk(points[0], -0.3));
        let almost = Arc::fit(&points, Vec2::new(0.0, 1e-9), 1.0).unwrap();
        assert!((almost.walk(points[0], -0.3) - circle.walk(points[0], -0.3)).norm() < 1e-5);
    }
}
