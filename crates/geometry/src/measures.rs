//! Porosity, specific surface and a grid of wall distances.
//!
//! The porosity is exact: Green's theorem over the segments and arcs that bound the solid within the domain. Its error estimate is the gap by which that
//! outline fails to close.

use std::borrow::Cow;

use crate::body::{Body, Location};
use crate::boundary::split;
use crate::curve::Curve;
use crate::solid::Geometry;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Field, Grid, Values};

/// A dimensionless number with its error bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Porosity {
    /// Fraction of the domain that is not solid, 0 to 1.
    pub value: f64,
    /// Estimated error.
    pub uncertainty: f64,
}

impl Geometry {
    /// The fraction of the domain that is not solid.
    pub fn porosity(&self) -> Porosity {
        let domain = self.bounds();
        let outline = self.solid_outline();
        let solid: f64 = outline.iter().map(|curve| curve.area_about(domain.center())).sum();
        let gap: Vec2 = outline.iter().map(|curve| curve.point(1.0) - curve.point(0.0)).sum();
        let rounding = f64::EPSILON * outline.len() as f64;
        Porosity {
            value: (1.0 - solid / domain.area()).clamp(0.0, 1.0),
            uncertainty: gap.norm() * domain.size().norm() / domain.area() + rounding,
        }
    }

    /// Wall length per area of the domain in 1/m.
    pub fn specific_surface(&self) -> f64 {
        self.wall_length() / self.bounds().area()
    }

    /// Closed outline of the solid within the domain: its walls, and the sides of the domain where they cut solid.
    pub fn solid_outline(&self) -> Vec<Curve> {
        let tolerance = self.tolerance();
        let frame = Body::of_box(u32::MAX, self.bounds());
        let mut outline = Vec::new();
        for piece in self.visible_pieces() {
            let keep = match frame.locate(piece.curve.point(0.5), tolerance) {
                Location::In => true,
                Location::Out => false,
                // A wall on a side of the domain bounds solid within the domain only if it faces outwards.
                Location::On(outwards) => outwards.dot(&piece.curve.normal(0.5)) > 0.0,
            };
            if keep {
                outline.push(piece.curve);
            }
        }
        for side in frame.curves.iter() {
            let near = self.boundary.tree.near_in_order(side.bounds().grown(tolerance));
            let walls = near.iter().map(|&piece| &self.boundary.pieces[piece].curve);
            for part in split(side, walls, tolerance) {
                if self.signed_distance(part.point(0.5)) < -tolerance {
                    outline.push(part);
                }
            }
        }
        outline
    }

    /// Wall distance (m) and wall normal on a regular grid over the domain, about `spacing` (m) apart.
    ///
    /// The spacing is adjusted so that nodes lie on all sides of the domain. Without walls: distance infinite, normal zero.
    pub fn distance_grid(&self, spacing: f64) -> Grid<'static> {
        use rayon::prelude::*;
        let domain = self.bounds();
        // Larger numbers of cells per side are mistakes.
        const MOST_CELLS: f64 = 20_000.0;
        let cells = domain.size().map(|side| (side / spacing).round().clamp(1.0, MOST_CELLS));
        let step = domain.size().component_div(&cells);
        let counts = [cells.x as usize + 1, cells.y as usize + 1];
        let walls: Vec<_> = (0..counts[0] * counts[1])
            .into_par_iter()
            .map(|k| {
                let index = Vec2::new((k % counts[0]) as f64, (k / counts[0]) as f64);
                self.wall(domain.min + step.component_mul(&index))
            })
            .collect();
        let distances = walls.iter().map(|wall| wall.distance).collect();
        let normals = walls.iter().map(|wall| wall.normal).collect();
        let fields = vec![
            Field { name: "wall-distance", unit: "m", values: Values::Scalar(Cow::Owned(distances)) },
            Field { name: "wall-normal", unit: "", values: Values::Vector(Cow::Owned(normals)) },
        ];
        Grid { origin: domain.min, spacing: step, counts, fields }
    }
}
