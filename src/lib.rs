//! Two-phase flow with partial wetting in pores.
//!
//! Data flow of a run: case -> checked case -> geometry -> solver -> snapshot -> sinks -> report. The program `meniscus` does all of it; the types below do
//! each part separately. SI units; angles in rad, in degrees where a name says so. Each part is a package of its own: `meniscus_geometry`,
//! `meniscus_drawings`, `meniscus_case`, `meniscus_network`, `meniscus_sph`, `meniscus_film` and others, which this one gathers.
//!
//! # Equations
//!
//! Direct simulation (Huber et al. 2013): ∇·v = 0, ρ Dv/Dt = −∇p + ∇·(μ (∇v + ∇vᵀ)) + ρ g + σ κ n + σ (cos θ − cos α) ν δ, with the curvature κ and the gradient n
//! of the color across the interface, and at a contact line its delta function δ, its normal ν along the wall, the present angle α and that of the wetting law θ.
//!
//! Thin film (Pang and Ó Náraigh 2022), scaled: ∂h/∂t = −∂/∂x (h h̄² ∂/∂x (∂²h̄/∂x² + ξ² h̄)), with the smoothed height h̄ and, in partial wetting, ξ² from the energy.
//!
//! Pore network: a meniscus advances at p_n − p_w = σ κ until it passes its largest curvature κ in a throat, touches a wall ahead, or meets another one (Cieplak
//! and Robbins 1990).
//!
//! # Examples
//!
//! A drop on a floor, step by step (`examples/droplet.rs`):
//! ```
#![doc = include_str!("../examples/droplet.rs")]
//! ```
//! The drainage of a pack, with the package of networks alone (`crates/network/examples/drainage.rs`):
//! ```
#![doc = include_str!("../crates/network/examples/drainage.rs")]
//! ```
//! The signed distance from walls (`examples/distance.rs`):
//! ```
#![doc = include_str!("../examples/distance.rs")]
//! ```
//! A drawing of another program (`examples/drawing.rs`):
//! ```
#![doc = include_str!("../examples/drawing.rs")]
//! ```
//! A spreading droplet (`examples/film.rs`):
//! ```
#![doc = include_str!("../examples/film.rs")]
//! ```
//!
//! # Parts
//!
//! A case file, checked, and its solver step by step:
//!
//! ```
//! use meniscus::{Loaded, Model, Overrides, load_default, solver_of};
//!
//! let Loaded { case, .. } = load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?;
//! assert!(matches!(case.model, Model::Sph(_)));
//! let mut solver = solver_of(&case)?;
//! let step = solver.step(case.end)?;
//! assert!(solver.time() == step.dt && step.dt < case.end);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Mistakes are reported all at once, each with its source location and a remedy:
//!
//! ```
//! use meniscus::{InputError, Mistake, Overrides, load_default};
//!
//! let overrides = Overrides::parse(&["sph.spacing=-1", "sph.interface.tension=\"high\""])?;
//! let InputError { mistakes } = load_default(&overrides).unwrap_err();
//! assert_eq!(mistakes.len(), 2);
//! let is_expected = |mistake: &Mistake| mistake.message == "expected a spacing in m above 0, found -1.0";
//! assert!(mistakes.iter().any(is_expected));
//! # Ok::<(), InputError>(())
//! ```
//!
//! Points and boxes in m:
//!
//! ```
//! use meniscus::{Bounds, Vec2};
//!
//! let bounds = Bounds { min: Vec2::zeros(), max: Vec2::new(2e-3, 1e-3) };
//! assert!(bounds.contains(Vec2::new(1e-3, 1e-3)) && (bounds.area() - 2e-6).abs() < 1e-18);
//! ```
//!
//! The state of a solver for output:
//!
//! ```
//! use meniscus::{Field, Overrides, Snapshot, Values, load_default, solver_of};
//!
//! let solver = solver_of(&load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?.case)?;
//! let Snapshot { particles, .. } = solver.snapshot();
//! let is_pressure = |field: &&Field| field.name == "pressure" && field.unit == "Pa";
//! let pressure = particles.fields.iter().find(is_pressure).expect("every particle has a pressure");
//! assert!(matches!(&pressure.values, Values::Scalar(values) if values.len() == particles.points.len()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A solver, independent of its model, and its measures:
//!
//! ```
//! use meniscus::{Measure, Overrides, Series, Solver, SolverError, load_default, solver_of};
//!
//! fn density_error(solver: &mut dyn Solver, end: f64) -> Result<Option<f64>, SolverError> {
//!     solver.step(end)?;
//!     let is_asked_for = |measure: &Measure| measure.name == "density-error";
//!     Ok(solver.measures(&Series::default()).into_iter().find(is_asked_for).map(|measure| measure.value))
//! }
//! let case = load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?.case;
//! assert!(density_error(solver_of(&case)?.as_mut(), case.end)?.is_some_and(|error| error < 0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Shapes as specified, and the distance from their walls, above 0 in the pore; lengths in m:
//!
//! ```
//! use meniscus::{Channel, Disc, Geometry, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide, Vec2};
//!
//! let outer = vec![[0.0, 0.0], [1e-3, 0.0], [0.0, 1e-3]];
//! let shapes = vec![
//!     ShapeSpec::Channel(Channel { center: [0.0; 2], width: 4e-3, rotation_deg: 0.0 }),
//!     ShapeSpec::Disc(Disc { center: [-2e-3, 0.0], radius: 0.5e-3 }),
//!     ShapeSpec::Rectangle(Rectangle { center: [0.0; 2], size: [1e-3, 2e-3], rotation_deg: 90.0 }),
//!     ShapeSpec::Polygon(Polygon { outer, holes: vec![], position: [2e-3, 0.0], rotation_deg: 0.0 }),
//! ];
//! let mut spec = GeometrySpec { min: [-4e-3, -3e-3], max: [4e-3, 3e-3], solid: SolidSide::Inside, shapes };
//! let geometry = Geometry::new(&spec)?;
//! assert!((geometry.signed_distance(Vec2::new(-3e-3, 0.0)) - 0.5e-3).abs() < 1e-15);
//! spec.shapes.push(ShapeSpec::Disc(Disc { center: [0.0; 2], radius: -1.0 }));
//! assert!(Geometry::new(&spec).unwrap_err().to_string().starts_with("the geometry has 1 problem(s)"));
//! # Ok::<(), meniscus::GeometryError>(())
//! ```
//!
//! The pore network of a geometry, and the events of a displacement in it:
//!
//! ```
//! use meniscus::{Conditions, Disc, Displacement, EventKind, Geometry, GeometrySpec, Network, Phase, Pores, ShapeSpec};
//! use meniscus::{SolidSide, Trapping, extract};
//!
//! // Two discs; open on the left and on the right.
//! let shapes = [-1e-3, 1e-3].map(|y| ShapeSpec::Disc(Disc { center: [0.0, y], radius: 0.9e-3 })).to_vec();
//! let spec = GeometrySpec { min: [-2e-3, -1e-3], max: [2e-3, 1e-3], solid: SolidSide::Inside, shapes };
//! let network = extract(&Geometry::new(&spec)?, [true, true, false, false])?;
//! let Network { regions, throats, .. } = &network;
//! assert_eq!((regions.len(), throats.len()), (2, 1));
//! assert!((throats[0].width - 0.2e-3).abs() < 1e-15);
//!
//! // A gas displaces a liquid that wets all walls: angles of the shapes, then of the sides.
//! let conditions = Conditions {
//!     inlet: [true, false, false, false],
//!     outlet: [false, true, false, false],
//!     trapping: Trapping::Disconnected,
//!     ..Conditions::new(vec![0.0; 2 + 4])
//! };
//! let mut events = Displacement::new(&network, &Pores::merged(&network, 1.0), conditions);
//! let burst = events.find(|event| event.throat == Some(0)).expect("the gas passes the throat");
//! assert!(burst.kind == EventKind::Burst && (burst.curvature * 0.1e-3 - 1.0).abs() < 1e-9);
//! assert_eq!(events.phase(burst.elements[0]), Phase::Invading);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Wetting laws: the angle of a contact line from its state:
//!
//! ```
//! use meniscus::{LineState, Wetting, Young};
//!
//! let law = Wetting::Young(Young { contact_angle_deg: 60.0 });
//! assert!((law.angle(&LineState::default()).cos() - 0.5).abs() < 1e-15);
//! ```
//!
//! A run from its folder to its report, as executed by the program:
//!
//! ```
//! use meniscus::{Finished, Job, Mode, Overrides, Unwatched, execute, load_default, solver_of};
//!
//! let loaded = load_default(&Overrides::parse(&["sph.spacing=4e-6", "time.end=1e-10"])?)?;
//! let folder = std::env::temp_dir().join(format!("meniscus-{}", std::process::id()));
//! let job = Job { case: &loaded.case, resolved: &loaded.resolved, folder, mode: Mode::New };
//! let Finished { report, folder, .. } =
//!     execute(&job, solver_of(&loaded.case)?.as_mut(), &false.into(), &mut Unwatched)?;
//! assert!(report.error.is_none() && folder.join("report.json").exists());
//! std::fs::remove_dir_all(folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The public interface is selected deliberately; the rest of this package is `pub(crate)`, so that the compiler detects unused items.
#![warn(unreachable_pub)]

#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod run;
#[doc(hidden)]
pub mod study;
#[doc(hidden)]
pub mod verify;

#[doc(inline)]
pub use meniscus_case::{Case, Loaded, Model, load, load_default};
#[doc(inline)]
pub use meniscus_core::input::{InputError, Mistake, Overrides};
#[doc(inline)]
pub use meniscus_core::math::{Bounds, Vec2};
#[doc(inline)]
pub use meniscus_core::snapshot::{Field, Snapshot, Values};
#[doc(inline)]
pub use meniscus_core::solver::{Measure, Series, Solver, SolverError};
#[doc(inline)]
pub use meniscus_geometry::{
    Geometry, GeometryError,
    spec::{Channel, Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide},
};
#[doc(inline)]
pub use meniscus_network::{
    ExtractError,
    displacement::{Conditions, CornerFilms, Displacement, Event, EventKind, Events, Phase, Trapping},
    extract,
    graph::{Network, Opening, Pores, Region, Throat},
};
#[doc(inline)]
pub use meniscus_wetting::{Wetting, Young, law::LineState};
pub use run::execute::{Finished, Job, Mode, RunError, execute};
pub use run::setup::build as solver_of;
pub use run::simulation::{Unwatched, Watcher};
