//! Networks of chips with a depth: ducts, arrays of posts, the order of events, and the plane as the depth grows.

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use meniscus::run::execute::Mode;
use meniscus::run::simulation::Unwatched;
use meniscus_case::Loaded;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::interface::depth::duct_factor;
use meniscus_geometry::spec::{Channel, ShapeSpec};
use meniscus_network::conductance::conductances;
use meniscus_network::graph::Network;
use meniscus_network::permeability::{Drive, Paths, permeability};

use crate::cases::{loaded, measures, named, run, to_the_end};
use crate::scenes::*;

fn along(network: &Network, size: [f64; 2], drive: Drive) -> f64 {
    let (conductance, holds) = (conductances(network), vec![true; network.regions.len()]);
    let domain = Bounds { min: Vec2::zeros(), max: Vec2::new(size[0], size[1]) };
    permeability(network, Paths { conductance: &conductance, holds: &holds }, domain, drive).unwrap()
}

#[test]
fn a_duct_conducts_as_its_series_says() {
    let channel = ShapeSpec::Channel(Channel { center: [0.5, 0.5], width: 0.2, rotation_deg: 0.0 });
    let plane = network(&grains([1.0, 1.0], vec![channel]), LEFT_RIGHT);
    let of = |network: &Network| along(network, [1.0; 2], Drive::Sides(0));
    for ratio in [0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0] {
        let depth = 0.2 / ratio;
        // b² F in place of w².
        let (exact, found) =
            (duct_factor(ratio) / (ratio * ratio), of(&Network { depth: Some(depth), ..plane.clone() }) / of(&plane));
        assert!((found / exact - 1.0).abs() < 1e-6, "{ratio}: {found}, {exact}");
    }
    let deep = Network { depth: Some(200.0), ..plane.clone() };
    let ratio = of(&deep) / of(&plane);
    assert!((1.0 - 1e-3..1.0).contains(&ratio), "{ratio}");
}

#[test]
fn arrays_of_posts_have_the_permeability_of_the_averaged_flow() {
    // Finite elements with 6/5 of the viscosity in the plane, mesh error .1 to .7 %.
    let radius = (0.5 / PI).sqrt();
    let geometry = grains([1.0; 2], vec![disc(0.5, 0.5, radius)]).with_periodic([true, true]);
    let plane = network(&geometry, CLOSED);
    for (depth, exact) in [(0.5, 1.2219e-3), (0.2, 5.768e-4), (0.1, 2.0576e-4)] {
        let chip = Network { depth: Some(depth), ..plane.clone() };
        let error = along(&chip, [1.0; 2], Drive::Periodic(0)) / exact - 1.0;
        assert!(error.abs() < 0.05, "{depth}: {error}");
    }
}

/// Columns of a table that a run leaves.
fn columns<const N: usize>(case: &Loaded, table: &str, names: [&str; N]) -> Vec<[String; N]> {
    let folder = tempfile::tempdir().unwrap();
    run(case, folder.path(), Mode::New, &AtomicBool::new(false), &mut Unwatched);
    let text = std::fs::read_to_string(folder.path().join(table)).unwrap();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let places = names.map(|name| head.iter().position(|column| *column == name).unwrap());
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        places.map(|place| cells[place].to_owned())
    };
    text.lines().skip(1).map(row).collect()
}

/// Throat, capillary pressure and saturation of each event of a case.
fn events(case: &Loaded) -> Vec<(String, f64, f64)> {
    let rows = columns(case, "events.csv", ["throat", "capillary_pressure_Pa", "saturation"]);
    let event =
        |[throat, pressure, saturation]: [String; 3]| (throat, pressure.parse().unwrap(), saturation.parse().unwrap());
    // Nothing is applied at the beginning.
    rows.into_iter().filter(|[_, pressure, _]| !pressure.is_empty()).map(event).collect()
}

#[test]
fn a_depth_moves_all_pressures_by_one_constant_and_changes_no_order() {
    let angle = |deg: f64| format!("network.wetting={{young={{contact-angle-deg={deg}}}}}");
    for deg in [50.0, 60.0, 90.0, 110.0] {
        let set = [angle(deg), "expect=[]".to_owned()];
        let plain: Vec<&str> = set.iter().map(String::as_str).collect();
        let case = loaded(&named("drainage"), &plain);
        let tension = 0.0728;
        for depth in [20e-6, 400e-6] {
            let with_depth = format!("geometry.depth={depth}");
            let set: Vec<&str> = plain.iter().copied().chain([with_depth.as_str()]).collect();
            let (plane, chip) = (events(&case), events(&loaded(&named("drainage"), &set)));
            assert!(plane.len() > 20 && plane.len() == chip.len());
            let constant = 2.0 * tension * f64::to_radians(deg).cos() / depth;
            for (one, other) in plane.iter().zip(&chip) {
                assert!(one.0 == other.0 && one.2 == other.2);
                let moved = other.1 - one.1 - constant;
                assert!(moved.abs() <= 1e-12 * (constant.abs() + one.1.abs()), "{deg} {depth}: {moved}");
            }
        }
    }
}

#[test]
fn with_films_in_corners_the_order_stays_and_pressures_are_those_of_ducts() {
    let set = ["network.wetting={young={contact-angle-deg=20.0}}", "network.films=\"none\"", "expect=[]"];
    let plane = events(&loaded(&named("drainage"), &set));
    let deep = events(&loaded(&named("drainage"), &[&set[..], &["geometry.depth=1.0"]].concat()));
    let chip = events(&loaded(&named("drainage"), &[&set[..], &["geometry.depth=50e-6"]].concat()));
    assert!(plane.len() > 20 && plane.len() == chip.len());
    let constant = 2.0 * 0.0728 * f64::to_radians(20.0).cos() / 50e-6;
    for ((plane, deep), chip) in plane.iter().zip(&deep).zip(&chip) {
        assert!(plane.0 == chip.0 && plane.0 == deep.0);
        assert!((deep.1 / plane.1 - 1.0).abs() < 1e-3);
        assert!(chip.1 < plane.1 + constant && chip.1 > constant, "{} {}", chip.1, plane.1);
    }
}

#[test]
fn floor_and_lid_may_have_angles_of_their_own() {
    let walls = "network.wetting.young.contact-angle-deg=60.0";
    let of = |patches: &str| {
        let patches = format!("network.wetting.patches={patches}");
        let case = loaded(&named("drainage"), &[walls, &patches, "geometry.depth=50e-6", "expect=[]"]);
        measures(to_the_end(&case).as_ref())["breakthrough-pressure-Pa"]
    };
    let (same, glass) = (of("[]"), of("[{plate=\"lid\", contact-angle-deg=45.0}]"));
    let exact = 0.0728 * (f64::to_radians(45.0).cos() - 0.5) / 50e-6;
    assert!((glass - same - exact).abs() < 1e-9 * exact, "{same} {glass}");
    let both = of("[{plate=\"lid\", contact-angle-deg=120.0}, {plate=\"floor\", contact-angle-deg=60.0}]");
    let plane = of("[{plate=\"lid\", contact-angle-deg=90.0}, {plate=\"floor\", contact-angle-deg=90.0}]");
    assert!((both - plane).abs() < 1e-9 * plane.abs());
}

#[test]
fn relative_permeabilities_are_those_of_ducts() {
    let of = |depth: &str| {
        let set = ["network.wetting={young={contact-angle-deg=60.0}}", "network.stop={breakthrough=true}", "expect=[]"];
        let set: Vec<&str> = set.into_iter().chain((!depth.is_empty()).then_some(depth)).collect();
        measures(to_the_end(&loaded(&named("drainage"), &set)).as_ref())
    };
    let [plane, deep, shallow] = ["", "geometry.depth=1.0", "geometry.depth=5e-6"].map(of);
    const NAME: &str = "relative-permeability-non-wetting";
    // Wide throats conduct less between close plates than the third power of their width says.
    assert!(plane[NAME] > 0.0 && (deep[NAME] / plane[NAME] - 1.0).abs() < 1e-3, "{plane:?} {deep:?}");
    assert!((shallow[NAME] / plane[NAME] - 1.0).abs() > 0.01, "{plane:?} {shallow:?}");
}

#[test]
fn a_displacement_in_time_is_that_of_the_plane_where_the_chip_is_deep() {
    // So deep that it is plane.
    let set = ["network.wetting={young={contact-angle-deg=60.0}}", "expect=[]"];
    let depth = 1.0;
    let rate = depth * 1.0e-8;
    let chip = [set[0], set[1], &format!("geometry.depth={depth}"), &format!("network.dynamic.rate={rate}")];
    let plane = [set[0], set[1], "network.dynamic.rate=1.0e-8"];
    let [plane, chip] =
        [&plane[..], &chip[..]].map(|set| measures(to_the_end(&loaded(&named("dynamic"), set)).as_ref()));
    // The constant is 2 cos 60°/m: .07 Pa.
    for name in ["breakthrough-time-s", "breakthrough-pressure-difference-Pa", "final-wetting-saturation"] {
        assert!((chip[name] / plane[name] - 1.0).abs() < 1e-3, "{name}: {} {}", chip[name], plane[name]);
    }
}

#[test]
fn in_time_pores_are_invaded_at_the_pressures_of_events() {
    for process in ["drainage", "imbibition"] {
        let process = format!("network.process={process:?}");
        for (depth, rate) in
            [("", "network.dynamic.rate=1.0e-8"), ("geometry.depth=50e-6", "network.dynamic.rate=5.0e-13")]
        {
            let set = [
                "network.wetting={young={contact-angle-deg=60.0}}",
                "expect=[]",
                "time.end=20.0",
                &process,
                rate,
                depth,
            ];
            let case = loaded(&named("dynamic"), if depth.is_empty() { &set[..5] } else { &set });
            let events = columns(&case, "events.csv", ["meniscus_pressure_Pa"]);
            let pores = columns(&case, "pores.csv", ["invasion_capillary_pressure_Pa"]);
            let known: Vec<[String; 1]> = pores.into_iter().filter(|[pressure]| !pressure.is_empty()).collect();
            assert!(known.len() > 5 && known.iter().all(|pressure| events.contains(pressure)), "{process} {depth}");
        }
    }
}
