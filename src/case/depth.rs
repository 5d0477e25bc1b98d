//! `depth` of `[geometry]`: which models know one, and what belongs to it.

use super::case_file::Model;
use super::network::refuse_films;
use super::wetting::PatchedWall;
use crate::geometry::spec::GeometrySpec;
use crate::input::{Checker, Problem};

/// Largest size of a domain over the depth, and of the depth over the domain.
const MOST: f64 = 1e6;

const KEY: &str = "geometry.depth";

/// Gives the model its depth; refuses one that it does not know or that is none of the geometry, and floors and lids without one.
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
            // A table without a model has a mistake of its own.
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
            refuse_films(checker, network, depth);
            ("network", network.interface.as_ref().map_or(&[][..], |interface| &interface.patches))
        }
        Some(Model::ThinFilm(_)) if depth.is_some() => {
            let message = "a thin film lies on one wall, and a depth is the distance of a floor and a lid";
            return checker.refuse(KEY, message, "leave it out");
        }
        _ => return,
    };
    let Some(depth) = depth else {
        let on_plates = patches.iter().position(|patch| matches!(patch.on, PatchedWall::Plate(_)));
        if let Some(index) = on_plates {
            let message = "floor and lid are those of a chip with a depth, and there is none";
            checker.refuse(
                format!("{table}.wetting.patches[{index}].plate"),
                message,
                "add depth = 50e-6 to [geometry]",
            );
        }
        return;
    };
    checker.problems.extend(geometry.and_then(|geometry| none_of(depth, geometry)));
}

/// What is wrong with a depth in m that is none of a geometry.
pub(crate) fn none_of(depth: f64, geometry: &GeometrySpec) -> Option<Problem> {
    let size = (geometry.max[0] - geometry.min[0]).max(geometry.max[1] - geometry.min[1]);
    // The command line gives any number.
    let is_of_it = depth <= MOST * size && depth * MOST >= size;
    let message = format!("the depth of {depth:e} m is none of a domain of {size:e} m");
    (!is_of_it).then(|| Problem::new(KEY, message, "give it in m: 50 um are 50e-6; leave it out for a plane"))
}
