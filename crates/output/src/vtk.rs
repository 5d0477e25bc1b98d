//! Snapshots as VTK XML files, written by vtkio: each an unstructured grid (`.vtu`), which meshio reads, too.
//!
//! Particles are vertices, a grid is quadrilaterals, lines are segments, since meshio does not support polylines. Points of the plane get z = 0 and vectors
//! three components. Arrays are inline, in base 64 and compressed by zlib: the form that every reader supports. LZ4 is faster, but read by VTK, ParaView and
//! pyvista only. Times are in the `.pvd`, units in `units.json` of the output folder.

mod document;
pub mod read;

use std::io::{self, Write};

use vtkio::IOBuffer;
use vtkio::model::CellType;
use vtkio::xml::{AttributeData, DataArray};

use self::document::{Arrays, Piece};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{CellKind, Cloud, Field, Grid, Layer, Lines, Values};

/// Compression of the arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Compression {
    /// None.
    None,
    /// zlib at its fastest level.
    #[default]
    Zlib,
    /// LZ4.
    Lz4,
}

/// A snapshot that cannot be written as VTK.
#[derive(Debug, thiserror::Error)]
pub enum VtkError {
    /// A field whose length differs from the number of its points or cells.
    #[error("the field {name} has {found} values, expected {expected}")]
    Length {
        /// Name of the field.
        name: &'static str,
        /// Number of values.
        found: usize,
        /// Number of points.
        expected: usize,
    },
}

/// Returns points in m.
type Points<'a> = Box<dyn Fn() -> Box<dyn Iterator<Item = Vec2> + 'a> + 'a>;

/// A file ready to be written.
pub struct VtkFile<'a> {
    points: Points<'a>,
    number_of_points: usize,
    cells: Cells<'a>,
    on_points: &'a [Field<'a>],
    on_cells: &'a [Field<'a>],
    compression: Compression,
}

/// Points, each a vertex.
///
/// # Errors
/// [`VtkError`] if a field has another length than its points.
pub fn points<'a>(cloud: &'a Cloud<'_>, compression: Compression) -> Result<VtkFile<'a>, VtkError> {
    file(
        (given(&cloud.points), cloud.points.len()),
        Cells::Vertices(cloud.points.len()),
        [&cloud.fields, &[]],
        compression,
    )
}

/// Fields on the corners of the quadrilaterals of a regular grid.
///
/// # Errors
/// [`VtkError`] if a field has another length than its nodes.
pub fn grid<'a>(grid: &'a Grid<'_>, compression: Compression) -> Result<VtkFile<'a>, VtkError> {
    let points = || -> Box<dyn Iterator<Item = Vec2>> { Box::new(grid.points().into_iter()) };
    let count = grid.counts[0] * grid.counts[1];
    file((Box::new(points), count), Cells::Quadrilaterals(grid.counts), [&grid.fields, &[]], compression)
}

/// Polylines, segment by segment.
///
/// # Errors
/// [`VtkError`] if a field has another length than its vertices.
pub fn lines<'a>(lines: &'a Lines<'_>, compression: Compression) -> Result<VtkFile<'a>, VtkError> {
    file((given(&lines.points), lines.points.len()), Cells::Segments(&lines.lines), [&lines.fields, &[]], compression)
}

/// Cells with fields on them.
///
/// # Errors
/// [`VtkError`] if a field has another length than its cells.
pub fn layer<'a>(layer: &'a Layer<'_>, compression: Compression) -> Result<VtkFile<'a>, VtkError> {
    let count = layer.ends.last().map_or(0, |&end| end as usize);
    let points = (Box::new(|| layer.vertices()) as Points<'a>, count);
    file(points, Cells::Consecutive(layer.kind, &layer.ends), [&[], &layer.fields], compression)
}

fn given(points: &[Vec2]) -> Points<'_> {
    Box::new(|| Box::new(points.iter().copied()))
}

/// The file of points and cells with fields on both.
fn file<'a>(
    (points, number_of_points): (Points<'a>, usize),
    cells: Cells<'a>,
    [on_points, on_cells]: [&'a [Field<'a>]; 2],
    compression: Compression,
) -> Result<VtkFile<'a>, VtkError> {
    for (fields, expected) in [(on_points, number_of_points), (on_cells, cells.count())] {
        let length = |field: &Field<'_>| match &field.values {
            Values::Scalar(values) => values.len(),
            Values::Vector(values) => values.len(),
            Values::Integer(values) => values.len(),
        };
        if let Some(field) = fields.iter().find(|field| length(field) != expected) {
            return Err(VtkError::Length { name: field.name, found: length(field), expected });
        }
    }
    Ok(VtkFile { points, number_of_points, cells, on_points, on_cells, compression })
}

/// Cells of one kind.
enum Cells<'a> {
    /// One for each of so many points.
    Vertices(usize),
    /// Those of a grid of so many nodes along x and y.
    Quadrilaterals([usize; 2]),
    /// The segments of polylines.
    Segments(&'a [Vec<u32>]),
    /// Those of a layer, each of consecutive points, by their ends.
    Consecutive(CellKind, &'a [u32]),
}

/// Numbers of points or of cells, in order.
type Numbers<'a> = Box<dyn Iterator<Item = i64> + 'a>;

impl Cells<'_> {
    /// Their kind in VTK, and the number of the points of each, if all have as many.
    fn kind(&self) -> (CellType, Option<i64>) {
        match self {
            Self::Vertices(_) | Self::Consecutive(CellKind::Points, _) => (CellType::Vertex, Some(1)),
            Self::Segments(_) => (CellType::Line, Some(2)),
            Self::Consecutive(CellKind::Lines, _) => (CellType::Line, None),
            Self::Consecutive(CellKind::Polygons, _) => (CellType::Polygon, None),
            Self::Quadrilaterals(_) => (CellType::Quad, Some(4)),
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::Vertices(count) => *count,
            Self::Quadrilaterals([columns, rows]) => columns.saturating_sub(1) * rows.saturating_sub(1),
            Self::Segments(lines) => lines.iter().map(|line| line.len().saturating_sub(1)).sum(),
            Self::Consecutive(_, ends) => ends.len(),
        }
    }

    /// The points of all cells.
    fn connectivity(&self) -> Numbers<'_> {
        match self {
            Self::Vertices(count) => Box::new(0..*count as i64),
            Self::Quadrilaterals([columns, rows]) => {
                let [columns, rows] = [*columns as i64, *rows as i64];
                let nodes = (1..rows).flat_map(move |row| (1..columns).map(move |column| row * columns + column));
                Box::new(nodes.flat_map(move |node| [node - columns - 1, node - columns, node, node - 1]))
            }
            Self::Segments(lines) => {
                Box::new(lines.iter().flat_map(|line| line.windows(2)).flatten().map(|&it| it.into()))
            }
            Self::Consecutive(_, ends) => Box::new(0..ends.last().map_or(0, |&end| end.into())),
        }
    }

    /// The end of each cell in the connectivity.
    fn offsets(&self) -> Numbers<'_> {
        match (self.kind().1, self) {
            (_, Self::Consecutive(_, ends)) => Box::new(ends.iter().map(|&end| end.into())),
            (each, _) => Box::new((1..=self.count() as i64).map(move |cell| cell * each.unwrap_or_default())),
        }
    }
}

impl VtkFile<'_> {
    /// Writes the file.
    ///
    /// # Errors
    /// Those of the library and of the target.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        let (compression, number_of_cells) = (self.compression, self.cells.count());
        let types = vec![self.cells.kind().0 as u8; number_of_cells];
        let numbers = |name: &str, numbers: Numbers<'_>| compression.array(name, 1, numbers.collect::<IOBuffer>());
        let cells =
            vec![numbers("connectivity", self.cells.connectivity())?, numbers("offsets", self.cells.offsets())?];
        let types = compression.array("types", 1, types.into())?;
        let piece = Piece {
            number_of_points: self.number_of_points,
            number_of_cells,
            point_data: data(self.on_points, compression)?,
            cell_data: data(self.on_cells, compression)?,
            points: Arrays { arrays: vec![vectors("Points", (self.points)(), compression)?] },
            cells: Arrays { arrays: cells.into_iter().chain([types]).collect() },
        };
        piece.write(compression, to)
    }

    /// The content of the file.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Writing to memory cannot fail.
        let _ = self.write(&mut bytes);
        bytes
    }
}

/// 2-vectors with a third component of 0.
fn vectors(name: &str, values: impl Iterator<Item = Vec2>, compression: Compression) -> io::Result<DataArray> {
    compression.array(name, 3, values.flat_map(|v| [v.x, v.y, 0.0]).collect::<IOBuffer>())
}

/// The fields.
fn data(fields: &[Field<'_>], compression: Compression) -> io::Result<AttributeData> {
    let mut data = AttributeData::default();
    for Field { name, values, .. } in fields {
        data.data_array.push(match values {
            Values::Scalar(values) => compression.array(name, 1, values.to_vec().into()),
            Values::Vector(values) => vectors(name, values.iter().copied(), compression),
            Values::Integer(values) => compression.array(name, 1, values.to_vec().into()),
        }?);
    }
    Ok(data)
}

#[cfg(test)]
#[allow(unreachable_pub, dead_code, reason = "the tests beside the library use it too")]
#[path = "../../../tests/support/python.rs"]
mod python;

#[cfg(test)]
mod tests {
    use std::borrow::Cow;
    use std::sync::Arc;

    use vtkio::model::{Attribute, DataSet, UnstructuredGridPiece, VertexNumbers, Vtk};

    use super::*;
    use meniscus_core::snapshot::{Outlined, Outlines, Vertices};

    fn parse(bytes: &[u8]) -> UnstructuredGridPiece {
        let DataSet::UnstructuredGrid { pieces, .. } = Vtk::parse_xml(bytes).unwrap().data else {
            panic!("not an unstructured grid")
        };
        pieces.into_iter().next().unwrap().into_loaded_piece_data(None).unwrap()
    }

    fn fields(count: usize) -> Vec<Field<'static>> {
        let scalar: Vec<f64> = (0..count).map(|i| if i == 0 { f64::NAN } else { i as f64 / 3.0 }).collect();
        vec![
            Field { name: "pressure", unit: "Pa", values: Values::Scalar(scalar.into()) },
            Field { name: "velocity", unit: "m/s", values: Values::Vector(vec![Vec2::new(1.0, 2.0); count].into()) },
            Field { name: "id", unit: "", values: Values::Integer((0..count as i64).collect()) },
        ]
    }

    fn coordinates(points: &[Vec2]) -> IOBuffer {
        points.iter().flat_map(|v| [v.x, v.y, 0.0]).collect()
    }

    #[test]
    fn a_grid_has_its_nodes_in_double_precision_at_the_corners_of_quadrilaterals() {
        let (origin, spacing) = (Vec2::new(0.1e-3, -1.0 / 3.0), Vec2::new(1.0e-5, 2.0e-5));
        let example = Grid { origin, spacing, counts: [3, 2], fields: fields(6) };
        let piece = parse(&grid(&example, Compression::None).unwrap().bytes());
        let nodes = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]];
        assert_eq!(piece.points, coordinates(&nodes.map(|[x, y]| origin + Vec2::new(x, y).component_mul(&spacing))));
        assert_eq!(piece.cells.types, [CellType::Quad; 2]);
        let (connectivity, offsets) = (vec![0, 1, 4, 3, 1, 2, 5, 4], vec![4, 8]);
        assert_eq!(piece.cells.cell_verts, VertexNumbers::XML { connectivity, offsets });
    }

    #[test]
    fn polylines_read_back_as_their_segments() {
        let vertices = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        let example =
            Lines { points: Cow::Borrowed(&vertices), lines: vec![vec![0, 1, 2, 0], vec![1, 2]], fields: fields(3) };
        let piece = parse(&lines(&example, Compression::None).unwrap().bytes());
        assert_eq!(piece.cells.types, [CellType::Line; 4]);
        let (connectivity, offsets) = (vec![0, 1, 1, 2, 2, 0, 1, 2], vec![2, 4, 6, 8]);
        assert_eq!(piece.cells.cell_verts, VertexNumbers::XML { connectivity, offsets });
    }

    #[test]
    fn polygons_carry_their_fields() {
        struct Polygons([Vec2; 4]);
        impl Outlined for Polygons {
            fn outline(&self, cell: usize) -> Vec<Vec2> {
                self.0[cell..].to_vec()
            }
        }
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec2::new(x, y));
        let vertices = Vertices::Made(Outlines(Arc::new(Polygons(square))));
        let example =
            Layer { name: "regions", kind: CellKind::Polygons, vertices, ends: vec![4, 7], fields: fields(2) };
        let piece = parse(&layer(&example, Compression::None).unwrap().bytes());
        assert_eq!(piece.cells.types, [CellType::Polygon; 2]);
        assert_eq!((piece.data.point.len(), piece.data.cell.len()), (0, 3));
        assert_eq!(piece.points, coordinates(&[&square[..], &square[1..]].concat()));
        let (connectivity, offsets) = ((0..7).collect(), vec![4, 7]);
        assert_eq!(piece.cells.cell_verts, VertexNumbers::XML { connectivity, offsets });
    }

    #[test]
    fn files_without_points_tell_their_counts_and_the_names_of_their_fields() {
        for compression in [Compression::None, Compression::Zlib, Compression::Lz4] {
            let nothing = Lines { fields: fields(0), ..Lines::default() };
            let text = String::from_utf8(lines(&nothing, compression).unwrap().bytes()).unwrap();
            for expected in ["<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\">", "Name=\"velocity\""] {
                assert!(text.contains(expected), "{text}");
            }
        }
    }

    #[test]
    fn particles_are_vertices_and_arrays_around_the_length_of_a_block_are_read_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let names = [Compression::None, Compression::Zlib, Compression::Lz4]
            .map(|compression| (compression, format!("{compression:?}")));
        // Blocks are full at 4096 numbers of a field, at 4096 vectors, and at 32768 types of cells.
        for count in [0, 1, 4095, 4096, 4097, 8192, 32767, 32768, 32769, 65536] {
            let given: Vec<Vec2> = (0..count).map(|i| Vec2::new((i as f64).sqrt(), -(i as f64) / 7.0)).collect();
            let cloud = Cloud { points: given.clone().into(), fields: fields(count) };
            for (compression, name) in &names {
                let content = points(&cloud, *compression).unwrap().bytes();
                if *compression == Compression::None {
                    let piece = parse(&content);
                    assert_eq!(piece.points, coordinates(&given), "{count} points");
                    assert_eq!(piece.cells.types, vec![CellType::Vertex; count]);
                    let names: Vec<&str> = piece.data.point.iter().map(Attribute::name).collect();
                    assert_eq!(names, ["pressure", "velocity", "id"]);
                }
                crate::atomic::write(&folder.path().join(name).join(format!("{count}.vtu")), &content).unwrap();
            }
        }
        let mut compare = std::process::Command::new(python::interpreter());
        compare.arg(python::root().join("postprocess/tests/same_arrays.py"));
        let printed =
            python::run(compare.args(names.map(|(_, name)| folder.path().join(name))), "all must read the same arrays");
        assert_eq!(
            printed,
            "None: 10 files, 9 of them by meshio too\nZlib: 10 files, 9 of them by meshio too\nLz4: 10 files, 0 of them by meshio too\n"
        );
    }

    #[test]
    fn a_field_of_another_length_is_refused() {
        let cloud = Cloud { points: vec![Vec2::zeros(); 2].into(), fields: fields(3) };
        assert_eq!(
            points(&cloud, Compression::None).err().unwrap().to_string(),
            "the field pressure has 3 values, expected 2"
        );
    }
}
