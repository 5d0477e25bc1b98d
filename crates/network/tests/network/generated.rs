//! Generated drawings for properties of networks: lattices, as regular as rounding allows, and random packs.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A grain: a disc, or a ring of corners, counter-clockwise.
#[derive(Debug, Clone)]
pub enum Grain {
    Disc([f64; 2], f64),
    Ring(Vec<[f64; 2]>),
    /// The ends of the axis of a capsule, and its radius.
    Capsule([[f64; 2]; 2], f64),
}

/// What becomes of opposite sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pairs {
    Walls,
    Open,
    Periodic,
}

/// Grains in a box that begins at the origin; fluids enter through the first side along `flow` (0 or 1) if it is open.
#[derive(Debug, Clone)]
pub struct Scene {
    pub size: [f64; 2],
    pub grains: Vec<Grain>,
    pub sides: [Pairs; 2],
    pub flow: usize,
    pub angle_deg: f64,
    pub trapping: bool,
    /// Whether gravity acts.
    pub is_heavy: bool,
}

/// A scene of its own for each number.
pub fn scene(number: u64) -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(number);
    let mut pick = |of: usize| ((of as f64 * rng.random::<f64>()) as usize).min(of - 1);
    let sides = [
        [Pairs::Open, Pairs::Walls],
        [Pairs::Walls, Pairs::Open],
        [Pairs::Open, Pairs::Periodic],
        [Pairs::Walls, Pairs::Walls],
        [Pairs::Open, Pairs::Open],
        [Pairs::Periodic, Pairs::Periodic],
    ][pick(6)];
    let flow = usize::from(sides[0] != Pairs::Open);
    let angle_deg = [0.0, 5.0, 20.0, 40.0, 90.0, 140.0][pick(6)];
    let trapping = pick(2) == 0;
    let kind = pick(4);
    let is_lattice = pick(2) == 0;
    let (size, places) = if is_lattice { lattice(&mut rng) } else { scattered(&mut rng) };
    let corners = 3 + (5.0 * rng.random::<f64>()) as usize;
    let grains = places.into_iter().map(|place| grain(kind, corners, place, is_lattice, &mut rng)).collect();
    Scene { size, grains, sides, flow, angle_deg, trapping, is_heavy: number % 3 == 1 }
}

/// Sites of a square, hexagonal or staggered lattice with room around each, moved by nearly nothing.
fn lattice(rng: &mut ChaCha8Rng) -> ([f64; 2], Vec<[f64; 3]>) {
    let mut pick = |of: usize| ((of as f64 * rng.random::<f64>()) as usize).min(of - 1);
    let pitch = [1e-4, 1.5e-4, 2e-4, 2.5e-4, 3e-4, 5e-4, 1.0, 0.0][pick(8)];
    let (columns, rows) = (2 + pick(7), 2 + pick(7));
    let (staggered, flat) = [(false, 1.0), (true, 0.75_f64.sqrt()), (true, 1.0), (false, 1.0)][pick(4)];
    let noise = [0.0, 1e-16, 1e-12, 1e-8][pick(4)];
    let turned = pick(2) == 0;
    let pitch = if pitch == 0.0 { 1e-4 * (1.0 + 4.0 * rng.random::<f64>()) } else { pitch };
    let share = if rng.random::<f64>() < 0.5 { 0.4 } else { 0.2 + 0.2 * rng.random::<f64>() };
    let mut places = Vec::new();
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let by = if staggered && j % 2 == 1 { 1.0 } else { 0.5 };
        let at = [(i as f64 + by) * pitch, (j as f64 + 0.5) * pitch * flat];
        let at = at.map(|x| x + noise * pitch * (2.0 * rng.random::<f64>() - 1.0));
        places.push(if turned { [at[1], at[0], share * pitch] } else { [at[0], at[1], share * pitch] });
    }
    let size = [(columns as f64 + if staggered { 0.5 } else { 0.0 }) * pitch, rows as f64 * pitch * flat];
    (if turned { [size[1], size[0]] } else { size }, places)
}

/// Random places with room around each, in boxes of all shapes.
fn scattered(rng: &mut ChaCha8Rng) -> ([f64; 2], Vec<[f64; 3]>) {
    let ratio = [0.25, 0.4, 0.5, 0.8, 1.0, 1.7, 4.0][(7.0 * rng.random::<f64>()) as usize % 7];
    let size = [1.0, ratio];
    let tries = [2, 10, 60, 600][(4.0 * rng.random::<f64>()) as usize % 4];
    let largest = 0.05 + 0.1 * rng.random::<f64>();
    let mut places: Vec<[f64; 3]> = Vec::new();
    for _ in 0..tries {
        let [x, y, r] = [0, 1, 2].map(|_| rng.random::<f64>());
        let place = [x * size[0], y * size[1], largest * (0.4 + 0.6 * r)];
        let is_free =
            |other: &[f64; 3]| (other[0] - place[0]).hypot(other[1] - place[1]) > other[2] + place[2] + 0.2 * largest;
        let is_inside = (0..2).all(|i| place[i] > place[2] + 0.02 && place[i] < size[i] - place[2] - 0.02);
        if places.iter().all(is_free) && is_inside {
            places.push(place);
        }
    }
    if places.is_empty() {
        places.push([0.5, 0.5 * ratio, 0.1 * ratio]);
    }
    (size, places)
}

fn grain(kind: usize, corners: usize, [x, y, radius]: [f64; 3], is_regular: bool, rng: &mut ChaCha8Rng) -> Grain {
    let ring = |corners: usize, turn: f64, even: bool, rng: &mut ChaCha8Rng| {
        let corner = |k: usize| {
            let apart = if even { 0.0 } else { 0.6 * rng.random::<f64>() };
            let angle = turn + std::f64::consts::TAU * (k as f64 + apart) / corners as f64;
            [x + radius * angle.cos(), y + radius * angle.sin()]
        };
        Grain::Ring((0..corners).map(corner).collect())
    };
    match kind {
        0 | 1 => Grain::Disc([x, y], radius),
        2 => {
            let half = radius * 0.7;
            Grain::Ring(
                [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[a, b]| [x + a, y + b]).into(),
            )
        }
        _ if is_regular => ring(corners, 0.0, true, rng),
        _ => {
            let turn = std::f64::consts::TAU * rng.random::<f64>();
            ring(corners, turn, false, rng)
        }
    }
}

/// Decimals to which a drawing is rounded, or noise, over the pitch of its posts.
#[derive(Debug, Clone, Copy)]
enum Error {
    None,
    Noise(f64),
    Rounded(f64),
}

impl Error {
    fn pick(rng: &mut ChaCha8Rng) -> Self {
        let [kind, size] = [(); 2].map(|()| rng.random::<f64>());
        match kind {
            _ if kind < 0.15 => Self::None,
            // 1e-12 to 5e-2.
            _ if kind < 0.7 => Self::Noise(5e-2 * (-size * 5e10_f64.ln()).exp()),
            _ => Self::Rounded(10.0_f64.powi(-4 - (5.0 * size) as i32)),
        }
    }

    fn of(self, x: f64, pitch: f64, rng: &mut ChaCha8Rng) -> f64 {
        match self {
            Self::None => x,
            Self::Noise(noise) => x + noise * pitch * (2.0 * rng.random::<f64>() - 1.0),
            Self::Rounded(step) => (x / (step * pitch)).round() * (step * pitch),
        }
    }
}

/// A drawing as people have them, of its own for each number: lattices of equal posts with errors from 1e-12 to 5e-2 of their pitch, also turned or rounded,
/// and packs of equal discs, upright rectangles, polygons and capsules; drained, with moderate angles, or filled.
pub fn drawing(number: u64) -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 + number);
    let mut pick = |of: usize| ((of as f64 * rng.random::<f64>()) as usize).min(of - 1);
    let sides = [
        [Pairs::Open, Pairs::Walls],
        [Pairs::Open, Pairs::Walls],
        [Pairs::Walls, Pairs::Open],
        [Pairs::Open, Pairs::Periodic],
        [Pairs::Open, Pairs::Open],
        [Pairs::Periodic, Pairs::Periodic],
    ][pick(6)];
    let flow = usize::from(sides[0] != Pairs::Open);
    let angle_deg = [0.0, 5.0, 20.0, 40.0, 60.0, 120.0][pick(6)];
    let trapping = pick(3) > 0;
    let kind = pick(8);
    let (size, grains) = match kind {
        0..=2 => posts(kind == 1, kind == 2, &mut rng),
        3 => pack(&mut rng, |place, r, _| Grain::Disc(place, r)),
        4 => pack(&mut rng, |[x, y], r, rng| {
            let [a, b] = [0, 1].map(|_| r * (0.3 + 0.4 * rng.random::<f64>()));
            Grain::Ring(vec![[x - a, y - b], [x + a, y - b], [x + a, y + b], [x - a, y + b]])
        }),
        5 => pack(&mut rng, |place, r, rng| {
            let (corners, turn) =
                (3 + (4.0 * rng.random::<f64>()) as usize, std::f64::consts::TAU * rng.random::<f64>());
            polygon(place, r, corners, turn, rng)
        }),
        6 => pack(&mut rng, |place, r, rng| {
            let kind = (3.0 * rng.random::<f64>()) as usize;
            let turn = std::f64::consts::TAU * rng.random::<f64>();
            if kind == 0 { Grain::Disc(place, r) } else { polygon(place, r, 2 + kind, turn, rng) }
        }),
        _ => pack(&mut rng, |[x, y], r, rng| {
            let turn = if rng.random::<f64>() < 0.5 { 0.0 } else { std::f64::consts::TAU * rng.random::<f64>() };
            let half = r * (0.2 + 0.4 * rng.random::<f64>());
            let (dx, dy) = (half * turn.cos(), half * turn.sin());
            Grain::Capsule([[x - dx, y - dy], [x + dx, y + dy]], r - half)
        }),
    };
    Scene { size, grains, sides, flow, angle_deg, trapping, is_heavy: number % 3 == 1 }
}

fn polygon([x, y]: [f64; 2], radius: f64, corners: usize, turn: f64, rng: &mut ChaCha8Rng) -> Grain {
    let corner = |k: usize| {
        let angle = turn + std::f64::consts::TAU * (k as f64 + 0.6 * rng.random::<f64>()) / corners as f64;
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    Grain::Ring((0..corners).map(corner).collect())
}

/// Equal posts on a lattice with errors.
fn posts(is_hexagonal: bool, is_turned: bool, rng: &mut ChaCha8Rng) -> ([f64; 2], Vec<Grain>) {
    let error = Error::pick(rng);
    let pitch = [1e-4, 1.5e-4, 2e-4, 1.0][(4.0 * rng.random::<f64>()) as usize % 4];
    let [columns, rows] = [(); 2].map(|()| 2 + (5.0 * rng.random::<f64>()) as usize);
    let radius = pitch * if rng.random::<f64>() < 0.5 { 0.3 } else { 0.15 + 0.27 * rng.random::<f64>() };
    let has_equal_radii = rng.random::<f64>() < 0.7;
    let angle = [20.0, 30.0, 45.0, 90.0 * rng.random::<f64>()][(4.0 * rng.random::<f64>()) as usize % 4];
    let (sin, cos) = f64::to_radians(angle).sin_cos();
    let flat = if is_hexagonal { 0.75_f64.sqrt() } else { 1.0 };
    let size = [columns as f64 * pitch, rows as f64 * pitch * flat];
    let site = |i: i32, j: i32| {
        let by = if is_hexagonal && j.rem_euclid(2) == 1 { 0.75 } else { 0.25 };
        let by = if is_hexagonal { by } else { 0.5 };
        let at = [(f64::from(i) + by) * pitch, (f64::from(j) + 0.5) * pitch * flat];
        if is_turned { [cos * at[0] - sin * at[1], sin * at[0] + cos * at[1]] } else { at }
    };
    let reach = if is_turned { 2 * (columns + rows) as i32 } else { 0 };
    let mut grains = Vec::new();
    for (i, j) in (-reach..columns as i32 + reach).flat_map(|i| (-reach..rows as i32 + reach).map(move |j| (i, j))) {
        let at = site(i, j);
        let is_inside = (0..2).all(|k| at[k] > radius * 1.2 && at[k] < size[k] - radius * 1.2);
        if is_inside {
            let center = at.map(|x| error.of(x, pitch, rng));
            let radius = if has_equal_radii { radius } else { error.of(radius, pitch, rng) };
            grains.push(Grain::Disc(center, radius));
        }
    }
    if grains.is_empty() {
        grains.push(Grain::Disc(size.map(|x| 0.5 * x), radius));
    }
    (size, grains)
}

/// Grains at random places, as far apart as their circles of equal radius allow.
fn pack(rng: &mut ChaCha8Rng, grain: impl Fn([f64; 2], f64, &mut ChaCha8Rng) -> Grain) -> ([f64; 2], Vec<Grain>) {
    let size = [1.0, [0.7, 1.0, 1.3][(3.0 * rng.random::<f64>()) as usize % 3]];
    let radius = [0.05, 0.07, 0.1][(3.0 * rng.random::<f64>()) as usize % 3];
    let decimals = [4, 6, 16][(3.0 * rng.random::<f64>()) as usize % 3];
    let mut places: Vec<[f64; 2]> = Vec::new();
    for _ in 0..400 {
        let place = [0, 1].map(|i: usize| size[i] * rng.random::<f64>());
        let place = place
            .map(|x| if decimals < 16 { (x * 10.0_f64.powi(decimals)).round() / 10.0_f64.powi(decimals) } else { x });
        let is_free = |other: &[f64; 2]| (other[0] - place[0]).hypot(other[1] - place[1]) > 2.15 * radius;
        let is_inside = (0..2).all(|i| place[i] > 1.1 * radius && place[i] < size[i] - 1.1 * radius);
        if places.iter().all(is_free) && is_inside {
            places.push(place);
        }
    }
    (size, places.into_iter().map(|place| grain(place, radius, rng)).collect())
}
