//! Random packs of grains, the same for the same seed on every machine.

use meniscus_geometry::spec::{Capsule, Disc, Polygon, Rectangle, ShapeSpec};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What grains of a pack look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grains {
    /// Discs.
    Discs,
    /// Star-shaped polygons of 3 to 9 corners, concave ones too.
    Polygons,
    /// Smooth curves cut into 40 to 200 segments.
    Curves,
    /// Turned rectangles and capsules.
    Bars,
    /// All of these.
    Mixed,
}

/// A pack in a square that begins at the origin.
#[derive(Debug, Clone, Copy)]
pub struct Pack {
    /// Side of the square.
    pub side: f64,
    /// Number of grains that are tried; those that find no place are left out.
    pub count: usize,
    /// Smallest and largest radius of the circle around a grain.
    pub radii: [f64; 2],
    /// Smallest gap between those circles; grains overlap where it is negative.
    pub gap: f64,
    /// Whether grains are placed as on a torus.
    pub periodic: bool,
    /// What they look like.
    pub grains: Grains,
    /// The seed.
    pub seed: u64,
}

impl Pack {
    /// The grains.
    pub fn shapes(&self) -> Vec<ShapeSpec> {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let cells = ((self.side / (2.0 * self.radii[1] + self.gap.max(0.0))) as i64).max(1);
        let cell = |x: f64| ((x / self.side * cells as f64) as i64).min(cells - 1);
        let mut places: Vec<[f64; 3]> = Vec::new();
        let mut grid: Vec<Vec<usize>> = vec![Vec::new(); (cells * cells) as usize];
        for _ in 0..100 * self.count {
            if places.len() == self.count {
                break;
            }
            let [x, y] = [0, 1].map(|_| self.side * rng.random::<f64>());
            let radius = self.radii[0] + (self.radii[1] - self.radii[0]) * rng.random::<f64>();
            let apart = |other: &[f64; 3]| {
                let [dx, dy] = [(other[0] - x).abs(), (other[1] - y).abs()]
                    .map(|d| if self.periodic { d.min(self.side - d) } else { d });
                dx.hypot(dy) - other[2] - radius
            };
            let mut near = (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))).flat_map(|(i, j)| {
                let (i, j) = ((cell(x) + i).rem_euclid(cells), (cell(y) + j).rem_euclid(cells));
                grid[(i * cells + j) as usize].iter()
            });
            if near.all(|&k| apart(&places[k]) > self.gap) {
                grid[(cell(x) * cells + cell(y)) as usize].push(places.len());
                places.push([x, y, radius]);
            }
        }
        places.iter().map(|&place| self.grain(place, &mut rng)).collect()
    }

    fn grain(&self, [x, y, radius]: [f64; 3], rng: &mut ChaCha8Rng) -> ShapeSpec {
        let turn = 360.0 * rng.random::<f64>();
        let share = 0.3 + 0.6 * rng.random::<f64>();
        let kind = match self.grains {
            Grains::Discs => 0,
            Grains::Polygons => 1,
            Grains::Curves => 4,
            Grains::Bars => 2 + usize::from(rng.random::<bool>()),
            Grains::Mixed => (5.0 * rng.random::<f64>()) as usize,
        };
        match kind {
            0 => ShapeSpec::Disc(Disc { center: [x, y], radius }),
            1 => {
                let corners = 3 + (7.0 * rng.random::<f64>()) as usize;
                let outer = (0..corners)
                    .map(|k| {
                        let angle = std::f64::consts::TAU * (k as f64 + 0.7 * rng.random::<f64>()) / corners as f64;
                        let r = radius * (0.4 + 0.6 * rng.random::<f64>());
                        [r * angle.cos(), r * angle.sin()]
                    })
                    .collect();
                ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [x, y], rotation_deg: turn })
            }
            2 => {
                let size = [2.0 * radius * share, 2.0 * radius * (1.0 - share * share).sqrt()];
                ShapeSpec::Rectangle(Rectangle { center: [x, y], size, rotation_deg: turn })
            }
            4 => {
                let corners = 40 + (160.0 * rng.random::<f64>()) as usize;
                let waves = (2.0 + 3.0 * rng.random::<f64>()).floor();
                let depth = 0.2 * rng.random::<f64>();
                let outer = (0..corners)
                    .map(|k| {
                        let angle = std::f64::consts::TAU * k as f64 / corners as f64;
                        let r = radius * (1.0 - depth * (1.0 + (waves * angle).cos()));
                        [r * angle.cos(), r * angle.sin()]
                    })
                    .collect();
                ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [x, y], rotation_deg: turn })
            }
            _ => {
                let (thin, reach) = (radius * (1.0 - share), radius * share);
                let (s, c) = turn.to_radians().sin_cos();
                let ends = [[x - reach * c, y - reach * s], [x + reach * c, y + reach * s]];
                ShapeSpec::Capsule(Capsule { ends, radius: thin })
            }
        }
    }
}
