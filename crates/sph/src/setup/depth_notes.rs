//! Notes on a flow between a floor and a lid before it starts: throats for which the depth-averaged equations are inaccurate, and wetting laws that
//! do not apply to floor and lid.

use super::method::median_width;
use meniscus_case::Sph;
use meniscus_geometry::Geometry;
use meniscus_geometry::interface::depth::{duct_error, implausible, profile_factor};
use meniscus_geometry::throats::throats;
use meniscus_wetting::Wetting;

/// Relative error of the flow through a throat above which a note is issued.
const LARGEST_ERROR: f64 = 0.05;

/// The notes; none in the plane.
pub fn notes(sph: &Sph, geometry: &Geometry) -> Vec<String> {
    let Some(depth) = sph.depth else { return Vec::new() };
    let widths: Vec<f64> = throats(geometry).iter().map(|throat| throat.width).collect();
    let law = sph.wetting_model.filter(|_| sph.acting_tension() > 0.0).and_then(|law| on_walls_only(&law));
    let [Some(&narrowest), Some(&widest)] = [widths.first(), widths.last()] else { return law.into_iter().collect() };
    let of_throats = implausible(depth, narrowest, widest).or_else(|| unlike(sph, depth, &widths, [narrowest, widest]));
    of_throats.into_iter().chain(law).collect()
}

/// The note if throats are so much narrower or wider than the median one that a single profile factor cannot describe the flow in both.
fn unlike(sph: &Sph, depth: f64, widths: &[f64], ends: [f64; 2]) -> Option<String> {
    let profile = sph.profile_factor.or_else(|| Some(profile_factor(median_width(widths)? / depth)))?;
    let error = |width: &f64| duct_error(width / depth, profile);
    let worst = ends.into_iter().max_by(|a, b| error(a).abs().total_cmp(&error(b).abs()))?;
    (error(&worst).abs() > LARGEST_ERROR).then(|| {
        format!(
            "the depth-averaged flow through a throat of {worst:.3e} m, {:.2} depths wide, is {:+.0} % off that of a duct: one profile over the depth (factor \
             {profile:.3}) cannot fit throats of {:.2} to {:.2} depths; the network has the flow of ducts in each",
            worst / depth,
            100.0 * error(&worst),
            ends[0] / depth,
            ends[1] / depth
        )
    })
}

/// The note on a law with dynamic contact angles: floor and lid keep the static angle.
fn on_walls_only(law: &Wetting) -> Option<String> {
    (!law.is_static()).then(|| {
        format!(
            "the law [sph.wetting.{}] acts on lines along the walls; floor and lid keep the static angle, {:.1} degrees unless a patch gives another one",
            law.table().key,
            law.static_angle().to_degrees()
        )
    })
}
