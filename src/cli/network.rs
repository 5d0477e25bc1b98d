//! `meniscus network`: pores and throats of a shape file, and a displacement in them, without a case file.

use std::path::Path;

use super::arguments::{NetworkArguments, PeriodicAxes};
use super::exit::Failure;
use super::output::tell;
use super::run::{finish, new_folder};
use super::source::{self, Source};
use super::verify::verify;
use super::verify_arguments::NetworkCommand;
use crate::case::network::{RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess};
use crate::case::{RawInterface, RawWetting, SideName, quick as network_case};
use crate::geometry::spec::GeometrySpec;
use crate::input::tables::Words;
use crate::run::execute::Mode;
use crate::wetting::{Wetting, Young};

/// Tension in N/m where none is given: pressures are then those per N/m of tension.
const UNIT_TENSION: f64 = 1.0;
/// Contact angle in degrees where none is given: the wetting phase wets wholly.
const WHOLLY_WETTING: f64 = 0.0;

/// Extracts the network of a shape file, or of the geometry of a case file, and displaces what the options say.
pub(crate) fn network(arguments: &NetworkArguments) -> Result<u8, Failure> {
    if let Some(NetworkCommand::Verify(arguments)) = &arguments.command {
        return verify(arguments);
    }
    let source = load(arguments)?;
    let folder = new_folder(arguments.out.as_deref(), &source.name, Mode::New);
    finish(&source, folder, Mode::New, arguments.threads)
}

fn load(arguments: &NetworkArguments) -> Result<Source, Failure> {
    // The command line asks for it.
    let path = arguments.file.as_deref().unwrap_or(Path::new(""));
    if !source::is_case_file(path) {
        let read = source::geometry_of_file(
            path,
            &arguments.import.options(),
            arguments.periodic.map(PeriodicAxes::along).unwrap_or_default(),
        )?;
        return quick(arguments, read.spec, arguments.depth.or(read.depth));
    }
    let overrides = overrides(arguments);
    let case = source::load_case(Some(path), &[])?;
    if source::is_network(&case.case) {
        return source::load_case(Some(path), &overrides);
    }
    quick(arguments, case.case.geometry, arguments.depth.or(case.case.depth))
}

fn quick(arguments: &NetworkArguments, geometry: GeometrySpec, depth: Option<f64>) -> Result<Source, Failure> {
    let name = arguments.file.as_deref().and_then(Path::file_stem).unwrap_or_default().to_string_lossy().into_owned();
    if arguments.has_interface() && arguments.tension.is_none() {
        tell("no --tension: pressures are those of a tension of 1 N/m; multiply them by yours");
    }
    let title = format!("Network of {name}");
    let (case, resolved) =
        network_case(&title, geometry, depth, &raw(arguments)).map_err(|problems| source::of_options(&problems))?;
    Ok(Source { case, resolved, name: format!("{name}-network"), notes: Vec::new(), document: None })
}

/// The keys of `[network]` that the options stand for.
fn raw(arguments: &NetworkArguments) -> RawNetwork {
    let along = |axes: &[PeriodicAxes]| {
        arguments.periodic.filter(|given| axes.contains(given)).map(|_| RawNetworkSide::Periodic)
    };
    let x = along(&[PeriodicAxes::X, PeriodicAxes::Xy]);
    let y = along(&[PeriodicAxes::Y, PeriodicAxes::Xy]);
    let angle = arguments.angle_deg.unwrap_or(WHOLLY_WETTING);
    RawNetwork {
        inlet: arguments.inlet,
        outlet: arguments.outlet,
        sides: Some(RawNetworkSides { left: x, right: x, bottom: y, top: y }),
        interface: arguments
            .has_interface()
            .then(|| RawInterface { tension: Some(arguments.tension.unwrap_or(UNIT_TENSION)) }),
        wetting: arguments
            .has_interface()
            .then(|| RawWetting::of(&Wetting::Young(Young { contact_angle_deg: angle }), None)),
        process: arguments.process,
        cycles: arguments.cycles,
        trapping: arguments.trapping,
        persistence: arguments.persistence,
        ..RawNetwork::default()
    }
}

/// The options as changes of a case file with `[network]`.
fn overrides(arguments: &NetworkArguments) -> Vec<String> {
    let name = |side: SideName| format!("\"{}\"", side.word());
    let axes = |axes: PeriodicAxes| match axes {
        PeriodicAxes::X => &["left", "right"][..],
        PeriodicAxes::Y => &["bottom", "top"],
        PeriodicAxes::Xy => &["left", "right", "bottom", "top"],
    };
    let process = |process: RawProcess| format!("\"{}\"", process.word());
    let given = [
        ("persistence", arguments.persistence.map(|value| value.to_string())),
        ("wetting.young.contact-angle-deg", arguments.angle_deg.map(|value| value.to_string())),
        ("interface.tension", arguments.tension.map(|value| value.to_string())),
        ("inlet", arguments.inlet.map(name)),
        ("outlet", arguments.outlet.map(name)),
        ("process", arguments.process.map(process)),
        ("cycles", arguments.cycles.map(|value| value.to_string())),
        ("trapping", arguments.trapping.map(|value| value.to_string())),
    ];
    let given = given.into_iter().filter_map(|(key, value)| Some(format!("network.{key}={}", value?)));
    let given = given.chain(arguments.depth.map(|depth| format!("geometry.depth={depth}")));
    let periodic = arguments.periodic.map_or(&[][..], axes).iter();
    given.chain(periodic.map(|side| format!("network.sides.{side}=\"periodic\""))).collect()
}
