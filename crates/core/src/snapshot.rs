//! The state of a solver for output: points, named fields with units, a grid, lines. Independent of solver types.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use crate::math::Vec2;

/// The values of a field, one per point.
#[derive(Debug, Clone)]
pub enum Values<'a> {
    /// One number per point.
    Scalar(Cow<'a, [f64]>),
    /// One vector of the plane per point.
    Vector(Cow<'a, [Vec2]>),
    /// One integer per point.
    Integer(Cow<'a, [i64]>),
}

impl Values<'_> {
    /// The same with owned values.
    pub(crate) fn into_owned(self) -> Values<'static> {
        match self {
            Self::Scalar(values) => Values::Scalar(Cow::Owned(values.into_owned())),
            Self::Vector(values) => Values::Vector(Cow::Owned(values.into_owned())),
            Self::Integer(values) => Values::Integer(Cow::Owned(values.into_owned())),
        }
    }
}

/// A named field with its unit.
#[derive(Debug, Clone)]
pub struct Field<'a> {
    /// Name as in the output files, such as `wall-distance`.
    pub name: &'static str,
    /// SI unit, such as `m/s`; empty for dimensionless numbers.
    pub unit: &'static str,
    /// One value per point.
    pub values: Values<'a>,
}

impl Field<'static> {
    /// A field of numbers.
    pub fn scalar(name: &'static str, unit: &'static str, values: impl IntoIterator<Item = f64>) -> Self {
        Self { name, unit, values: Values::Scalar(values.into_iter().collect()) }
    }

    /// A field of vectors.
    pub fn vector(name: &'static str, unit: &'static str, values: impl IntoIterator<Item = Vec2>) -> Self {
        Self { name, unit, values: Values::Vector(values.into_iter().collect()) }
    }

    /// A field of whole numbers without unit.
    pub fn integer(name: &'static str, values: impl IntoIterator<Item = i64>) -> Self {
        Self { name, unit: "", values: Values::Integer(values.into_iter().collect()) }
    }
}

impl Field<'_> {
    /// The same with owned values.
    pub(crate) fn into_owned(self) -> Field<'static> {
        Field { name: self.name, unit: self.unit, values: self.values.into_owned() }
    }
}

/// The fields with owned values.
fn owned(fields: Vec<Field<'_>>) -> Vec<Field<'static>> {
    fields.into_iter().map(Field::into_owned).collect()
}

/// Scattered points with fields.
#[derive(Debug, Clone, Default)]
pub struct Cloud<'a> {
    /// Positions in m.
    pub points: Cow<'a, [Vec2]>,
    /// Fields, each as long as `points`.
    pub fields: Vec<Field<'a>>,
}

impl Cloud<'_> {
    /// The same with owned values.
    pub(crate) fn into_owned(self) -> Cloud<'static> {
        Cloud { points: Cow::Owned(self.points.into_owned()), fields: owned(self.fields) }
    }
}

/// Fields on the nodes of a regular grid; x runs fastest.
#[derive(Debug, Clone)]
pub struct Grid<'a> {
    /// Position of the first node in m.
    pub origin: Vec2,
    /// Spacing of the nodes in m.
    pub spacing: Vec2,
    /// Number of nodes along x and y.
    pub counts: [usize; 2],
    /// Fields, each of `counts[0] * counts[1]` values.
    pub fields: Vec<Field<'a>>,
}

impl Grid<'_> {
    /// Positions of the nodes in m.
    pub fn points(&self) -> Vec<Vec2> {
        let node = |x, y| self.origin + Vec2::new(x as f64, y as f64).component_mul(&self.spacing);
        (0..self.counts[1]).flat_map(|y| (0..self.counts[0]).map(move |x| node(x, y))).collect()
    }

    /// The same with owned values.
    pub(crate) fn into_owned(self) -> Grid<'static> {
        Grid { origin: self.origin, spacing: self.spacing, counts: self.counts, fields: owned(self.fields) }
    }
}

/// Polylines with fields on their vertices.
#[derive(Debug, Clone, Default)]
pub struct Lines<'a> {
    /// Vertices in m.
    pub points: Cow<'a, [Vec2]>,
    /// Each polyline as indices into `points`; closed if the first index is repeated at the end.
    pub lines: Vec<Vec<u32>>,
    /// Fields on the vertices, each as long as `points`.
    pub fields: Vec<Field<'a>>,
}

impl Lines<'_> {
    /// The same with owned values.
    pub(crate) fn into_owned(self) -> Lines<'static> {
        Lines { points: Cow::Owned(self.points.into_owned()), lines: self.lines, fields: owned(self.fields) }
    }
}

/// Kinds of cells of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellKind {
    /// Single points.
    Points,
    /// Lines of two points.
    Lines,
    /// Polygons, without repetition of the first vertex.
    Polygons,
}

/// Cells of one kind with fields on them: pores, throats, regions.
#[derive(Debug, Clone)]
pub struct Layer<'a> {
    /// Base name of its files.
    pub name: &'static str,
    /// Kind of its cells.
    pub kind: CellKind,
    /// The vertices of all cells, one cell after the other.
    pub vertices: Vertices<'a>,
    /// The end of each cell among the vertices.
    pub ends: Vec<u32>,
    /// Fields on the cells, each as long as `ends`.
    pub fields: Vec<Field<'a>>,
}

/// The vertices of cells.
#[derive(Debug, Clone)]
pub enum Vertices<'a> {
    /// In m.
    Given(Cow<'a, [Vec2]>),
    /// Those of the outlines.
    Made(Outlines),
}

/// Something that has an outline for each of its cells.
pub trait Outlined: Send + Sync {
    /// The vertices of a cell in m, without repetition of the first one.
    fn outline(&self, cell: usize) -> Vec<Vec2>;
}

/// Outlines of cells, made when they are drawn or written: together they take more memory than the cells. Those of the same source are equal.
#[derive(Clone)]
pub struct Outlines(pub Arc<dyn Outlined>);

impl Outlines {
    /// The vertices of a cell in m, without repetition of the first one.
    pub fn of(&self, cell: usize) -> Vec<Vec2> {
        self.0.outline(cell)
    }
}

impl PartialEq for Outlines {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(Arc::as_ptr(&self.0), Arc::as_ptr(&other.0))
    }
}

impl fmt::Debug for Outlines {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("Outlines")
    }
}

impl Layer<'_> {
    /// The vertices of all cells in m, one cell after the other.
    pub fn vertices(&self) -> Box<dyn Iterator<Item = Vec2> + '_> {
        match &self.vertices {
            Vertices::Given(vertices) => Box::new(vertices.iter().copied()),
            Vertices::Made(outlines) => Box::new((0..self.ends.len()).flat_map(|cell| outlines.of(cell))),
        }
    }

    /// The same with owned values.
    pub fn into_owned(self) -> Layer<'static> {
        let vertices = match self.vertices {
            Vertices::Given(vertices) => Vertices::Given(Cow::Owned(vertices.into_owned())),
            Vertices::Made(outlines) => Vertices::Made(outlines),
        };
        Layer { name: self.name, kind: self.kind, vertices, ends: self.ends, fields: owned(self.fields) }
    }
}

/// The state of a solver at one time, for output.
#[derive(Debug, Clone)]
pub struct Snapshot<'a> {
    /// Time in s.
    pub time: f64,
    /// Number of steps done.
    pub step: u64,
    /// The particles, or the nodes of a thin film.
    pub particles: Cloud<'a>,
    /// The same fields on a regular grid, if the solver provides them.
    pub grid: Option<Grid<'a>>,
    /// The interface between the fluids, if there is one.
    pub interface: Option<Lines<'a>>,
}

impl Snapshot<'_> {
    /// The same with owned values, independent of the solver's next step.
    pub fn into_owned(self) -> Snapshot<'static> {
        Snapshot {
            time: self.time,
            step: self.step,
            particles: self.particles.into_owned(),
            grid: self.grid.map(Grid::into_owned),
            interface: self.interface.map(Lines::into_owned),
        }
    }
}
