//! The arguments of the command line.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

use clap_complete::Shell;

use super::compare::CompareArguments;
use super::couple::CoupleArguments;
use super::import_arguments::ImportArguments;
use super::movie::MovieArguments;
use super::run::RunArguments;
use super::study_arguments::StudyCommand;
use super::verify_arguments::NetworkCommand;
use meniscus_case::SideName;
use meniscus_case::network::{FilmModel, NetworkResults, RawProcess, RegionExtent};
use meniscus_core::input::tables::Words;

/// Exit codes, as in the help.
const EXIT_CODES: &str = "Exit codes: 0 done, 1 bug, 2 usage or output folder, 3 bad case or shape file, 4 solver failed, \
                          5 expectation failed, 130 interrupted";

/// Direct simulation of two-phase flow with partial wetting in pores.
///
/// Without a command: runs the built-in case, a wetting liquid between four discs.
#[derive(Debug, Parser)]
#[command(name = "meniscus", version, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    /// The command.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    /// Print results and errors only: no progress, notes or warnings
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a case: from a case file to VTK files, a series, a picture and a report
    Run(RunArguments),
    /// Report everything that is known before a run: mistakes, particles, time step, dimensionless numbers, duration
    Check(CheckArguments),
    /// Measure a shape file or the geometry of a case: porosity, specific surface, throats; write its outline and signed distance
    Geometry(GeometryArguments),
    /// Write a commented starter case
    New(NewArguments),
    /// List the models with their references
    List,
    /// Print the JSON schema of a case file
    Schema {
        /// Print the schema of a study file
        #[arg(long)]
        study: bool,
    },
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page, or write those of all commands
    Man {
        /// Folder for the pages of all commands: meniscus.1, meniscus-run.1, ...
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Extract pores and throats of a shape file, and displace one fluid by another in them
    #[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
    Network(NetworkArguments),
    /// Run a network and a direct simulation of the same geometry, and write a page with both side by side
    Compare(CompareArguments),
    /// Run a slow displacement in a network with one of its avalanches by direct simulation
    Couple(CoupleArguments),
    /// Make a movie of a run from its output folder
    Movie(MovieArguments),
    /// Parameter studies: many runs from one file, with a table, curves and a page
    #[command(subcommand)]
    Study(StudyCommand),
}

/// `check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Case file
    pub(crate) case: PathBuf,
    /// Change a value of the case
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
    /// Print the estimated cost of a run as JSON, for other programs
    #[arg(long)]
    pub(crate) json: bool,
    /// Number of threads; all cores if not given
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,
}

/// `geometry`.
#[derive(Debug, Args)]
pub(crate) struct GeometryArguments {
    /// Shape file (TOML, list of discs, network of OpenPNM, SVG, DXF, shapefile, GeoJSON, WKT, or a mask in PNG or TIFF), or a case file, whose geometry is
    /// measured with the sides of the case
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) import: ImportArguments,
    /// Depth of the chip (distance between floor and lid) in m; if not given, that of the file, or all results are per meter of depth
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pub(crate) depth: Option<f64>,
    /// Periodic axes of a shape file; none if not given
    #[arg(long, value_enum, value_name = "AXES")]
    pub(crate) periodic: Option<PeriodicAxes>,
    /// Number of threads; all cores if not given
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,
    /// Folder for outline, signed distance and picture; nothing is written if not given
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawings: WriteArguments,
}

/// `geometry --write`.
#[derive(Debug, Default, Args)]
pub(crate) struct WriteArguments {
    /// Write the shapes as a drawing: .svg, .dxf, .wkt, .geojson, .xyr, .toml, .vtu, or a mask as .png; may be given several times
    #[arg(long, value_name = "FILE")]
    pub(crate) write: Vec<PathBuf>,
    /// Side of a pixel of a mask in m; if not given, the longer side has 2048
    #[arg(long, value_name = "M")]
    pub(crate) mask_pixel: Option<f64>,
}

/// `network`.
#[derive(Debug, Args)]
pub(crate) struct NetworkArguments {
    /// Further commands on a network
    #[command(subcommand)]
    pub(crate) command: Option<NetworkCommand>,
    /// Shape file, or a case file
    #[arg(required = true)]
    pub(crate) file: Option<PathBuf>,
    /// Persistence ratio above which two maxima of the wall distance are one pore, 0.5 to 1 (default 0.95)
    #[arg(long, value_name = "RATIO")]
    pub(crate) persistence: Option<f64>,
    /// Contact angle through the wetting phase in degrees (default 0)
    #[arg(long, value_name = "DEGREES")]
    pub(crate) angle_deg: Option<f64>,
    /// Interfacial tension in N/m (default 1, so that pressures are those per N/m)
    #[arg(long, value_name = "N_PER_M")]
    pub(crate) tension: Option<f64>,
    /// Side through which the invading phase enters; if not given, the network is extracted and nothing is displaced
    #[arg(long, value_parser = word::<SideName>(), value_name = "SIDE")]
    pub(crate) inlet: Option<SideName>,
    /// Side through which the defending phase leaves
    #[arg(long, value_parser = word::<SideName>(), value_name = "SIDE")]
    pub(crate) outlet: Option<SideName>,
    /// The displacement (default drainage)
    #[arg(long, value_parser = word::<RawProcess>(), value_name = "PROCESS")]
    pub(crate) process: Option<RawProcess>,
    /// Number of cycles, with --process cycle (default 1)
    #[arg(long, value_name = "N")]
    pub(crate) cycles: Option<u32>,
    /// Whether a defending region without a path to the outlet is trapped (default true)
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true")]
    pub(crate) trapping: Option<bool>,
    /// How films in the corners of a chip are connected (default rings, where angles of walls and plates sum to less than 90 degrees)
    #[arg(long, value_parser = word::<FilmModel>(), value_name = "MODEL")]
    pub(crate) films: Option<FilmModel>,
    /// The region of saturations, porosity and relative permeabilities (default pack, where there is a manifold between inlet or outlet and the grains)
    #[arg(long, value_parser = word::<RegionExtent>(), value_name = "REGION")]
    pub(crate) region: Option<RegionExtent>,
    /// What is found besides events, curve and measures of the displacement (default all)
    #[arg(long, value_parser = word::<NetworkResults>(), value_name = "RESULTS")]
    pub(crate) results: Option<NetworkResults>,
    /// Makes opposite sides periodic
    #[arg(long, value_enum, value_name = "AXES")]
    pub(crate) periodic: Option<PeriodicAxes>,
    /// Depth of the chip (distance between floor and lid) in m; if not given, that of the file, or all results are per meter of depth
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pub(crate) depth: Option<f64>,
    /// Output folder, new or empty; if not given: out/NAME-network, out/NAME-network-2, ...
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Number of threads; all cores if not given. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,
    #[command(flatten)]
    pub(crate) import: ImportArguments,
}

/// Parses a word as in a case file.
fn word<W: Words + Send + Sync>() -> impl TypedValueParser<Value = W> {
    let words =
        W::ALL.iter().map(|(word, about)| PossibleValue::new(word.word()).help(about.trim().trim_end_matches('.')));
    let named = |name: String| W::ALL.iter().find(|(word, _)| word.word() == name).map(|(word, _)| *word);
    PossibleValuesParser::new(words).try_map(move |name| named(name).ok_or("unknown word"))
}

/// Periodic axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PeriodicAxes {
    /// Left and right
    X,
    /// Bottom and top
    Y,
    /// All four
    Xy,
}

impl PeriodicAxes {
    /// Whether x and y are periodic.
    pub(crate) fn along(self) -> [bool; 2] {
        [self != Self::Y, self != Self::X]
    }
}

/// `new`.
#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// File to write, which must not exist; if not given, case.toml, or pack.toml with --pack
    pub(crate) file: Option<PathBuf>,
    /// Depth of the chip (distance between floor and lid) in m, written to the file
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pub(crate) depth: Option<f64>,
    #[command(flatten)]
    pub(crate) pack: PackArguments,
}

/// `new --pack`.
#[derive(Debug, Args)]
pub(crate) struct PackArguments {
    /// Write a shape file of generated grains instead of a case
    #[arg(long, value_enum, value_name = "KIND")]
    pub(crate) pack: Option<PackKind>,
    /// Seed of a random pack
    #[arg(long, default_value = "1", requires = "pack")]
    pub(crate) seed: u64,
    /// Share of a random pack that is not solid
    #[arg(long, default_value = "0.6", requires = "pack")]
    pub(crate) porosity: f64,
    /// Radius in m, the mean of a random pack
    #[arg(long, value_name = "M", default_value = "1e-4", requires = "pack")]
    pub(crate) radius: f64,
    /// Standard deviation of the radii of a random pack relative to their mean, 0 to 0.35
    #[arg(long, default_value = "0", requires = "pack")]
    pub(crate) radius_deviation: f64,
    /// Smallest gap between grains in m; of a cosine throat, its width
    #[arg(long, value_name = "M", default_value = "2e-5", requires = "pack")]
    pub(crate) gap: f64,
    /// Width and height of the pack in m
    #[arg(long, value_name = "W,H", value_delimiter = ',', num_args = 1, default_values_t = [5e-3, 3e-3], requires = "pack")]
    pub(crate) size: Vec<f64>,
    /// Axes along which a random pack is periodic
    #[arg(long, value_enum, default_value = "none", requires = "pack")]
    pub(crate) periodic: PackPeriodic,
}

/// Kinds of packs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PackKind {
    /// Randomly placed discs
    Random,
    /// Discs on a square lattice
    Square,
    /// Discs on a hexagonal lattice
    Hexagonal,
    /// A channel with a cosine constriction
    Cosine,
    /// A random pack with manifolds, channels and walls
    Micromodel,
}

/// Axes of a periodic pack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PackPeriodic {
    /// Neither
    None,
    /// Along x
    X,
    /// Along y
    Y,
    /// Along both
    Xy,
}
