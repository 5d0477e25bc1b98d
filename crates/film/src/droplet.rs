//! Initial droplets, h(x, 0) = 3A/(4r) (1 − ((x − c)/r)²)₊ [Pang2022, Eq. 56], and their particles. Dimensionless.

use std::f64::consts::TAU;

use meniscus_case::film::FilmWeights;

/// A parabolic droplet [Pang2022, Eq. 56].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Droplet {
    /// Cross-section ∫ h dx.
    pub area: f64,
    /// Half of the base width r.
    pub half_width: f64,
    /// Its center c.
    pub center: f64,
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
    /// Height at its center.
    pub(crate) fn peak(&self) -> f64 {
        0.75 * self.area / self.half_width
    }

    fn share(&self, x: f64) -> f64 {
        (x - self.center) / self.half_width
    }

    /// Height at x.
    pub(crate) fn height(&self, x: f64) -> f64 {
        self.peak() * (1.0 - self.share(x).powi(2)).max(0.0)
    }

    /// Mass to the left of x, ∫ h dx.
    pub(crate) fn mass_below(&self, x: f64) -> f64 {
        let share = self.share(x).clamp(-1.0, 1.0);
        self.area * (0.5 + 0.75 * share - 0.25 * share.powi(3))
    }

    /// Volume within the distance `r` of an axis through the center, ∫ h 2πr dr.
    pub fn volume_within(&self, r: f64) -> f64 {
        let share = (r / self.half_width).clamp(0.0, 1.0);
        TAU * self.peak() * self.half_width.powi(2) * (0.5 * share.powi(2) - 0.25 * share.powi(4))
    }
}

/// Particles on the nodes k Δx of a lattice through x = 0. Nodes without mass are omitted, as they would have no effect.
pub fn particles(droplets: &[Droplet], spacing: f64, rule: FilmWeights) -> PointMasses {
    let mut masses = PointMasses::default();
    let ends = |droplet: &Droplet| [droplet.center - droplet.half_width, droplet.center + droplet.half_width];
    let reach =
        droplets.iter().flat_map(ends).fold([f64::INFINITY, f64::NEG_INFINITY], |r, x| [r[0].min(x), r[1].max(x)]);
    let [first, last] = [(reach[0] / spacing).floor() as i64 - 1, (reach[1] / spacing).ceil() as i64 + 1];
    // A cell that overlaps a droplet by rounding only has no mass.
    let least = 1.0e-12 * droplets.iter().map(|droplet| droplet.area).fold(0.0, f64::max);
    for node in first..=last {
        let x = node as f64 * spacing;
        let of = |droplet: &Droplet| match rule {
            FilmWeights::Cell => droplet.mass_below(x + 0.5 * spacing) - droplet.mass_below(x - 0.5 * spacing),
            FilmWeights::Point => droplet.height(x) * spacing,
        };
        let weight: f64 = droplets.iter().map(of).sum();
        if weight > least {
            masses.x.push(x);
            masses.weight.push(weight);
        }
    }
    masses
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_hold_all_of_the_mass_and_points_as_much_as_their_rule_says() {
        let droplet = Droplet { area: 0.25, half_width: 0.5, center: 0.0 };
        let mass = |rule| particles(&[droplet], 0.005, rule).weight.iter().sum::<f64>();
        assert!((mass(FilmWeights::Cell) - 0.25).abs() < 1.0e-14);
        assert!((mass(FilmWeights::Point) - 0.25 * (1.0 - 0.005_f64.powi(2))).abs() < 1.0e-14);
        let count = |rule| particles(&[droplet], 0.005, rule).x.len();
        assert_eq!((count(FilmWeights::Cell), count(FilmWeights::Point)), (201, 199));
    }

    #[test]
    fn two_droplets_have_the_particles_of_both() {
        let droplets = [-0.8, 0.71].map(|center| Droplet { area: 0.25, half_width: 0.5, center });
        let masses = particles(&droplets, 0.01, FilmWeights::Cell);
        assert!((masses.weight.iter().sum::<f64>() - 0.5).abs() < 1.0e-14);
        assert!(masses.x.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(!masses.x.iter().any(|x| (-0.29..=0.2).contains(x)));
    }

    #[test]
    fn a_droplet_about_an_axis_has_half_the_volume_of_its_cylinder() {
        let droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };
        let cylinder = std::f64::consts::PI * 0.25 * droplet.peak();
        assert!((droplet.volume_within(3.0) - 0.5 * cylinder).abs() < 1.0e-14);
        let thin = 1.0e-6;
        let ring = droplet.volume_within(0.3 + thin) - droplet.volume_within(0.3 - thin);
        assert!((ring / (2.0 * thin) - TAU * 0.3 * droplet.height(0.3)).abs() < 1.0e-8);
    }
}
