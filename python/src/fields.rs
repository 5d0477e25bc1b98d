//! The fields of a solver as data for Python, with the names and the exact values of the files that a run writes.

use meniscus::{Series, Snapshot, Solver, Values, Vec2};
use meniscus_core::diagram::{Diagram, Stroke};
use meniscus_core::snapshot::{CellKind, Cloud, Field, Grid, Layer, Lines};
use meniscus_core::table::{Cells, Table};

use crate::data::Data;

/// The state at one time: the content of the VTK files of that time.
pub(crate) fn frame(time: f64, snapshot: &Snapshot<'_>, layers: &[Layer<'_>]) -> Data {
    Data::group([
        ("time", Data::Number(time)),
        ("particles", cloud(&snapshot.particles)),
        ("grid", snapshot.grid.as_ref().map_or(Data::Absent, grid)),
        ("interface", snapshot.interface.as_ref().map_or(Data::Absent, lines)),
        ("layers", Data::Group(layers.iter().map(|it| (it.name.to_owned(), layer(it))).collect())),
    ])
}

/// All output of a solver at its end.
pub(crate) fn all(solver: &dyn Solver) -> Data {
    let results = solver.results();
    let mut layers = solver.layers();
    layers.extend(results.layers.iter().map(|layer| layer()));
    let clock = solver.clock();
    Data::group([
        ("frame", frame(solver.time(), &solver.snapshot(), &layers)),
        ("clock", Data::group([("name", Data::text(clock.name)), ("unit", Data::text(clock.unit))])),
        ("solid", lines(&solver.outline())),
        (
            "tables",
            Data::Group(results.tables.iter().map(|it| it()).map(|it| (it.name.to_owned(), table(&it))).collect()),
        ),
        (
            "documents",
            Data::Group(results.documents.iter().map(|it| (it.name.to_owned(), Data::Text(it.text()))).collect()),
        ),
        ("diagrams", Data::Group(solver.diagrams().iter().map(|it| (it.name.to_owned(), diagram(it))).collect())),
    ])
}

/// The rows of the series, column by column.
pub(crate) fn series(series: &Series) -> Data {
    let column = |index: usize| series.rows.iter().map(|row| row[index]).collect();
    let columns = series.columns.iter().enumerate();
    Data::Group(columns.map(|(index, name)| (name.clone(), Data::Floats(column(index), 1))).collect())
}

fn points(points: &[Vec2]) -> Data {
    Data::Floats(points.iter().flat_map(|x| [x.x, x.y]).collect(), 2)
}

fn cells<'c>(cells: impl Iterator<Item = &'c Vec<u32>>) -> [(&'static str, Data); 2] {
    let (mut vertices, mut ends) = (Vec::new(), Vec::new());
    for cell in cells {
        vertices.extend(cell.iter().map(|&vertex| i64::from(vertex)));
        ends.push(vertices.len() as i64);
    }
    [("vertices", Data::Integers(vertices, 1)), ("ends", Data::Integers(ends, 1))]
}

fn fields(fields: &[Field<'_>]) -> [(&'static str, Data); 2] {
    let values = |field: &Field<'_>| match &field.values {
        Values::Scalar(values) => Data::Floats(values.to_vec(), 1),
        Values::Vector(values) => points(values),
        Values::Integer(values) => Data::Integers(values.to_vec(), 1),
    };
    let named = |of: &dyn Fn(&Field<'_>) -> Data| {
        Data::Group(fields.iter().map(|field| (field.name.to_owned(), of(field))).collect())
    };
    [("fields", named(&values)), ("units", named(&|field| Data::text(field.unit)))]
}

fn cloud(cloud: &Cloud<'_>) -> Data {
    if cloud.points.is_empty() && cloud.fields.is_empty() {
        return Data::Absent;
    }
    let [values, units] = fields(&cloud.fields);
    Data::group([("points", points(&cloud.points)), values, units])
}

fn grid(grid: &Grid<'_>) -> Data {
    let [values, units] = fields(&grid.fields);
    Data::group([
        ("origin", Data::Floats(vec![grid.origin.x, grid.origin.y], 1)),
        ("spacing", Data::Floats(vec![grid.spacing.x, grid.spacing.y], 1)),
        ("counts", Data::Integers(grid.counts.map(|count| count as i64).to_vec(), 1)),
        values,
        units,
    ])
}

fn lines(lines: &Lines<'_>) -> Data {
    let [values, units] = fields(&lines.fields);
    let [vertices, ends] = cells(lines.lines.iter());
    Data::group([("points", points(&lines.points)), vertices, ends, values, units])
}

fn layer(layer: &Layer<'_>) -> Data {
    let [values, units] = fields(&layer.fields);
    let vertices: Vec<Vec2> = layer.vertices().collect();
    let numbers = Data::Integers((0..vertices.len() as i64).collect(), 1);
    let ends = Data::Integers(layer.ends.iter().map(|&end| i64::from(end)).collect(), 1);
    let kind = match layer.kind {
        CellKind::Points => "points",
        CellKind::Lines => "lines",
        CellKind::Polygons => "polygons",
    };
    Data::group([
        ("kind", Data::text(kind)),
        ("points", points(&vertices)),
        ("vertices", numbers),
        ("ends", ends),
        values,
        units,
    ])
}

/// As in the file: absent numbers are NaN, absent indices are -1, and minus zero is zero.
fn table(table: &Table) -> Data {
    let number = |value: &f64| if value.is_finite() { value + 0.0 } else { f64::NAN };
    let column = |cells: &Cells| match cells {
        Cells::Numbers(values) => Data::Floats(values.iter().map(number).collect(), 1),
        Cells::Counts(values) => Data::Integers(values.iter().map(|&value| value as i64).collect(), 1),
        Cells::Indices(values) => {
            Data::Integers(values.iter().map(|value| value.map_or(-1, |index| index as i64)).collect(), 1)
        }
        Cells::Flags(values) => Data::Flags(values.clone()),
        Cells::Words(values) => Data::Words(values.clone()),
    };
    Data::Group(table.columns.iter().map(|it| (it.name.to_owned(), column(&it.cells))).collect())
}

fn diagram(diagram: &Diagram) -> Data {
    let stroke = |stroke| match stroke {
        Stroke::Full => "full",
        Stroke::Thin => "thin",
        Stroke::Dashed => "dashed",
        Stroke::Dots => "dots",
        Stroke::Band => "band",
        // Those of the curves of studies.
        Stroke::Bar | Stroke::Blank | Stroke::Disc | Stroke::Ring | Stroke::Reference => "dots",
    };
    let traces = diagram.traces.iter().map(|trace| {
        Data::group([
            ("name", Data::text(&trace.name)),
            ("stroke", Data::text(stroke(trace.stroke))),
            ("points", Data::Floats(trace.points.as_flattened().to_vec(), 2)),
        ])
    });
    let map = diagram.map.as_ref().map_or(Data::Absent, |map| {
        Data::group([
            ("label", Data::text(&map.quantity.label)),
            ("x", Data::Floats(map.x.clone(), 1)),
            ("y", Data::Floats(map.y.clone(), 1)),
            ("values", Data::Floats(map.values.clone(), 1)),
        ])
    });
    let logarithmic = vec![diagram.x.logarithmic, diagram.y.logarithmic];
    Data::group([
        ("title", Data::text(&diagram.title)),
        ("labels", Data::List([&diagram.x.label, &diagram.y.label].map(|label| Data::text(label)).into())),
        ("logarithmic", Data::Flags(logarithmic)),
        ("traces", Data::List(traces.collect())),
        ("map", map),
    ])
}
