//! `meniscus couple`: a slow displacement in a network, one avalanche of which is run by direct simulation, and continued from its final state.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::exit::{BAD_INPUT, BUG, DONE, Failure, SOLVER_FAILED, USAGE};
use super::output::{readable, say, tell};
use super::run::{finish, new_folder};
use super::source;
use crate::run::avalanche::{Avalanche, AvalancheError, Wanted, find, state_at_end};
use crate::run::execute::Mode;
use crate::run::folder;
use crate::run::source::Source;
use meniscus_case::network::state::NetworkState;
use meniscus_case::{Case, Drive, Model, SIDES, Side};
use meniscus_output::atomic;

/// `couple`.
#[derive(Debug, Args)]
pub(crate) struct CoupleArguments {
    /// Case file with [network], an inlet and an outlet, without [network.dynamic]
    pub(crate) network: PathBuf,
    /// Case file with [sph] and two fluids, of the same geometry, an inlet with a pressure and an outlet, which starts from [sph.initial] network = "..."; the
    /// state and the pressure are set by this command
    pub(crate) direct: PathBuf,
    /// Avalanche for the direct simulation, by its first event of a kind: breakthrough, overlap (two menisci meet), or pore:N (pore N of pores.csv is invaded)
    #[arg(long, value_name = "WHICH", default_value = "breakthrough", value_parser = wanted)]
    pub(crate) event: Wanted,
    /// Excess over the pressure of the event, relative to it; with a depth, relative to the part due to the in-plane curvature
    #[arg(long, value_name = "SHARE", default_value = "0.02", value_parser = fraction)]
    pub(crate) excess: f64,
    /// Output folder, new or empty; if not given: out/NAME-couple, out/NAME-couple-2, ..., NAME being that of the direct case
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Number of threads; all cores if not given. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,
}

fn wanted(text: &str) -> Result<Wanted, String> {
    match text.split_once(':') {
        None if text == "breakthrough" => Ok(Wanted::Breakthrough),
        None if text == "overlap" => Ok(Wanted::Overlap),
        Some(("pore", number)) => {
            number.parse().map(Wanted::Pore).map_err(|_| format!("{number} is not the number of a pore"))
        }
        _ => Err("expected breakthrough, overlap or pore:N, with the number N of a pore".to_owned()),
    }
}

fn fraction(text: &str) -> Result<f64, String> {
    let fraction = text.parse().ok().filter(|fraction| (0.0..1.0).contains(fraction) && *fraction > 0.0);
    fraction.ok_or_else(|| "expected a number above 0 and below 1".to_owned())
}

/// Results, as written to `couple.json`.
#[derive(Debug, Serialize)]
struct Coupled {
    /// The avalanche in the network.
    avalanche: Avalanche,
    /// Capillary pressure p_n - p_w in Pa that drives the direct simulation.
    driving_pressure_pa: f64,
    /// Wetting saturation at the end of the direct simulation, counted by whole elements.
    saturation_by_direct_simulation: f64,
    /// Fraction of the elements with the same phase after the avalanche in network and direct simulation.
    same_elements: Option<f64>,
}

/// Runs the three parts, writes `couple.json`, and prints the results.
pub(crate) fn couple(arguments: &CoupleArguments) -> Result<u8, Failure> {
    let network = source::load_case(Some(&arguments.network), &[])?;
    let avalanche = find(&network.case, arguments.event).map_err(|error| failure(&network, &error))?;
    let name = arguments.direct.file_stem().map_or_else(|| "direct".into(), |stem| stem.to_string_lossy().into_owned());
    let direction = if avalanche.invading == meniscus_case::FluidPhase::NonWetting { 1.0 } else { -1.0 };
    let beyond = |fraction: f64| avalanche.pressure_pa + direction * fraction * avalanche.in_plane_pa;
    let driving = beyond(arguments.excess);
    let stop = |pressure: f64| format!("network.stop.capillary-pressure={pressure:?}");
    // Both cases are checked before anything runs.
    let at_rest = source::load_case(Some(&arguments.network), &[stop(avalanche.rest_pressure_pa)])?;
    let start = state_at_end(&at_rest.case).map_err(|error| failure(&at_rest, &error))?;
    let direct = source::load_started(&arguments.direct, &[], &start)?;
    if direct.case.depth != network.case.depth {
        let text = |case: &Case| case.depth.map_or("no depth".to_owned(), |depth| format!("a depth of {depth:e} m"));
        let message =
            format!("the network has {}, and the direct simulation {}", text(&network.case), text(&direct.case));
        return Err(direct.refused_at("geometry.depth", &message, "give both the same").into());
    }
    let inlet = inlet_pressure(&direct, avalanche.inlet, direction * driving)?;
    source::load_started(&arguments.direct, std::slice::from_ref(&inlet), &start)?;
    let out = new_folder(arguments.out.as_deref(), &format!("{name}-couple"), Mode::New);
    let _claim = folder::create(&out).map_err(Failure::with(USAGE))?;
    let [before, during, same, after] = ["1-network", "2-direct", "2-network", "3-network"].map(|part| out.join(part));
    tell(format_args!(
        "the avalanche begins at {} Pa and has {} events",
        readable(avalanche.pressure_pa),
        avalanche.events
    ));

    let parts = [
        (&arguments.network, vec![stop(avalanche.rest_pressure_pa)], &before),
        (&arguments.direct, vec![initial("sph.initial.network", &before)?, inlet], &during),
        // The same avalanche by the network, for comparison.
        (&arguments.network, vec![stop(driving)], &same),
        (&arguments.network, vec![initial("network.initial", &during)?], &after),
    ];
    for (case, overrides, folder) in parts {
        let source = source::load_case(Some(case), &overrides)?;
        let code = finish(&source, folder.clone(), Mode::New, arguments.threads)?;
        if code != DONE {
            return Ok(code);
        }
    }
    let [by_direct, by_network] = [read(&during)?, read(&same)?];
    let found = Coupled {
        driving_pressure_pa: driving,
        saturation_by_direct_simulation: by_direct.saturation,
        same_elements: same_elements(&by_direct, &by_network),
        avalanche,
    };
    let json = serde_json::to_string_pretty(&found).map_err(Failure::with(BUG))?;
    atomic::write(&out.join("couple.json"), (json + "\n").as_bytes()).map_err(Failure::with(USAGE))?;
    summary(&found, &out);
    Ok(DONE)
}

/// `key` set to the final state of the run in a folder.
fn initial(key: &str, folder: &Path) -> Result<String, Failure> {
    let path = std::path::absolute(folder.join("at-end.json")).map_err(Failure::with(USAGE))?;
    Ok(format!("{key}={}", toml::Value::String(path.to_string_lossy().into_owned())))
}

/// The pressure at the inlet, `difference` in Pa above that at the outlet.
fn inlet_pressure(direct: &Source, inlet: usize, difference: f64) -> Result<String, Failure> {
    let Model::Sph(sph) = &direct.case.model else {
        return Err(direct
            .refused_at("", "the second case is not a direct simulation", "give it [sph] with both phases")
            .into());
    };
    if sph.initial.network.is_none() {
        let message = "the direct case does not begin with the state of a network";
        let help = "add [sph.initial] network = \"at-end.json\"; `couple` sets the file";
        return Err(direct.refused_at("sph.initial", message, help).into());
    }
    let sides = sph.sides.each();
    let pressure = |side: usize| match sph.open[side].map(|open| open.drive) {
        Some(Drive::Pressure(pressure)) => Some(pressure),
        _ => None,
    };
    let outlet = sides.iter().position(|&side| side == Side::Outlet).and_then(pressure);
    let name = SIDES[inlet];
    match (pressure(inlet).filter(|_| sides[inlet] == Side::Inlet), outlet) {
        (Some(_), Some(outlet)) => Ok(format!("sph.sides.open.{name}.pressure={:?}", outlet + difference)),
        (None, _) => {
            let message =
                format!("the network has its inlet at `{name}`, and here that is not an inlet with a pressure");
            let help = format!(
                "set {name} = \"inlet\", and pressure = 0.0 in [sph.sides.open.{name}]; `couple` sets the value"
            );
            Err(direct.refused_at(&format!("sph.sides.{name}"), &message, &help).into())
        }
        (_, None) => {
            let help = "make the side of the network's outlet an outlet";
            Err(direct.refused_at("sph.sides", "there is no outlet with a pressure", help).into())
        }
    }
}

fn read(folder: &Path) -> Result<NetworkState, Failure> {
    let path = folder.join("at-end.json");
    let text =
        std::fs::read_to_string(&path).map_err(|error| Failure::new(USAGE, format!("{}: {error}", path.display())))?;
    NetworkState::read(&text).map_err(|error| Failure::new(BUG, format!("{}: {error}", path.display())))
}

/// Fraction of the elements with the same phase in both.
fn same_elements(one: &NetworkState, other: &NetworkState) -> Option<f64> {
    let count = one.elements.len();
    let same = one.elements.iter().zip(&other.elements).filter(|(a, b)| a.phase == b.phase).count();
    (count > 0 && count == other.elements.len()).then(|| same as f64 / count as f64)
}

fn failure(network: &Source, error: &AvalancheError) -> Failure {
    if let AvalancheError::Setup(misfit) = error {
        return network.refused(misfit).into();
    }
    let code = if matches!(error, AvalancheError::Solver(_)) { SOLVER_FAILED } else { BAD_INPUT };
    Failure::new(code, error)
}

fn summary(found: &Coupled, out: &Path) {
    let [before, after] = found.avalanche.saturation.map(readable);
    say(format_args!(
        "the avalanche at {} Pa, driven at {} Pa",
        readable(found.avalanche.pressure_pa),
        readable(found.driving_pressure_pa)
    ));
    say(format_args!("  saturation before        {before}"));
    say(format_args!("  after, by the network    {after}"));
    say(format_args!("  after, by direct         {}", readable(found.saturation_by_direct_simulation)));
    if let Some(same) = found.same_elements {
        say(format_args!("  elements alike           {}", readable(same)));
    }
    say(format_args!("  written                  {}", out.join("couple.json").display()));
}
