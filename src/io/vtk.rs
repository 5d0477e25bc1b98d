//! Snapshots as VTK XML files: particles `.vtu`, grid `.vti`, lines and layers of cells `.vtp`.
//!
//! Points of the plane get z = 0 and vectors three components. Arrays stand where they belong, in base 64 and compressed by
//! zlib: the form that every reader knows, meshio too. LZ4 is faster, and read by VTK, ParaView and pyvista only. The time is
//! field data. Units stand in `units.json` of the output folder.

mod array;

use std::fmt::Write as _;

pub(crate) use array::Compression;

use crate::math::Vec2;
use crate::snapshot::{CellKind, Cloud, Field, Grid, Layer, Lines, Values};

/// Type of a cell that is a point, as VTK numbers them.
const VERTEX: u8 = 1;

/// A snapshot that cannot be written as VTK.
#[derive(Debug, thiserror::Error)]
pub(crate) enum VtkError {
    /// A field that is longer or shorter than the points it belongs to.
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

/// Points as a `.vtu` file, each a vertex cell; `time` in s.
pub(crate) fn points(cloud: &Cloud<'_>, time: f64, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let count = cloud.points.len();
    let fields = arrays(&cloud.fields, count, compression)?;
    let types = compression.bytes("types", &vec![VERTEX; count]);
    let piece = format!(
        "<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\"><PointData>{fields}</PointData>{}<Cells>{}{types}</Cells></Piece>",
        places(&cloud.points, compression),
        cells((0..count).map(|point| [point as i64]), compression),
    );
    Ok(file("UnstructuredGrid", "", time, &piece, compression))
}

/// Fields on a regular grid as a `.vti` file; `time` in s.
pub(crate) fn grid(grid: &Grid<'_>, time: f64, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let fields = arrays(&grid.fields, grid.counts[0] * grid.counts[1], compression)?;
    let [last_x, last_y] = grid.counts.map(|count| count.saturating_sub(1));
    let extent = format!("0 {last_x} 0 {last_y} 0 0");
    // The third spacing has no meaning with one layer of nodes, but must not be zero.
    let attributes = format!(
        " WholeExtent=\"{extent}\" Origin=\"{:?} {:?} 0\" Spacing=\"{:?} {:?} {:?}\"",
        grid.origin.x, grid.origin.y, grid.spacing.x, grid.spacing.y, grid.spacing.x
    );
    let piece = format!("<Piece Extent=\"{extent}\"><PointData>{fields}</PointData></Piece>");
    Ok(file("ImageData", &attributes, time, &piece, compression))
}

/// Polylines as a `.vtp` file; `time` in s.
pub(crate) fn lines(lines: &Lines<'_>, time: f64, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let fields = arrays(&lines.fields, lines.points.len(), compression)?;
    let data = format!("<PointData>{fields}</PointData>");
    Ok(poly_data(&lines.points, CellKind::Lines, &lines.lines, &data, time, compression))
}

/// Cells with fields on them as a `.vtp` file; `time` in s, or where the clock of the run stands.
pub(crate) fn layer(layer: &Layer<'_>, time: f64, compression: Compression) -> Result<Vec<u8>, VtkError> {
    let fields = arrays(&layer.fields, layer.cells.len(), compression)?;
    let data = format!("<CellData>{fields}</CellData>");
    Ok(poly_data(&layer.points, layer.kind, &layer.cells, &data, time, compression))
}

fn poly_data(
    points: &[Vec2],
    kind: CellKind,
    cells_of: &[Vec<u32>],
    data: &str,
    time: f64,
    compression: Compression,
) -> Vec<u8> {
    let name = match kind {
        CellKind::Points => "Verts",
        CellKind::Lines => "Lines",
        CellKind::Polygons => "Polys",
    };
    let mut counts = format!("NumberOfPoints=\"{}\"", points.len());
    for other in ["Verts", "Lines", "Strips", "Polys"] {
        let count = if other == name { cells_of.len() } else { 0 };
        // Writing to a string cannot fail.
        let _ = write!(counts, " NumberOf{other}=\"{count}\"");
    }
    let topology = cells(cells_of.iter().map(|cell| cell.iter().map(|&point| i64::from(point))), compression);
    let piece = format!("<Piece {counts}>{data}{}<{name}>{topology}</{name}></Piece>", places(points, compression));
    file("PolyData", "", time, &piece, compression)
}

/// A file of the given kind around its one piece.
fn file(kind: &str, attributes: &str, time: f64, piece: &str, compression: Compression) -> Vec<u8> {
    let compressor = compression.attribute();
    format!(
        "<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>\
         <{kind}{attributes}><FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\">{time:?}</DataArray></FieldData>{piece}</{kind}></VTKFile>"
    )
    .into_bytes()
}

/// Points, cells or other elements with their points, one after the other, and where each ends.
fn cells(of: impl Iterator<Item = impl IntoIterator<Item = i64>>, compression: Compression) -> String {
    let (mut connectivity, mut offsets) = (Vec::new(), Vec::new());
    for cell in of {
        connectivity.extend(cell);
        offsets.push(connectivity.len() as i64);
    }
    compression.integers("connectivity", &connectivity) + &compression.integers("offsets", &offsets)
}

fn places(points: &[Vec2], compression: Compression) -> String {
    format!("<Points>{}</Points>", compression.vectors("Points", points))
}

/// The fields, one after the other.
fn arrays(fields: &[Field<'_>], points: usize, compression: Compression) -> Result<String, VtkError> {
    let mut text = String::new();
    for field in fields {
        let (found, array) = match &field.values {
            Values::Scalar(values) => (values.len(), compression.scalars(field.name, values)),
            Values::Vector(values) => (values.len(), compression.vectors(field.name, values)),
            Values::Integer(values) => (values.len(), compression.integers(field.name, values)),
        };
        if found != points {
            return Err(VtkError::Length { name: field.name, found, expected: points });
        }
        text += &array;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use vtkio::IOBuffer;
    use vtkio::model::{Attribute, CellType, DataSet, Vtk};

    use super::*;

    fn find(bytes: &[u8], text: &str) -> Option<usize> {
        bytes.windows(text.len()).position(|window| window == text.as_bytes())
    }

    fn parse(bytes: &[u8]) -> Vtk {
        Vtk::parse_xml(bytes).unwrap()
    }

    fn fields(count: usize) -> Vec<Field<'static>> {
        let scalar: Vec<f64> = (0..count).map(|i| if i == 0 { f64::NAN } else { i as f64 / 3.0 }).collect();
        vec![
            Field { name: "pressure", unit: "Pa", values: Values::Scalar(scalar.into()) },
            Field { name: "velocity", unit: "m/s", values: Values::Vector(vec![Vec2::new(1.0, 2.0); count].into()) },
            Field { name: "id", unit: "", values: Values::Integer((0..count as i64).collect()) },
        ]
    }

    #[test]
    fn particles_read_back_as_vertex_cells_with_all_fields_and_the_time() {
        let points_given: Vec<Vec2> = (0..5000).map(|i| Vec2::new(f64::from(i) * 1.0e-7 / 3.0, -1.0e-3)).collect();
        let cloud = Cloud { points: Cow::Borrowed(&points_given), fields: fields(5000) };
        let bytes = points(&cloud, 0.25e-3, Compression::Zlib).unwrap();
        assert!(find(&bytes, "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.00025<").is_some());
        let DataSet::UnstructuredGrid { pieces, .. } = parse(&bytes).data else { panic!("not an unstructured grid") };
        let piece = pieces.into_iter().next().unwrap().into_loaded_piece_data(None).unwrap();
        assert_eq!(piece.points, IOBuffer::F64(points_given.iter().flat_map(|v| [v.x, v.y, 0.0]).collect()));
        assert_eq!(piece.cells.types, vec![CellType::Vertex; 5000]);
        let names: Vec<&str> = piece.data.point.iter().map(Attribute::name).collect();
        assert_eq!(names, ["pressure", "velocity", "id"]);
    }

    #[test]
    fn a_grid_keeps_its_origin_and_spacing_in_double_precision() {
        let example = Grid {
            origin: Vec2::new(0.1e-3, -1.0 / 3.0),
            spacing: Vec2::new(1.0e-5, 2.0e-5),
            counts: [4, 3],
            fields: fields(12),
        };
        let bytes = grid(&example, 1.0, Compression::Zlib).unwrap();
        assert!(find(&bytes, "Origin=\"0.0001 -0.3333333333333333 0\"").is_some());
        let DataSet::ImageData { extent, spacing, .. } = parse(&bytes).data else { panic!("not image data") };
        assert_eq!(extent.into_dims(), [4, 3, 1]);
        assert_eq!(spacing[..2], [1.0e-5_f32, 2.0e-5]);
    }

    #[test]
    fn lines_read_back_with_their_vertices() {
        let vertices = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        let example =
            Lines { points: Cow::Borrowed(&vertices), lines: vec![vec![0, 1, 2, 0], vec![1, 2]], fields: fields(3) };
        let DataSet::PolyData { pieces, .. } = parse(&lines(&example, 0.0, Compression::Lz4).unwrap()).data else {
            panic!("not lines")
        };
        let piece = pieces.into_iter().next().unwrap().into_loaded_piece_data(None).unwrap();
        assert_eq!(piece.num_lines(), 2);
        assert_eq!(piece.num_points(), 3);
    }

    #[test]
    fn files_without_points_tell_their_counts_and_the_names_of_their_fields() {
        let nothing = Lines { fields: fields(0), ..Lines::default() };
        let bytes = lines(&nothing, 0.0, Compression::Zlib).unwrap();
        assert!(matches!(parse(&bytes).data, DataSet::PolyData { .. }));
        assert!(find(&bytes, "<Piece NumberOfPoints=\"0\"").is_some() && find(&bytes, "Name=\"velocity\"").is_some());
        let bytes = points(&Cloud { points: Cow::default(), fields: fields(0) }, 0.0, Compression::Zlib).unwrap();
        assert!(matches!(parse(&bytes).data, DataSet::UnstructuredGrid { .. }));
    }

    #[test]
    fn a_field_of_another_length_is_refused() {
        let cloud = Cloud { points: vec![Vec2::zeros(); 2].into(), fields: fields(3) };
        assert_eq!(
            points(&cloud, 0.0, Compression::None).unwrap_err().to_string(),
            "the field pressure has 3 values, expected 2"
        );
    }
}
