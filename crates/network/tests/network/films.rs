//! Films of the wetting phase in the corners of a chip: what they hold, what they let out and in, and the throats that they close.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use meniscus::run::execute::Mode;
use meniscus::run::simulation::Unwatched;
use meniscus_case::{Loaded, load};
use meniscus_core::input::Overrides;
use meniscus_geometry::interface::depth::{corner_area, duct_factor};
use meniscus_geometry::interface::film_flow::conductance;

use crate::cases::{loaded, measures, named, run, to_the_end};

const TENSION: f64 = 0.07;

/// A case in a folder that lasts as long as it does.
struct Case {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

impl Case {
    /// Shapes in a domain from the origin, with an angle in degrees of walls and plates, drained from the left.
    fn new(size: [f64; 2], shapes: &str, depth: f64, deg: f64) -> Self {
        let text = format!(
            "format = 1\ntitle = \"Chambers and ducts\"\n[geometry]\nmin = [0.0, 0.0]\nmax = {size:?}\ndepth = {depth}\nshapes = [{shapes}]\n[network]\ninlet = \"left\"\noutlet = \"right\"\n\
             films = \"joined\"\n[network.interface]\ntension = {TENSION}\n[network.wetting.young]\ncontact-angle-deg = {deg:?}\n"
        );
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.toml");
        std::fs::write(&path, text).unwrap();
        Self { _folder: folder, path }
    }

    fn loaded(&self, set: &[&str]) -> Loaded {
        loaded(&self.path, set)
    }

    fn measures(&self, set: &[&str]) -> BTreeMap<String, f64> {
        measures(to_the_end(&self.loaded(set)).as_ref())
    }
}

/// Rows of a table that a run leaves, by column.
fn table(case: &Loaded, name: &str) -> Vec<BTreeMap<String, String>> {
    let folder = tempfile::tempdir().unwrap();
    run(case, folder.path(), Mode::New, &AtomicBool::new(false), &mut Unwatched);
    let text = std::fs::read_to_string(folder.path().join(name)).unwrap();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let row = |line: &str| head.iter().zip(line.split(',')).map(|(&name, cell)| (name.into(), cell.into())).collect();
    text.lines().skip(1).map(row).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

/// Chambers in a channel of .24 mm along x, .6 mm apart, joined by throats of these widths (um) between discs at the top and at the bottom.
fn chambers(widths: &[f64], is_mirrored: bool) -> ([f64; 2], String) {
    let mut shapes = String::new();
    let size = [6e-4 * widths.len() as f64, 2.4e-4];
    for (index, width) in widths.iter().enumerate() {
        let x = 6e-4 * index as f64 + 3e-4;
        let x = if is_mirrored { size[0] - x } else { x };
        for y in [0.0, 2.4e-4] {
            let radius = 1.2e-4 - 0.5e-6 * width;
            write!(shapes, "{{ disc = {{ center = [{x:e}, {y:e}], radius = {radius:e} }} }},").unwrap();
        }
    }
    (size, shapes)
}

/// [Princen1969; Princen1970]
#[test]
fn the_films_of_a_straight_duct_hold_four_corners() {
    let (width, depth) = (1e-4, 5e-5);
    let channel = format!("{{ channel = {{ center = [5e-4, 5e-4], width = {width}, rotation-deg = 0.0 }} }}");
    for deg in [0.0_f64, 20.0, 40.0] {
        let duct = Case::new([1e-3, 1e-3], &channel, depth, deg);
        let angle = deg.to_radians();
        // The last two are so low that films would meet at half of the depth.
        let meeting = 2.0 * TENSION * (angle.cos() - angle.sin()) / depth;
        for pressure in [8e3, 1.2e4, 0.5 * meeting, 1.0] {
            let found = duct.measures(&[&format!("network.stop.capillary-pressure={pressure}")]);
            let radius = TENSION / f64::max(pressure, meeting);
            let exact = 4.0 * corner_area(angle, angle) * radius * radius / (width * depth);
            // At a low pressure the meniscus stands where a segment divides the duct, and films are behind it.
            let (films, wetting) = (found["film-saturation"], found["final-wetting-saturation"]);
            let passed = 1.0 - (wetting - films);
            assert!((films / (passed * exact) - 1.0).abs() < 1e-9, "{deg} {pressure}: {found:?} {exact}");
            assert!(passed == 1.0 || pressure < meeting && (passed - 0.5).abs() < 1e-9);
            assert!((found["largest-capillary-pressure-Pa"] / pressure - 1.0).abs() < 1e-9);
        }
    }
}

/// [RansohoffRadke1988]
#[test]
fn the_films_of_a_drained_duct_conduct_as_four_corners() {
    let (width, depth) = (1e-4, 5e-5);
    let plates = "{ rectangle = { center = [5e-4, 8e-4], size = [2e-3, 5e-4] } }, { rectangle = { center = [5e-4, 2e-4], size = [2e-3, 5e-4] } }";
    for deg in [0.0_f64, 20.0, 35.0] {
        let case = Case::new([1e-3, 1e-3], plates, depth, deg);
        let found = case.measures(&["network.films=\"rings\""]);
        let (angle, radius) = (deg.to_radians(), TENSION / found["largest-capillary-pressure-Pa"]);
        let films = 4.0 * conductance(angle, angle) * radius.powi(4);
        let duct = width * depth.powi(3) / 12.0 * duct_factor(width / depth);
        let ratio = found["relative-permeability-wetting"] / (films / duct);
        assert!((ratio - 1.0).abs() < 1e-6, "{deg}: {ratio} {found:?}");
    }
}

#[test]
fn films_of_floor_and_lid_with_angles_of_their_own_hold_what_their_corners_do() {
    let channel = "{ channel = { center = [5e-4, 5e-4], width = 1e-4, rotation-deg = 0.0 } }";
    let duct = Case::new([1e-3, 1e-3], channel, 5e-5, 30.0);
    let lid = |deg: f64| format!("network.wetting.patches=[{{plate=\"lid\", contact-angle-deg={deg:?}}}]");
    for deg in [10.0_f64, 50.0, 70.0] {
        let found = duct.measures(&["network.stop.capillary-pressure=8e3", &lid(deg)]);
        let (wall, radius) = (30.0_f64.to_radians(), TENSION / 8e3);
        let area = 2.0 * (corner_area(wall, wall) + corner_area(wall, deg.to_radians()));
        let exact = area * radius * radius / 5e-9;
        assert!((found["film-saturation"] / exact - 1.0).abs() < 1e-9, "{deg}: {found:?} {exact}");
    }
}

/// [LenormandZarconeSarr1983]
#[test]
fn a_throat_snaps_off_where_its_films_meet_and_what_is_behind_is_trapped() {
    let (deg, depth) = (10.0_f64, 1e-4);
    let (sin, cos) = deg.to_radians().sin_cos();
    for is_mirrored in [false, true] {
        let (size, shapes) = chambers(&[20.0, 30.0], is_mirrored);
        let case = Case::new(size, &shapes, depth, deg);
        let [inlet, outlet] = if is_mirrored { ["right", "left"] } else { ["left", "right"] };
        let sides = [format!("network.inlet={inlet:?}"), format!("network.outlet={outlet:?}")];
        let set = [sides[0].as_str(), &sides[1], "network.process=\"cycle\""];
        let events = table(&case.loaded(&set), "events.csv");
        let snapped: Vec<_> = events.iter().filter(|row| row["event"] == "snap-off").collect();
        assert_eq!(snapped.len(), 1, "{events:?}");
        let exact = 2.0 * TENSION * (cos - sin) / 20e-6;
        let found = number(snapped[0], "capillary_pressure_Pa");
        assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
        // The chamber between both throats keeps its gas, but for the films in it.
        let pores = table(&case.loaded(&set), "pores.csv");
        let trapped: Vec<_> = pores.iter().filter(|row| row["trapped"] == "True").collect();
        assert!(!trapped.is_empty() && trapped.len() < pores.len());
        let volume =
            |rows: &[&BTreeMap<String, String>], column| rows.iter().map(|row| number(row, column)).sum::<f64>();
        let all: Vec<_> = pores.iter().collect();
        let gas = volume(&trapped, "volume_m3") - volume(&trapped, "film_volume_m3");
        let measures = case.measures(&set);
        let share = gas / volume(&all, "volume_m3");
        assert!((measures["trapped-saturation"] / share - 1.0).abs() < 1e-9, "{measures:?} {share}");
        assert!((measures["residual-saturation"] / share - 1.0).abs() < 1e-9);
        // Without films, water pushes all of it out.
        let plain = case.measures(&[set[0], set[1], set[2], "network.films=\"none\""]);
        assert_eq!(plain["residual-saturation"], 0.0);
    }
}

#[test]
fn a_throat_that_films_closed_opens_again_at_its_entry_pressure() {
    let (size, shapes) = chambers(&[24.0, 20.0, 30.0], false);
    let case = Case::new(size, &shapes, 1e-4, 10.0);
    let set = ["network.process=\"cycle\"", "network.cycles=2"];
    let events = table(&case.loaded(&set), "events.csv");
    let opened: Vec<_> = events.iter().filter(|row| row["event"] == "reconnection").collect();
    assert_eq!(opened.len(), 1, "{events:?}");
    let throats = table(&case.loaded(&set), "throats.csv");
    let throat = throats.iter().find(|row| row["throat"] == opened[0]["throat"]).unwrap();
    assert!((number(throat, "width_m") / 20e-6 - 1.0).abs() < 1e-6);
    let (found, entry) = (number(opened[0], "meniscus_pressure_Pa"), number(throat, "entry_pressure_Pa"));
    assert!((found / entry - 1.0).abs() < 1e-9, "{found} {entry}");
}

#[test]
fn nothing_is_trapped_in_a_drainage_with_films() {
    let of = |films: &str| {
        let angle = "network.wetting={young={contact-angle-deg=20.0}}";
        let set = [angle, "geometry.depth=50e-6", films, "expect=[]"];
        measures(to_the_end(&loaded(&named("drainage"), &set)).as_ref())
    };
    let (with, without) = (of("network.films=\"joined\""), of("network.films=\"none\""));
    assert!(without["trapped-saturation"] > 0.05 && with["trapped-saturation"] == 0.0);
    assert!((with["final-wetting-saturation"] / with["film-saturation"] - 1.0).abs() < 1e-9);
    assert!(with["breakthrough-pressure-Pa"] == without["breakthrough-pressure-Pa"]);
    assert!(!without.contains_key("film-saturation"));
}

#[test]
fn the_curve_falls_on_in_drainage_after_the_last_event_and_rises_in_imbibition() {
    let set = [
        "network.wetting={young={contact-angle-deg=20.0}}",
        "geometry.depth=50e-6",
        "network.films=\"joined\"",
        "network.process=\"cycle\"",
        "network.stop={capillary-pressure=5e4}",
        "expect=[]",
    ];
    let case = loaded(&named("drainage"), &set);
    let curve = table(&case, "capillary_pressure.csv");
    let of = |half: &str| curve.iter().filter(|row| row["half_cycle"] == half).collect::<Vec<_>>();
    let (drainage, imbibition) = (of("1"), of("2"));
    assert!(drainage.windows(2).all(|pair| number(pair[1], "saturation") <= number(pair[0], "saturation") + 1e-12));
    assert!(imbibition.windows(2).all(|pair| number(pair[1], "saturation") >= number(pair[0], "saturation") - 1e-12));
    let last = drainage[drainage.len() - 1];
    assert!((number(last, "capillary_pressure_Pa") / 5e4 - 1.0).abs() < 1e-12);
    // Water fills what is open at its side at once, at the same pressure.
    assert_eq!(last["capillary_pressure_Pa"], imbibition[0]["capillary_pressure_Pa"]);
    assert!(number(imbibition[0], "saturation") > number(last, "saturation"));
    // At the end of the drainage films alone hold water: their share goes with the square of 1/p.
    let last_event = table(&case, "events.csv").into_iter().rfind(|row| row["half_cycle"] == "1").unwrap();
    let ratio = 5e4 / number(&last_event, "capillary_pressure_Pa");
    let shrunk = number(&last_event, "film_saturation") / number(last, "film_saturation");
    assert!(ratio > 1.5 && (shrunk / (ratio * ratio) - 1.0).abs() < 1e-9, "{ratio} {shrunk}");
    let end = measures(to_the_end(&case).as_ref());
    let residual = end["residual-saturation"];
    assert!(residual > 0.0 && residual < 1.0 && (residual - end["trapped-saturation"]).abs() < 1e-9, "{end:?}");
}

#[test]
fn films_vanish_towards_45_degrees_and_in_a_deep_chip() {
    let film = |set: &[&str]| {
        let fixed = ["network.films=\"joined\"", "network.stop={capillary-pressure=5e4}", "expect=[]"];
        let set: Vec<&str> = set.iter().copied().chain(fixed).collect();
        measures(to_the_end(&loaded(&named("drainage"), &set)).as_ref())["film-saturation"]
    };
    let angle = |deg: f64| format!("network.wetting={{young={{contact-angle-deg={deg:?}}}}}");
    let some = film(&[&angle(20.0), "geometry.depth=50e-6"]);
    // The cross-section goes with the square of the distance to 45 degrees.
    assert!(some > 1e-4 && film(&[&angle(44.99), "geometry.depth=50e-6"]) < 1e-6 * some);
    let deep = film(&[&angle(20.0), "geometry.depth=50e-2"]);
    assert!((deep / some * 1e4 - 1.0).abs() < 1e-6, "{deep} {some}");
}

#[test]
fn films_need_a_depth_and_corners_that_hold_them() {
    let films = "network.films=\"rings\"";
    let refused = load(&named("drainage"), &Overrides::parse(&[films]).unwrap()).unwrap_err().render();
    assert!(refused.contains("add depth = 50e-6"), "{refused}");
    // At 45 degrees no corner holds a film, and the displacement is that without; a lid that wets less leaves those on the floor.
    let of = |set: &[&str]| {
        measures(
            to_the_end(&loaded(&named("drainage"), &[set, &["geometry.depth=50e-6", "expect=[]"]].concat())).as_ref(),
        )
    };
    let same = |one: &BTreeMap<String, f64>, other: &BTreeMap<String, f64>| format!("{one:?}") == format!("{other:?}");
    let steep = "network.wetting={young={contact-angle-deg=45.0}}";
    assert!(same(&of(&[steep, films]), &of(&[steep])));
    assert!(!of(&[steep]).contains_key("film-saturation"));
    let lid = "network.wetting={young={contact-angle-deg=40.0}, patches=[{plate=\"lid\", contact-angle-deg=60.0}]}";
    // Rings are the default.
    assert!(of(&[lid])["film-saturation"] > 0.0);
    assert!(same(&of(&[lid, films]), &of(&[lid])));
}

/// Three posts around a pocket in a channel of 4 mm by 2 mm, with a stem of the last one to the floor if `is_joined`.
fn three_posts(is_joined: bool, is_mirrored: bool) -> Case {
    let mut shapes = String::new();
    let y = |y: f64| if is_mirrored { 2e-3 - y } else { y };
    for (x, center) in [(1.3e-3, 1.2e-3), (1.75e-3, 1.2e-3), (1.525e-3, 0.81e-3)] {
        write!(shapes, "{{ disc = {{ center = [{x:e}, {:e}], radius = 2e-4 }} }},", y(center)).unwrap();
    }
    // Between the pocket and the outlet.
    for center in [0.33e-3, 1e-3, 1.67e-3] {
        write!(shapes, "{{ disc = {{ center = [2.7e-3, {:e}], radius = 1.8e-4 }} }},", y(center)).unwrap();
    }
    if is_joined {
        write!(shapes, "{{ rectangle = {{ center = [1.525e-3, {:e}], size = [1e-4, 8e-4] }} }},", y(0.4e-3)).unwrap();
    }
    Case::new([4e-3, 2e-3], &shapes, 1e-4, 10.0)
}

#[test]
fn the_pocket_between_posts_is_cut_off_unless_their_films_reach_a_wall() {
    for is_mirrored in [false, true] {
        let of = |is_joined: bool, films: &str| {
            let case = three_posts(is_joined, is_mirrored);
            case.measures(&[&format!("network.films={films:?}"), "network.stop.capillary-pressure=2e4"])
        };
        let pocket = of(false, "none")["trapped-saturation"];
        assert!(pocket > 1e-3, "{pocket}");
        for is_joined in [false, true] {
            assert_eq!(of(is_joined, "joined")["trapped-saturation"], 0.0);
            let none = of(is_joined, "none")["trapped-saturation"];
            let rings = of(is_joined, "rings");
            assert!((rings["trapped-saturation-without-films"] - none).abs() < 1e-12);
            if is_joined {
                // The pocket has left; the other two posts keep the films that they had.
                let (left, films) = (rings["final-wetting-saturation"], rings["film-saturation"]);
                assert!(
                    none > 1e-3 && (left - films).abs() < 1e-12 && rings["trapped-saturation"] < films,
                    "{rings:?}"
                );
            } else {
                // With the pocket what is left of the films around the posts.
                let kept = rings["trapped-saturation"] - none;
                assert!(kept > 0.0 && kept < rings["film-saturation"] + 1e-12, "{none} {rings:?}");
            }
        }
    }
}

#[test]
fn a_pocket_and_the_films_around_it_keep_the_pressure_at_which_they_were_cut_off() {
    let case = three_posts(false, false);
    let at = |pressure: f64| {
        case.measures(&["network.films=\"rings\"", &format!("network.stop.capillary-pressure={pressure:e}")])
    };
    let events = table(&case.loaded(&[]), "events.csv");
    let last = events.iter().filter_map(|row| row["capillary_pressure_Pa"].parse().ok()).fold(0.0, f64::max);
    let (one, two) = (at(2.0 * last), at(4.0 * last));
    // Posts hold on to theirs; films along floor and ceiling shrink with the square of the pressure.
    assert!(
        one["trapped-saturation"] > 0.0 && one["trapped-saturation"] == two["trapped-saturation"],
        "{one:?} {two:?}"
    );
    let free = |found: &BTreeMap<String, f64>| found["final-wetting-saturation"] - found["trapped-saturation"];
    assert!((free(&one) / free(&two) / 4.0 - 1.0).abs() < 1e-9, "{} {}", free(&one), free(&two));
}

#[test]
fn water_that_returns_reaches_what_was_cut_off_when_it_touches_its_posts() {
    let cycle = "network.process=\"cycle\"";
    let of = |films: &str| three_posts(false, false).measures(&[cycle, &format!("network.films={films:?}")]);
    for films in ["none", "rings", "joined"] {
        let found = of(films);
        assert!(found["final-wetting-saturation"] > 0.9, "{films}: {found:?}");
    }
}
