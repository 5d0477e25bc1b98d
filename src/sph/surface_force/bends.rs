//! Contact lines at edges and tight bends of walls.
//!
//! An edge is the limit of a round one. Its normals are a fan, and a line can stand there at any angle between the contact angles of
//! both faces, as one normal of the fan makes the contact angle with the interface (Gibbs; Oliver, Huh and Mason 1977). Circle fits that
//! look up the wall each for itself find now this face and now that one. So each line near a bend is placed once, by all of its points:
//! where on the wall, and to which normal, does the interface have its angle? The fits around it meet that tangent.

use crate::math::{Vec2, perpendicular};
use crate::sph::surface_force::circles::fit_from_contact;
use crate::sph::surface_force::fit::angle_pulled;
use crate::sph::surface_force::sightings::InterfaceLine;

/// A wall bends at a line where the normals this far to both sides of it, over h, differ by more than `BENT`.
const NEIGHBORHOOD: f64 = 1.0;

/// Cosine of 45 degrees.
const BENT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Steps of the search for the place of a line; it ends before where there is one.
const STEPS: usize = 16;

/// Places nearer to each other than this, over h, are the same.
const SAME_PLACE: f64 = 1e-6;

/// Places are searched so far above the wall, over dx, where those around an edge differ.
const LIFT: f64 = 0.5;

/// A contact line where its wall bends.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// A place in m on the tangent of the wall that the interface meets.
    pub(super) place: Vec2,
    /// ν_ns along the tangent.
    pub(super) outwards: Vec2,
    /// The wall normal of the tangent.
    pub(super) normal: Vec2,
}

/// A place of the wall where the interface may end, relative to the line.
#[derive(Clone, Copy)]
struct End {
    contact: Vec2,
    normal: Vec2,
}

impl InterfaceLine<'_> {
    /// Where the interface meets the wall at the `angle` (rad), if the wall bends there.
    #[must_use]
    pub fn bend(&self, angle: f64) -> Option<Bend> {
        let (fit, place) = (self.fit, self.place);
        let normal_at = |way: f64| (fit.wall)(place + way * fit.h * self.outward).1;
        if normal_at(NEIGHBORHOOD).dot(&normal_at(-NEIGHBORHOOD)) > BENT {
            return None;
        }
        let mut end = End { contact: Vec2::zeros(), normal: self.normal };
        // The nearest places from which the line would go on outwards, and from which it would come back, with how far.
        let mut between: [Option<(End, f64)>; 2] = [None; 2];
        for _ in 0..STEPS {
            let outwards = self.side * perpendicular(end.normal);
            let pulled = angle_pulled(self.into_wetting, (outwards, end.normal), angle);
            let (_, way) = fit_from_contact(&self.near, end.contact, (outwards, end.normal), pulled)?;
            if way.abs() < SAME_PLACE * fit.h {
                break;
            }
            between[usize::from(way < 0.0)] = Some((end, way.abs()));
            let next = match between {
                [Some((inner, out)), Some((outer, back))] => {
                    let share = (out / (out + back)).clamp(0.1, 0.9);
                    (1.0 - share) * self.above(&inner) + share * self.above(&outer)
                }
                _ => end.contact + way.clamp(-fit.h, fit.h) * outwards,
            };
            let (distance, normal) = (fit.wall)(place + next);
            end = End { contact: next - distance * normal, normal };
        }
        let place = fit.domain.wrapped(place + end.contact);
        Some(Bend { place, outwards: self.side * perpendicular(end.normal), normal: end.normal })
    }

    /// A place above an end from which the wall is found again with the same normal.
    fn above(&self, end: &End) -> Vec2 {
        end.contact + LIFT * self.fit.spacing * end.normal
    }
}
