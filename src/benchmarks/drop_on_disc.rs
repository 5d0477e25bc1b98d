//! A drop on a disc without gravity (C10 of the benchmarks), compared with its closed form.

use crate::analysis::laws::drops::drop_on_disc;
use crate::solver::Measure;
use crate::sph::measures::{Group, Subject, measure};

/// Measures of its table `[sph.measure.drop-on-disc]`.
pub const GROUP: Group = Group::of(measures);

fn measures(s: &Subject) -> Vec<Measure> {
    let (Some(disc), Some(wetting)) = (s.discs.first(), s.flow.setting.method.wetting) else { return vec![] };
    let ends: Vec<_> = s.seen.lines_with_angle().collect();
    let half = match ends[..] {
        [a, b] => 0.5 * (a.position - disc.center).angle(&(b.position - disc.center)),
        _ => f64::NAN,
    };
    let contour = s.seen.interface.iter().flat_map(|line| &line.points);
    let height = contour.map(|x| (x - disc.center).norm() - disc.radius).fold(f64::NAN, f64::max);
    let exact = drop_on_disc(s.seen.areas.wetting, wetting.static_angle(), disc.radius);
    let ratio = |found: f64, exact: Option<f64>| exact.map_or(f64::NAN, |exact| found / exact);
    vec![
        measure(
            "half-angle-deg",
            half.to_degrees(),
            "deg",
            None,
            "half of the angle between the contact points of the fitted circle, seen from the center of the disc",
        ),
        measure(
            "half-angle-ratio",
            ratio(half, exact.map(|e| e.half_angle)),
            "",
            None,
            "half-angle over that of the exact drop with the same area and the requested angle",
        ),
        measure(
            "height-ratio",
            ratio(height, exact.map(|e| e.height)),
            "",
            None,
            "largest distance of the c = 0.5 contour from the disc over that of the exact drop",
        ),
    ]
}
