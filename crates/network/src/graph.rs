//! The network as a graph: pore regions bounded by walls and chords, and the throats between them.
//!
//! A pore region belongs to one local maximum of the wall distance. Its boundary is a closed loop that alternates between stretches of
//! wall and chords of throats (or openings of open sides), with the pore on the right. Positions along a loop are continuous: in periodic
//! domains they may leave the domain, and [`Throat::shift`] transforms from the frame of one region to that of its neighbor.

use std::f64::consts::TAU;
use std::sync::Arc;

use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;

/// A piece of wall with its shape; the solid lies on its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPiece {
    /// Its curve in the frame of its region, cut at chords.
    pub curve: Curve,
    /// Polar angle in rad at which the uncut circle begins of which it is a part, that of a disc; infinite if it is not part of one.
    pub circle_start: f64,
    /// Index of the written shape; walls at the left, right, bottom and top side follow after the last shape.
    pub shape: u32,
}

/// Consecutive pieces of wall, shared by all that they bound.
pub type Stretch = Arc<[WallPiece]>;

impl WallPiece {
    /// A part of an uncut piece of wall of a shape.
    pub(super) fn part_of(whole: &Curve, curve: Curve, shape: u32) -> Self {
        let circle_start = match whole {
            Curve::Arc { start, .. } if whole.is_closed() => *start,
            _ => f64::INFINITY,
        };
        Self { curve, circle_start, shape }
    }

    /// The full circle of which it is a part; `None` if it is not part of one.
    pub(super) fn circle(&self) -> Option<Curve> {
        match self.curve {
            Curve::Arc { center, radius, sweep, .. } if self.circle_start.is_finite() => {
                Some(Curve::Arc { center, radius, start: self.circle_start, sweep: TAU.copysign(sweep) })
            }
            _ => None,
        }
    }

    pub(super) fn shifted(&self, by: Vec2) -> Self {
        Self { curve: self.curve.shifted(by), ..*self }
    }
}

/// One part of the boundary of a region.
#[derive(Debug, Clone, PartialEq)]
pub enum Edge {
    /// A stretch of wall between two chords: consecutive pieces, pore on the right.
    Wall(Stretch),
    /// The chord of a throat.
    Throat {
        /// Index of the throat.
        throat: usize,
        /// Which of the two regions of the throat this one is, 0 or 1.
        end: usize,
        /// Start of the chord in m, the end of the wall before it.
        from: Vec2,
        /// End in m.
        to: Vec2,
    },
    /// An interval of an open side between two walls.
    Opening {
        /// Index of the opening.
        opening: usize,
        /// Start in m.
        from: Vec2,
        /// End in m.
        to: Vec2,
    },
}

/// The part of the pore space that belongs to one local maximum of the wall distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Center of the largest inscribed circle in m, within the domain.
    pub center: Vec2,
    /// Its radius in m.
    pub radius: f64,
    /// The boundary in order, pore on the right.
    pub edges: Vec<Edge>,
    /// Area in m2, closed form.
    pub area: f64,
    /// Length of its walls in m.
    pub wall_length: f64,
    /// Centroid in m.
    pub centroid: Vec2,
}

/// A saddle of the wall distance: the narrowest cross-section between two pores.
#[derive(Debug, Clone, PartialEq)]
pub struct Throat {
    /// Distance between the two contacts in m.
    pub width: f64,
    /// The contacts P and Q in m, in the frame of the first region.
    pub contacts: [Vec2; 2],
    /// Written shapes of the walls at P and Q.
    pub shapes: [u32; 2],
    /// Signed curvature of the walls at P and Q in 1/m, positive for a convex solid; infinite at a vertex.
    pub curvatures: [f64; 2],
    /// The regions on both sides; they may be equal around an island in a pore or in a periodic domain.
    pub regions: [usize; 2],
    /// Shift in m from the frame of the first region to that of the second.
    pub shift: Vec2,
}

impl Throat {
    /// The middle of its chord in m.
    pub fn middle(&self) -> Vec2 {
        0.5 * (self.contacts[0] + self.contacts[1])
    }
}

/// An interval of an open side between two walls: a throat without entry pressure to a boundary pore of area zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// The side: left, right, bottom, top are 0 to 3.
    pub side: usize,
    /// Its ends in m.
    pub ends: [Vec2; 2],
    /// The region behind it.
    pub region: usize,
}

/// The network of all local maxima (persistence ratio 1).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Network {
    /// The regions; they tile the pore space.
    pub regions: Vec<Region>,
    /// The throats.
    pub throats: Vec<Throat>,
    /// The openings at open sides.
    pub openings: Vec<Opening>,
    /// Distance between floor and lid in m; `None` in the plane.
    pub depth: Option<f64>,
}

/// Regions joined by the persistence ratio.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pores {
    /// The ratio f: a throat is dissolved if its half width exceeds f times the smaller inscribed radius.
    pub persistence: f64,
    /// The pore of each region.
    pub pore_of: Vec<usize>,
    /// The region of each pore with the largest inscribed circle.
    pub main_region: Vec<usize>,
    /// Area of each pore in m2.
    pub area: Vec<f64>,
    /// The remaining throats; both regions of one may belong to the same pore.
    pub throats: Vec<usize>,
}
