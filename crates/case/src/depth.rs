//! `depth` of `[geometry]`: which models support it, and what it requires.

use super::case_file::{Model, RawCase};
use super::network::films;
use super::side::SIDES;
use super::wetting::PatchedWall;
use meniscus_core::input::{Checker, Problem};
use meniscus_geometry::spec::GeometrySpec;

/// Largest ratio of the size of a domain to the depth, and of the depth to the size.
const MOST: f64 = 1e6;

const KEY: &str = "geometry.depth";

/// Passes the depth to the model; refuses a depth that the model does not support or that does not fit the geometry, and floors and lids without one.
pub(super) fn depth(
    checker: &mut Checker,
    depth: Option<f64>,
    model: Option<&mut Model>,
    geometry: Option<&GeometrySpec>,
    has_wetting_table: bool,
) {
    let (table, patches) = match model {
        Some(Model::Sph(sph)) => {
            sph.depth = depth;
            // A wetting table without a model is reported separately.
            if depth.is_some() && sph.acting_tension() > 0.0 && sph.wetting_model.is_none() && !has_wetting_table {
                let message = "an interface between floor and lid is curved by their contact angles, and none is given";
                checker.refuse("sph.wetting", message, "add the table [sph.wetting.young]");
            }
            if depth.is_none() && sph.profile_factor.is_some() {
                let message = "it belongs to a flow between a floor and a lid, and there is no depth";
                checker.refuse("sph.profile-factor", message, "add depth = 50e-6 to [geometry], or leave this out");
            }
            ("sph", &sph.wetting_patches[..])
        }
        Some(Model::Network(network)) => {
            films(checker, network, depth);
            ("network", network.interface.as_ref().map_or(&[][..], |interface| &interface.patches))
        }
        Some(Model::ThinFilm(_)) if depth.is_some() => {
            let message = "a thin film lies on one wall, and a depth is the distance between a floor and a lid";
            return checker.refuse(KEY, message, "leave it out");
        }
        _ => return,
    };
    let Some(depth) = depth else {
        let on_plates = patches.iter().position(|patch| matches!(patch.on, PatchedWall::Plate(_)));
        if let Some(index) = on_plates {
            let message = "floor and lid need a depth, and none is given";
            checker.refuse(
                format!("{table}.wetting.patches[{index}].plate"),
                message,
                "add depth = 50e-6 to [geometry]",
            );
        }
        return;
    };
    checker.problems.extend(geometry.and_then(|geometry| implausible_depth(depth, geometry)));
}

/// Refuses rates of a case whose unit is not that of its geometry, with or without a depth.
pub(super) fn refuse_rates(checker: &mut Checker, raw: &RawCase, has_depth: bool) {
    let dynamic = raw.network.as_ref().and_then(|network| network.dynamic.as_ref());
    let of_network = dynamic.and_then(|dynamic| dynamic.rate).map(|rate| ("network.dynamic.rate".to_owned(), rate));
    let sides = raw.sph.as_ref().and_then(|sph| sph.sides.as_ref()).and_then(|sides| sides.open.as_ref());
    let of_sides = sides.into_iter().flat_map(|open| {
        let tables = SIDES.iter().zip([&open.left, &open.right, &open.bottom, &open.top]);
        tables
            .filter_map(|(side, table)| Some((format!("sph.sides.open.{side}.flow-rate"), table.as_ref()?.flow_rate?)))
    });
    for (path, rate) in of_network.into_iter().chain(of_sides) {
        rate.refuse_other_unit(checker, &path, has_depth);
    }
}

/// What is wrong with a depth in m that does not fit a geometry.
pub fn implausible_depth(depth: f64, geometry: &GeometrySpec) -> Option<Problem> {
    let size = (geometry.max[0] - geometry.min[0]).max(geometry.max[1] - geometry.min[1]);
    // The command line accepts any number.
    let is_of_it = depth <= MOST * size && depth * MOST >= size;
    let message = format!("the depth of {depth:e} m is implausible for a domain of {size:e} m");
    (!is_of_it).then(|| Problem::new(KEY, message, "give it in m: 50 um are 50e-6; leave it out for a plane"))
}
