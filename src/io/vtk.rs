//! Snapshots as VTK XML files: particles `.vtu`, grid `.vti`, lines and layers of cells `.vtp`, written by `vtkio`.
//!
//! Points of the plane get z = 0 and vectors three components. Arrays are compressed by LZ4, which ParaView and pyvista read.
//! `vtkio` knows neither field data nor double-precision grids, so the time and the grid's origin and spacing are put into
//! the text it writes. Nor does it write a readable file without points (it leaves out the count), so that one is written
//! here: an interface may vanish. Units stand in `units.json` of the output folder.

use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells, DataArray, DataSet, Extent, IOBuffer, ImageDataPiece, Piece,
    PolyDataPiece, UnstructuredGridPiece, Version, VertexNumbers, Vtk,
};
use vtkio::xml::Compressor;

use crate::math::Vec2;
use crate::snapshot::{CellKind, Cloud, Field, Grid, Layer, Lines, Values};

/// Fastest level of LZ4.
const COMPRESSION_LEVEL: u32 = 1;

/// A snapshot that cannot be written as VTK.
#[derive(Debug, thiserror::Error)]
pub enum VtkError {
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
    /// The VTK library refused the data.
    #[error("{0}")]
    Library(String),
}

/// Points as a `.vtu` file, each a vertex cell; `time` in s.
///
/// # Errors
/// [`VtkError`].
pub fn points(cloud: &Cloud<'_>, time: f64) -> Result<Vec<u8>, VtkError> {
    let count = cloud.points.len();
    if count == 0 {
        return Ok(empty("UnstructuredGrid", "Cells", &cloud.fields, time));
    }
    let piece = UnstructuredGridPiece {
        points: IOBuffer::F64(spatial(&cloud.points)),
        cells: Cells {
            cell_verts: VertexNumbers::XML {
                connectivity: (0..count as u64).collect(),
                offsets: (1..=count as u64).collect(),
            },
            types: vec![CellType::Vertex; count],
        },
        data: attributes(&cloud.fields, count)?,
    };
    file(DataSet::inline(piece), time, "<UnstructuredGrid>")
}

/// Fields on a regular grid as a `.vti` file; `time` in s.
///
/// # Errors
/// [`VtkError`].
pub fn grid(grid: &Grid<'_>, time: f64) -> Result<Vec<u8>, VtkError> {
    let last = |count: usize| i32::try_from(count.saturating_sub(1)).unwrap_or(i32::MAX);
    let extent = Extent::Ranges([0..=last(grid.counts[0]), 0..=last(grid.counts[1]), 0..=0]);
    let piece =
        ImageDataPiece { extent: extent.clone(), data: attributes(&grid.fields, grid.counts[0] * grid.counts[1])? };
    let data = DataSet::ImageData {
        extent,
        origin: [0.0; 3],
        spacing: [1.0; 3],
        meta: None,
        pieces: vec![Piece::Inline(Box::new(piece))],
    };
    let bytes = encode(data)?;
    let bytes = replace_attribute(&bytes, "Origin", &format!("{:?} {:?} 0", grid.origin.x, grid.origin.y))?;
    // The third spacing has no meaning with one layer of nodes, but must not be zero.
    let spacing = grid.spacing;
    let bytes = replace_attribute(&bytes, "Spacing", &format!("{:?} {:?} {:?}", spacing.x, spacing.y, spacing.x))?;
    with_time(&bytes, time, "<ImageData ")
}

/// Polylines as a `.vtp` file; `time` in s.
///
/// # Errors
/// [`VtkError`].
pub fn lines(lines: &Lines<'_>, time: f64) -> Result<Vec<u8>, VtkError> {
    if lines.points.is_empty() {
        return Ok(empty("PolyData", "Lines", &lines.fields, time));
    }
    let connectivity = lines.lines.iter().flatten().map(|&index| u64::from(index)).collect();
    let offsets = lines
        .lines
        .iter()
        .scan(0, |end, line| {
            *end += line.len() as u64;
            Some(*end)
        })
        .collect();
    let piece = PolyDataPiece {
        points: IOBuffer::F64(spatial(&lines.points)),
        lines: Some(VertexNumbers::XML { connectivity, offsets }),
        data: attributes(&lines.fields, lines.points.len())?,
        ..PolyDataPiece::default()
    };
    file(DataSet::inline(piece), time, "<PolyData>")
}

/// Cells with fields on them as a `.vtp` file; `time` in s, or where the clock of the run stands.
///
/// # Errors
/// [`VtkError`].
pub fn layer(layer: &Layer<'_>, time: f64) -> Result<Vec<u8>, VtkError> {
    if layer.points.is_empty() {
        return Ok(empty("PolyData", "Lines", &[], time));
    }
    let connectivity = layer.cells.iter().flatten().map(|&index| u64::from(index)).collect();
    let offsets = layer
        .cells
        .iter()
        .scan(0, |end, cell| {
            *end += cell.len() as u64;
            Some(*end)
        })
        .collect();
    let topology = Some(VertexNumbers::XML { connectivity, offsets });
    let data = Attributes { point: Vec::new(), cell: attributes(&layer.fields, layer.cells.len())?.point };
    let points = IOBuffer::F64(spatial(&layer.points));
    let piece = PolyDataPiece { points, data, ..PolyDataPiece::default() };
    let piece = match layer.kind {
        CellKind::Points => PolyDataPiece { verts: topology, ..piece },
        CellKind::Lines => PolyDataPiece { lines: topology, ..piece },
        CellKind::Polygons => PolyDataPiece { polys: topology, ..piece },
    };
    file(DataSet::inline(piece), time, "<PolyData>")
}

fn file(data: DataSet, time: f64, tag: &str) -> Result<Vec<u8>, VtkError> {
    with_time(&encode(data)?, time, tag)
}

fn encode(data: DataSet) -> Result<Vec<u8>, VtkError> {
    let vtk = Vtk {
        version: Version::new_xml(1, 0),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data,
        file_path: None,
    };
    let library = |error: vtkio::xml::Error| VtkError::Library(error.to_string());
    let mut bytes = Vec::new();
    vtk.try_into_xml_format(Compressor::LZ4, COMPRESSION_LEVEL)
        .and_then(|xml| xml.write(&mut bytes))
        .map_err(library)?;
    Ok(bytes)
}

/// Interleaved x, y, 0.
fn spatial(vectors: &[Vec2]) -> Vec<f64> {
    vectors.iter().flat_map(|v| [v.x, v.y, 0.0]).collect()
}

fn attributes(fields: &[Field<'_>], points: usize) -> Result<Attributes, VtkError> {
    let mut point = Vec::with_capacity(fields.len());
    for field in fields {
        let (components, found, data) = match &field.values {
            Values::Scalar(values) => (1, values.len(), IOBuffer::F64(values.to_vec())),
            Values::Vector(values) => (3, values.len(), IOBuffer::F64(spatial(values))),
            Values::Integer(values) => (1, values.len(), IOBuffer::I64(values.to_vec())),
        };
        if found != points {
            return Err(VtkError::Length { name: field.name, found, expected: points });
        }
        point.push(Attribute::DataArray(DataArray::new(field.name, components).with_buf(data)));
    }
    Ok(Attributes { point, cell: Vec::new() })
}

/// A file of the given type without a point, with the names of the fields.
fn empty(kind: &str, cells: &str, fields: &[Field<'_>], time: f64) -> Vec<u8> {
    let array = |kind: &str, name: &str, components: u32| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\"></DataArray>"
        )
    };
    let fields: String = fields
        .iter()
        .map(|field| match field.values {
            Values::Scalar(_) => array("Float64", field.name, 1),
            Values::Vector(_) => array("Float64", field.name, 3),
            Values::Integer(_) => array("Int64", field.name, 1),
        })
        .collect();
    let points = array("Float64", "Points", 3);
    let mut topology = array("Int64", "connectivity", 1) + &array("Int64", "offsets", 1);
    let mut counts = "NumberOfPoints=\"0\" NumberOfCells=\"0\"";
    if kind == "PolyData" {
        counts =
            "NumberOfPoints=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"";
    } else {
        topology += &array("UInt8", "types", 1);
    }
    let time = time_data(time);
    format!(
        "<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"><{kind}>{time}\
         <Piece {counts}><PointData>{fields}</PointData><Points>{points}</Points><{cells}>{topology}</{cells}></Piece>\
         </{kind}></VTKFile>"
    )
    .into_bytes()
}

/// The time in s as field data; ParaView shows it.
fn time_data(time: f64) -> String {
    format!(
        "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray></FieldData>"
    )
}

/// Puts the time as field data behind the first tag that begins with `tag`.
fn with_time(bytes: &[u8], time: f64, tag: &str) -> Result<Vec<u8>, VtkError> {
    let behind = find(bytes, tag)
        .and_then(|start| bytes[start..].iter().position(|&byte| byte == b'>').map(|length| start + length + 1))
        .ok_or_else(|| VtkError::Library(format!("no {tag} in the file")))?;
    Ok([&bytes[..behind], time_data(time).as_bytes(), &bytes[behind..]].concat())
}

/// Gives the first attribute `name` another value.
fn replace_attribute(bytes: &[u8], name: &str, value: &str) -> Result<Vec<u8>, VtkError> {
    let missing = || VtkError::Library(format!("no attribute {name} in the file"));
    let opening = format!("{name}=\"");
    let from = find(bytes, &opening).ok_or_else(missing)? + opening.len();
    let length = bytes[from..].iter().position(|&byte| byte == b'"').ok_or_else(missing)?;
    Ok([&bytes[..from], value.as_bytes(), &bytes[from + length..]].concat())
}

fn find(bytes: &[u8], text: &str) -> Option<usize> {
    bytes.windows(text.len()).position(|window| window == text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::borrow::Cow;

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
        let bytes = points(&cloud, 0.25e-3).unwrap();
        assert!(find(&bytes, "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.00025<").is_some());
        let DataSet::UnstructuredGrid { pieces, .. } = parse(&bytes).data else { panic!("not an unstructured grid") };
        let piece = pieces.into_iter().next().unwrap().into_loaded_piece_data(None).unwrap();
        assert_eq!(piece.points, IOBuffer::F64(spatial(&points_given)));
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
        let bytes = grid(&example, 1.0).unwrap();
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
        let DataSet::PolyData { pieces, .. } = parse(&lines(&example, 0.0).unwrap()).data else { panic!("not lines") };
        let piece = pieces.into_iter().next().unwrap().into_loaded_piece_data(None).unwrap();
        assert_eq!(piece.num_lines(), 2);
        assert_eq!(piece.num_points(), 3);
    }

    #[test]
    fn files_without_points_tell_their_counts_and_the_names_of_their_fields() {
        let nothing = Lines { fields: fields(0), ..Lines::default() };
        let bytes = lines(&nothing, 0.0).unwrap();
        assert!(matches!(parse(&bytes).data, DataSet::PolyData { .. }));
        assert!(find(&bytes, "<Piece NumberOfPoints=\"0\"").is_some() && find(&bytes, "Name=\"velocity\"").is_some());
        let bytes = points(&Cloud { points: Cow::default(), fields: fields(0) }, 0.0).unwrap();
        assert!(matches!(parse(&bytes).data, DataSet::UnstructuredGrid { .. }));
    }

    #[test]
    fn a_field_of_another_length_is_refused() {
        let cloud = Cloud { points: vec![Vec2::zeros(); 2].into(), fields: fields(3) };
        assert_eq!(points(&cloud, 0.0).unwrap_err().to_string(), "the field pressure has 3 values, expected 2");
    }
}
