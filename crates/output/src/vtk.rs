//! Snapshots as VTK XML files, written by vtkio: each an unstructured grid (`.vtu`), which meshio reads, too.
//!
//! Particles are vertices, a grid is quadrilaterals, lines are segments, since meshio does not support polylines. Points of the plane get z = 0 and vectors
//! three components. Arrays are inline, in base 64 and compressed by zlib: the form that every reader supports. LZ4 is faster, but read by VTK, ParaView and
//! pyvista only. Times are in the `.pvd`, units in `units.json` of the output folder.

mod document;
pub mod read;

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
    /// The error of the writing library.
    #[error("the file cannot be written: {0}")]
    Write(String),
}

/// Points, each a vertex.
pub fn points(cloud: &Cloud<'_>, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let cells = Cells::new(CellType::Vertex, (0..cloud.points.len()).map(|point| [point]));
    file(&cloud.points, cells, [&cloud.fields, &[]], compression)
}

/// Fields on the corners of the quadrilaterals of a regular grid.
pub fn grid(grid: &Grid<'_>, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let [columns, rows] = grid.counts;
    let nodes = (1..rows).flat_map(|row| (1..columns).map(move |column| row * columns + column));
    let corners = nodes.map(|node| [node - columns - 1, node - columns, node, node - 1]);
    file(&grid.points(), Cells::new(CellType::Quad, corners), [&grid.fields, &[]], compression)
}

/// Polylines, segment by segment.
pub fn lines(lines: &Lines<'_>, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let segments = lines.lines.iter().flat_map(|line| line.windows(2)).map(|it| [it[0] as usize, it[1] as usize]);
    file(&lines.points, Cells::new(CellType::Line, segments), [&lines.fields, &[]], compression)
}

/// Cells with fields on them.
pub fn layer(layer: &Layer<'_>, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let kind = match layer.kind {
        CellKind::Points => CellType::Vertex,
        CellKind::Lines => CellType::Line,
        CellKind::Polygons => CellType::Polygon,
    };
    let points: Vec<Vec2> = layer.vertices().collect();
    let connectivity = (0..points.len() as i64).collect();
    let cells = Cells { kind, connectivity, offsets: layer.ends.iter().map(|&end| end.into()).collect() };
    file(&points, cells, [&[], &layer.fields], compression)
}

/// Cells of one kind: their points, one after the other, and the end offset of each.
struct Cells {
    kind: CellType,
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
}

impl Cells {
    fn new(kind: CellType, of: impl Iterator<Item = impl IntoIterator<Item = usize>>) -> Self {
        let (mut connectivity, mut offsets) = (Vec::new(), Vec::new());
        for cell in of {
            connectivity.extend(cell.into_iter().map(|point| point as i64));
            offsets.push(connectivity.len() as i64);
        }
        Self { kind, connectivity, offsets }
    }
}

/// The file of points and cells with fields on both.
fn file(
    points: &[Vec2],
    cells: Cells,
    [on_points, on_cells]: [&[Field<'_>]; 2],
    compression: Compression,
) -> Result<Vec<u8>, VtkError> {
    let (number_of_points, number_of_cells) = (points.len(), cells.offsets.len());
    let types = vec![cells.kind as u8; number_of_cells];
    let piece = Piece {
        number_of_points,
        number_of_cells,
        point_data: data(on_points, number_of_points, compression)?,
        cell_data: data(on_cells, number_of_cells, compression)?,
        points: Arrays { arrays: vec![vectors("Points", points, compression)?] },
        cells: Arrays {
            arrays: vec![
                compression.array("connectivity", 1, cells.connectivity.into())?,
                compression.array("offsets", 1, cells.offsets.into())?,
                compression.array("types", 1, types.into())?,
            ],
        },
    };
    piece.into_file(compression)
}

/// 2-vectors with a third component of 0.
fn vectors(name: &str, values: &[Vec2], compression: Compression) -> Result<DataArray, VtkError> {
    compression.array(name, 3, values.iter().flat_map(|v| [v.x, v.y, 0.0]).collect::<IOBuffer>())
}

/// The fields, each with `expected` values.
fn data(fields: &[Field<'_>], expected: usize, compression: Compression) -> Result<AttributeData, VtkError> {
    let mut data = AttributeData::default();
    for Field { name, values, .. } in fields {
        let (found, array) = match values {
            Values::Scalar(values) => (values.len(), compression.array(name, 1, values.to_vec().into())),
            Values::Vector(values) => (values.len(), vectors(name, values, compression)),
            Values::Integer(values) => (values.len(), compression.array(name, 1, values.to_vec().into())),
        };
        if found != expected {
            return Err(VtkError::Length { name, found, expected });
        }
        data.data_array.push(array?);
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
        let piece = parse(&grid(&example, Compression::None).unwrap());
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
        let piece = parse(&lines(&example, Compression::None).unwrap());
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
        let piece = parse(&layer(&example, Compression::None).unwrap());
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
            let text = String::from_utf8(lines(&nothing, compression).unwrap()).unwrap();
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
                let content = points(&cloud, *compression).unwrap();
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
            points(&cloud, Compression::None).unwrap_err().to_string(),
            "the field pressure has 3 values, expected 2"
        );
    }
}
