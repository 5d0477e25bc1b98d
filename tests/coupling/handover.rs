//! States of networks: their menisci and outlines are exact, a network and a direct simulation begin with them, and what does not fit is refused.

use std::path::{Path, PathBuf};

use meniscus::run::setup;
use meniscus_case::FluidPhase;
use meniscus_case::Model;
use meniscus_case::network::state::NetworkState;
use meniscus_case::{Loaded, load};
use meniscus_core::input::{InputError, Overrides};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::solver::Solver;
use meniscus_geometry::Geometry;
use meniscus_geometry::curve::Curve;
use meniscus_network::displacement::EventKind;
use meniscus_network::solver::NetworkSolver;
use meniscus_network::{self, state};
use tempfile::TempDir;

/// A random pack of 2 mm by 1.4 mm; `more` are further keys of `[network]`.
fn pack(seed: u32, sides: &str, process: &str, angle: f64, more: &str) -> String {
    format!(
        "format = 1\ntitle = \"pack\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [2.0e-3, 1.4e-3]\nshapes = [{{ random-pack = {{ \
         region = [[1.0e-4, 0.0], [1.9e-3, 1.4e-3]], porosity = 0.6, radius = 1.0e-4, radius-deviation = 0.2, gap = 2.0e-5, \
         seed = {seed}, periodic = \"{}\" }} }}]\n[network]\ninlet = \"left\"\noutlet = \"right\"\nprocess = \"{process}\"\n{more}\n{sides}\n\
         [network.interface]\ntension = 0.03\n[network.wetting.young]\ncontact-angle-deg = {angle:?}\n",
        if sides.is_empty() { "none" } else { "y" }
    )
}

const PERIODIC: &str = "sides = { bottom = \"periodic\", top = \"periodic\" }";

fn loaded(folder: &Path, text: &str) -> Result<Loaded, InputError> {
    let path = folder.join("case.toml");
    std::fs::write(&path, text).unwrap();
    load(&path, &Overrides::default())
}

fn solver(text: &str) -> NetworkSolver {
    let folder = TempDir::new().unwrap();
    let case = loaded(folder.path(), text).unwrap().case;
    let Model::Network(wanted) = &case.model else { panic!("no network") };
    meniscus_network::setup::build_quasi_static(&case, wanted).unwrap()
}

fn state_of(solver: &NetworkSolver) -> NetworkState {
    let cycles = solver.cycles().unwrap();
    state::state(solver.config(), cycles.half_cycles(), &cycles.moment())
}

/// States along a displacement, every `stride` events.
fn states(solver: &mut NetworkSolver, stride: usize) -> Vec<NetworkState> {
    let mut found = vec![state_of(solver)];
    let mut count = 0;
    while !solver.is_done() {
        solver.step(f64::INFINITY).unwrap();
        count += 1;
        if count % stride == 0 {
            found.push(state_of(solver));
        }
    }
    found.push(state_of(solver));
    found
}

fn wetting_area(state: &NetworkState) -> f64 {
    state.elements.iter().filter(|it| it.phase == FluidPhase::Wetting).map(|it| it.area_m2).sum()
}

fn pore_area(state: &NetworkState) -> f64 {
    state.elements.iter().map(|it| it.area_m2).sum()
}

#[test]
fn the_area_within_the_outline_is_that_of_elements_and_of_what_menisci_sweep() {
    for (process, angle) in [("drainage", 40.0), ("drainage", 90.0), ("drainage", 130.0), ("imbibition", 60.0)] {
        let mut closed = 0;
        for seed in 1..=3 {
            for state in states(&mut solver(&pack(seed, "", process, angle, "")), 3) {
                let swept: Option<Vec<f64>> = state.menisci.iter().map(|it| it.swept_area_m2).collect();
                let Some(swept) = swept else { continue };
                let sign = if state.invading == FluidPhase::Wetting { 1.0 } else { -1.0 };
                let by_elements = wetting_area(&state) + sign * swept.iter().sum::<f64>();
                let by_outline = state.saturation_with_menisci.unwrap() * pore_area(&state);
                let error = (by_elements - by_outline).abs() / pore_area(&state);
                assert!(error < 1e-9, "{process} at {angle}, seed {seed}, event {}: {error:e}", state.events);
                closed += 1;
            }
        }
        assert!(closed > 20, "{closed}");
    }
}

#[test]
fn menisci_rest_at_one_curvature_and_meet_their_walls_at_the_contact_angle() {
    for angle in [40.0_f64, 90.0] {
        let mut solver = solver(&pack(1, "", "drainage", angle, ""));
        let geometry = Geometry::new(&case_geometry(&pack(1, "", "drainage", angle, "")))
            .unwrap()
            .with_wall_sides([false, false, true, true]);
        let mut seen = 0;
        for state in states(&mut solver, 4) {
            for meniscus in state.menisci.iter().filter(|it| it.curvature_per_m.is_some()) {
                let is_trapped = state.elements[meniscus.between[1]].trapped;
                let curvature = meniscus.curvature_per_m.unwrap();
                let [a, b] = meniscus.contacts_m.map(Vec2::from);
                // An arc of this bend has this curvature.
                let chord = (b - a).norm();
                assert!((2.0 * meniscus.bend_rad.sin() - curvature * chord).abs() < 1e-7);
                if !is_trapped && ((curvature - state.applied_curvature_per_m) * chord).abs() > 1e-9 {
                    // Where all menisci of a gate are bent more it stands at the flattest.
                    assert!(curvature > state.applied_curvature_per_m);
                    continue;
                }
                let out = nalgebra::Rotation2::new(meniscus.bend_rad) * (b - a).normalize();
                let wall = geometry.wall(a);
                assert!(wall.distance.abs() < 1e-12, "{}", wall.distance);
                // On the left wall the defending phase lies ahead, on the left of the interface.
                let tangent = Vec2::new(-wall.normal.y, wall.normal.x);
                let ahead = if tangent.dot(&Vec2::new(-out.y, out.x)) > 0.0 { tangent } else { -tangent };
                let found = out.dot(&ahead).clamp(-1.0, 1.0).acos().to_degrees();
                assert!((found - angle).abs() < 1e-4, "{found} at {a:?}");
                seen += 1;
            }
        }
        assert!(seen > 50, "{seen}");
    }
}

fn case_geometry(text: &str) -> meniscus_geometry::spec::GeometrySpec {
    let folder = TempDir::new().unwrap();
    loaded(folder.path(), text).unwrap().case.geometry
}

/// Share of the wetting phase among the points of a grid in the pore, by the outline.
fn sampled(state: &NetworkState, text: &str) -> f64 {
    let bounds = Bounds { min: state.domain_m[0].into(), max: state.domain_m[1].into() };
    let pore = Geometry::new(&case_geometry(text)).unwrap().with_periodic(state.periodic());
    let region = Geometry::of_surface(bounds, state.periodic(), &NetworkState::curves(&state.invading_outline));
    let (mut inside, mut all) = (0, 0);
    const NODES: usize = 300;
    for (i, j) in (0..NODES).flat_map(|i| (0..NODES).map(move |j| (i, j))) {
        let share = Vec2::new((i as f64 + 0.5) / NODES as f64, (j as f64 + 0.5) / NODES as f64);
        let x = bounds.min + bounds.size().component_mul(&share);
        if pore.signed_distance(x) > 0.0 {
            all += 1;
            inside += usize::from(region.signed_distance(x) < 0.0);
        }
    }
    let invading = f64::from(inside as u32) / f64::from(all);
    if state.invading == FluidPhase::Wetting { invading } else { 1.0 - invading }
}

#[test]
fn the_outline_tells_the_phase_of_every_point_also_in_a_periodic_domain() {
    for sides in ["", PERIODIC] {
        for (process, angle) in [("drainage", 40.0), ("imbibition", 60.0)] {
            let text = pack(2, sides, process, angle, "");
            for state in states(&mut solver(&text), 8) {
                let Some(exact) = state.saturation_with_menisci else { continue };
                let found = sampled(&state, &text);
                assert!((found - exact).abs() < 2e-3, "{sides} {process} event {}: {found} {exact}", state.events);
            }
        }
    }
}

#[test]
fn a_displacement_that_is_handed_on_goes_on_as_the_unbroken_one() {
    let mut events = 0;
    let processes = [("", "drainage", 40.0), ("", "drainage", 90.0), (PERIODIC, "imbibition", 60.0)];
    for (seed, (sides, process, angle)) in (1..=4).flat_map(|seed| processes.map(|process| (seed, process))) {
        let folder = TempDir::new().unwrap();
        let text = pack(seed, sides, process, angle, "");
        let mut whole = solver(&text);
        while whole.cycles().unwrap().breakthrough().is_none() && !whole.is_done() {
            whole.step(f64::INFINITY).unwrap();
        }
        let cycles = whole.cycles().unwrap();
        let done = cycles.history().len();
        let Some(moment) = cycles.breakthrough() else { continue };
        let state = state::state(whole.config(), cycles.half_cycles(), moment);
        std::fs::write(folder.path().join("state.json"), serde_json::to_string(&state).unwrap()).unwrap();
        let handed_on =
            loaded(folder.path(), &pack(seed, sides, process, angle, "initial = \"state.json\"")).unwrap().case;
        let Model::Network(wanted) = &handed_on.model else { panic!("no network") };
        let mut rest = meniscus_network::setup::build_quasi_static(&handed_on, wanted).unwrap();
        for solver in [&mut whole, &mut rest] {
            while !solver.is_done() {
                solver.step(f64::INFINITY).unwrap();
            }
        }
        let (whole, rest) = (whole.cycles().unwrap(), rest.cycles().unwrap());
        events += rest.history().len();
        assert_eq!(whole.history().len() - done, rest.history().len());
        for (one, other) in whole.history()[done..].iter().zip(rest.history()) {
            assert_eq!(one.kind, other.kind);
            // Two menisci meet: which of their throats is told depends on which came last.
            assert!(one.throat == other.throat || one.kind == EventKind::Overlap);
            assert!((one.applied - other.applied).abs() <= 1e-12 * one.applied.abs());
            assert!((one.saturation - other.saturation).abs() < 1e-12);
        }
        assert!((whole.trapped_saturation() - rest.trapped_saturation()).abs() < 1e-12);
    }
    assert!(events > 10, "{events}");
}

fn repository(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The case that begins with a state, coarser and shorter, and with the changes.
fn direct(changes: &[&str]) -> Result<Loaded, InputError> {
    let coarse = ["sph.spacing=7.5e-6", "time.end=1e-4", "output.series.every-time=1e-5"];
    load(&repository("cases/from-network.toml"), &Overrides::parse(&[&coarse[..], changes].concat()).unwrap())
}

fn committed() -> NetworkState {
    NetworkState::read(&std::fs::read_to_string(repository("cases/states/hand-over.json")).unwrap()).unwrap()
}

#[test]
fn the_state_beside_the_cases_is_the_one_that_its_network_writes() {
    let case = load(&repository("cases/network/hand-over.toml"), &Overrides::default()).unwrap().case;
    let Model::Network(wanted) = &case.model else { panic!("no network") };
    let mut solver = meniscus_network::setup::build_quasi_static(&case, wanted).unwrap();
    while !solver.is_done() {
        solver.step(f64::INFINITY).unwrap();
    }
    let (found, kept) = (state_of(&solver), committed());
    assert_eq!(
        (&found.geometry_hash, found.events, found.menisci.len()),
        (&kept.geometry_hash, kept.events, kept.menisci.len())
    );
    assert!((found.saturation_with_menisci.unwrap() - kept.saturation_with_menisci.unwrap()).abs() < 1e-12);
    assert!((found.applied_curvature_per_m / kept.applied_curvature_per_m - 1.0).abs() < 1e-9);
}

#[test]
fn a_direct_simulation_that_begins_at_rest_stays_there_and_hands_the_same_phases_back() {
    let case = direct(&[]).unwrap().case;
    let mut solver = setup::build(&case).unwrap();
    let kept = committed();
    let value = |solver: &dyn Solver, name: &str| solver.sample().iter().find(|it| it.name == name).unwrap().value;
    let exact = kept.saturation_with_menisci.unwrap();
    // Areas are measured as those of particles: half of one by rounding, of both phases.
    let cell = case.geometry.max[0] * case.geometry.max[1] / (200.0 * 140.0);
    let first = value(solver.as_ref(), "saturation");
    assert!((first - exact).abs() * pore_area(&kept) < 1.5 * cell, "{first} {exact}");
    assert!((value(solver.as_ref(), "capillary_pressure_Pa") - kept.capillary_pressure_pa).abs() < 1e-6);
    while solver.time() < case.end {
        solver.step(case.end).unwrap();
    }
    assert!((value(solver.as_ref(), "saturation") - exact).abs() < 0.01);
    // Viscosity times speed over tension; the pressure of the menisci drives flow at 0.05.
    let speed = value(solver.as_ref(), "max_speed_m_per_s");
    assert!(0.01 * speed / 0.03 < 0.01, "{speed} m/s");
    let results = solver.results();
    let back = results.documents.iter().find(|document| document.name == "at-end.json").unwrap();
    let back = NetworkState::read(&back.text()).unwrap();
    let phases = |state: &NetworkState| state.elements.iter().map(|it| it.phase).collect::<Vec<_>>();
    assert_eq!(phases(&back), phases(&kept));
}

/// The one mistake of a direct case with the changes: its key path as a line of the file, and the message.
fn refused(changes: &[&str]) -> String {
    let mistakes = direct(changes).unwrap_err().mistakes;
    assert_eq!(mistakes.len(), 1, "{mistakes:?}");
    assert!(mistakes[0].location.is_some());
    mistakes[0].message.clone()
}

#[test]
fn what_does_not_fit_is_refused_with_file_and_reason() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        format!("sph.initial.network={:?}", path.display().to_string())
    };
    let text = std::fs::read_to_string(repository("cases/states/hand-over.json")).unwrap();
    let missing = refused(&["sph.initial.network=\"nowhere.json\""]);
    assert!(missing.contains("there is no file") && missing.contains("nowhere.json"), "{missing}");
    let damaged = refused(&[&file("damaged.json", &text[..text.len() / 2])]);
    assert!(damaged.contains("damaged.json is not a network state") && damaged.contains("line 1 column"), "{damaged}");
    let other = refused(&["geometry.file=\"../geometries/post-pack.toml\"", "sph.spacing=1e-6"]);
    assert!(other.contains("another geometry") && other.contains("domain"), "{other}");
    let mut moved = committed();
    moved.geometry_hash = "0".to_owned();
    let same_walls = direct(&[&file("moved.json", &serde_json::to_string(&moved).unwrap())]);
    assert!(same_walls.is_ok(), "the walls are the same, however they were cut");
    moved.elements[0].boundary[0][0] += 1e-6;
    let moved = refused(&[&file("moved.json", &serde_json::to_string(&moved).unwrap())]);
    assert!(moved.contains("another geometry") && moved.contains("hash"), "{moved}");
    let sides = refused(&["sph.sides.bottom=\"symmetry\""]);
    assert!(
        sides.contains("other sides") && sides.contains("`bottom` is a wall, that of this case a symmetry line"),
        "{sides}"
    );
    let mut back = committed();
    (back.menisci, back.invading_outline) = (Vec::new(), Vec::new());
    let back = refused(&[&file("back.json", &serde_json::to_string(&back).unwrap())]);
    assert!(back.contains("has no menisci"), "{back}");
    let both = refused(&["sph.initial.background=\"wetting\""]);
    assert!(both.contains("`network` defines the regions of the phases"), "{both}");
    let curve = text.replacen("\"boundary\":[[", "\"boundary\":[[1.0],[", 1);
    let curve = refused(&[&file("curve.json", &curve)]);
    assert!(curve.contains("the four numbers of a segment or the five of an arc"), "{curve}");
}

#[test]
fn every_curve_of_a_state_is_written_so_that_it_is_read_again() {
    let state = committed();
    let again = NetworkState::read(&serde_json::to_string(&state).unwrap()).unwrap();
    let ends = |state: &NetworkState| -> Vec<Vec2> {
        NetworkState::curves(&state.invading_outline)
            .iter()
            .flat_map(|c: &Curve| [c.point(0.0), c.point(1.0)])
            .collect()
    };
    assert!(ends(&state).iter().zip(ends(&again)).all(|(a, b)| (a - b).norm() < 1e-18));
}
