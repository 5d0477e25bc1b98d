//! The network as a graph: pore regions bounded by walls and chords, and the throats between them.
//!
//! A pore region belongs to one local maximum of the wall distance. Its boundary is one closed loop that alternates between stretches of
//! wall and chords of throats (or openings of open sides), run through with the pore on the right. Positions of a loop are continuous:
//! in periodic domains they may leave the domain, and [`Throat::shift`] leads from the frame of one region to that of its neighbor.

use crate::geometry::curve::Curve;
use crate::math::Vec2;

/// A piece of wall with the shape that it belongs to; the solid lies on its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPiece {
    /// Where it runs, in the frame of its region; cut at chords.
    pub curve: Curve,
    /// The piece of wall that it is a part of, before chords cut it; a full circle for a disc.
    pub whole: Curve,
    /// Index of the written shape; walls at the left, right, bottom and top side follow after the last shape.
    pub shape: u32,
}

/// One part of the boundary of a region.
#[derive(Debug, Clone, PartialEq)]
pub enum Edge {
    /// A stretch of wall between two chords: pieces that follow each other, pore on the right.
    Wall(Vec<WallPiece>),
    /// The chord of a throat.
    Throat {
        /// Index of the throat.
        throat: usize,
        /// Which of the two regions of the throat this one is, 0 or 1.
        end: usize,
        /// Where the chord begins in m: the wall before it ends there.
        from: Vec2,
        /// Where it ends in m.
        to: Vec2,
    },
    /// An interval of an open side between two walls.
    Opening {
        /// Index of the opening.
        opening: usize,
        /// Where it begins in m.
        from: Vec2,
        /// Where it ends in m.
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

/// A saddle of the wall distance: the narrowest place between two pores.
#[derive(Debug, Clone, PartialEq)]
pub struct Throat {
    /// Distance of the two contacts in m.
    pub width: f64,
    /// The contacts P and Q in m, in the frame of the first region.
    pub contacts: [Vec2; 2],
    /// Written shapes of the walls at P and Q.
    pub shapes: [u32; 2],
    /// Signed curvature of the walls at P and Q in 1/m, above 0 where the solid is convex; infinite at a vertex.
    pub curvatures: [f64; 2],
    /// The regions on both sides; equal where an island stands in a pore or the domain is periodic.
    pub regions: [usize; 2],
    /// What is added to a position in the frame of the first region to get that in the frame of the second, in m.
    pub shift: Vec2,
}

impl Throat {
    /// The middle of its chord in m.
    pub(crate) fn middle(&self) -> Vec2 {
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
    /// Distance of floor and lid in m; none in the plane.
    pub depth: Option<f64>,
}

/// Regions joined by the persistence ratio.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pores {
    /// The ratio f: a throat is dissolved where its half width exceeds f times the smaller inscribed radius.
    pub persistence: f64,
    /// The pore of each region.
    pub pore_of: Vec<usize>,
    /// The region of each pore whose inscribed circle is the largest.
    pub main_region: Vec<usize>,
    /// Area of each pore in m2.
    pub area: Vec<f64>,
    /// The throats that are left; their regions may be of one pore.
    pub throats: Vec<usize>,
}
