//! `meniscus geometry`: measures of a shape file or of the geometry of a case, its outline, its signed distance and a picture.

use std::path::Path;

use super::arguments::{GeometryArguments, PeriodicAxes};
use super::exit::{BUG, DONE, Failure, USAGE};
use super::output::{readable, say, tell};
use super::source::{self, Shapes};
use super::stages::Stages;
use super::write_shapes::{formats, write_shapes};
use crate::run::slips::slip_of_size;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Cloud, Field, Snapshot, Values};
use meniscus_output::picture::{PORE, picture};
use meniscus_output::{atomic, vtk};

/// Stages of loading and measuring, and those of writing.
const STAGES: usize = 5;
const WRITING_STAGES: usize = 1;

/// Measures a shape file and writes its outline, distance field and picture.
pub(crate) fn geometry(arguments: &GeometryArguments) -> Result<u8, Failure> {
    let formats = formats(&arguments.drawings)?;
    let count = if arguments.out.is_some() { STAGES + WRITING_STAGES } else { STAGES };
    let stages = Stages::of(count);
    let periodic = arguments.periodic.map(PeriodicAxes::along);
    let shapes =
        source::load_shapes(&arguments.file, &arguments.import.options(), periodic, arguments.depth, |stage| {
            stages.at(stage)
        })?;
    let width = shapes.measures.iter().map(|measure| measure.name.len()).max().unwrap_or(0);
    for measure in &shapes.measures {
        let value = format!("{} {}", readable(measure.value), measure.unit);
        say(format_args!("{:<width$}  {value:<12}  {}", measure.name, measure.method));
    }
    let none = "none: walls that a case has at its sides may be nearer to the shapes than these are to each other";
    say(format_args!("{:<width$}  {}", "sides", shapes.sides.as_deref().unwrap_or(none)));
    let [min, max] = [shapes.spec.min, shapes.spec.max].map(Vec2::from);
    if let Some(slip) = slip_of_size(max - min) {
        tell(format_args!("  WARNING     {slip}"));
    }
    if let Some(folder) = &arguments.out {
        let title = arguments.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        stages.at("drawing and writing files");
        write(folder, &shapes, &title)?;
        drop(stages);
        say(format_args!("wrote solid.vtu, distance.vtu and picture.png to {}", folder.display()));
    }
    write_shapes(&arguments.drawings, formats, &shapes)?;
    Ok(DONE)
}

fn write(folder: &Path, shapes: &Shapes, title: &str) -> Result<(), Failure> {
    let files = [
        ("solid.vtu", vtk::lines(&shapes.outline, vtk::Compression::default()).map_err(Failure::with(BUG))?),
        ("distance.vtu", vtk::grid(&shapes.distance, vtk::Compression::default()).map_err(Failure::with(BUG))?),
        (
            "picture.png",
            picture(&pore(shapes), &shapes.outline, title, None)
                .and_then(|picture| picture.png())
                .map_err(Failure::with(USAGE))?,
        ),
    ];
    files
        .iter()
        .try_for_each(|(name, content)| atomic::write(&folder.join(name), content))
        .map_err(Failure::with(USAGE))
}

/// The nodes of the grid as points, with those in the pore marked.
fn pore(shapes: &Shapes) -> Snapshot<'static> {
    const SOLID: i64 = 2;
    let points = shapes.distance.points();
    let distance = shapes.distance.fields.iter().find(|field| field.name == "wall-distance").map(|field| &field.values);
    let is_pore = |i: usize| matches!(distance, Some(Values::Scalar(d)) if d.get(i).is_some_and(|&d| d > 0.0));
    let phase = (0..points.len()).map(|i| if is_pore(i) { PORE } else { SOLID }).collect();
    let fields = vec![Field { name: "phase", unit: "", values: Values::Integer(phase) }];
    Snapshot { time: 0.0, step: 0, particles: Cloud { points: points.into(), fields }, grid: None, interface: None }
}
