//! Menisci against closed forms and against root searches.

use super::*;
use crate::geometry::curve::Curve;
use crate::math::Vec2;

/// Two discs, the right one to the right of the left one; the advance is upwards.
fn discs(radii: [f64; 2], distance: f64, angles: [f64; 2]) -> Passage {
    let (l, r) = (Vec2::zeros(), Vec2::new(distance, 0.0));
    Passage::new(
        Wall::of_disc(l, radii[0], angles[0], r, Hand::Left),
        Wall::of_disc(r, radii[1], angles[1], l, Hand::Right),
    )
}

fn relative(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

#[test]
fn equal_discs_burst_at_the_tabulated_pressures() {
    // Benchmark C7, printed to five decimals.
    let table = [(0.5, [4.0, 3.80798, 3.26775, 2.49136, 1.33333]), (1.0, [2.0, 1.92014, 1.69707, 1.37980, 0.89443])];
    for (gap, pressures) in table {
        for (degrees, printed) in [0.0, 20.0, 40.0, 60.0, 90.0_f64].into_iter().zip(pressures) {
            let theta = degrees.to_radians();
            let l: f64 = 2.0 + gap;
            let exact = 1.0 / ((0.25 * l * l - theta.sin().powi(2)).sqrt() - theta.cos());
            let k = discs([1.0, 1.0], l, [theta; 2]).burst().unwrap().curvature;
            assert!((k - printed).abs() < 6e-6, "{gap} {degrees}: {k}");
            assert!(relative(k, exact) < 1e-12, "{gap} {degrees}: {k} {exact}");
        }
    }
}

#[test]
fn a_disc_over_a_plate_bursts_where_the_closed_form_says() {
    for degrees in [0.0, 30.0, 60.0, 90.0, 120.0, 150.0_f64] {
        let (r, w, theta) = (1.3, 0.4, degrees.to_radians());
        let disc = Wall::of_disc(Vec2::zeros(), r, theta, Vec2::new(5.0, 0.0), Hand::Left);
        let line = |a: f64, b: f64| WallPart {
            curve: Curve::Segment { a: Vec2::new(r + w, a), b: Vec2::new(r + w, b) },
            angle: theta,
        };
        // Solid on the left of a curve that runs downwards: at larger x.
        let plate = Wall {
            parts: vec![line(0.0, 50.0), line(-50.0, 0.0)]
                .into_iter()
                .map(|p| WallPart { curve: p.curve.reversed(), ..p })
                .rev()
                .collect(),
            behind: 1,
        };
        let k = Passage::new(disc, plate).burst().unwrap().curvature;
        let (s, c, q) = (theta.sin(), theta.cos(), 2.0 * r + w);
        // (r_m sin)² + 2 r_m cos (2R + w) = w (2R + w) in k = 1/r_m.
        let exact = (c * q + (c * c * q * q + s * s * w * q).sqrt()) / (w * q);
        assert!(relative(k, exact) < 1e-12, "{degrees}: {k} {exact}");
    }
}
