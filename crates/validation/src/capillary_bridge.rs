//! A capillary bridge between two discs (C9 of the benchmarks), compared with its closed form.

use super::disc_pair::disc_pair;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::{DiscOf, Subject};

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let [a, b, ..] = s.discs else { return vec![] };
    let axis = (b.center - a.center).normalize();
    let middle = 0.5 * (a.center + b.center);
    let good = || s.observed.lines_with_angle();
    let filling = |disc: DiscOf, axis: Vec2| {
        let near = move |x: Vec2| ((x - disc.center).norm() - disc.radius).abs() < 0.1 * disc.radius;
        good().filter(move |l| near(l.position)).map(move |l| (l.position - disc.center).angle(&axis).to_degrees())
    };
    let angles: Vec<f64> = filling(*a, axis).chain(filling(*b, -axis)).collect();
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    let across = |x: &Vec2| (x - middle).perp(&axis).abs();
    let contour = || s.observed.interface.iter().flat_map(|line| &line.points);
    let neck = contour().map(across).fold(f64::INFINITY, f64::min);
    let exact = disc_pair(s).and_then(|pair| pair.bridge(s.observed.areas.wetting));
    let ratio = |found: f64, exact: Option<f64>| exact.map_or(f64::NAN, |exact| found / exact);
    let tension = s.flow.config.method.tension;
    let pressure = s.observed.capillary_pressure.value;
    vec![
        measure("filling-angle-deg", mean, "deg").by("contact points of the fitted circles from the line of centers"),
        measure("neck-half-width-m", neck, "m").by("smallest distance of the c = 0.5 contour from the line of centers"),
        measure("capillary-pressure-ratio", ratio(pressure, exact.map(|e| tension * e.curvature)), "")
            .by("capillary pressure over that of the exact bridge with the same area and the requested angle"),
        measure("filling-angle-ratio", ratio(mean.to_radians(), exact.map(|e| e.filling)), "")
            .by("filling angle over that of the exact bridge with the same area and the requested angle"),
    ]
}
