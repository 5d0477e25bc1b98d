//! Networks and displacements do not depend on how their drawing is turned, mirrored, shifted or scaled, however regular it is.
//!
//! `MENISCUS_PACKS=10000 cargo test --release --test network symmetry -- --nocapture` tries more inputs and prints how many failed.

use std::collections::BTreeMap;

use meniscus_case::FluidPhase;
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Capsule, Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};
use meniscus_network::conductance::resistances;
use meniscus_network::displacement::{Conditions, CornerFilms, Displacement, FilmPaths, Phase};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};
use meniscus_network::gravity::Gravity;
use rayon::prelude::*;

use crate::generated::{Grain, Pairs, Scene, drawing, scene};
use crate::invariants::violations;
use crate::motion::{MOTIONS, Motion, STILL};

impl Scene {
    fn geometry(&self, motion: &Motion) -> Geometry {
        let point = |x: [f64; 2]| motion.point(self.size, x);
        let shape = |grain: &Grain| match &self.moved_in_periods(grain, motion.cut) {
            Grain::Disc(center, radius) => {
                ShapeSpec::Disc(Disc { center: point(*center), radius: motion.scale * radius })
            }
            Grain::Capsule(ends, radius) => {
                ShapeSpec::Capsule(Capsule { ends: ends.map(point), radius: motion.scale * radius })
            }
            Grain::Ring(corners) => {
                let mut outer: Vec<[f64; 2]> = corners.iter().map(|&x| point(x)).collect();
                if motion.is_mirror() {
                    outer.reverse();
                }
                ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
            }
        };
        let size = motion.size(self.size);
        let spec = GeometrySpec {
            min: [0, 1].map(|i| motion.scale * size[i] * motion.shift[i]),
            max: [0, 1].map(|i| motion.scale * size[i] * (1.0 + motion.shift[i])),
            solid: SolidSide::Inside,
            shapes: self.grains.iter().map(shape).collect(),
        };
        let pairs = |i: usize| self.sides[if motion.exchanges { 1 - i } else { i }];
        let walls = [0, 0, 1, 1].map(|i| pairs(i) == Pairs::Walls);
        Geometry::new(&spec).unwrap().with_sides([0, 1].map(|i| pairs(i) == Pairs::Periodic), walls)
    }

    /// A grain moved along periodic axes by a share of the period, its first point within the box.
    fn moved_in_periods(&self, grain: &Grain, share: f64) -> Grain {
        let first = match grain {
            Grain::Disc(center, _) => *center,
            Grain::Capsule(ends, _) => ends[0],
            Grain::Ring(corners) => corners[0],
        };
        let by = [0, 1].map(|i| match self.sides[i] {
            Pairs::Periodic if share > 0.0 => (first[i] + share * self.size[i]).rem_euclid(self.size[i]) - first[i],
            Pairs::Periodic | Pairs::Open | Pairs::Walls => 0.0,
        });
        let moved = |x: [f64; 2]| [0, 1].map(|i| x[i] + by[i]);
        match grain {
            Grain::Disc(center, radius) => Grain::Disc(moved(*center), *radius),
            Grain::Capsule(ends, radius) => Grain::Capsule(ends.map(moved), *radius),
            Grain::Ring(corners) => Grain::Ring(corners.iter().map(|&x| moved(x)).collect()),
        }
    }

    fn outcome(&self, motion: &Motion) -> Result<Outcome, String> {
        let geometry = self.geometry(motion);
        let mut open = [false; 4];
        for side in (0..4).filter(|&side| self.sides[side / 2] == Pairs::Open) {
            open[motion.side(side)] = true;
        }
        let mut network = extract(&geometry, open).map_err(|error| error.to_string())?;
        // Half of the drawings have a depth; a sixth drain through corner films that are joined, another one through those of rings.
        network.depth = self.grains.len().is_multiple_of(2).then(|| 0.1 * motion.scale * self.size[0]);
        let violations = violations(&geometry, &network);
        if !violations.is_empty() {
            return Err(format!("violated: {violations:?}"));
        }
        Ok(Outcome::new(self, motion, &network))
    }
}

/// A throat, in the frame and the unit of length of the scene.
#[derive(Debug, Clone)]
struct Throat {
    contacts: [Vec2; 2],
    width: f64,
    /// Entry curvature.
    entry: f64,
    /// Resistance up to the chord from the center of each pore that touches it, and this center.
    halves: [(f64, Vec2); 2],
}

/// A network and its displacement, in the frame and the unit of length of the scene.
#[derive(Debug, Clone)]
struct Outcome {
    throats: Vec<Throat>,
    /// Inscribed radius, area, number of edges.
    regions: Vec<(f64, f64, usize)>,
    openings: usize,
    /// Applied curvature and filled area after each event.
    steps: Vec<(f64, f64)>,
}

/// Gravity along the axes that are not periodic.
fn gravity(scene: &Scene, motion: &Motion) -> Gravity {
    let along = |axis: usize| {
        if scene.sides[axis] == Pairs::Periodic { 0.0 } else { [3.0, -4.0][axis] / scene.size[0].powi(2) }
    };
    let [here, there] = [[0.0; 2], [0, 1].map(along)].map(|x| Vec2::from(motion.point(scene.size, x)));
    Gravity {
        gradient: (there - here) / motion.scale.powi(3),
        reference: here,
        invading: FluidPhase::NonWetting,
        depth: None,
    }
}

impl Outcome {
    fn new(scene: &Scene, motion: &Motion, network: &Network) -> Self {
        // Films part far below the bursts of their throats.
        let meeting: Vec<f64> = network.throats.iter().map(|throat| 0.2 / throat.width).collect();
        let paths = |rings: Option<Vec<bool>>| FilmPaths { meeting: meeting.clone(), rings };
        let conditions = |inlet: bool| {
            let on = |end: usize| {
                let mut sides = [false; 4];
                sides[motion.side(2 * scene.flow + end)] = scene.sides[scene.flow] == Pairs::Open && inlet;
                sides
            };
            Conditions {
                inlet: on(0),
                outlet: on(1),
                trapping: scene.trapping.into(),
                films: match scene.grains.len() % 6 {
                    0 => CornerFilms::Drain(paths(None)),
                    3 => CornerFilms::Drain(paths(Some(vec![true; scene.grains.len() + 4]))),
                    _ => CornerFilms::Absent,
                },
                gravity: scene.is_heavy.then(|| gravity(scene, motion)),
                ..Conditions::new(vec![scene.angle_deg.to_radians(); scene.grains.len() + 4])
            }
        };
        let pores = Pores::merged(network, 0.95);
        let (length, area) = (motion.scale, motion.scale * motion.scale);
        let mut state = Displacement::new(network, &pores, conditions(true));
        let entries = state.entry_curvatures(&conditions(false), network.throats.len());
        let area_of = |state: &Displacement, element: usize| state.elements()[element].area / area;
        let begun = (0..state.elements().len()).filter(|&e| state.phase(e) == Phase::Invading);
        let mut filled: f64 = begun.map(|e| area_of(&state, e)).sum();
        let mut steps = vec![(f64::NEG_INFINITY, filled)];
        while let Some(event) = state.next() {
            filled += event.elements.iter().map(|&e| area_of(&state, e)).sum::<f64>();
            steps.push((event.applied * length, filled));
        }
        let by = [0, 1].map(|i| if scene.sides[i] == Pairs::Periodic { motion.cut * scene.size[i] } else { 0.0 });
        let back = |x: Vec2| motion.back(scene.size, x) - Vec2::from(by);
        let throats = network.throats.iter().zip(entries).zip(resistances(network));
        let throats = throats.map(|((throat, entry), resistances)| Throat {
            contacts: throat.contacts.map(back),
            width: throat.width / length,
            entry: entry * length,
            halves: [0, 1].map(|k| (resistances[k] * area, back(network.regions[throat.regions[k]].center))),
        });
        let regions = network.regions.iter();
        let regions = regions.map(|region| (region.radius / length, region.area / area, region.edges.len()));
        Self { throats: throats.collect(), regions: regions.collect(), openings: network.openings.len(), steps }
    }

    /// What differs from another outcome of the same scene.
    fn difference(&self, other: &Self, scene: &Scene) -> Option<String> {
        let scale = scene.size[0].max(scene.size[1]);
        let counts = |it: &Self| [it.throats.len(), it.regions.len(), it.openings];
        if counts(self) != counts(other) {
            return Some(format!("counts: {:?} {:?}", counts(self), counts(other)));
        }
        let is_near = |a: Vec2, b: Vec2, within: f64| {
            (0..2).all(|i| {
                let (d, period) = (a[i] - b[i], scene.size[i]);
                let whole = if scene.sides[i] == Pairs::Periodic { (d / period).round() * period } else { 0.0 };
                (d - whole).abs() < within * scale
            })
        };
        let mut left = other.throats.clone();
        for it in &self.throats {
            let same = left.iter().position(|there| {
                let both = |j: usize| (0..2).all(|k| is_near(it.contacts[k], there.contacts[k ^ j], 1e-6));
                (it.width - there.width).abs() < 1e-9 * scale && (both(0) || both(1))
            });
            let Some(same) = same else { return Some(format!("throat: {it:?} has no like")) };
            let there = left.swap_remove(same);
            if (it.entry - there.entry).abs() > 1e-8 * it.entry.abs() {
                return Some(format!("entry: {it:?} {there:?}"));
            }
            // Where several circles of a pore are the largest, its center is any of theirs, also where they differ by rounding.
            for (half, center) in it.halves {
                let mut alike = there.halves.iter().filter(|other| is_near(center, other.1, 1e-12)).peekable();
                if alike.peek().is_some() && !alike.any(|other| (half - other.0).abs() <= 1e-8 * half.abs().max(1.0)) {
                    return Some(format!("resistance: {it:?} {there:?}"));
                }
            }
        }
        let mut left = other.regions.clone();
        for &(radius, area, edges) in &self.regions {
            let apart = |it: &(f64, f64, usize)| (radius - it.0).abs().max((area - it.1).abs() / scale);
            let is_like = |it: &(f64, f64, usize)| it.2 == edges && apart(it) < 1e-9 * scale;
            let nearest = (0..left.len())
                .filter(|&k| is_like(&left[k]))
                .min_by(|&a, &b| apart(&left[a]).total_cmp(&apart(&left[b])));
            let Some(same) = nearest else { return Some(format!("region: {radius} {area} {edges} has no like")) };
            left.swap_remove(same);
        }
        self.curve_differs(other).or_else(|| other.curve_differs(self))
    }

    /// Where the area filled at a curvature is not that of another outcome, up to equal events.
    fn curve_differs(&self, other: &Self) -> Option<String> {
        let at = |k: f64| other.steps.partition_point(|step| step.0 <= k);
        let total: f64 = self.regions.iter().map(|region| region.1).sum();
        for (i, &(k, filled)) in self.steps.iter().enumerate() {
            let size = k.abs().max(1.0 / total.sqrt());
            if self.steps.get(i + 1).is_some_and(|next| next.0 <= k + 1e-7 * size) {
                continue;
            }
            let slack = 1e-6 * size;
            let [below, above] = if k.is_finite() { [at(k - slack), at(k + slack)] } else { [1, 1] };
            let range = [below.max(1) - 1, above.max(1) - 1].map(|i| other.steps[i].1);
            if filled < range[0] - 1e-8 * total || filled > range[1] + 1e-8 * total {
                return Some(format!("events: at {k} {} not {:?}", filled / total, range.map(|x| x / total)));
            }
        }
        None
    }
}

/// What fails for a scene.
fn failures_of(scene: &Scene) -> Vec<(String, String)> {
    let quasi_static = match scene.outcome(&STILL) {
        Ok(quasi_static) => quasi_static,
        Err(error) => return vec![("refused".to_owned(), error)],
    };
    let mut found = Vec::new();
    for motion in &MOTIONS {
        let difference = match scene.outcome(motion) {
            Ok(moved) => quasi_static.difference(&moved, scene),
            Err(error) => Some(format!("refused: {error}")),
        };
        if let Some(what) = difference {
            let kind = what.split(':').next().unwrap_or_default().to_owned();
            found.push((kind, format!("{}: {what}", motion.name)));
        }
    }
    found
}

/// Whether the order of events is asked for as well. Between polygons of the first generator it may depend on rounding where menisci are pinned at two edges
/// at once.
fn has_no_corners(scene: &Scene) -> bool {
    scene.grains.iter().all(|grain| !matches!(grain, Grain::Ring(..)))
}

/// A number from the environment.
fn asked(key: &str, default: u64) -> u64 {
    std::env::var(key).ok().and_then(|count| count.parse().ok()).unwrap_or(default)
}

/// Asserts that the chosen number of generated inputs do not fail, and prints how many do.
fn assert_symmetric(generated: fn(u64) -> Scene, has_order: fn(&Scene) -> bool) {
    let (first, count) = (asked("MENISCUS_PACKS_FIRST", 0), asked("MENISCUS_PACKS", 40));
    let found: Vec<(u64, String, String)> = (first..first + count)
        .into_par_iter()
        .flat_map_iter(|number| {
            let first = failures_of(&generated(number)).into_iter().next();
            first.map(|(kind, what)| (number, kind, what))
        })
        .collect();
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, kind, _) in &found {
        *kinds.entry(kind).or_default() += 1;
    }
    println!("{count} inputs, {} failed: {kinds:?}", found.len());
    found.iter().for_each(|(number, kind, what)| println!("{number} {kind} {what}"));
    let counts = |(number, kind, _): &&(u64, String, String)| kind != "events" || has_order(&generated(*number));
    let failed: Vec<_> = found.iter().filter(counts).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn a_network_and_its_displacement_do_not_depend_on_how_the_drawing_lies() {
    assert_symmetric(scene, has_no_corners);
}

#[test]
fn lattices_with_errors_of_any_size_and_packs_of_equal_grains_have_one_network_and_one_displacement() {
    assert_symmetric(drawing, |_| true);
}

#[test]
fn three_discs_drain_like_their_mirror_image() {
    let discs = [([0.44, 0.16], 0.06), ([0.38, 0.57], 0.08), ([0.82, 0.13], 0.06)];
    for angle_deg in [0.0, 5.0, 20.0, 40.0] {
        let grains = discs.map(|(center, radius)| Grain::Disc(center, radius)).to_vec();
        let sides = [Pairs::Open, Pairs::Walls];
        let scene = Scene { size: [1.0, 0.8], grains, sides, flow: 0, angle_deg, trapping: true, is_heavy: false };
        let found = failures_of(&scene);
        assert!(found.is_empty(), "{found:?}");
    }
}

/// Asserts that discs have a network, the same however they lie.
fn has_network(size: [f64; 2], discs: &[[f64; 3]], sides: [Pairs; 2]) -> Outcome {
    let grains = discs.iter().map(|&[x, y, r]| Grain::Disc([x, y], r)).collect();
    let scene = Scene {
        size,
        grains,
        sides,
        flow: usize::from(sides[0] != Pairs::Open),
        angle_deg: 0.0,
        trapping: true,
        is_heavy: false,
    };
    let found = failures_of(&scene);
    assert!(found.is_empty(), "{found:?}");
    scene.outcome(&STILL).unwrap()
}

#[test]
fn a_grain_that_is_given_at_both_periodic_sides_counts_once() {
    let sides = [Pairs::Open, Pairs::Periodic];
    for at in [0.02, -0.013, 0.0, 0.1 / 3.0, 0.777e-3] {
        // The copy has the rounding errors of decimals.
        let copies = [([0.31, at], 0.12), ([0.31, at + 0.8], 0.12)];
        let others = [([0.62, 0.37], 0.15), ([0.83, 0.61], 0.08)];
        let scene = |copies: &[([f64; 2], f64)]| {
            let discs = copies.iter().chain(&others);
            let grains = discs.map(|&(center, radius)| Grain::Disc(center, radius)).collect();
            Scene { size: [1.0, 0.8], grains, sides, flow: 0, angle_deg: 20.0, trapping: true, is_heavy: false }
        };
        let [once, twice] = [&copies[..1], &copies].map(|copies| {
            let network = extract(&scene(copies).geometry(&STILL), [true, true, false, false]).unwrap();
            let mut numbers: Vec<f64> = network.throats.iter().map(|throat| throat.width).collect();
            numbers.extend(network.regions.iter().flat_map(|region| [region.radius, region.area]));
            numbers.sort_by(f64::total_cmp);
            numbers
        });
        let differs = once.iter().zip(&twice).any(|(one, other)| (one - other).abs() > 1e-12);
        assert!(once.len() == twice.len() && !differs, "{at}: {once:?} {twice:?}");
    }
}

#[test]
fn posts_on_a_square_and_discs_in_tall_boxes_have_a_network() {
    let posts = [[1e-4, 1e-4, 4e-5], [3e-4, 1e-4, 4e-5], [1e-4, 3e-4, 4e-5], [3e-4, 3e-4, 4e-5]];
    let [open, walls] = [Pairs::Open, Pairs::Walls];
    for sides in [[open, walls], [walls, open], [walls, walls]] {
        let drained = has_network([4e-4, 4e-4], &posts, sides);
        if sides.contains(&open) {
            // Two posts are 120 um apart.
            assert!((drained.steps[1].0 - 2.0 / 1.2e-4).abs() < 1e-9 * 2.0 / 1.2e-4, "{:?}", drained.steps);
        }
        has_network([1.0, 3.0], &[[0.5, 1.5, 0.05]], sides);
        has_network([1.0, 4.0], &[[0.3, 1.0, 0.15], [0.7, 2.1, 0.12], [0.4, 3.0, 0.15]], sides);
    }
}

#[test]
fn a_square_lattice_has_a_network_however_large_its_errors_are() {
    let (pitch, radius) = (1e-4, 3e-5);
    for power in 2..=14 {
        let error = pitch * 10.0_f64.powi(-power);
        // Errors of no symmetry.
        let noise = |k: usize| error * (2.0 * (0.618_033_988_749_895 * (k * k + 3 * k + 1) as f64).fract() - 1.0);
        let posts: Vec<[f64; 3]> = (0..9)
            .map(|k| {
                let site = |i: usize| (i as f64 + 0.5) * pitch;
                [site(k % 3) + noise(3 * k), site(k / 3) + noise(3 * k + 1), radius + noise(3 * k + 2)]
            })
            .collect();
        let drained = has_network([3.0 * pitch; 2], &posts, [Pairs::Open, Pairs::Walls]);
        // At 0 degrees a meniscus between two posts is a half circle as wide as their gap.
        let exact = 2.0 / (pitch - 2.0 * radius);
        let entry = drained.steps[1].0;
        assert!((entry - exact).abs() <= 5.0 * error / pitch * exact + 1e-9 * exact, "{error}: {entry} {exact}");
    }
}
