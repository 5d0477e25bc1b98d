//! Capillary curves, curvature over area: of a meniscus over its swept area up to its event, and of a filling pore over its filled area.

use std::sync::Arc;

use super::terms::Terms;
use meniscus_geometry::interface::menisci::Passage;

/// Points of a curve; they are denser towards the event, where the curvature of a burst levels off.
const POINTS: usize = 17;
/// Capacity dA/dκ, in widths cubed, of a fully receded meniscus: so small that it hardly recedes further, and above 0, so that it can advance again.
const CLOSED: f64 = 1e-4;
/// Least area between two points in widths squared.
const LEAST: f64 = 1e-9;

/// A piecewise linear, rising curvature over area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CapillaryCurve {
    /// Swept area in m² since the chord of the gate, ascending.
    area: Vec<f64>,
    /// Curvature in the plane in 1/m, ascending.
    curvature: Vec<f64>,
    /// Total curvature in 1/m including that by floor and lid: capillary pressure over tension.
    total: Vec<f64>,
    /// Slope dκ/dA in 1/m³ before the first point.
    closed: f64,
}

impl CapillaryCurve {
    /// The stable menisci of a passage up to its event at the curvature `event` (1/m), between walls `width` (m) apart at the chord; `None`
    /// if no meniscus ever passes.
    pub(crate) fn new(passage: &Passage, event: f64, width: f64) -> Option<Self> {
        if !event.is_finite() || !(width > 0.0) {
            return None;
        }
        let lowest = passage.lowest()?.curvature.min(event);
        let (mut area, mut curvature): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        for point in 0..POINTS {
            let left = 1.0 - point as f64 / (POINTS - 1) as f64;
            let k = event - (event - lowest) * left * left;
            let Some(swept) = passage.at(k).map(|meniscus| passage.swept_area(&meniscus)) else { continue };
            let is_next = area.last().is_none_or(|&before| swept > before + LEAST * width * width)
                && curvature.last().is_none_or(|&last| k > last);
            if is_next {
                area.push(swept);
                curvature.push(k);
            }
        }
        // If the last menisci differ only by rounding, the event is at the last one kept.
        if let Some(last) = curvature.last_mut() {
            *last = event;
        }
        (!area.is_empty()).then(|| Self {
            area,
            total: curvature.clone(),
            curvature,
            closed: 1.0 / (CLOSED * width.powi(3)),
        })
    }

    /// The same with the curvature by floor and lid.
    pub(crate) fn between(mut self, terms: &Terms) -> Arc<Self> {
        self.total.iter_mut().for_each(|curvature| *curvature = terms.with_depth(*curvature));
        Arc::new(self)
    }

    /// Curvature in the plane in 1/m at a swept area in m².
    pub(crate) fn curvature(&self, area: f64) -> f64 {
        self.at(&self.curvature, area).0
    }

    /// Total curvature in 1/m at a swept area in m², and its derivative with respect to the area in 1/m³.
    pub(crate) fn resistance(&self, area: f64) -> (f64, f64) {
        self.at(&self.total, area)
    }

    fn at(&self, curvature: &[f64], area: f64) -> (f64, f64) {
        if self.area.len() < 2 || area < self.area[0] {
            return (curvature[0] + self.closed * (area - self.area[0]), self.closed);
        }
        let end = self.area.partition_point(|&a| a <= area).clamp(1, self.area.len() - 1);
        let slope = self.slope(curvature, end);
        (curvature[end] + slope * (area - self.area[end]), slope)
    }

    /// The swept area v in m² at which c (v − `from`) plus the total curvature is `drive`, with c in 1/m³ and the drive in 1/m.
    pub(crate) fn balanced_area(&self, from: f64, c: f64, drive: f64) -> f64 {
        let need = |point: usize| c * (self.area[point] - from) + self.total[point];
        let (mut low, mut high) = (0, self.area.len());
        while low < high {
            let middle = (low + high) / 2;
            if need(middle) <= drive {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        let (point, slope) = match low {
            0 => (0, self.closed),
            _ if self.area.len() < 2 => (0, self.closed),
            _ => (low.min(self.area.len() - 1), self.slope(&self.total, low.min(self.area.len() - 1))),
        };
        self.area[point] + (drive - need(point)) / (c + slope)
    }

    fn slope(&self, curvature: &[f64], end: usize) -> f64 {
        (curvature[end] - curvature[end - 1]) / (self.area[end] - self.area[end - 1])
    }

    /// Swept area in m² at a curvature in 1/m, at most that at the event.
    pub(crate) fn area(&self, curvature: f64) -> f64 {
        let end = self.curvature.partition_point(|&k| k < curvature);
        if end == self.curvature.len() {
            self.end().0
        } else if end == 0 {
            self.area[0] + (curvature - self.curvature[0]) / self.closed
        } else {
            self.area[end] + (curvature - self.curvature[end]) / self.slope(&self.curvature, end)
        }
    }

    /// Swept area in m² and curvature in 1/m at the event.
    pub(crate) fn end(&self) -> (f64, f64) {
        let last = self.area.len() - 1;
        (self.area[last], self.curvature[last])
    }

    /// Swept area in m² and curvature in 1/m of the fully receded meniscus.
    pub(crate) fn start(&self) -> (f64, f64) {
        (self.area[0], self.curvature[0])
    }

    /// The curve of a filling pore through points of ascending area in m² and curvature in 1/m: constant before the first, of the slope `last`
    /// in 1/m³ past the last.
    pub(crate) fn of_body(points: &[(f64, f64)], last: f64) -> Self {
        let (mut area, mut curvature): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        if let (Some(&a), Some(&k)) = (area.last(), curvature.last()) {
            area.push(a + 1.0 / last);
            curvature.push(k + 1.0);
        }
        Self { area, total: curvature.clone(), curvature, closed: 0.0 }
    }

    /// A constant curvature in 1/m between two areas in m², of a meniscus past walls `width` (m) apart; it does not recede below the first area.
    pub(crate) fn level(area: [f64; 2], curvature: f64, width: f64) -> Self {
        let curvature = vec![curvature; 2];
        Self { area: area.to_vec(), total: curvature.clone(), curvature, closed: 1.0 / (CLOSED * width.powi(3)) }
    }

    /// The curve of a filling pore of a constant curvature in 1/m.
    pub(crate) fn constant(curvature: f64) -> Self {
        Self { area: vec![0.0], curvature: vec![curvature], total: vec![curvature], closed: 0.0 }
    }

    /// Scale of errors of areas in m².
    pub(crate) fn scale(&self) -> f64 {
        let range = self.end().0 - self.area[0];
        range.max(self.end().1.abs().max(f64::MIN_POSITIVE) / self.closed)
    }
}

/// The meniscus past its event in a pore at the outlet, up to its touch of the outlet side.
#[derive(Debug, Clone)]
pub(super) struct Reach {
    /// Area in m² swept since the chord of its gate when it touches.
    pub(super) area: f64,
    /// Its capillary curve until then.
    pub(super) curve: Arc<CapillaryCurve>,
}
