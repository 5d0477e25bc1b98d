//! Two equal discs among the solids, between which bridges and menisci have exact solutions.

use crate::analysis::laws::pores::DiscPair;
use crate::sph::measures::{DiscOf, Subject};

/// The first disc and the one nearest to it as a pair with the requested contact angle; none where their radii differ or nothing wets them.
#[must_use]
pub fn disc_pair(s: &Subject) -> Option<DiscPair> {
    let [a, rest @ ..] = s.discs else { return None };
    let distance = |b: &&DiscOf| (b.center - a.center).norm();
    let b = rest.iter().min_by(|b, c| distance(b).total_cmp(&distance(c)))?;
    let half_gap = 0.5 * distance(&b) - a.radius;
    let angle = s.flow.setting.method.wetting?.static_angle();
    ((a.radius - b.radius).abs() < 1e-9 * a.radius).then_some(DiscPair { radius: a.radius, half_gap, angle })
}
