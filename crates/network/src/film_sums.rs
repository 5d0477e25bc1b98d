//! The volume of all corner films at any pressure, without a look at each of them.
//!
//! Films that follow the pressure have the radius 1/c at the curvature c = (p_n - p_w)/σ, at most their largest one, and a volume proportional to its square.
//! In the order of their largest radii those that are not limited come first, so that their sum is that of a part of the order. A tree of sums gives it, and
//! takes a change of one film, in a time that grows with the logarithm of their number; its sums do not depend on the changes before.

use std::ops::Range;

/// A sum over films: m² at their largest radii, m² at a radius of 1 m, and m² of those that keep their pressure.
type Sum = [f64; 3];

/// Films in the order of the curvatures from which they are thinner than their largest radius.
#[derive(Debug, Clone)]
pub(super) struct FilmSums {
    /// These curvatures in 1/m.
    limits: Vec<f64>,
    /// The place of each film in the order.
    place: Vec<u32>,
    /// The sum of both children at each node, the root at 1; the films are the second half.
    tree: Vec<Sum>,
}

impl FilmSums {
    /// Films of these largest radii in m, none of which exists.
    pub(super) fn of(largest: &[f64]) -> Self {
        let mut order: Vec<u32> = (0..largest.len() as u32).collect();
        order.sort_by(|&a, &b| largest[b as usize].total_cmp(&largest[a as usize]).then(a.cmp(&b)));
        let mut place = vec![0; order.len()];
        (0..).zip(&order).for_each(|(at, &film)| place[film as usize] = at);
        let limits = order.iter().map(|&film| 1.0 / largest[film as usize]).collect();
        Self { limits, place, tree: vec![Sum::default(); 2 * order.len()] }
    }

    /// Sets a film that follows the pressure, with a volume over the depth in m² at a radius of 1 m; zero for none.
    pub(super) fn set_free(&mut self, film: usize, unit: f64) {
        let limit = self.limits[self.place[film] as usize];
        self.set(film, if unit > 0.0 { [unit / (limit * limit), unit, 0.0] } else { Sum::default() });
    }

    /// Sets a film that keeps its pressure, with its volume over the depth in m².
    pub(super) fn set_kept(&mut self, film: usize, area: f64) {
        self.set(film, [0.0, 0.0, area]);
    }

    fn set(&mut self, film: usize, value: Sum) {
        let mut node = self.limits.len() + self.place[film] as usize;
        self.tree[node] = value;
        while node > 1 {
            node /= 2;
            self.tree[node] = plus(self.tree[2 * node], self.tree[2 * node + 1]);
        }
    }

    /// The volume over the depth in m² of all films at a curvature in 1/m.
    pub(super) fn at(&self, curvature: f64) -> f64 {
        let count = self.limits.len();
        let thinner = self.limits.partition_point(|&limit| limit < curvature);
        let [_, thin, kept] = self.sum(0..thinner);
        let [limited, _, kept_of_limited] = self.sum(thinner..count);
        let following = if thinner > 0 { thin / (curvature * curvature) } else { 0.0 };
        following + limited + (kept + kept_of_limited)
    }

    /// The sum over a range of places.
    fn sum(&self, places: Range<usize>) -> Sum {
        let count = self.limits.len();
        let (mut from, mut to) = (places.start + count, places.end + count);
        let mut sum = Sum::default();
        while from < to {
            if from % 2 == 1 {
                sum = plus(sum, self.tree[from]);
                from += 1;
            }
            if to % 2 == 1 {
                to -= 1;
                sum = plus(sum, self.tree[to]);
            }
            (from, to) = (from / 2, to / 2);
        }
        sum
    }
}

fn plus(a: Sum, b: Sum) -> Sum {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_of_any_state_have_the_sum_of_each_at_every_pressure() {
        let noise = |k: usize| (k as f64 * 0.754_877_666_246_69).fract();
        for count in [1, 2, 7, 100] {
            let largest: Vec<f64> = (0..count).map(|k| 0.1 + noise(k)).collect();
            let mut sums = FilmSums::of(&largest);
            let mut films = vec![(0.0, 0.0); count];
            for change in 0..5 * count {
                let film = (noise(3 * change + 1) * count as f64) as usize;
                if change % 3 == 0 {
                    films[film] = (0.0, noise(change));
                    sums.set_kept(film, noise(change));
                } else {
                    films[film] = (noise(change), 0.0);
                    sums.set_free(film, noise(change));
                }
                for curvature in [f64::NEG_INFINITY, -1.0, 0.0, 0.5, 1.0 / largest[film], 3.0, 40.0, f64::INFINITY] {
                    let radius = |film: usize| {
                        if curvature > 0.0 { (1.0 / curvature).min(largest[film]) } else { largest[film] }
                    };
                    let each = films.iter().enumerate().map(|(film, (unit, kept))| unit * radius(film).powi(2) + kept);
                    let (expected, found): (f64, f64) = (each.sum(), sums.at(curvature));
                    assert!((found - expected).abs() <= 1.5e-15 * expected, "{count} {curvature}: {found} {expected}");
                }
            }
        }
    }
}
