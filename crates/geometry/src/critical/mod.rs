//! Critical points of the wall distance: its saddles, which are throats, and its maxima, which are pores.
//!
//! A point of the pore space is critical if it lies in the convex hull of its nearest wall points \[Lieutier2004\]. `walls` holds the walls as chains,
//! `candidates` finds facing ones, `opposite` the points between two walls, `slope` distinguishes saddles from maxima, `level` joins sections of constant
//! distance, `maxima` finds points between three walls, `clusters` counts those that coincide.

pub mod candidates;
pub mod clusters;
mod joints;
pub(crate) mod level;
pub(crate) mod maxima;
pub mod opposite;
pub mod shift;
pub mod slope;
pub mod walls;

use crate::critical::candidates::{Pair, Samples, candidates, pair, sorted};
use crate::critical::clusters::Coincident;
use crate::critical::level::{Classifier, Kind, Passage, slopes};
use crate::critical::maxima::{Maximum, between_three, center_of_arc, is_maximum, parallel_walls};
use crate::critical::opposite::{Opposite, TIE, opposite_points};
use crate::critical::shift::minus;
use crate::critical::slope::{Slope, is_opening};
use crate::critical::walls::{Contact, Walls};
use meniscus_core::math::Vec2;
use rayon::prelude::*;

/// Critical points nearer than this fraction of their wall distance coincide.
const SAME_PLACE: f64 = 4.0 * TIE;

/// The critical points within the domain.
pub struct CriticalPoints {
    /// Saddles: the throats.
    pub saddles: Vec<Opposite>,
    /// Maxima: the pores.
    pub maxima: Vec<Maximum>,
}

impl CriticalPoints {
    /// The critical points of the distance from `walls`; `density` multiplies the samples on each piece, `further` are pairs to look at besides
    /// those that the samples offer.
    pub(crate) fn find(walls: &Walls, density: &[f64], further: &[Pair], coincident: Coincident) -> Self {
        Unresolved::of_samples(walls, &Samples::new(walls, density), further).resolved(walls, coincident)
    }
}

/// The critical points within the domain, with those that coincide.
pub struct Unresolved {
    saddles: Vec<Opposite>,
    maxima: Vec<Maximum>,
    /// Points between two walls off level passages, and between three walls.
    isolated: (Vec<Opposite>, Vec<Maximum>),
}

impl Unresolved {
    /// Those that samples of the walls offer; `further` are pairs to look at besides.
    pub fn of_samples(walls: &Walls, samples: &Samples, further: &[Pair]) -> Self {
        let (mut pairs, triples) = candidates(walls, samples);
        pairs.extend(further);
        let between: Vec<(Maximum, bool)> = (triples.par_iter())
            .filter_map(|triple| between_three(walls, triple))
            .map(|at| {
                let is_maximum = is_maximum(walls, &at);
                (at, is_maximum)
            })
            .collect();
        let (mut maxima, mut others) = (Vec::new(), Vec::new());
        between.into_iter().for_each(|(at, is_maximum)| if is_maximum { maxima.push(at) } else { others.push(at) });
        // A short level passage is found from its ends.
        pairs.extend(others.iter().filter_map(|at| {
            let [a, b] = parallel_walls(walls, at)?.map(|contact| (contact.wall, contact.shift));
            pair(walls, a, b, at.center)
        }));
        maxima.extend((0..walls.walls.len()).filter_map(|wall| center_of_arc(walls, wall)));
        Self::of_pairs(walls, &sorted(pairs), one_of_each(maxima, maximum_key(walls)))
    }

    /// Adds those that samples of some of the walls offer.
    pub fn add(&mut self, walls: &Walls, samples: &Samples) {
        let more = Self::of_samples(walls, samples, &[]);
        // Those found twice go when they are resolved.
        self.saddles.extend(more.saddles);
        self.maxima.extend(more.maxima);
        let (isolated, maxima) = &mut self.isolated;
        isolated.extend(more.isolated.0);
        maxima.extend(more.isolated.1);
        *isolated = one_of_each(std::mem::take(isolated), opposite_key(walls));
        *maxima = one_of_each(std::mem::take(maxima), maximum_key(walls));
    }

    /// The saddles and maxima between pairs of walls, and the maxima between three.
    fn of_pairs(walls: &Walls, pairs: &[Pair], maxima: Vec<Maximum>) -> Self {
        let of_pair = |(k, pair): (usize, &Pair)| {
            let is_first = k == 0 || (pairs[k - 1].walls, pairs[k - 1].shift) != (pair.walls, pair.shift);
            opposite_points(walls, pair, is_first).into_iter().map(|at| in_cell(walls, at))
        };
        let found: Vec<Opposite> = pairs.par_iter().enumerate().flat_map_iter(of_pair).collect();
        let found = one_of_each(found, opposite_key(walls));
        let slopes: Vec<[Slope; 2]> = found.par_iter().map(|at| slopes(walls, at)).collect();
        let mut classifier = Classifier::default();
        let mut isolated = Vec::new();
        let (mut saddles, mut between) = (Vec::new(), Vec::new());
        for (at, slopes) in found.iter().zip(&slopes) {
            match classifier.classify(walls, at, slopes) {
                Passage::Point => isolated.push(*at),
                Passage::Level(kinds) => {
                    for kind in kinds {
                        match kind {
                            Kind::Saddle(at) => saddles.push(at),
                            Kind::Maximum(at) => between.push(maxima::at(walls, at.center, at.half)),
                        }
                    }
                }
            }
        }
        Self { saddles, maxima: between, isolated: (isolated, maxima) }
    }

    /// The critical points, with a treatment of those that coincide.
    pub fn resolved(&self, walls: &Walls, coincident: Coincident) -> CriticalPoints {
        let (isolated, maxima) = self.isolated.clone();
        let (more, maxima) = clusters::resolve(walls, isolated, maxima, coincident);
        let saddles = self.saddles.iter().copied().chain(more).filter(|at| !is_opening(walls, at));
        let saddles = saddles.map(|at| in_cell(walls, at)).collect();
        let maxima = self.maxima.iter().cloned().chain(maxima).collect();
        CriticalPoints {
            saddles: one_of_each(saddles, opposite_key(walls)),
            maxima: one_of_each(maxima, maximum_key(walls)),
        }
    }
}

/// The position of opposite points, and half their distance.
fn opposite_key(walls: &Walls) -> impl Fn(&Opposite) -> (Vec2, f64) + Sync + '_ {
    |at| (walls.folded(at.center), at.half)
}

/// The position and the wall distance of a maximum.
fn maximum_key(walls: &Walls) -> impl Fn(&Maximum) -> (Vec2, f64) + Sync + '_ {
    |maximum| (walls.folded(maximum.center), maximum.radius)
}

/// The same with its midpoint in the half-open cell.
fn in_cell(walls: &Walls, at: Opposite) -> Opposite {
    let (center, shift) = walls.wrapped(at.center);
    let back = walls.offset(shift);
    let moved = |c: Contact| Contact { shift: minus(c.shift, shift), point: c.point - back, ..c };
    Opposite { contacts: at.contacts.map(moved), center, half: at.half }
}

/// The items with distinct centers, sorted by these; of coincident ones the largest.
fn one_of_each<T: Send>(mut found: Vec<T>, key: impl Fn(&T) -> (Vec2, f64) + Sync) -> Vec<T> {
    // Along this direction, the many candidates of a slit along an axis are apart.
    let along = |thing: &T| key(thing).0.dot(&Vec2::new(0.825_335_614_909_678, 0.564_642_473_395_035));
    let by_center = |a: &T, b: &T| {
        let (p, q) = (key(a), key(b));
        p.0.x.total_cmp(&q.0.x).then(p.0.y.total_cmp(&q.0.y)).then(p.1.total_cmp(&q.1))
    };
    found.par_sort_by(|a, b| along(a).total_cmp(&along(b)).then(by_center(a, b)));
    let mut kept: Vec<T> = Vec::new();
    for thing in found {
        let (x, size) = key(&thing);
        let near = SAME_PLACE * size;
        let mut known = kept.iter_mut().rev().take_while(|other| along(&thing) - along(other) <= near);
        match known.find(|other| (x - key(other).0).norm() <= near) {
            Some(other) if key(other).1 < size => *other = thing,
            Some(_) => {}
            None => kept.push(thing),
        }
    }
    kept.par_sort_by(by_center);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Geometry;
    use crate::critical::walls::Sides;
    use crate::spec::{Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};

    /// Reproducible pseudorandom numbers.
    fn noise(k: usize) -> f64 {
        (f64::from(k as u32) * 0.754_877_666_246_69 + 0.5 * (f64::from(k as u32) * 0.569_840_290_998).fract()).fract()
    }

    /// All pairs of pieces and images, independent of the samples.
    fn all_pairs(walls: &Walls) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let images = |i: usize| if walls.periodic[i] { -1..=1 } else { 0..=0 };
        for a in 0..walls.walls.len() {
            for b in a..walls.walls.len() {
                for shift in images(0).flat_map(|dx| images(1).map(move |dy| [dx, dy])) {
                    if a != b || shift < [0, 0] {
                        let between = 0.5 * (walls.walls[a].curve.point(0.5) + walls.curve(b, shift).point(0.5));
                        pairs.push(Pair { walls: [a, b], shift, between });
                    }
                }
            }
        }
        pairs
    }

    #[test]
    fn samples_miss_no_saddle_that_all_pairs_of_pieces_have() {
        for scene in 0..40 {
            let shapes: Vec<ShapeSpec> = (0..14)
                .map(|k| {
                    let [x, y, r, turn] = [0, 1, 2, 3].map(|i| noise(1 + 56 * scene + 4 * k + i));
                    let center = [6.0 * x, 6.0 * y];
                    if k % 3 == 0 {
                        let corner = |i: usize| {
                            let angle = turn + std::f64::consts::TAU * (i as f64 + 0.6 * noise(i + k)) / 5.0;
                            [0.7 * (0.3 + r) * angle.cos(), 0.7 * (0.3 + r) * angle.sin()]
                        };
                        let outer = (0..5).map(corner).collect();
                        ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: center, rotation_deg: 0.0 })
                    } else {
                        ShapeSpec::Disc(Disc { center, radius: 0.2 + 0.5 * r })
                    }
                })
                .collect();
            let spec = GeometrySpec { min: [0.0; 2], max: [6.0; 2], solid: SolidSide::Inside, shapes };
            let geometry = Geometry::new(&spec).unwrap();
            for (periodic, sides) in [([false; 2], Sides::Cut), ([false; 2], Sides::Beyond), ([true; 2], Sides::Cut)] {
                let geometry = geometry.clone().with_periodic(periodic);
                let walls = Walls::new(&geometry, sides);
                let found =
                    CriticalPoints::find(&walls, &vec![1.0; walls.walls.len()], &[], Coincident::Clusters).saddles;
                let expected = Unresolved::of_pairs(&walls, &all_pairs(&walls), Vec::new());
                let expected = expected.resolved(&walls, Coincident::Clusters).saddles;
                assert_eq!(found.len(), expected.len(), "scene {scene} {periodic:?} {sides:?}");
                for (a, b) in found.iter().zip(&expected) {
                    assert!((a.center - b.center).norm() < 1e-12 && (a.half - b.half).abs() < 1e-12);
                }
            }
        }
    }
}
