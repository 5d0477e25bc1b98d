//! Notes on a flow between a floor and a lid before it starts: throats for which the depth-averaged equations are inaccurate, layers at walls that the
//! spacing does not resolve, and wetting laws that do not apply to floor and lid.

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
    let layer = median_width(&widths).and_then(|median| unresolved_layer(sph, depth, narrowest, median));
    of_throats.into_iter().chain(layer).chain(law).collect()
}

/// The note if the spacing is so large that the flow through the narrowest throat is inaccurate: the flow slows down in a layer of the thickness λ = b √(α/12)
/// at its walls. The depth-averaged equation u − λ² u″ = const. on rows dx apart, no slip half a row beside the outer ones, has the displacement thickness
/// λ/√(1 + (dx/2λ)²) instead of λ, so that a throat w wide conducts (2λ/w)(1 − 1/√(1 + (dx/2λ)²))/(1 − 2λ/w) too much.
fn unresolved_layer(sph: &Sph, depth: f64, width: f64, median: f64) -> Option<String> {
    let profile = sph.profile_factor.unwrap_or_else(|| profile_factor(median / depth));
    let layer = depth * (profile / 12.0).sqrt();
    let (displaced, rows) = (2.0 * layer / width, sph.spacing / (2.0 * layer));
    let error = displaced * (1.0 - 1.0 / rows.hypot(1.0)) / (1.0 - displaced);
    (displaced < 1.0 && error > LARGEST_ERROR).then(|| {
        format!(
            "the layer beside walls in which the flow between floor and lid slows down is {layer:.2e} m thick, which a spacing of {:.2e} m does not \
             resolve: the narrowest throat, {width:.2e} m wide, conducts about {:.0} % too much",
            sph.spacing,
            100.0 * error
        )
    })
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
