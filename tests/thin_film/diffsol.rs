//! The integrators of the library diffsol: the same films as ours, and the same bits where a run is resumed.

use crate::support::films::{advance, loaded, named};
use meniscus::run::setup;
use meniscus::solver::Solver;

const BY_LIBRARY: [&str; 2] = ["diffsol-stiff", "diffsol-explicit"];

fn by_library(integrator: &str) -> [String; 2] {
    let method = format!("thin-film.method={{ particles = {{ integrator = \"{integrator}\" }} }}");
    [method, "thin-film.spacing=1e-5".to_owned()]
}

#[test]
fn the_integrators_of_diffsol_find_the_same_films_and_go_on_with_the_same_bits() {
    for (name, share) in [("complete-wetting", 1.0), ("partial-wetting", 0.02)] {
        for integrator in BY_LIBRARY {
            // The explicit one takes 1e5 steps to the end.
            let share = if integrator == BY_LIBRARY[1] { 0.002 * share } else { share };
            let set = by_library(integrator);
            let case = loaded(&named(name), &set.each_ref().map(String::as_str)).case;
            let stops = [0.3, 0.7, 1.0].map(|part| part * share * case.end);
            let mut solver = setup::build(&case).unwrap();
            advance(solver.as_mut(), &stops);
            let own = ["thin-film.method={ particles = {} }", set[1].as_str()];
            let mut known = setup::build(&loaded(&named(name), &own).case).unwrap();
            advance(known.as_mut(), &stops);
            let column = |solver: &dyn Solver, name: &str| {
                solver.sample().iter().find(|sample| sample.name == name).unwrap().value
            };
            for value in ["last_particle_position_m", "center_height_m"] {
                // A tolerance of 1e-7 a step, over a hundred steps.
                let (found, known) = (column(solver.as_ref(), value), column(known.as_ref(), value));
                assert!((found / known - 1.0).abs() < 1.0e-5, "{name} {integrator} {value}: {found} {known}");
            }
            let mut broken = setup::build(&case).unwrap();
            for _ in 0..25 {
                broken.step(stops[0]).unwrap();
            }
            let mut resumed = setup::build(&case).unwrap();
            resumed.restore(&broken.state()).unwrap();
            advance(resumed.as_mut(), &stops);
            assert!(resumed.state() == solver.state(), "{name} {integrator}");
        }
    }
}
