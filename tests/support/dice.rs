//! Numbers that look random and are the same on every machine, and discs at such places.
#![allow(dead_code, reason = "each test file and benchmark uses its own part")]

use meniscus_core::math::Vec2;
use meniscus_geometry::spec::Disc;

/// The generator of Knuth's MMIX.
pub struct Dice(u64);

impl Dice {
    /// Dice that fall the same way for the same `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector with both components between -1 and 1.
    pub fn vector(&mut self) -> Vec2 {
        Vec2::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }
}

/// Discs with radii between `radii` in a box of the given `size` from the origin: those of `tries` that are at least `gap` apart and `margin` inside.
pub fn scattered_discs(seed: u64, tries: usize, size: [f64; 2], radii: [f64; 2], [gap, margin]: [f64; 2]) -> Vec<Disc> {
    let mut dice = Dice::new(seed);
    let mut discs: Vec<Disc> = Vec::new();
    for _ in 0..tries {
        let radius = dice.between(radii[0], radii[1]);
        let center = size.map(|side| dice.between(0.0, side));
        let apart = |disc: &Disc| (disc.center[0] - center[0]).hypot(disc.center[1] - center[1]) - disc.radius - radius;
        let is_inside = (0..2).all(|i| center[i] > radius + margin && center[i] < size[i] - radius - margin);
        if is_inside && discs.iter().all(|disc| apart(disc) > gap) {
            discs.push(Disc { center, radius });
        }
    }
    discs
}
