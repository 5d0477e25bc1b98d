//! The initial droplet, h(x, 0) = 3A/(4r) (1 − (x/r)²)₊ [Pang2022, Eq. 56], and its particles. Dimensionless.

/// A parabolic droplet about x = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Droplet {
    /// Cross-section ∫ h dx.
    pub area: f64,
    /// Half of the base width r.
    pub half_width: f64,
}

/// How the mass of the droplet is given to particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WeightRule {
    /// Each particle holds the film of its cell of width Δx: the mass is exact.
    Cell,
    /// Each particle holds h(xᵢ) Δx: the mass is A (1 − (Δx/2r)²).
    Point,
}

/// Point masses on the wall: h = Σ wᵢ δ(x − xᵢ).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PointMasses {
    /// Positions, ascending.
    pub x: Vec<f64>,
    /// Weights, above 0.
    pub weight: Vec<f64>,
}

impl Droplet {
    /// Height at x.
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        let share = x / self.half_width;
        0.75 * self.area / self.half_width * (1.0 - share * share).max(0.0)
    }

    /// Mass to the left of x.
    fn mass_below(&self, x: f64) -> f64 {
        let share = (x / self.half_width).clamp(-1.0, 1.0);
        self.area * (0.5 + 0.75 * share - 0.25 * share.powi(3))
    }

    /// Particles on the nodes k Δx of a lattice through x = 0. Nodes without mass are left out: they would move nothing.
    #[must_use]
    pub fn particles(&self, spacing: f64, rule: WeightRule) -> PointMasses {
        let reach = (self.half_width / spacing).ceil() as i64 + 1;
        // A cell that the droplet touches by rounding only has no mass.
        let least = 1.0e-12 * self.area;
        let mut masses = PointMasses::default();
        for node in -reach..=reach {
            let x = node as f64 * spacing;
            let weight = match rule {
                WeightRule::Cell => self.mass_below(x + 0.5 * spacing) - self.mass_below(x - 0.5 * spacing),
                WeightRule::Point => self.height(x) * spacing,
            };
            if weight > least {
                masses.x.push(x);
                masses.weight.push(weight);
            }
        }
        masses
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_hold_all_of_the_mass_and_points_as_much_as_their_rule_says() {
        let droplet = Droplet { area: 0.25, half_width: 0.5 };
        let mass = |rule| droplet.particles(0.005, rule).weight.iter().sum::<f64>();
        assert!((mass(WeightRule::Cell) - 0.25).abs() < 1.0e-14);
        assert!((mass(WeightRule::Point) - 0.25 * (1.0 - 0.005_f64.powi(2))).abs() < 1.0e-14);
        let count = |rule| droplet.particles(0.005, rule).x.len();
        assert_eq!((count(WeightRule::Cell), count(WeightRule::Point)), (201, 199));
    }
}
