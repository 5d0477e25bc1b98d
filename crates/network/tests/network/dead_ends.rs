//! Dead ends beside a channel: what they hold stays where nothing can leave them, and leaves at 2 cos θ/w where films drain it.

use meniscus_geometry::spec::ShapeSpec;
use meniscus_network::displacement::{Conditions, Displacement, Phase};
use meniscus_network::extract;
use meniscus_network::graph::Pores;

use crate::scenes::{grains, polygon};
use crate::support::dice::Dice;

/// A channel along x between walls, with a dead end that leads off its upper wall.
#[derive(Debug, Clone, Copy)]
struct DeadEnd {
    /// Height of the channel.
    channel: f64,
    /// Width of the dead end across its axis.
    width: f64,
    /// Length of its axis.
    depth: f64,
    /// Where its axis begins, along the channel.
    at: f64,
    /// Angle of its axis from the normal of the channel in rad.
    lean: f64,
    /// Rows and columns exchanged, and mirrored.
    turns: [bool; 3],
}

const LENGTH: f64 = 3.0;
const HEIGHT: f64 = 1.0;
const FLOOR: f64 = 0.1;

impl DeadEnd {
    fn random(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let channel = dice.between(0.1, 0.3);
        // Wider ones are pores that the channel leads past.
        let width = dice.between(0.02, 1.4 * channel);
        let lean = if seed.is_multiple_of(3) { dice.between(-0.5, 0.5) } else { 0.0 };
        let depth = dice.between(1.2 * width, 0.55).max(1.2 * width);
        let turns = [0, 1, 2].map(|bit| seed >> bit & 1 == 1);
        Self { channel, width, depth, at: dice.between(1.0, 2.0), lean, turns }
    }

    fn turned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let x = if self.turns[1] { LENGTH - x } else { x };
        let y = if self.turns[2] { HEIGHT - y } else { y };
        if self.turns[0] { [y, x] } else { [x, y] }
    }

    fn shapes(&self) -> Vec<ShapeSpec> {
        let (top, mouth) = (FLOOR + self.channel, 0.5 * self.width / self.lean.cos());
        let (sin, cos) = self.lean.sin_cos();
        let axis = |side: f64, depth: f64| [self.at + side * mouth + depth * sin, top + depth * cos];
        // The end lies across the axis: its corners are as deep along both walls.
        let shift = mouth * sin;
        let lower = vec![[-1.0, -1.0], [LENGTH + 1.0, -1.0], [LENGTH + 1.0, FLOOR], [-1.0, FLOOR]];
        let upper = vec![
            [-1.0, top],
            axis(-1.0, 0.0),
            axis(-1.0, self.depth + shift),
            axis(1.0, self.depth - shift),
            axis(1.0, 0.0),
            [LENGTH + 1.0, top],
            [LENGTH + 1.0, 2.0],
            [-1.0, 2.0],
        ];
        let is_mirrored = self.turns.iter().filter(|&&turn| turn).count() % 2 == 1;
        let turned = |ring: Vec<[f64; 2]>| {
            let mut ring: Vec<[f64; 2]> = ring.into_iter().map(|x| self.turned(x)).collect();
            if is_mirrored {
                ring.reverse();
            }
            polygon(ring)
        };
        [lower, upper].map(turned).into()
    }

    fn displacement(&self, angle: f64, trapping: bool) -> Displacement {
        let side = |low: bool| {
            let mut sides = [false; 4];
            sides[2 * usize::from(self.turns[0]) + usize::from(low == self.turns[1])] = true;
            sides
        };
        let [inlet, outlet] = [side(true), side(false)];
        let size = if self.turns[0] { [HEIGHT, LENGTH] } else { [LENGTH, HEIGHT] };
        let geometry = grains(size, self.shapes()).with_wall_sides([0, 1, 2, 3].map(|k| !(inlet[k] || outlet[k])));
        let network = extract(&geometry, [0, 1, 2, 3].map(|k| inlet[k] || outlet[k])).unwrap();
        let conditions = Conditions { inlet, outlet, trapping: trapping.into(), ..Conditions::new(vec![angle; 6]) };
        Displacement::new(&network, &Pores::merged(&network, 0.95), conditions)
    }

    /// Its area beyond the chord across its mouth, which stands across the axis.
    fn area(&self) -> f64 {
        self.width * (self.depth - 0.5 * self.width * self.lean.tan().abs())
    }

    fn pore_area(&self) -> f64 {
        LENGTH * self.channel + self.width * self.depth
    }
}

/// `MENISCUS_INPUTS=10000` tries so many.
fn inputs(few: u64) -> u64 {
    std::env::var("MENISCUS_INPUTS").ok().and_then(|count| count.parse().ok()).unwrap_or(few)
}

fn held(displacement: &Displacement) -> f64 {
    let elements = displacement.elements().iter().enumerate();
    elements.filter(|(k, _)| displacement.phase(*k) == Phase::Defending).map(|(_, element)| element.area).sum()
}

#[test]
fn what_a_dead_end_holds_stays() {
    for seed in 0..inputs(200) {
        let dead_end = DeadEnd::random(seed);
        for angle_deg in [0.0_f64, 30.0, 60.0] {
            let mut displacement = dead_end.displacement(angle_deg.to_radians(), true);
            while displacement.next().is_some() {}
            assert!(displacement.reached_outlet());
            let held = held(&displacement);
            let (area, all) = (dead_end.area(), dead_end.pore_area());
            assert!((held - area).abs() < 1e-9 * all, "{seed} {dead_end:?}, {angle_deg} degrees: {held} {area}");
        }
    }
}

#[test]
fn films_drain_a_dead_end_at_the_pressure_of_its_width() {
    for seed in 0..inputs(200) {
        let dead_end = DeadEnd::random(seed);
        for angle_deg in [0.0_f64, 30.0, 60.0] {
            let cos = angle_deg.to_radians().cos();
            let displacement = dead_end.displacement(angle_deg.to_radians(), false);
            let ends: Vec<f64> = displacement.elements().iter().map(|element| element.area).collect();
            let is_it = |element: usize| (ends[element] - dead_end.area()).abs() < 1e-9;
            let found = displacement.into_iter().find(|event| event.elements.iter().any(|&e| is_it(e)));
            let found = found.map(|event| [event.curvature, event.applied]);
            // The meniscus of the channel is pinned at the edge of the mouth until it leaves that along the wall, however narrow the mouth.
            let passed = (1.0 + cos) / dead_end.channel;
            let expected = [2.0 * cos / dead_end.width, passed.max(2.0 * cos / dead_end.width)];
            let is_right = |found: [f64; 2]| (0..2).all(|i| (found[i] - expected[i]).abs() < 1e-9 * expected[i]);
            assert!(found.is_some_and(is_right), "{seed} {dead_end:?}, {angle_deg} degrees: {found:?} {expected:?}");
        }
    }
}

#[test]
fn a_dead_end_as_wide_as_its_channel_keeps_an_eleventh_of_the_pores() {
    let dead_end = DeadEnd { channel: 0.2, width: 0.2, depth: 0.3, at: 1.5, lean: 0.0, turns: [false; 3] };
    let mut displacement = dead_end.displacement(30.0_f64.to_radians(), true);
    while displacement.next().is_some() {}
    assert!((held(&displacement) / dead_end.pore_area() - 1.0 / 11.0).abs() < 1e-9);
}
