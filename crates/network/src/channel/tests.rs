//! Channels against bipolar coordinates, close cylinders, a slit in a screen and a round pore.

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;

/// Two discs or corners below and above the origin with a gap `w`, up to the center of a pore.
fn resistance([below, above]: [f64; 2], w: f64, center: Vec2) -> f64 {
    let wall = |radius: f64, side: f64| {
        let begin = Vec2::new(0.0, 0.5 * w * side);
        let disc = Vec2::new(0.0, (0.5 * w + radius) * side);
        let curve = Curve::Arc { center: disc, radius, start: -FRAC_PI_2 * side, sweep: PI * side };
        let pieces = [WallPiece::part_of(&Curve::circle(disc, radius), curve, 0)];
        Wall::new(if radius > 0.0 { &pieces } else { &[] }, side, begin, Vec2::x())
    };
    Channel { walls: [wall(below, -1.0), wall(above, 1.0)], along: Vec2::x(), depth: None }.resistance(center)
}

/// The same up to the arc of a given t = tan(σ/2), with the middle of that arc, in bipolar coordinates, in which walls and arcs are
/// lines: h = a (1 + t²)(A1 + A2)/t with A = atan(k t), k = a/(R + √(R² + a²)).
fn in_bipolar_coordinates([below, above]: [f64; 2], w: f64, end: f64) -> (f64, Vec2) {
    let d = below + above + w;
    let squares = d * d - below * below - above * above;
    let a = (squares * squares - 4.0 * (below * above).powi(2)).sqrt() / (2.0 * d);
    let angles = |t: f64| [below, above].map(|radius| (t * a / (radius + radius.hypot(a))).atan());
    let middle = |t: f64| (0.5 * (angles(t)[1] - angles(t)[0])).tan();
    // The midpoint rule.
    let count = 10_000;
    let step = end / f64::from(count);
    let part = |i: u32| {
        let t = (f64::from(i) + 0.5) * step;
        let m = middle(t);
        let h = a * (1.0 + t * t) * angles(t).iter().sum::<f64>() / t;
        12.0 / h.powi(3) * a * (1.0 - (m / t).powi(2)) / (1.0 + m * m) * step
    };
    let m = middle(end);
    let q = m / end;
    let chord = 0.5 * (above.hypot(a) - above - below.hypot(a) + below);
    let x = a * end * (1.0 - q * q) / (1.0 + m * m);
    let y = a * q * (1.0 + end * end) / (1.0 + m * m) - chord;
    ((0..count).map(part).sum(), Vec2::new(x, y))
}

#[test]
fn two_discs_of_any_radii_resist_as_in_bipolar_coordinates() {
    for radii in [[1.0, 1.0], [1.0, 0.4], [0.2, 3.0], [1.0, 0.0], [0.0, 0.0]] {
        for (w, end) in [(0.01, 1.0), (0.1, 0.7), (1.0, 0.5)] {
            let (expected, center) = in_bipolar_coordinates(radii, w, end);
            let found = resistance(radii, w, center);
            // Fourth order in the step length.
            assert!((found / expected - 1.0).abs() < 2e-4, "{radii:?}, {w}: {found} and {expected}");
        }
    }
}

#[test]
fn no_channel_takes_many_steps_wherever_its_walls_end() {
    // Walls that end at any angle, pores at any distance.
    for k in 1..400 {
        let sweep = 1.5 * f64::from(k) / 400.0;
        for j in 1..50 {
            let wall = |side: f64, sweep: f64| {
                let center = Vec2::new(0.0, 1.04 * side);
                let curve = Curve::Arc { center, radius: 1.0, start: -FRAC_PI_2 * side, sweep: sweep * side };
                let piece = WallPiece::part_of(&Curve::circle(center, 1.0), curve, 0);
                Wall::new(&[piece], side, Vec2::new(0.0, 0.04 * side), Vec2::x())
            };
            let channel = Channel { walls: [wall(-1.0, sweep), wall(1.0, 1.6)], along: Vec2::x(), depth: None };
            let (resistance, steps) = channel.integral(Vec2::new(0.03 * f64::from(j), 0.1));
            assert!(resistance > 0.0 && steps < 200, "{sweep}, {j}: {steps} steps");
        }
    }
}

#[test]
fn narrow_throats_resist_as_close_cylinders() {
    // 1/g = 4.5 π √2/(w^(5/2) √(1/R1 + 1/R2)) for w far below R, to the order w/R.
    for w in [1e-2, 1e-3] {
        let found = 2.0 * resistance([1.0, 0.5], w, Vec2::new(0.5, 0.0));
        let leading = 4.5 * PI * 2.0_f64.sqrt() / (w.powf(2.5) * 3.0_f64.sqrt());
        assert!((found / leading - 1.0).abs() < w, "{w}: {}", found / leading - 1.0);
    }
}

#[test]
fn a_slit_in_a_thin_screen_resists_as_stokes_flow_through_it() {
    // Exact is g = π w²/32 (Hasimoto 1958). Walls that turn about corners, back to back, are the farthest from lubrication.
    let v = Vec2::new;
    let side = |sign: f64| {
        let curve = Curve::Segment { a: v(0.0, sign * 0.5), b: v(0.0, sign * 1e4) };
        Wall::new(&[WallPiece::part_of(&curve, curve, 0)], sign, v(0.0, sign * 0.5), v(1.0, 0.0))
    };
    let resistance =
        2.0 * Channel { walls: [side(-1.0), side(1.0)], along: Vec2::x(), depth: None }.resistance(v(1e3, 0.0));
    let share = PI / 32.0 * resistance;
    assert!((share - 1.0).abs() < 0.1, "{share}");
}

#[test]
fn a_round_pore_behind_a_slit_resists_as_its_arcs_say() {
    // The slit w = 2 sin γ0 in the circle of radius 1 around the origin; ends at the polar angles π ± γ. At the corners
    // 12/h³ dl = 3 (sin α/α)³/cos²(α/2) dα/w², in the pore h = 2 γ' tan γ with γ' = π/2 - γ = α and the middle at -tan(γ'/2).
    let start = 0.2_f64;
    let w = 2.0 * start.sin();
    let wall = |side: f64| {
        let curve = Curve::Arc { center: Vec2::zeros(), radius: 1.0, start: PI - side * start, sweep: -side * 2.0 };
        let piece = WallPiece::part_of(&curve, curve, 0);
        Wall::new(&[piece], side, curve.point(0.0), Vec2::x())
    };
    let found = Channel { walls: [wall(-1.0), wall(1.0)], along: Vec2::x(), depth: None }.resistance(Vec2::zeros());
    let count = 100_000;
    let sum = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| -> f64 {
        let step = (to - from) / f64::from(count);
        (0..count).map(|i| f(from + (f64::from(i) + 0.5) * step) * step).sum()
    };
    let alpha = FRAC_PI_2 - start;
    let corners = sum(0.0, alpha, &|a| 3.0 * (a.sin() / a).powi(3) / ((0.5 * a).cos() * w).powi(2));
    let pore = sum(0.0, alpha, &|a| 6.0 / (2.0 * a / a.tan()).powi(3) / (0.5 * a).cos().powi(2));
    let expected = corners + pore;
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} and {expected}");
}

#[test]
fn a_channel_with_many_small_bends_resists_as_a_round_one() {
    let v = Vec2::new;
    let [radius, half] = [3.0, 0.5];
    let point = |sign: f64, angle: f64| v(radius * angle.sin(), sign * (half + radius * (1.0 - angle.cos())));
    let walls = |count: u32| {
        [-1.0, 1.0].map(|sign| {
            let at = |i: u32| point(sign, 0.6 * f64::from(i) / f64::from(count));
            let pieces: Vec<WallPiece> = (0..count)
                .map(|i| Curve::Segment { a: at(i), b: at(i + 1) })
                .map(|curve| WallPiece::part_of(&curve, curve, 0))
                .collect();
            Wall::new(&pieces, sign, at(0), v(1.0, 0.0))
        })
    };
    let round = resistance([radius; 2], 2.0 * half, v(1.2, 0.0));
    let errors: Vec<f64> = [8, 32]
        .map(|count| {
            (Channel { walls: walls(count), along: Vec2::x(), depth: None }.resistance(v(1.2, 0.0)) / round - 1.0).abs()
        })
        .into();
    // Vertices on the wall: second order.
    assert!(errors[1] < 1e-3 && errors[1] < 0.2 * errors[0], "{errors:?}");
}
