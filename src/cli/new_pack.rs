//! `meniscus new --pack`: generated grains as an ordinary shape file, and their properties.

use std::path::Path;

use super::arguments::{NewArguments, PackArguments, PackKind, PackPeriodic};
use super::exit::{BAD_INPUT, DONE, Failure, USAGE};
use super::output::{readable, say};
use super::source::valid_depth;
use meniscus_drawings::export::{self, Beside, Format};
use meniscus_geometry::Geometry;
use meniscus_geometry::pack::{Micromodel, array, micromodel, random_pack, smallest_gap};
use meniscus_geometry::spec::{
    Arrangement, Array, Disc, GeometrySpec, PackAxes, RandomPack, ShapeSpec, SolidSide, ThroatCosine,
};
use meniscus_output::atomic;

/// Fractions of the pack's size that a micromodel adds, and of a cosine throat's.
const MANIFOLD: f64 = 0.1;
const CHANNEL_WIDTH: f64 = 0.2;
const CHANNEL_LENGTH: f64 = 0.2;
const WALL: f64 = 0.05;
const THROAT_WALLS: f64 = 0.8;
const THROAT_LENGTH: f64 = 0.5;

/// Generates the grains, writes them, and prints porosity, smallest gap and whether the pore space percolates.
pub(crate) fn new_pack(kind: PackKind, arguments: &NewArguments, file: &Path) -> Result<u8, Failure> {
    let (depth, arguments) = (arguments.depth, &arguments.pack);
    // The command line requires two numbers.
    let size = [arguments.size.first().copied().unwrap_or(0.0), arguments.size.get(1).copied().unwrap_or(0.0)];
    let region = [[0.0; 2], size];
    let (spec, discs, periodic) = shapes(kind, arguments, region).map_err(Failure::with(BAD_INPUT))?;
    let geometry = Geometry::new(&spec).map_err(Failure::with(BAD_INPUT))?.with_periodic(periodic);
    valid_depth(depth, &spec)?;
    let comment = format!("# {}\n", std::env::args().skip(1).collect::<Vec<_>>().join(" "));
    let mut text = comment.into_bytes();
    text.extend(
        export::write(&spec, Format::Toml, Beside { depth, ..Beside::default() }).map_err(Failure::with(BAD_INPUT))?,
    );
    atomic::write(file, &text).map_err(Failure::with(USAGE))?;
    say(format_args!("wrote {} with {} discs, {} shapes", file.display(), discs.len(), spec.shapes.len()));
    say(format_args!("porosity      {}", readable(geometry.porosity().value)));
    let gap = smallest_gap(&discs, region, periodic);
    if gap.is_finite() {
        say(format_args!("smallest gap  {} m", readable(gap)));
    }
    // Generators leave a gap around every disc, so only touching grains could block the flow.
    say(format_args!("percolates    {}", if gap > 0.0 { "yes" } else { "no" }));
    Ok(DONE)
}

type Made = (GeometrySpec, Vec<Disc>, [bool; 2]);

fn shapes(
    kind: PackKind,
    arguments: &PackArguments,
    region: [[f64; 2]; 2],
) -> Result<Made, meniscus_geometry::pack::PackError> {
    let [min, max] = region;
    let plain = |discs: &[Disc]| GeometrySpec {
        min,
        max,
        solid: SolidSide::Inside,
        shapes: discs.iter().cloned().map(ShapeSpec::Disc).collect(),
    };
    let periodic = match arguments.periodic {
        PackPeriodic::None => PackAxes::None,
        PackPeriodic::X => PackAxes::X,
        PackPeriodic::Y => PackAxes::Y,
        PackPeriodic::Xy => PackAxes::Xy,
    };
    let PackArguments { seed, porosity, radius, radius_deviation, gap, .. } = *arguments;
    let pack = RandomPack { seed, porosity, radius, radius_deviation, gap, region, periodic };
    let lattice = |arrangement| array(&Array { arrangement, radius, gap, region });
    Ok(match kind {
        PackKind::Random => {
            let discs = random_pack(&pack)?;
            (plain(&discs), discs, periodic.axes())
        }
        PackKind::Square | PackKind::Hexagonal => {
            let is_square = kind == PackKind::Square;
            let discs = lattice(if is_square { Arrangement::Square } else { Arrangement::Hexagonal })?;
            (plain(&discs), discs, [false; 2])
        }
        PackKind::Cosine => {
            let throat = ThroatCosine {
                center: [0.5 * max[0], 0.5 * max[1]],
                width: THROAT_WALLS * max[1],
                throat: gap,
                length: THROAT_LENGTH * max[0],
                rotation_deg: 0.0,
            };
            (GeometrySpec { shapes: vec![ShapeSpec::ThroatCosine(throat)], ..plain(&[]) }, Vec::new(), [false; 2])
        }
        PackKind::Micromodel => {
            let model = Micromodel {
                pack: RandomPack { periodic: PackAxes::None, ..pack },
                manifold: MANIFOLD * max[0],
                channel_width: CHANNEL_WIDTH * max[1],
                channel_length: CHANNEL_LENGTH * max[0],
                wall: WALL * max[1],
            };
            let (spec, discs) = micromodel(&model)?;
            (spec, discs, [false; 2])
        }
    })
}
