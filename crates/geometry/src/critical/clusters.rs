//! Critical points that coincide: in nearly regular drawings several saddles and maxima lie so close together that rounding, of coordinates in a drawing or of
//! distances here, decides which of them exist.
//!
//! Points nearer to each other than [`COINCIDENT`] times their wall distance form a cluster, and a cluster counts by its index: the number of maxima minus the
//! number of saddles within it. By the theorem of Poincaré and Hopf the index follows from the wall distance on a circle around the cluster, where it is well
//! conditioned: 1 minus the number of arcs on which the distance increases outwards. The cluster is one maximum (index 1), one saddle (−1), or no critical
//! point (0): three walls in less than half a circle. So the numbers of maxima and saddles always agree, whatever the rounding.

use crate::critical::candidates::{Triple, joined};
use crate::critical::level::{Kind, decided};
use crate::critical::maxima::{self, Maximum, largest_gap, maximum};
use crate::critical::opposite::{Opposite, slack};
use crate::critical::shift::Shift;
use crate::critical::walls::Walls;
use crate::curve::{cross, unit};
use meniscus_core::math::{Vec2, root};
use rayon::prelude::*;

/// Treatment of critical points that coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coincident {
    /// They count by the index of their cluster.
    Clusters,
    /// Each counts by its own slopes: for walls of facets shorter than the radius of a cluster.
    Points,
}

/// Critical points nearer than this fraction of their wall distance are one. Its square exceeds the rounding of distances: where three walls are equally near
/// within that, the saddle and the maximum between them are nearer than this.
pub(crate) const COINCIDENT: f64 = 1e-4;

/// Maxima whose radii differ by less than this fraction are equally large.
const AS_LARGE: f64 = 1e-9;

/// Clusters that are looked at together.
const BLOCK: usize = 1024;

/// Contacts around a maximum that leave no gap of more than half a circle minus this angle in rad: no saddle is near.
const SURROUNDS: f64 = 0.1;

/// The saddles and maxima of `opposites` off level passages, and of maxima between three walls.
pub(super) fn resolve(
    walls: &Walls,
    opposites: Vec<Opposite>,
    maxima: Vec<Maximum>,
    coincident: Coincident,
) -> (Vec<Opposite>, Vec<Maximum>) {
    let members: Vec<Member> =
        opposites.into_iter().map(Member::Opposite).chain(maxima.into_iter().map(Member::Maximum)).collect();
    let of_block = |block: &[Cluster]| {
        let mut found = (Vec::new(), Vec::new());
        for cluster in block {
            let index = if coincident == Coincident::Clusters { cluster.index(walls) } else { None };
            match index {
                Some(1..) => found.1.extend(cluster.maximum(walls)),
                Some(0) => {}
                Some(_) => found.0.extend(cluster.saddle()),
                None => cluster.undecided(walls, &mut found),
            }
        }
        found
    };
    let (saddles, maxima): (Vec<_>, Vec<_>) = clusters(walls, members).par_chunks(BLOCK).map(of_block).unzip();
    (joined(saddles), joined(maxima))
}

enum Member {
    Opposite(Opposite),
    Maximum(Maximum),
}

impl Member {
    fn center(&self) -> Vec2 {
        match self {
            Self::Opposite(at) => at.center,
            Self::Maximum(at) => at.center,
        }
    }

    fn distance(&self) -> f64 {
        match self {
            Self::Opposite(at) => at.half,
            Self::Maximum(at) => at.radius,
        }
    }
}

/// Critical points that are one.
#[derive(Default)]
struct Cluster {
    /// The positions of its members in m, periodic images side by side.
    centers: Vec<Vec2>,
    opposites: Vec<Opposite>,
    maxima: Vec<Maximum>,
}

/// The clusters, in the order of their first members.
fn clusters(walls: &Walls, members: Vec<Member>) -> Vec<Cluster> {
    let centers: Vec<Vec2> = members.iter().map(|member| walls.folded(member.center())).collect();
    let mut order: Vec<usize> = (0..members.len()).collect();
    order.par_sort_by(|&a, &b| centers[a].x.total_cmp(&centers[b].x).then(a.cmp(&b)));
    let mut parent: Vec<usize> = (0..members.len()).collect();
    for (k, &a) in order.iter().enumerate() {
        let near = COINCIDENT * members[a].distance();
        for &b in order[k + 1..].iter().take_while(|&&b| centers[b].x - centers[a].x <= near) {
            if (centers[b] - centers[a]).norm() <= near {
                let (one, other) = (root(&mut parent, a), root(&mut parent, b));
                parent[one.max(other)] = one.min(other);
            }
        }
    }
    let mut found: Vec<Cluster> = (0..members.len()).map(|_| Cluster::default()).collect();
    for (k, member) in members.into_iter().enumerate() {
        let cluster = &mut found[root(&mut parent, k)];
        cluster.centers.push(centers[k]);
        match member {
            Member::Opposite(at) => cluster.opposites.push(at),
            Member::Maximum(at) => cluster.maxima.push(at),
        }
    }
    found.retain(|cluster| !cluster.centers.is_empty());
    found
}

impl Cluster {
    /// The number of maxima minus that of saddles; `None` for a saddle or a maximum between two walls by itself, or if its surroundings are not in the domain.
    fn index(&self, walls: &Walls) -> Option<i32> {
        let gaps = || self.maxima.iter().map(largest_gap);
        if gaps().any(|gap| gap < std::f64::consts::PI - SURROUNDS) {
            return Some(1);
        }
        let is_doubtful = match (&self.opposites[..], &self.maxima[..]) {
            ([at], []) => has_third_wall(walls, at),
            ([], [at]) => largest_gap(at) > std::f64::consts::PI - 8.0 * COINCIDENT,
            _ => true,
        };
        if !is_doubtful {
            return if self.maxima.is_empty() { None } else { Some(1) };
        }
        let center = self.centers.iter().sum::<Vec2>() / self.centers.len() as f64;
        let distance = walls.distance(center);
        let extent = self.centers.iter().map(|x| (x - center).norm()).fold(0.0, f64::max);
        let radius = extent + 0.5 * COINCIDENT * distance;
        let is_within = (0..2).all(|i| {
            walls.periodic[i] || center[i] - radius > walls.domain.min[i] && center[i] + radius < walls.domain.max[i]
        });
        is_within.then(|| 1 - rises(walls, center, radius) as i32)
    }

    /// Its maximum: the largest one, the mean of those that are equally large.
    fn maximum(&self, walls: &Walls) -> Option<Maximum> {
        let mut all = self.maxima.clone();
        if let (Some(first), true) = (self.centers.first(), self.centers.len() > 1) {
            all.extend(between_all(walls, *first));
        }
        let opposite = self.opposites.iter().max_by(|a, b| a.half.total_cmp(&b.half));
        let radius = all.iter().map(|at| at.radius).fold(0.0, f64::max);
        if radius == 0.0 {
            return opposite.map(|at| maxima::at(walls, at.center, at.half));
        }
        let largest: Vec<&Maximum> = all.iter().filter(|at| at.radius >= radius * (1.0 - AS_LARGE)).collect();
        if let [only] = largest[..] {
            return Some(only.clone());
        }
        let center = largest.iter().map(|at| walls.folded(at.center)).sum::<Vec2>() / largest.len() as f64;
        Some(maxima::at(walls, center, radius))
    }

    /// Its saddle: the narrowest, as wider ones cancel against maxima.
    fn saddle(&self) -> Option<Opposite> {
        self.opposites.iter().min_by(|a, b| a.half.total_cmp(&b.half)).copied()
    }

    /// Each member by itself.
    fn undecided(&self, walls: &Walls, found: &mut (Vec<Opposite>, Vec<Maximum>)) {
        for at in &self.opposites {
            match decided(walls, at) {
                Some(Kind::Saddle(at)) => found.0.push(at),
                Some(Kind::Maximum(at)) => found.1.push(maxima::at(walls, at.center, at.half)),
                None => {}
            }
        }
        found.1.extend(self.maxima.iter().cloned());
    }
}

/// Whether a third wall is so near to the midpoint of opposite points that the maximum between all three coincides with it.
fn has_third_wall(walls: &Walls, at: &Opposite) -> bool {
    let slack = slack(walls, at.half);
    walls.contacts(at.center, at.half * (1.0 + 2.0 * COINCIDENT) + slack).iter().any(|contact| {
        let v = contact.point - at.center;
        let distance = v.norm();
        // The center between all three lies at the excess distance over the cosine of the direction of the third.
        let ahead = cross(at.across(), v).abs() / distance;
        at.leads_elsewhere(v / distance) && distance - at.half <= 2.0 * COINCIDENT * at.half * ahead + slack
    })
}

/// Maxima between any three of the walls around a point.
fn between_all(walls: &Walls, x: Vec2) -> Vec<Maximum> {
    const MOST: usize = 8;
    let reach = walls.distance(x) * (1.0 + 4.0 * COINCIDENT);
    let mut around: Vec<(usize, Shift)> = walls.contacts(x, reach).iter().map(|at| (at.wall, at.shift)).collect();
    around.dedup();
    if around.len() > MOST {
        return Vec::new();
    }
    let mut found = Vec::new();
    for a in 0..around.len() {
        for b in a + 1..around.len() {
            for c in b + 1..around.len() {
                let of = [around[a], around[b], around[c]];
                found.extend(maximum(walls, &Triple { walls: of, ends: [None; 3], start: x }));
            }
        }
    }
    let near = |at: &Maximum| (walls.folded(at.center) - walls.folded(x)).norm() <= 4.0 * COINCIDENT * at.radius;
    found.retain(near);
    found
}

/// The number of arcs of a circle on which the wall distance increases outwards.
fn rises(walls: &Walls, center: Vec2, radius: f64) -> usize {
    const SAMPLES: usize = 24;
    // Below this outward slope at the samples beside it, the slope between two samples is negative.
    const STEEP: f64 = -0.5;
    // The angle between two samples is halved to its last digit.
    const HALVINGS: usize = 50;
    // The outward slope of the distance at an angle, and the side on which the nearest wall lies.
    let slope = |angle: f64| {
        let u = unit(angle);
        let x = center + u * radius;
        let v = walls.nearest(x).map_or_else(Vec2::zeros, |(_, contact)| contact.point - x).normalize();
        (-u.dot(&v), cross(u, v) > 0.0)
    };
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / SAMPLES as f64;
    let samples: Vec<(f64, bool)> = (0..SAMPLES).map(|k| slope(angle(k))).collect();
    (0..SAMPLES)
        .filter(|&k| {
            let (here, next) = (samples[k], samples[(k + 1) % SAMPLES]);
            // Between two walls, away from both.
            if here.1 || !next.1 || here.0.max(next.0) < STEEP {
                return false;
            }
            let (mut low, mut high) = (angle(k), angle(k + 1));
            let mut slopes = [here.0, next.0];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let (value, is_ahead) = slope(middle);
                if is_ahead { (high, slopes[1]) = (middle, value) } else { (low, slopes[0]) = (middle, value) }
            }
            slopes[0].min(slopes[1]) > 0.0
        })
        .count()
}
