//! Our integrators of particles against those of the library diffsol.

use crate::diffsol::system::System;
use crate::diffsol::{Reached, esdirk34, tsit45};
use meniscus_case::film::{FilmIntegrator, FilmWeights, LatticeEnergy};
use meniscus_film::droplet::{Droplet, particles};
use meniscus_film::equilibrium::Equilibrium;
use meniscus_film::kernel::Kernel;
use meniscus_film::ode::{Integrator, Rates, Tolerance};
use meniscus_film::particles::{ParticleMethod, Pull};

const ALPHA: f64 = 0.05;
/// Largest error of a step, and the first step.
const TOLERANCE: f64 = 1.0e-9;
const FIRST_STEP: f64 = 1.0e-7;
/// Times. Explicit methods would take 1e5 steps to the last of the late ones.
const EARLY: [f64; 3] = [1.0e-4, 1.0e-3, 1.0e-2];
const LATE: [f64; 3] = [1.0e-2, 1.0, 50.0];

/// A film of 101 particles at time zero.
struct Film {
    name: &'static str,
    method: ParticleMethod,
    start: Vec<f64>,
}

fn films() -> [Film; 4] {
    let film = |name, area, pull, lattice| {
        let masses = particles(&[Droplet { area, half_width: 0.5, center: 0.0 }], 0.01, FilmWeights::Cell);
        Film { name, method: ParticleMethod::new(Kernel::new(ALPHA), &masses, pull, lattice), start: masses.x }
    };
    let wetting = Equilibrium::of_unit_slope(ALPHA).unwrap().wetting();
    [
        film("spreads", 0.25, Pull::default(), LatticeEnergy::Kept),
        film("spreads, lattice energy taken off", 0.25, Pull::default(), LatticeEnergy::TakenOff),
        film("comes to rest", 1.0, Pull { wetting, bond: 0.0 }, LatticeEnergy::Kept),
        film("comes to rest under gravity", 1.0, Pull { wetting, bond: 5.0 }, LatticeEnergy::Kept),
    ]
}

fn films_of_the_paper() -> impl Iterator<Item = Film> {
    films().into_iter().filter(|film| !film.method.corrects())
}

impl Film {
    fn by(&self, method: FilmIntegrator, times: &[f64]) -> Vec<Reached> {
        let mut film = self.method.clone();
        let tolerance = Tolerance { absolute: TOLERANCE, relative: 0.0 };
        let mut state = Integrator::new(method, tolerance, self.start.clone(), FIRST_STEP);
        let mut steps = 0;
        let at = |&time: &f64| {
            while state.time < time {
                state.step(&mut film, time).unwrap();
                steps += 1;
            }
            Reached { x: state.x.clone(), steps }
        };
        times.iter().map(at).collect()
    }

    fn by_esdirk34(&self, times: &[f64]) -> Vec<Reached> {
        esdirk34(&self.method, &self.start, TOLERANCE, FIRST_STEP, times)
    }

    fn by_tsit45(&self, times: &[f64]) -> Vec<Reached> {
        tsit45(&self.method, &self.start, TOLERANCE, FIRST_STEP, times)
    }
}

/// Root mean square over particles, the norm that both limit the error of a step in.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
}

/// What the steps to both states may have added up to: a film forgets errors, as a test below shows.
fn allowed(a: &Reached, b: &Reached) -> f64 {
    TOLERANCE * (a.steps + b.steps) as f64
}

fn assert_same(name: &str, ours: &[Reached], oracle: &[Reached]) {
    for (ours, oracle) in ours.iter().zip(oracle) {
        let (found, allowed) = (distance(&ours.x, &oracle.x), allowed(ours, oracle));
        assert!(found < allowed, "{name}: apart by {found:e}, allowed {allowed:e}");
    }
}

/// Rates that are wrong by a thousandth do not pass: as long as the film moves, its state a thousandth later is another one.
fn assert_seen(name: &str, ours: &Reached, later: &Reached) {
    let (found, allowed) = (distance(&ours.x, &later.x), allowed(ours, later));
    assert!(found > 2.0 * allowed, "{name}: a thousandth later apart by {found:e}, allowed {allowed:e}");
}

fn a_thousandth_later(times: [f64; 3]) -> [f64; 3] {
    times.map(|time| 1.001 * time)
}

#[test]
fn the_stiff_and_the_explicit_method_find_the_films_of_tsit45() {
    for film in films() {
        let (oracle, later) = (film.by_tsit45(&EARLY), film.by_tsit45(&a_thousandth_later(EARLY)));
        for method in [FilmIntegrator::Stiff, FilmIntegrator::Explicit] {
            let name = format!("{}, {method:?}", film.name);
            let ours = film.by(method, &EARLY);
            assert_same(&name, &ours, &oracle);
            ours.iter().zip(&later).for_each(|(ours, later)| assert_seen(&name, ours, later));
        }
    }
}

#[test]
fn the_stiff_method_finds_the_films_of_esdirk34_in_fewer_steps() {
    for film in films_of_the_paper() {
        let (ours, oracle) = (film.by(FilmIntegrator::Stiff, &LATE), film.by_esdirk34(&LATE));
        assert_same(film.name, &ours, &oracle);
        // Wrong coefficients would cost steps first: the error of each is limited.
        assert!(ours[2].steps < oracle[2].steps, "{}: {} steps, {}", film.name, ours[2].steps, oracle[2].steps);
        // Two of the three films are at rest at the last time.
        assert_seen(film.name, &ours[0], &film.by_esdirk34(&a_thousandth_later(LATE))[0]);
    }
}

#[test]
fn a_film_forgets_errors() {
    for mut film in films() {
        // The lattice energy can be taken off only while gaps are small.
        let times: &[f64] = if film.method.corrects() { &EARLY } else { &[1.0e-4, 1.0e-2, 1.0, 50.0] };
        let undisturbed = film.by(FilmIntegrator::Stiff, times);
        let start = film.start.clone();
        for wave in [0.0, 3.0, 10.0, 40.0, 150.0, 300.0] {
            film.start = start.iter().map(|x| x + 1.0e-5 * (wave * x + 0.3).cos()).collect();
            let error = distance(&film.start, &start);
            for (disturbed, undisturbed) in film.by(FilmIntegrator::Stiff, times).iter().zip(&undisturbed) {
                let left = distance(&disturbed.x, &undisturbed.x);
                assert!(left < error + allowed(disturbed, undisturbed), "{} {wave}: {left:e} of {error:e}", film.name);
            }
        }
    }
}

#[test]
fn the_system_of_esdirk34_has_the_rates_of_the_film() {
    for mut film in films_of_the_paper() {
        let x: Vec<f64> = film.start.iter().map(|x| x + 0.002 * (40.0 * x + 0.3).sin()).collect();
        let mut rates = vec![0.0; x.len()];
        film.method.rates(&x, &mut rates);
        let system = System::new(&film.method, &x);
        let mut right_side = vec![0.0; system.start.len()];
        system.right_side(&system.start, &mut right_side);
        let largest = rates.iter().map(|rate| rate.abs()).fold(0.0, f64::max);
        for (row, value) in right_side.into_iter().enumerate() {
            let known = if row.is_multiple_of(system.block) { rates[row / system.block] } else { 0.0 };
            assert!((value - known).abs() < 1.0e-11 * largest, "{}, row {row}: {value} {known}", film.name);
        }
    }
}
