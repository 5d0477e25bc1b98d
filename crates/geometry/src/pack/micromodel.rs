//! A micromodel: a random pack between an inlet and an outlet manifold, each with a straight channel, enclosed by walls.

use super::error::PackError;
use super::random::random_pack;
use crate::spec::{Disc, GeometrySpec, Polygon, RandomPack, ShapeSpec, SolidSide};

/// Dimensions of a micromodel besides those of its pack. The flow is along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Micromodel {
    /// The grains; the region is that of the pack, its lower left corner the origin of the model's height.
    pub pack: RandomPack,
    /// Length of each manifold along x in m.
    pub manifold: f64,
    /// Width of the inlet and the outlet channel in m, at most the height of the pack.
    pub channel_width: f64,
    /// Length of each channel in m.
    pub channel_length: f64,
    /// Thickness of the walls above and below in m.
    pub wall: f64,
}

/// The shapes of a micromodel and its discs.
///
/// # Errors
/// As for a random pack, and invalid dimensions.
pub fn micromodel(model: &Micromodel) -> Result<(GeometrySpec, Vec<Disc>), PackError> {
    let [[x0, y0], [x1, y1]] = model.pack.region;
    for (key, length) in [
        ("manifold", model.manifold),
        ("channel-width", model.channel_width),
        ("channel-length", model.channel_length),
        ("wall", model.wall),
    ] {
        PackError::require(
            length > 0.0 && length.is_finite(),
            key,
            format!("{length:e} m is not a length"),
            "a length above 0",
        )?;
    }
    PackError::require(
        model.channel_width <= y1 - y0,
        "channel-width",
        format!("{:e} m is more than the height of the pack, {:e} m", model.channel_width, y1 - y0),
        "make the channel narrower than the pack",
    )?;
    let discs = random_pack(&model.pack)?;
    let (inner, outer) = (model.manifold, model.manifold + model.channel_length);
    let (left, right) = (x0 - outer, x1 + outer);
    let (bottom, top) = (y0 - model.wall, y1 + model.wall);
    let (low, high) = (0.5 * (y0 + y1 - model.channel_width), 0.5 * (y0 + y1 + model.channel_width));
    // Walls extend beyond the domain and are cut by its sides.
    let beyond = outer + model.wall;
    let lower = vec![
        [left - beyond, bottom - beyond],
        [right + beyond, bottom - beyond],
        [right + beyond, low],
        [x1 + inner, low],
        [x1 + inner, y0],
        [x0 - inner, y0],
        [x0 - inner, low],
        [left - beyond, low],
    ];
    let upper = vec![
        [left - beyond, high],
        [x0 - inner, high],
        [x0 - inner, y1],
        [x1 + inner, y1],
        [x1 + inner, high],
        [right + beyond, high],
        [right + beyond, top + beyond],
        [left - beyond, top + beyond],
    ];
    let mut shapes: Vec<ShapeSpec> = [lower, upper]
        .map(|mut outer| {
            // A channel as wide as the pack gives duplicate points.
            outer.dedup();
            ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
        })
        .to_vec();
    shapes.extend(discs.iter().cloned().map(ShapeSpec::Disc));
    Ok((GeometrySpec { min: [left, bottom], max: [right, top], solid: SolidSide::Inside, shapes }, discs))
}
