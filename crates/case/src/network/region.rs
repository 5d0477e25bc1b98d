//! `[network.region]`, the region of saturations and porosity.

use super::table::{RawNetwork, RegionExtent};
use crate::side::{Side, Sides};
use meniscus_core::input::Checker;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::Body;
use meniscus_geometry::spec::{GeometrySpec, SolidSide};

/// A rectangle of the domain.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Region {
    /// Lower left corner in m.
    pub min: [f64; 2],
    /// Upper right corner in m.
    pub max: [f64; 2],
    /// Whether it is that of the pack: the whole domain if this has no pore apart from manifolds.
    #[serde(skip)]
    pub is_pack: bool,
}

impl Region {
    /// The same as a box.
    pub fn bounds(self) -> Bounds {
        Bounds { min: self.min.into(), max: self.max.into() }
    }
}

/// Checks `[network.region]`; `geometry` is missing if it was wrong.
pub(super) fn region(
    checker: &mut Checker,
    raw: &RawNetwork,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Option<Region> {
    const KEY: &str = "network.region";
    let given = raw.region.as_ref()?;
    if raw.dynamic.is_some() {
        let message = "a region belongs to quasi-static displacement, and [network.dynamic] is given";
        checker.refuse(KEY, message, "leave out [network.region], or [network.dynamic]");
        return None;
    }
    let corners = [given.min.is_some(), given.max.is_some()];
    if given.extent.is_some() && corners.contains(&true) {
        let message = "both `extent` and a corner are given, and one follows from the other";
        checker.refuse("network.region.extent", message, "leave out `extent`, or `min` and `max`");
        return None;
    }
    let geometry = geometry?;
    let domain = Bounds { min: geometry.min.into(), max: geometry.max.into() };
    match given.extent {
        Some(RegionExtent::Pack) => return pack(checker, geometry, domain, sides?),
        Some(RegionExtent::Domain) => return None,
        None => {}
    }
    let min = checker.require("network.region.min", given.min, "min = [1.0e-3, 0.0] # m, or extent = \"pack\"")?;
    let max = checker.require("network.region.max", given.max, "max = [5.0e-3, 4.0e-3] # m")?;
    let extent = format!(
        "the domain reaches from [{:e}, {:e}] to [{:e}, {:e}] m",
        domain.min.x, domain.min.y, domain.max.x, domain.max.y
    );
    if (0..2).any(|axis| min[axis].partial_cmp(&max[axis]) != Some(std::cmp::Ordering::Less)) {
        let message = format!("expected `max` above and to the right of `min`, found {min:?} and {max:?}");
        checker.refuse("network.region.max", message, extent);
        return None;
    }
    // Corners may have been rounded in the file.
    let slack = 1e-9 * domain.size().max();
    let is_inside = (0..2).all(|axis| min[axis] >= domain.min[axis] - slack && max[axis] <= domain.max[axis] + slack);
    if !is_inside {
        let message = format!("expected a region inside of the domain, found one from {min:?} to {max:?} m");
        checker.refuse(KEY, message, extent);
        return None;
    }
    Some(Region { min, max, is_pack: false })
}

/// From the first to the last grain in the direction from inlet to outlet, across the whole domain; along both axes without an inlet.
fn pack(checker: &mut Checker, geometry: &GeometrySpec, domain: Bounds, sides: &Sides) -> Option<Region> {
    let inlet = sides.each().iter().position(|&side| side == Side::Inlet);
    let spans = |bounds: &Bounds| {
        (0..2).any(|axis| bounds.min[axis] <= domain.min[axis] && bounds.max[axis] >= domain.max[axis])
    };
    let bodies = geometry.shapes.iter().flat_map(|shape| Body::of(shape, 0, domain));
    let grains = bodies.filter(|body| !body.is_endless() && !spans(&body.bounds)).map(|body| body.bounds);
    let grains: Vec<Bounds> = if geometry.solid == SolidSide::Inside { grains.collect() } else { Vec::new() };
    let ends = grains.into_iter().reduce(|a, b| Bounds { min: a.min.inf(&b.min), max: a.max.sup(&b.max) });
    let Some(ends) = ends else {
        let message = "there is no grain: no shape is solid inside and ends within the domain along both axes";
        let help = "give the corners of the region, min = [x, y] and max = [x, y] in m";
        checker.refuse("network.region.extent", message, help);
        return None;
    };
    let end = |of_grain: Vec2, of_domain: Vec2| {
        [0, 1].map(|axis| if inlet.is_none_or(|side| side / 2 == axis) { of_grain[axis] } else { of_domain[axis] })
    };
    let (min, max) = (end(ends.min.sup(&domain.min), domain.min), end(ends.max.inf(&domain.max), domain.max));
    Some(Region { min, max, is_pack: true })
}

/// The pack of a drawing with manifolds: pore space between the inlet and the first grain, or between the last one and the outlet.
pub(crate) fn pack_between_manifolds(sides: &Sides, geometry: &GeometrySpec) -> Option<Region> {
    let domain = Bounds { min: geometry.min.into(), max: geometry.max.into() };
    let pack = pack(&mut Checker::default(), geometry, domain, sides)?;
    let is_inside = Bounds::area(&pack.bounds()) < domain.area() * (1.0 - ROUNDING);
    is_inside.then_some(pack)
}

/// Relative rounding error of the extent of a pack.
const ROUNDING: f64 = 1e-9;
