//! Shapes as specified by a user, in a shape file or in a case: the table's name is the shape's name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use meniscus_core::input::Range;
use meniscus_core::input::tables::{Key, Value, describe, tables};
use meniscus_core::math::{FNV1A_BASIS, fnv1a};

/// One shape, closed and solid, in m. In TOML: `disc = { center = [0.0, 0.0], radius = 1.0e-3 }`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ShapeSpec {
    /// All points below a straight line.
    HalfPlane(HalfPlane),
    /// A full disc (the paper's sphere).
    Disc(Disc),
    /// A rectangle about its center.
    Rectangle(Rectangle),
    /// All points within `radius` of a segment.
    Capsule(Capsule),
    /// A polygon, with holes.
    Polygon(Polygon),
    /// A polygon whose edges may be circular arcs, with holes.
    CurvedPolygon(CurvedPolygon),
    /// Two plates: all points farther than half the width from a center line.
    Channel(Channel),
    /// Two discs that leave a gap: a throat with converging and diverging walls.
    ThroatDiscs(ThroatDiscs),
    /// A channel with a cosine constriction.
    ThroatCosine(ThroatCosine),
    /// Discs at random positions, generated from a seed when the file is read.
    RandomPack(RandomPack),
    /// Discs in a regular array, generated when the file is read.
    Array(Array),
}

/// A length above 0.
const SIZE: Key = Key::positive("a length in m");

/// Declares shapes: fields with the ranges of their keys, like [`tables!`](meniscus_core::input::tables::tables), all of them required except those with a serde
/// default.
macro_rules! shapes {
    ($($(#[$outer:meta])* pub struct $name:ident { $($(#[$inner:meta])* pub $field:ident: $kind:ty $(=> $key:expr)?,)* })*) => {$(
        $(#[$outer])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        #[schemars(transform = $name::describe)]
        pub struct $name { $($(#[$inner])* pub $field: $kind,)* }

        impl $name {
            /// Its fields and the ranges of their keys.
            pub(crate) const KEYS: &'static [(&'static str, Key)] = &[$((stringify!($field), tables!(@key $($key)?)),)*];

            fn describe(schema: &mut schemars::Schema) {
                describe(schema, Self::KEYS);
            }
        }
    )*};
}

shapes! {
    /// The half-plane below the line through `point`; `rotation-deg` rotates it counter-clockwise about `point`.
    pub struct HalfPlane {
        /// A point of the surface in m.
        pub point: [f64; 2],
        /// Rotation about `point` in degrees; 0: solid below, 180: solid above, 90: solid on the right.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// A disc.
    pub struct Disc {
        /// Center in m.
        pub center: [f64; 2],
        /// Radius in m, above 0.
        pub radius: f64 => SIZE,
    }

    /// A rectangle.
    pub struct Rectangle {
        /// Center in m.
        pub center: [f64; 2],
        /// Width and height in m, above 0.
        pub size: [f64; 2] => SIZE,
        /// Rotation about the center in degrees.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// A capsule (stadium).
    pub struct Capsule {
        /// The two ends of its axis in m.
        pub ends: [[f64; 2]; 2],
        /// Radius in m, above 0.
        pub radius: f64 => SIZE,
    }

    /// A polygon: the outer ring counter-clockwise, holes clockwise, without repetition of the first point.
    pub struct Polygon {
        /// Outer ring in m, at least three points.
        pub outer: Vec<[f64; 2]>,
        /// Holes in m.
        #[serde(default)]
        pub holes: Vec<Vec<[f64; 2]>>,
        /// Shift in m, after the rotation.
        #[serde(default)]
        pub position: [f64; 2],
        /// Rotation about the origin of the ring's coordinates in degrees.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// A polygon of segments and circular arcs: each vertex is `[x, y, bulge]` with the bulge of the edge that starts there, the tangent of a quarter of its
    /// arc's angle: 0 straight, 1 a counter-clockwise half circle, below 0 clockwise.
    pub struct CurvedPolygon {
        /// Outer ring counter-clockwise, x and y in m, at least two vertices.
        pub outer: Vec<[f64; 3]>,
        /// Holes, clockwise.
        #[serde(default)]
        pub holes: Vec<Vec<[f64; 3]>>,
        /// Shift in m, after the rotation.
        #[serde(default)]
        pub position: [f64; 2],
        /// Rotation about the origin of the ring's coordinates in degrees.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// The solid outside of a straight channel.
    pub struct Channel {
        /// A point of the center line in m.
        pub center: [f64; 2],
        /// Distance between the plates in m, above 0.
        pub width: f64 => SIZE,
        /// Rotation of the center line in degrees; 0 is along x.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// Two discs of equal or different radius with a gap between them, the flow along x before the rotation.
    pub struct ThroatDiscs {
        /// Center of the gap in m.
        pub center: [f64; 2],
        /// Radii of the lower and the upper disc in m, above 0.
        pub radii: [f64; 2] => SIZE,
        /// Smallest distance between the discs in m, above 0.
        pub gap: f64 => SIZE,
        /// Rotation about the center in degrees.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// Walls at `+-(1/2) (width - (width - throat) (1 + cos(2 pi s/length))/2)` for |s| < length/2 along the axis, straight beyond.
    pub struct ThroatCosine {
        /// Center of the throat in m.
        pub center: [f64; 2],
        /// Distance between the walls away from the throat in m.
        pub width: f64 => SIZE,
        /// Distance between the walls in the throat in m, above 0 and at most `width`.
        pub throat: f64 => SIZE,
        /// Length of the constriction along the axis in m.
        pub length: f64 => SIZE,
        /// Rotation about the center in degrees; 0: axis along x.
        #[serde(default)]
        pub rotation_deg: f64,
    }

    /// Discs at random positions with a given porosity; expanded to discs when read.
    pub struct RandomPack {
        /// Seed of the pack; the same pack on every machine.
        #[serde(default = "first_seed")]
        pub seed: u64,
        /// Fraction of the region that is not solid, 0 to 1.
        pub porosity: f64 => Key::number("a porosity", Range::Between(0.0, 1.0)),
        /// Mean radius in m; all radii are scaled together by a few percent at most to meet the porosity.
        pub radius: f64 => SIZE,
        /// Standard deviation of the radii over their mean, 0 to 0.35.
        #[serde(default)]
        pub radius_deviation: f64 => Key::within("a share", 0.0, 0.35),
        /// Smallest distance between two discs, and between a disc and the region's sides, in m.
        pub gap: f64 => SIZE,
        /// Lower left and upper right corner in m.
        pub region: [[f64; 2]; 2],
        /// Axes along which the region is periodic: discs may cross these sides.
        #[serde(default)]
        pub periodic: PackAxes,
    }

    /// Equal discs in a regular array, as many as fit completely into the region; expanded to discs when read.
    pub struct Array {
        /// Square or hexagonal.
        pub arrangement: Arrangement,
        /// Radius in m.
        pub radius: f64 => SIZE,
        /// Smallest distance between two discs in m.
        pub gap: f64 => SIZE,
        /// Lower left and upper right corner in m.
        pub region: [[f64; 2]; 2],
    }
}

impl Polygon {
    /// The same with edges that may be arcs.
    pub(crate) fn curved(&self) -> CurvedPolygon {
        let straight = |ring: &Vec<[f64; 2]>| ring.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        let (outer, holes) = (straight(&self.outer), self.holes.iter().map(straight).collect());
        CurvedPolygon { outer, holes, position: self.position, rotation_deg: self.rotation_deg }
    }
}

impl Rectangle {
    /// The same as a ring of corners.
    pub(crate) fn curved(&self) -> CurvedPolygon {
        let [x, y] = self.size.map(|side| 0.5 * side);
        let outer = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| [x, y, 0.0]).to_vec();
        CurvedPolygon { outer, holes: Vec::new(), position: self.center, rotation_deg: self.rotation_deg }
    }
}

fn first_seed() -> u64 {
    1
}

/// Axes along which a pack is periodic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PackAxes {
    /// Neither.
    #[default]
    None,
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along both.
    Xy,
}

impl PackAxes {
    /// Along x and y.
    pub fn axes(self) -> [bool; 2] {
        [matches!(self, Self::X | Self::Xy), matches!(self, Self::Y | Self::Xy)]
    }
}

/// Arrangements of the discs of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// At the corners of squares.
    Square,
    /// At the corners of equilateral triangles, rows along x.
    Hexagonal,
}

/// Meaning of the shapes of a file: grains in a fluid, or the pore itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SolidSide {
    /// The shapes are solid; the pore is outside of their union.
    #[default]
    Inside,
    /// The shapes are the pore; all else is solid (complement of the union).
    Outside,
}

/// A shape file of ours, or the same keys inline in a case's `[geometry]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct GeometrySpec {
    /// Lower left corner of the domain in m.
    pub min: [f64; 2],
    /// Upper right corner of the domain in m.
    pub max: [f64; 2],
    /// Whether the shapes are solid or the pore.
    #[serde(default)]
    pub solid: SolidSide,
    /// The shapes; overlaps are united.
    #[serde(default)]
    pub shapes: Vec<ShapeSpec>,
}

impl Value for ShapeSpec {}
impl Value for SolidSide {}

impl GeometrySpec {
    /// A hash of the domain and of all shapes as specified.
    pub fn digest(&self) -> u64 {
        // Numbers, strings and lists of them can always be encoded.
        let bytes = postcard::to_stdvec(self).unwrap_or_default();
        fnv1a(FNV1A_BASIS, bytes)
    }
}
