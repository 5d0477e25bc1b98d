//! Two-phase flow with partial wetting in pores.
//!
//! A run goes one way: case -> checked case -> geometry -> solver -> snapshot -> sinks -> report. The program `meniscus` does all of it; the types below do
//! each part by itself. SI units; angles in rad, in degrees where a name says so.
//!
//! A case file, checked, and its solver step by step:
//!
//! ```
//! use meniscus::{Overrides, load_default, solver_of};
//!
//! let loaded = load_default(&Overrides::parse(&["sph.spacing=4e-6"])?)?;
//! let mut solver = solver_of(&loaded.case)?;
//! let step = solver.step(loaded.case.end)?;
//! assert!(solver.time() == step.dt && step.dt < loaded.case.end);
//! let snapshot = solver.snapshot();
//! assert!(snapshot.particles.fields.iter().any(|field| field.name == "pressure" && field.unit == "Pa"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Mistakes come all at once, each with its place and a way out:
//!
//! ```
//! use meniscus::{Overrides, load_default};
//!
//! let error = load_default(&Overrides::parse(&["sph.spacing=-1", "sph.interface.tension=\"high\""])?).unwrap_err();
//! assert_eq!(error.mistakes.len(), 2);
//! assert!(error.mistakes.iter().any(|mistake| mistake.message == "expected a spacing in m above 0, found -1.0"));
//! # Ok::<(), meniscus::InputError>(())
//! ```
//!
//! Shapes, the signed distance from their walls, the pore network between them, and the events of a displacement:
//!
//! ```
//! use meniscus::{Conditions, Disc, Displacement, Events, Geometry, GeometrySpec, Pores, ShapeSpec, SolidSide, Trapping, Vec2, extract};
//!
//! let disc = |y| ShapeSpec::Disc(Disc { center: [0.0, y], radius: 0.9e-3 });
//! let shapes = vec![disc(-1e-3), disc(1e-3)];
//! let spec = GeometrySpec { min: [-2e-3, -1e-3], max: [2e-3, 1e-3], solid: SolidSide::Inside, shapes };
//! let geometry = Geometry::new(&spec)?;
//! assert!((geometry.signed_distance(Vec2::zeros()) - 0.1e-3).abs() < 1e-15);
//!
//! // Open on the left and on the right.
//! let network = extract(&geometry, [true, true, false, false])?;
//! assert_eq!((network.regions.len(), network.throats.len()), (2, 1));
//! assert!((network.throats[0].width - 0.2e-3).abs() < 1e-15);
//!
//! // A gas displaces a liquid that wets all walls: angles of the shapes, then of the sides.
//! let conditions = Conditions {
//!     angle: vec![0.0; 2 + 4],
//!     inlet: [true, false, false, false],
//!     outlet: [false, true, false, false],
//!     trapping: Trapping::Disconnected,
//!     events: Events::All,
//!     largest_curvature: f64::INFINITY,
//!     measured: Vec::new(),
//! };
//! let mut events = Displacement::new(&network, &Pores::merged(&network, 1.0), conditions);
//! let burst = events.find(|event| event.throat == Some(0)).expect("the gas passes the throat");
//! assert!((burst.curvature * 0.1e-3 - 1.0).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Wetting laws:
//!
//! ```
//! use meniscus::{LineState, Wetting, Young};
//!
//! let law = Wetting::Young(Young { contact_angle_deg: 60.0 });
//! assert!((law.angle(&LineState::default()).cos() - 0.5).abs() < 1e-15);
//! ```
//!
//! What is `pub` is chosen; the rest is `pub(crate)`, so that the compiler sees what nobody uses.
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
pub(crate) mod diagram;
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
pub(crate) mod table;
#[doc(hidden)]
pub mod thin_film;
#[doc(hidden)]
pub mod verify;
#[doc(hidden)]
pub mod wetting;

pub use case::{Case, Loaded, Model, load, load_default};
pub use geometry::spec::{Channel, Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide};
pub use geometry::{Geometry, GeometryError};
pub use input::{InputError, Mistake, Overrides};
pub use math::{Bounds, Vec2};
pub use network::displacement::{Conditions, Displacement, Event, EventKind, Events, Phase, Trapping};
pub use network::graph::{Network, Opening, Pores, Region, Throat};
pub use network::{ExtractError, extract};
pub use run::execute::{Finished, Job, Mode, RunError, execute};
pub use run::setup::build as solver_of;
pub use snapshot::{Field, Snapshot, Values};
pub use solver::{Measure, Series, Solver, SolverError};
pub use wetting::law::LineState;
pub use wetting::{Wetting, Young};
