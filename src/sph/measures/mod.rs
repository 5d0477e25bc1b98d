//! Final results: those that every run reports, and groups that a case asks for, one file each.

mod bridge;
mod every_run;
mod four_discs;
mod laplace_drop;
mod poiseuille;
mod sessile_drop;
mod taylor_green;

use crate::case::checked::MeasureSet;
use crate::solver::{Measure, Series};
use crate::sph::observe::Observation;
use crate::sph::projection::Flow;

/// A disc of the geometry, for measures that compare with closed forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscOf {
    /// Center in m.
    pub center: crate::math::Vec2,
    /// Radius in m.
    pub radius: f64,
}

/// What a measure may look at.
pub struct Subject<'a> {
    /// The flow at its end.
    pub flow: &'a Flow,
    /// What is seen of it.
    pub seen: &'a Observation,
    /// What was seen at time zero.
    pub start: &'a Observation,
    /// All records.
    pub series: &'a Series,
    /// The discs of the geometry.
    pub discs: &'a [DiscOf],
}

impl Subject<'_> {
    /// The two nearest discs as a pair with the requested contact angle, where there are two of one radius.
    fn disc_pair(&self) -> Option<crate::analysis::laws::pores::DiscPair> {
        let [a, rest @ ..] = self.discs else { return None };
        let distance = |b: &&DiscOf| (b.center - a.center).norm();
        let b = rest.iter().min_by(|b, c| distance(b).total_cmp(&distance(c)))?;
        let half_gap = 0.5 * distance(&b) - a.radius;
        let angle = self.flow.method.wetting?.static_angle();
        ((a.radius - b.radius).abs() < 1e-9 * a.radius).then_some(crate::analysis::laws::pores::DiscPair {
            radius: a.radius,
            half_gap,
            angle,
        })
    }
}

/// A measure; `uncertainty` in its unit.
fn measure(name: &str, value: f64, unit: &str, uncertainty: Option<f64>, method: &str) -> Measure {
    Measure { name: name.into(), value, unit: unit.into(), uncertainty, method: method.into() }
}

/// A group of measures.
type Group = fn(&Subject) -> Vec<Measure>;

/// All measures of a run.
#[must_use]
pub fn all(subject: &Subject, set: &MeasureSet) -> Vec<Measure> {
    let mut measures = every_run::measures(subject);
    let groups: [(bool, Group); 6] = [
        (set.sessile_drop, sessile_drop::measures),
        (set.laplace_drop, laplace_drop::measures),
        (set.poiseuille, poiseuille::measures),
        (set.taylor_green, taylor_green::measures),
        (set.capillary_bridge, bridge::measures),
        (set.four_discs, four_discs::measures),
    ];
    for (_, group) in groups.iter().filter(|(wanted, _)| *wanted) {
        measures.extend(group(subject));
    }
    measures
}
