//! Slips of units: numbers of which another unit is likely.

use meniscus_case::{Case, Model};
use meniscus_core::math::Vec2;

/// Numbers of which another unit is likely, each with the unit that is meant.
pub(crate) fn slips(case: &Case) -> Vec<String> {
    /// No liquid but a molten metal has more, in N/m.
    const STRONGEST: f64 = 1.0;
    /// In degrees: a right angle, and more, in radians.
    const SHARPEST: f64 = 3.2;
    let (tension, range) = match &case.model {
        Model::Sph(sph) => (sph.tension, sph.wetting_model.map(|law| law.hysteresis_range())),
        Model::Network(network) => {
            network.interface.as_ref().map_or((0.0, None), |it| (it.tension, Some(it.wetting_model.hysteresis_range())))
        }
        Model::ThinFilm(_) => return Vec::new(),
    };
    let mut slips = Vec::new();
    if tension > 0.0 {
        slips.extend(slip_of_size(Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min)));
    }
    if tension > STRONGEST {
        slips.push(format!("the tension is {} N/m: water has 0.0728 against air, 72.8 mN/m", rounded(tension)));
    }
    let [least, most] = range.map_or([90.0; 2], |range| range.map(f64::to_degrees));
    if least > 0.0 && most < SHARPEST {
        slips.push(format!("the contact angle is {} degrees: angles are in degrees, not in radians", rounded(most)));
    }
    slips
}

/// The slip of a domain of this size in m.
pub(crate) fn slip_of_size(size: Vec2) -> Option<String> {
    /// Pores are smaller, in m.
    const LARGEST: f64 = 1.0;
    (size.max() > LARGEST).then(|| {
        format!(
            "the domain is {} m long: lengths are in m, also those of a window; a drawing in mm has the unit mm, a pixel its size in m",
            rounded(size.max())
        )
    })
}

/// A number with at most four digits and no trailing zeros.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
