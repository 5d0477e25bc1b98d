//! Generated drawings for properties of networks: lattices, as regular as rounding allows, and random packs.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A grain: a disc, or a ring of corners, counter-clockwise.
#[derive(Debug, Clone)]
pub enum Grain {
    Disc([f64; 2], f64),
    Ring(Vec<[f64; 2]>),
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
    Scene { size, grains, sides, flow, angle_deg, trapping }
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
