//! Menisci that have met on the walls between them: one meniscus between the outer walls, its event, and others that it meets in turn.
//!
//! Left out: a meniscus that forms beside two that have merged before meets the nearer of them as if that were alone.

use super::fronts::Neighbor;
use super::mesh::{FrontId, Mesh};
use super::progress::Displacement;
use super::walls::is_same;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Hand, Passage, overlap};

/// Neighboring menisci that have met, from left to right.
pub(super) struct Merged {
    /// Each with the shift in m from its frame to that of the first two.
    members: Vec<(FrontId, Vec2)>,
    /// The elements ahead of them.
    pub(super) passed: Vec<usize>,
    /// Whether it closes upon itself, around a grain or a periodic domain, so that no walls hold it.
    is_closed: bool,
}

impl Merged {
    /// A meniscus and the neighbor that it has met.
    pub(super) fn of(front: FrontId, hand: Hand, neighbor: &Neighbor) -> Self {
        let mut merged = Self { members: vec![(front, Vec2::zeros())], passed: Vec::new(), is_closed: false };
        merged.meet(hand, neighbor);
        merged
    }

    /// The outermost meniscus on a side.
    fn end(&self, hand: Hand) -> (FrontId, Vec2) {
        if hand == Hand::Left { self.members[0] } else { self.members[self.members.len() - 1] }
    }

    /// It meets its next neighbor on a side.
    fn meet(&mut self, hand: Hand, neighbor: &Neighbor) {
        let ahead = neighbor.passed.iter().filter(|element| !self.passed.contains(element)).copied();
        let ahead: Vec<usize> = ahead.collect();
        self.passed.extend(ahead);
        if self.members.iter().any(|(front, _)| *front == neighbor.front) {
            self.is_closed = true;
            return;
        }
        let offset = self.end(hand).1 + neighbor.offset;
        let place = if hand == Hand::Left { 0 } else { self.members.len() };
        self.members.insert(place, (neighbor.front, offset));
    }
}

impl Displacement {
    /// The event of the meniscus into which two neighbors merge that have met at an applied curvature in 1/m: its curvature, and the elements that it fills.
    ///
    /// It bursts or touches a wall between the outer walls of both \[CieplakRobbins1988\], or meets its own neighbors first, which extend it. Within one element,
    /// or where it closes upon itself, it advances at once.
    pub(super) fn merged_event(
        &self,
        mesh: &Mesh,
        (front, hand): (FrontId, Hand),
        neighbor: &Neighbor,
        met: f64,
    ) -> (f64, Vec<usize>) {
        let mut merged = Merged::of(front, hand, neighbor);
        let mut reached = met;
        loop {
            if merged.passed.len() < 2 || merged.is_closed {
                return (reached, merged.passed);
            }
            let (passage, obstacles) = self.merged_passage(mesh, &merged);
            let burst = passage.burst().map_or(f64::NEG_INFINITY, |meniscus| meniscus.curvature);
            let own = passage.touch(&obstacles, burst).unwrap_or(burst);
            let head = self.head_between(mesh, self.outer(&merged));
            let event = head.applied(own);
            if event <= reached {
                return (reached, merged.passed);
            }
            let meetings: Vec<(Hand, Neighbor, f64)> = [Hand::Left, Hand::Right]
                .into_iter()
                .filter_map(|hand| self.meets(mesh, &merged, hand, (&passage, event)))
                .collect();
            let next = meetings.iter().map(|(.., curvature)| *curvature).fold(event, f64::min);
            if next >= event {
                return (event, merged.passed);
            }
            reached = reached.max(next);
            // Rounding error relative to the curvature, or to the inverse of the wall between, as of simultaneous events.
            let shared = meetings.iter().map(|(_, neighbor, _)| neighbor.shared).fold(f64::INFINITY, f64::min);
            let rounding = 1e-9 * reached.abs().max(1.0 / shared);
            for (hand, neighbor, _) in meetings.iter().filter(|(.., curvature)| *curvature <= reached + rounding) {
                merged.meet(*hand, neighbor);
            }
        }
    }

    /// The next neighbor of a merged meniscus on a side, and the applied curvature in 1/m, below its event, at which they meet.
    fn meets(
        &self,
        mesh: &Mesh,
        merged: &Merged,
        hand: Hand,
        (passage, event): (&Passage, f64),
    ) -> Option<(Hand, Neighbor, f64)> {
        let (end, offset) = merged.end(hand);
        let neighbor = self.neighbor(mesh, end, hand)?;
        let (other, to) = neighbor.front;
        let front = self.fronts[other][to].as_ref()?;
        let facing = self.passage(mesh, neighbor.front, offset + neighbor.offset).0;
        let here = (passage, self.head_between(mesh, self.outer(merged)));
        let there = (&facing, self.head(mesh, other));
        let up_to = event.min(there.1.applied(front.own));
        let (a, b) = if hand == Hand::Left { (here, there) } else { (there, here) };
        let curvature = overlap(a, b, neighbor.shared, up_to)?;
        Some((hand, neighbor, curvature))
    }

    /// The outermost gates of a merged meniscus.
    fn outer(&self, merged: &Merged) -> [usize; 2] {
        [merged.end(Hand::Left).0.0, merged.end(Hand::Right).0.0]
    }

    /// The passage of a merged meniscus, and the walls ahead of it.
    pub(super) fn merged_passage(&self, mesh: &Mesh, merged: &Merged) -> (Passage, Vec<Curve>) {
        let all: Vec<(Passage, Vec<Curve>)> =
            merged.members.iter().map(|&(front, offset)| self.passage(mesh, front, offset)).collect();
        let last = all.len() - 1;
        let (left, right) = (all[0].0.left(), all[last].0.right());
        let between = all.iter().enumerate().flat_map(|(k, (passage, _))| {
            let walls = [(k > 0).then(|| passage.left()), (k < last).then(|| passage.right())];
            walls.into_iter().flatten()
        });
        // The wall on which two of them met is not ahead of the others.
        let inner: Vec<_> = if last > 1 { between.flat_map(|wall| &wall.parts).collect() } else { Vec::new() };
        let own = |curve: &Curve| {
            let mut parts = left.parts.iter().chain(&right.parts).chain(inner.iter().copied());
            parts.any(|part| part.curve == *curve || is_same(&part.curve, curve))
        };
        let obstacles = all.iter().flat_map(|(_, obstacles)| obstacles).filter(|curve| !own(curve)).copied().collect();
        (Passage::new(left.clone(), right.clone()), obstacles)
    }
}
