//! The wall of a cosine constriction as a smooth chain of circular arcs (biarcs), which makes its distance cheap and its normal continuous.
//!
//! Each span of the curve is replaced by two arcs that share its end points and tangents. The number of spans is doubled
//! until the chain lies within 1e-8 of the constriction's length of the curve.

use std::f64::consts::TAU;

use crate::curve::Curve;
use crate::spec::ThroatCosine;
use meniscus_core::math::Vec2;

/// Maximum distance between chain and curve over the length of the constriction.
const ACCURACY: f64 = 1e-8;

/// Number of spans of the first and of the last attempt, whatever the accuracy.
const SPANS: (usize, usize) = (16, 4096);

/// Half the width (m) and its slope at `s` (m) along the axis; for the formula see [`ThroatCosine`].
pub(crate) fn half_width(throat: &ThroatCosine, s: f64) -> (f64, f64) {
    if s.abs() >= 0.5 * throat.length {
        return (0.5 * throat.width, 0.0);
    }
    let narrowing = 0.25 * (throat.width - throat.throat);
    let phase = TAU * s / throat.length;
    (0.5 * throat.width - narrowing * (1.0 + phase.cos()), narrowing * TAU / throat.length * phase.sin())
}

/// The upper wall from s = −`reach` to s = `reach` in m, about the middle of the throat; the solid above is on its left.
pub(crate) fn upper_wall(throat: &ThroatCosine, reach: f64) -> Vec<Curve> {
    let end = 0.5 * throat.length;
    let height = 0.5 * throat.width;
    let mut wall = Vec::new();
    if reach > end {
        wall.push(Curve::Segment { a: Vec2::new(-reach, height), b: Vec2::new(-end, height) });
    }
    wall.extend(constriction(throat));
    if reach > end {
        wall.push(Curve::Segment { a: Vec2::new(end, height), b: Vec2::new(reach, height) });
    }
    wall
}

/// The curved part, from −length/2 to length/2.
fn constriction(throat: &ThroatCosine) -> Vec<Curve> {
    let end = 0.5 * throat.length;
    if throat.throat >= throat.width {
        let height = 0.5 * throat.width;
        return vec![Curve::Segment { a: Vec2::new(-end, height), b: Vec2::new(end, height) }];
    }
    let mut spans = SPANS.0;
    loop {
        let chain = biarcs(throat, spans);
        if spans >= SPANS.1 || deviation(throat, &chain, spans) < ACCURACY * throat.length {
            return chain;
        }
        spans *= 2;
    }
}

fn node(throat: &ThroatCosine, i: usize, spans: usize) -> (Vec2, Vec2) {
    let s = throat.length * (i as f64 / spans as f64 - 0.5);
    let (height, slope) = half_width(throat, s);
    (Vec2::new(s, height), Vec2::new(1.0, slope).normalize())
}

fn biarcs(throat: &ThroatCosine, spans: usize) -> Vec<Curve> {
    let mut chain = Vec::with_capacity(2 * spans);
    for i in 0..spans {
        let (p, t) = node(throat, i, spans);
        let (q, w) = node(throat, i + 1, spans);
        // Equal tangent lengths d: |p + d t − (q − d w)| = 2 d, a quadratic in d.
        let v = q - p;
        let (linear, quadratic) = (v.dot(&(t + w)), 2.0 * (1.0 - t.dot(&w)));
        let d = v.norm_squared() / (linear + (linear * linear + quadratic * v.norm_squared()).sqrt());
        let joint = 0.5 * ((p + t * d) + (q - w * d));
        chain.push(Curve::arc_from_tangent(p, t, joint));
        chain.push(Curve::arc_from_tangent(q, -w, joint).reversed());
    }
    chain
}

/// Maximum distance of sampled points of the curve from the two arcs of their span, in m.
fn deviation(throat: &ThroatCosine, chain: &[Curve], spans: usize) -> f64 {
    const SAMPLES: usize = 8;
    let mut worst: f64 = 0.0;
    for (i, pair) in chain.chunks(2).enumerate() {
        for k in 1..SAMPLES {
            let s = throat.length * ((i as f64 + k as f64 / SAMPLES as f64) / spans as f64 - 0.5);
            let x = Vec2::new(s, half_width(throat, s).0);
            let nearest = pair.iter().map(|arc| (arc.project(x).point - x).norm()).fold(f64::INFINITY, f64::min);
            worst = worst.max(nearest);
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    fn throat() -> ThroatCosine {
        ThroatCosine { center: [0.0; 2], width: 1.0, throat: 0.3, length: 2.0, rotation_deg: 0.0 }
    }

    #[test]
    fn the_chain_of_arcs_follows_the_cosine_and_has_no_kinks() {
        let wall = upper_wall(&throat(), 3.0);
        assert!(wall.len() > 10 && wall.len() < 1000, "{} pieces", wall.len());
        for pair in wall.windows(2) {
            assert!((pair[0].point(1.0) - pair[1].point(0.0)).norm() < 1e-12);
            assert!((pair[0].tangent(1.0) - pair[1].tangent(0.0)).norm() < 1e-6);
        }
        for piece in &wall {
            for u in [0.0, 0.3, 0.7] {
                let x = piece.point(u);
                assert!((x.y - half_width(&throat(), x.x).0).abs() < 1e-7);
            }
        }
    }
}
