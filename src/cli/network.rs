//! `meniscus network`: pores and throats of a shape file, and a displacement in them, without a case file.

use std::path::Path;

use super::arguments::{NetworkArguments, PeriodicAxes};
use super::exit::Failure;
use super::run::{finish, new_folder};
use super::source::load_network;
use super::verify::verify;
use super::verify_arguments::NetworkCommand;
use crate::run::execute::Mode;
use meniscus_case::NetworkOptions;

/// Extracts the network of a shape file, or of the geometry of a case file, and runs the displacement given by the options.
pub(crate) fn network(arguments: &NetworkArguments) -> Result<u8, Failure> {
    if let Some(NetworkCommand::Verify(arguments)) = &arguments.command {
        return verify(arguments);
    }
    // The command line requires the file.
    let path = arguments.file.as_deref().unwrap_or(Path::new(""));
    let source = load_network(path, &arguments.import.options(), &options(arguments))?;
    let folder = new_folder(arguments.out.as_deref(), &source.name, Mode::New);
    finish(&source, folder, Mode::New, arguments.threads)
}

fn options(arguments: &NetworkArguments) -> NetworkOptions {
    NetworkOptions {
        persistence: arguments.persistence,
        angle_deg: arguments.angle_deg,
        tension: arguments.tension,
        inlet: arguments.inlet,
        outlet: arguments.outlet,
        process: arguments.process,
        cycles: arguments.cycles,
        trapping: arguments.trapping,
        films: arguments.films,
        region: arguments.region,
        results: arguments.results,
        periodic: arguments.periodic.map(PeriodicAxes::along).unwrap_or_default(),
        depth: arguments.depth,
    }
}
