//! Contact lines tracked from step to step: position, speed and pinning.
//!
//! **Speed.** An interface that moves along a wall with the speed U has the normal velocity v·n = U ν·n at every height, ν along the wall
//! towards the non-wetting phase and n into the wetting one. So U = Σ w v·n/Σ w ν·n over the interface within the stencil of a fit,
//! relative to the wall: a mean over a dozen points, independent of the flow along the interface. Noise must not feed back
//! through a law θ(U), so the state of each line has the mean over the time τ = √(ρ̄h³/σ) + μh/σ, the response time of an
//! interface of size h to a change of its angle.
//!
//! **Position.** A line of a model with pinning has an anchor, a point of the wall. The circle fit passes through it, with free angle.
//! If this angle is within the hysteresis range, it is imposed: a line that has left its anchor is pulled back. Otherwise the angle is
//! the bound of the range, and the anchor moves to where the fit with that angle meets the wall.

use serde::{Deserialize, Serialize};

use crate::domain::Domain;
use meniscus_core::math::Vec2;
use meniscus_wetting::Wetting;
use meniscus_wetting::law::LineState;

/// Search radius of a line around its previous position, over h: more than it moves in a step, less than the distance between lines.
const SAME_LINE: f64 = 1.5;

/// An undetected line is kept for this many times τ, so that a moment without a fit does not lose its anchor.
const KEPT: f64 = 5.0;

/// A point at a wall belongs to a contact line within this distance over h: the constrained fit extends 3h along the interface.
pub(crate) const LINE_REACH: f64 = 4.0;

/// A contact line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrackedLine {
    /// Intersection of interface and wall, in m.
    pub position: Vec2,
    /// ν_ns: unit vector along the wall from the wetting to the other phase.
    pub outward: Vec2,
    /// Speed U in m/s relative to the wall along ν_ns, a mean over τ.
    pub speed: f64,
    /// The imposed contact angle in rad.
    pub angle: f64,
    /// The point of the wall in m at which a model with pinning holds the line.
    pub anchor: Vec2,
    /// Displacement in m along ν_ns since the line was first detected.
    pub travel: f64,
    /// Time in s since the line was last detected.
    pub undetected: f64,
}

/// The direction along the wall in which the lines have moved by at least `distance` (m) on average; `None` before.
pub(crate) fn gone(lines: &[TrackedLine], distance: f64) -> Option<Vec2> {
    let along = lines.first()?.outward;
    let displacements = lines.iter().map(|line| line.travel * line.outward.dot(&along));
    let mean = displacements.sum::<f64>() / lines.len() as f64;
    (mean.abs() >= distance).then(|| mean.signum() * along)
}

/// A contact line detected from the interface at one time.
pub trait DetectedLine {
    /// Approximate position of the line, a point of the wall in m.
    fn position(&self) -> Vec2;
    /// ν_ns.
    fn outward(&self) -> Vec2;
    /// Speed in m/s along ν_ns, not relative to the wall.
    fn speed(&self) -> f64;
    /// Angle in rad of the interface through the point `anchor` (m) of the wall; without one through the position of the line.
    fn present(&self, anchor: Option<Vec2>) -> f64;
    /// Intersection in m of interface and wall, given the contact angle (rad).
    fn intersection(&self, angle: f64) -> Vec2;
}

/// Tracker of contact lines, with properties of the flow and the wall.
pub struct ContactLineTracker<'a> {
    /// Box and sides.
    pub domain: &'a Domain,
    /// The wetting model at a point of the wall.
    pub model: &'a (dyn Fn(Vec2) -> Wetting + Sync + 'a),
    /// Velocity of the wall at a point in m/s.
    pub wall_velocity: &'a (dyn Fn(Vec2) -> Vec2 + Sync + 'a),
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Dynamic viscosity of the wetting phase in Pa s.
    pub viscosity: f64,
    /// Dynamic viscosity of the other phase in Pa s.
    pub other_viscosity: f64,
    /// Slip length in m of walls near lines.
    pub slip_length: f64,
    /// Smoothing length h in m.
    pub h: f64,
    /// τ in s.
    pub mean_over: f64,
}

impl ContactLineTracker<'_> {
    /// The present lines, from those of the previous step, `dt` (s) ago, and the detected ones, which come first, in order \[Dussan1979\].
    pub fn track(&self, before: &[TrackedLine], detected_lines: &[impl DetectedLine], dt: f64) -> Vec<TrackedLine> {
        let moved: Vec<TrackedLine> = before.iter().map(|line| self.carried(line, dt)).collect();
        let known = self.matches(&moved, detected_lines);
        let mut lines: Vec<TrackedLine> = detected_lines
            .iter()
            .zip(&known)
            .map(|(detected, known)| self.update(detected, known.map(|i| moved[i]), dt))
            .collect();
        let lost = |i: &usize| !known.contains(&Some(*i)) && moved[*i].undetected + dt < KEPT * self.mean_over;
        lines.extend(
            (0..moved.len()).filter(lost).map(|i| TrackedLine { undetected: moved[i].undetected + dt, ..moved[i] }),
        );
        lines
    }

    /// The line advected with its wall for `dt` (s).
    fn carried(&self, line: &TrackedLine, dt: f64) -> TrackedLine {
        let by = dt * (self.wall_velocity)(line.anchor);
        TrackedLine { anchor: self.domain.wrapped(line.anchor + by), ..*line }
    }

    /// For each detected line the tracked line that it continues, closest pairs first.
    fn matches(&self, lines: &[TrackedLine], detected_lines: &[impl DetectedLine]) -> Vec<Option<usize>> {
        let mut near = Vec::new();
        for (s, detected) in detected_lines.iter().enumerate() {
            for (i, line) in lines.iter().enumerate() {
                let distance = self.domain.separation(detected.position(), line.position).norm();
                if distance < SAME_LINE * self.h && detected.outward().dot(&line.outward) > 0.0 {
                    near.push((distance, s, i));
                }
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let (mut found, mut taken) = (vec![None; detected_lines.len()], vec![false; lines.len()]);
        for (_, s, i) in near {
            if found[s].is_none() && !taken[i] {
                (found[s], taken[i]) = (Some(i), true);
            }
        }
        found
    }

    fn update(&self, detected: &impl DetectedLine, known: Option<TrackedLine>, dt: f64) -> TrackedLine {
        let (position, outward) = (detected.position(), detected.outward());
        let speed = detected.speed() - (self.wall_velocity)(position).dot(&outward);
        let speed = match known {
            Some(line) => line.speed + (speed - line.speed) * (1.0 - (-dt / self.mean_over).exp()),
            None => speed,
        };
        let model = (self.model)(position);
        let anchor = known.map(|line| line.anchor).filter(|_| model.pins());
        let present = detected.present(anchor);
        let state = LineState {
            present,
            speed,
            tension: self.tension,
            viscosity: self.viscosity,
            other_viscosity: self.other_viscosity,
            length: self.h,
            slip_length: self.slip_length,
        };
        let angle = model.angle(&state);
        let is_pinned = model.pins() && angle == present;
        let position = match anchor {
            Some(anchor) if is_pinned => anchor,
            _ => self.domain.wrapped(detected.intersection(angle)),
        };
        let moved = |line: TrackedLine| line.travel + self.domain.separation(position, line.position).dot(&outward);
        let travel = known.map_or(0.0, moved);
        TrackedLine { position, outward, speed, angle, anchor: position, travel, undetected: 0.0 }
    }
}

/// The line to which a point (m) at the wall belongs: the nearest one with the same side within `reach` (m).
pub fn nearest<'l>(
    lines: &'l [TrackedLine],
    domain: &Domain,
    position: Vec2,
    outward: Vec2,
    reach: f64,
) -> Option<&'l TrackedLine> {
    let distance = |line: &&TrackedLine| domain.separation(position, line.position).norm();
    lines
        .iter()
        .filter(|line| line.outward.dot(&outward) > 0.0 && distance(line) < reach)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Bounds;
    use meniscus_wetting::{Hysteresis, Young};

    const H: f64 = 0.1;

    /// A straight interface over the floor y = 0 that meets it at x with an angle, and moves.
    struct Straight {
        x: f64,
        angle: f64,
        speed: f64,
    }

    impl DetectedLine for Straight {
        fn position(&self) -> Vec2 {
            Vec2::new(self.x, 0.0)
        }
        fn outward(&self) -> Vec2 {
            Vec2::x()
        }
        fn speed(&self) -> f64 {
            self.speed
        }
        fn present(&self, anchor: Option<Vec2>) -> f64 {
            // Through the anchor and the point of the interface at the height h.
            anchor.map_or(self.angle, |anchor| H.atan2(anchor.x - self.x + H / self.angle.tan()))
        }
        fn intersection(&self, angle: f64) -> Vec2 {
            Vec2::new(self.x - H / self.angle.tan() + H / angle.tan(), 0.0)
        }
    }

    /// A straight interface that meets the floor at `x` with an angle in degrees.
    fn at(x: f64, degrees: f64, speed: f64) -> [Straight; 1] {
        [Straight { x, angle: degrees.to_radians(), speed }]
    }

    fn track(model: Wetting, wall: f64, before: &[TrackedLine], detected: &[Straight], dt: f64) -> Vec<TrackedLine> {
        let bounds = Bounds { min: Vec2::repeat(-5.0), max: Vec2::repeat(5.0) };
        let tracker = ContactLineTracker {
            domain: &Domain::new(bounds, [true, false], vec![]),
            model: &|_| model,
            wall_velocity: &|_| Vec2::new(wall, 0.0),
            tension: 1.0,
            viscosity: 1.0,
            other_viscosity: 1.0,
            slip_length: 1.0,
            h: H,
            mean_over: 1.0,
        };
        tracker.track(before, detected, dt)
    }

    const PINNED: Wetting = Wetting::Hysteresis(Hysteresis { advancing_angle_deg: 100.0, receding_angle_deg: 60.0 });

    /// [Dussan1979]
    #[test]
    fn a_line_within_its_range_is_drawn_back_to_its_anchor() {
        let start = track(PINNED, 0.0, &[], &at(0.0, 80.0, 0.0), 0.0);
        assert_eq!(start[0].anchor, Vec2::zeros());
        let off = track(PINNED, 0.0, &start, &at(0.01, 80.0, 0.0), 0.1);
        assert_eq!(off[0].anchor, Vec2::zeros());
        // For an interface displaced outwards a larger angle is imposed, which pulls it back.
        assert!(off[0].angle > 80_f64.to_radians() && off[0].angle < 100_f64.to_radians(), "{:?}", off[0]);
    }

    /// [Dussan1979]
    #[test]
    fn a_line_beyond_its_range_has_the_bound_and_takes_its_anchor_along() {
        let start = track(PINNED, 0.0, &[], &at(0.0, 95.0, 0.0), 0.0);
        let off = track(PINNED, 0.0, &start, &at(0.05, 95.0, 0.0), 0.1);
        assert!((off[0].angle - 100_f64.to_radians()).abs() < 1e-12, "{:?}", off[0]);
        assert!(off[0].anchor.x > 0.01 && off[0].anchor == off[0].position && off[0].travel > 0.01, "{:?}", off[0]);
    }

    #[test]
    fn an_anchor_goes_with_its_wall_and_through_a_periodic_side() {
        let mut lines = track(PINNED, 1.0, &[], &at(4.98, 80.0, 1.0), 0.0);
        for x in [4.99, 5.0, 5.01, 5.02] {
            lines = track(PINNED, 1.0, &lines, &at(if x >= 5.0 { x - 10.0 } else { x }, 80.0, 1.0), 0.01);
        }
        let [line] = lines[..] else { panic!("{lines:?}") };
        assert!((line.anchor.x + 4.98).abs() < 1e-9 && line.speed.abs() < 1e-12, "{line:?}");
        assert!((line.travel - 0.04).abs() < 1e-9 && (line.angle - 80_f64.to_radians()).abs() < 1e-6, "{line:?}");
    }

    #[test]
    fn the_speed_is_a_mean_over_time() {
        let young = Wetting::Young(Young { contact_angle_deg: 57.0 });
        let mut lines = track(young, 0.0, &[], &at(0.0, 57.0, 0.0), 0.0);
        for _ in 0..100 {
            lines = track(young, 0.0, &lines, &at(0.0, 57.0, 1.0), 0.01);
        }
        // One averaging time after a step from 0 to 1.
        assert!((lines[0].speed - (1.0 - (-1.0_f64).exp())).abs() < 1e-9, "{:?}", lines[0]);
    }

    #[test]
    fn a_line_that_is_lost_for_a_moment_keeps_its_anchor() {
        let start = track(PINNED, 0.0, &[], &at(0.0, 80.0, 0.0), 0.0);
        let lost = track(PINNED, 0.0, &start, &[], 0.5);
        assert_eq!((lost.len(), lost[0].anchor, lost[0].undetected), (1, start[0].anchor, 0.5));
        assert!(track(PINNED, 0.0, &lost, &[], 10.0).is_empty());
    }
}
