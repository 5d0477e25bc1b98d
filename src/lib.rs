//! Two-phase flow with partial wetting in pores.
//!
//! Data flow of a run: case -> checked case -> geometry -> solver -> snapshot -> sinks -> report. The program `meniscus` does all of it; the types below do
//! each part separately. SI units; angles in rad, in degrees where a name says so.
//!
//! The public interface is selected deliberately; the rest is `pub(crate)`, so that the compiler detects unused items.
#![warn(unreachable_pub)]
#![allow(rustdoc::private_intra_doc_links, reason = "comments are for readers of the source too")]

#[doc(hidden)]
pub mod analysis;
#[doc(hidden)]
pub mod benchmarks;
#[doc(hidden)]
pub mod case;
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod diagram;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod input;
#[doc(hidden)]
pub mod interface;
#[doc(hidden)]
pub mod io;
#[doc(hidden)]
pub mod math;
#[doc(hidden)]
pub mod network;
#[doc(hidden)]
pub mod run;
#[doc(hidden)]
pub mod snapshot;
#[doc(hidden)]
pub mod solver;
#[doc(hidden)]
pub mod sph;
#[doc(hidden)]
pub mod study;
#[doc(hidden)]
pub mod table;
#[doc(hidden)]
pub mod thin_film;
#[doc(hidden)]
pub mod verify;
#[doc(hidden)]
pub mod wetting;

/// A case file, checked, and its solver step by step:
///
/// ```
/// use meniscus::{Loaded, Model, Overrides, load_default, solver_of};
///
/// let Loaded { case, .. } = load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?;
/// assert!(matches!(case.model, Model::Sph(_)));
/// let mut solver = solver_of(&case)?;
/// let step = solver.step(case.end)?;
/// assert!(solver.time() == step.dt && step.dt < case.end);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use case::{Case, Loaded, Model, load, load_default};
/// Shapes as specified, and the distance from their walls, above 0 in the pore; lengths in m:
///
/// ```
/// use meniscus::{Channel, Disc, Geometry, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide, Vec2};
///
/// let outer = vec![[0.0, 0.0], [1e-3, 0.0], [0.0, 1e-3]];
/// let shapes = vec![
///     ShapeSpec::Channel(Channel { center: [0.0; 2], width: 4e-3, rotation_deg: 0.0 }),
///     ShapeSpec::Disc(Disc { center: [-2e-3, 0.0], radius: 0.5e-3 }),
///     ShapeSpec::Rectangle(Rectangle { center: [0.0; 2], size: [1e-3, 2e-3], rotation_deg: 90.0 }),
///     ShapeSpec::Polygon(Polygon { outer, holes: vec![], position: [2e-3, 0.0], rotation_deg: 0.0 }),
/// ];
/// let mut spec = GeometrySpec { min: [-4e-3, -3e-3], max: [4e-3, 3e-3], solid: SolidSide::Inside, shapes };
/// let geometry = Geometry::new(&spec)?;
/// assert!((geometry.signed_distance(Vec2::new(-3e-3, 0.0)) - 0.5e-3).abs() < 1e-15);
/// spec.shapes.push(ShapeSpec::Disc(Disc { center: [0.0; 2], radius: -1.0 }));
/// assert!(Geometry::new(&spec).unwrap_err().to_string().starts_with("the geometry has 1 problem(s)"));
/// # Ok::<(), meniscus::GeometryError>(())
/// ```
pub use geometry::{
    Geometry, GeometryError,
    spec::{Channel, Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide},
};
/// Mistakes are reported all at once, each with its source location and a remedy:
///
/// ```
/// use meniscus::{InputError, Mistake, Overrides, load_default};
///
/// let overrides = Overrides::parse(&["sph.spacing=-1", "sph.interface.tension=\"high\""])?;
/// let InputError { mistakes } = load_default(&overrides).unwrap_err();
/// assert_eq!(mistakes.len(), 2);
/// let is_expected = |mistake: &Mistake| mistake.message == "expected a spacing in m above 0, found -1.0";
/// assert!(mistakes.iter().any(is_expected));
/// # Ok::<(), InputError>(())
/// ```
pub use input::{InputError, Mistake, Overrides};
/// Points and boxes in m:
///
/// ```
/// use meniscus::{Bounds, Vec2};
///
/// let bounds = Bounds { min: Vec2::zeros(), max: Vec2::new(2e-3, 1e-3) };
/// assert!(bounds.contains(Vec2::new(1e-3, 1e-3)) && (bounds.area() - 2e-6).abs() < 1e-18);
/// ```
pub use math::{Bounds, Vec2};
/// The pore network of a geometry, and the events of a displacement in it:
///
/// ```
/// use meniscus::{Conditions, Disc, Displacement, EventKind, Geometry, GeometrySpec, Network, Phase, Pores, ShapeSpec};
/// use meniscus::{SolidSide, Trapping, extract};
///
/// // Two discs; open on the left and on the right.
/// let shapes = [-1e-3, 1e-3].map(|y| ShapeSpec::Disc(Disc { center: [0.0, y], radius: 0.9e-3 })).to_vec();
/// let spec = GeometrySpec { min: [-2e-3, -1e-3], max: [2e-3, 1e-3], solid: SolidSide::Inside, shapes };
/// let network = extract(&Geometry::new(&spec)?, [true, true, false, false])?;
/// let Network { regions, throats, .. } = &network;
/// assert_eq!((regions.len(), throats.len()), (2, 1));
/// assert!((throats[0].width - 0.2e-3).abs() < 1e-15);
///
/// // A gas displaces a liquid that wets all walls: angles of the shapes, then of the sides.
/// let conditions = Conditions {
///     inlet: [true, false, false, false],
///     outlet: [false, true, false, false],
///     trapping: Trapping::Disconnected,
///     ..Conditions::new(vec![0.0; 2 + 4])
/// };
/// let mut events = Displacement::new(&network, &Pores::merged(&network, 1.0), conditions);
/// let burst = events.find(|event| event.throat == Some(0)).expect("the gas passes the throat");
/// assert!(burst.kind == EventKind::Burst && (burst.curvature * 0.1e-3 - 1.0).abs() < 1e-9);
/// assert_eq!(events.phase(burst.elements[0]), Phase::Invading);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use network::{
    ExtractError,
    displacement::{Conditions, CornerFilms, Displacement, Event, EventKind, Events, Phase, Trapping},
    extract,
    graph::{Network, Opening, Pores, Region, Throat},
};
/// A run from its folder to its report, as executed by the program:
///
/// ```
/// use meniscus::{Finished, Job, Mode, Overrides, Unwatched, execute, load_default, solver_of};
///
/// let loaded = load_default(&Overrides::parse(&["sph.spacing=4e-6", "time.end=1e-10"])?)?;
/// let folder = std::env::temp_dir().join(format!("meniscus-{}", std::process::id()));
/// let job = Job { case: &loaded.case, resolved: &loaded.resolved, folder, mode: Mode::New };
/// let Finished { report, folder, .. } =
///     execute(&job, solver_of(&loaded.case)?.as_mut(), &false.into(), &mut Unwatched)?;
/// assert!(report.error.is_none() && folder.join("report.json").exists());
/// std::fs::remove_dir_all(folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use run::execute::{Finished, Job, Mode, RunError, execute};
pub use run::setup::build as solver_of;
pub use run::simulation::{Unwatched, Watcher};
/// The state of a solver for output:
///
/// ```
/// use meniscus::{Field, Overrides, Snapshot, Values, load_default, solver_of};
///
/// let solver = solver_of(&load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?.case)?;
/// let Snapshot { particles, .. } = solver.snapshot();
/// let is_pressure = |field: &&Field| field.name == "pressure" && field.unit == "Pa";
/// let pressure = particles.fields.iter().find(is_pressure).expect("every particle has a pressure");
/// assert!(matches!(&pressure.values, Values::Scalar(values) if values.len() == particles.points.len()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use snapshot::{Field, Snapshot, Values};
/// A solver, independent of its model, and its measures:
///
/// ```
/// use meniscus::{Measure, Overrides, Series, Solver, SolverError, load_default, solver_of};
///
/// fn density_error(solver: &mut dyn Solver, end: f64) -> Result<Option<f64>, SolverError> {
///     solver.step(end)?;
///     let is_asked_for = |measure: &Measure| measure.name == "density-error";
///     Ok(solver.measures(&Series::default()).into_iter().find(is_asked_for).map(|measure| measure.value))
/// }
/// let case = load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?.case;
/// assert!(density_error(solver_of(&case)?.as_mut(), case.end)?.is_some_and(|error| error < 0.1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use solver::{Measure, Series, Solver, SolverError};
/// Wetting laws: the angle of a contact line from its state:
///
/// ```
/// use meniscus::{LineState, Wetting, Young};
///
/// let law = Wetting::Young(Young { contact_angle_deg: 60.0 });
/// assert!((law.angle(&LineState::default()).cos() - 0.5).abs() < 1e-15);
/// ```
pub use wetting::{Wetting, Young, law::LineState};
