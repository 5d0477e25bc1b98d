//! The thin-film model against numbers found by independent programs and against closed forms.

use meniscus_case::film::{FilmIntegrator, FilmWeights, LatticeEnergy};
use meniscus_film::backward_euler::StepRule;
use meniscus_film::droplet::{Droplet, particles};
use meniscus_film::equilibrium::Equilibrium;
use meniscus_film::grid_film::GridFilm;
use meniscus_film::kernel::Kernel;
use meniscus_film::ode::{Integrator, Tolerance};
use meniscus_film::particles::{ParticleMethod, Pull};
use meniscus_film::profile::Profile;
use meniscus_film::ring::{Line, Ring};

const ALPHA: f64 = 0.05;
const COMPLETE: Droplet = Droplet { area: 0.25, half_width: 0.5, center: 0.0 };
const PARTIAL: Droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };

struct Particles {
    method: ParticleMethod,
    state: Integrator,
}

impl Particles {
    fn new(droplet: Droplet, spacing: f64, wetting: f64, lattice: LatticeEnergy, method: FilmIntegrator) -> Self {
        let masses = particles(&[droplet], spacing, FilmWeights::Cell);
        let tolerance = Tolerance { absolute: 1.0e-8, relative: 1.0e-8 };
        Self {
            method: ParticleMethod::new(Kernel::new(ALPHA), &masses, Pull { wetting, bond: 0.0 }, lattice),
            state: Integrator::new(method, tolerance, masses.x, 1.0e-7),
        }
    }

    fn at(mut self, time: f64) -> Self {
        self.state.run(&mut self.method, time).unwrap();
        self
    }

    fn profile(&self, half: f64, count: i32) -> Profile {
        let x: Vec<f64> = (0..=count).map(|i| half * (2.0 * f64::from(i) / f64::from(count) - 1.0)).collect();
        let s = self.method.profile(&self.state.x, &x);
        Profile { x, height: s.height, slope: s.slope, curvature: s.curvature }
    }

    fn center(&self) -> f64 {
        self.method.profile(&self.state.x, &[0.0]).height[0]
    }

    fn last(&self) -> f64 {
        *self.state.x.last().unwrap()
    }
}

fn grid(droplet: Droplet, half: f64, count: usize, wetting: f64, rule: StepRule) -> GridFilm {
    let line = Line { from: -half, count, spacing: 2.0 * half / count as f64, alpha: ALPHA, wetting, bond: 0.0 };
    let (ring, height) = Ring::new(line, &[droplet], FilmWeights::Point).unwrap();
    GridFilm::new(ring, height, rule)
}

fn near(found: f64, known: f64, tolerance: f64) {
    assert!((found - known).abs() < tolerance, "found {found}, known {known}");
}

/// [Pang2022, Sect. 3]
#[test]
fn a_completely_wetting_droplet_of_particles_reaches_the_known_state() {
    // 800 nodes on [-2, 2], t = 50; the known values are from DOPRI5 of another program, good to its tolerance.
    let end = Particles::new(COMPLETE, 0.005, 0.0, LatticeEnergy::Kept, FilmIntegrator::Stiff).at(50.0);
    // An explicit method takes a hundred times as many.
    assert!(end.state.work.rates < 1500, "{:?}", end.state.work);
    near(end.last(), 1.142_002, 2.0e-6);
    near(end.center(), 0.166_871_0, 1.0e-6);
    near(end.profile(2.0, 6400).contact_line(0.0).unwrap().position, 1.186_667, 2.0e-5);
}

#[test]
fn the_explicit_and_the_stiff_method_agree() {
    // 400 nodes on [-1, 1], t = 1.
    for method in [FilmIntegrator::Explicit, FilmIntegrator::Stiff] {
        let end = Particles::new(COMPLETE, 0.005, 0.0, LatticeEnergy::Kept, method).at(1.0);
        near(end.center(), 0.260_898_4, 1.0e-6);
    }
}

#[test]
fn a_partially_wetting_droplet_of_particles_reaches_the_known_state() {
    let wetting = Equilibrium::of_unit_slope(ALPHA).unwrap().wetting();
    let end = Particles::new(PARTIAL, 0.005, wetting, LatticeEnergy::Kept, FilmIntegrator::Stiff).at(100.0);
    near(end.center(), 0.833_597, 2.0e-6);
    near(end.last(), 1.073_30, 1.0e-5);
}

#[test]
fn taking_off_the_lattice_energy_brings_particles_near_the_limit_of_fine_spacing() {
    let end = Particles::new(COMPLETE, 0.005, 0.0, LatticeEnergy::TakenOff, FilmIntegrator::Stiff).at(50.0);
    // The limit is 0.156117 and 1.24023; plain particles give 0.16687 and 1.18667 at this spacing.
    near(end.center(), 0.156_063, 1.0e-5);
    near(end.profile(2.0, 6400).contact_line(0.0).unwrap().position, 1.240_38, 1.0e-4);
}

/// [Pang2022, Eqs. 76-83]
#[test]
fn finite_differences_reach_the_known_state_and_keep_the_mass() {
    let mut film = grid(COMPLETE, 1.0, 400, 0.0, StepRule::fixed(0.01));
    let mass = film.mass();
    film.run(1.0).unwrap();
    near(film.state.height[200], 0.258_806_3, 1.0e-6);
    near(film.mass(), mass, 1.0e-11);
    assert_eq!(film.state.rejected, 0);
    assert!(film.state.iterations <= 300, "{} Newton iterations for 100 steps", film.state.iterations);
}

#[test]
fn finite_differences_have_second_order() {
    let at = |count: usize| {
        let mut film = grid(COMPLETE, 1.0, count, 0.0, StepRule::fixed(0.01));
        film.run(1.0).unwrap();
        film.state.height
    };
    let heights = [at(200), at(400), at(800)];
    let error = |coarse: &[f64], fine: &[f64]| {
        let sum: f64 = coarse.iter().enumerate().map(|(i, h)| (h - fine[2 * i]).abs()).sum();
        2.0 * sum / coarse.len() as f64
    };
    let (coarse, fine) = (error(&heights[0], &heights[1]), error(&heights[1], &heights[2]));
    near(coarse, 5.774e-5, 5.0e-8);
    near((coarse / fine).log2(), 2.0, 0.05);
}

#[test]
fn finite_differences_come_to_the_equilibrium_with_the_error_of_their_mass() {
    let droplet = Equilibrium::of_unit_slope(ALPHA).unwrap();
    let mut film = grid(PARTIAL, 2.0, 400, droplet.wetting(), StepRule::ADAPTIVE);
    film.run(100.0).unwrap();
    let x = film.grid().nodes();
    let profile = Profile { x, height: film.state.height.clone(), ..Profile::default() };
    // Sampled heights miss (dx/2r)^2 = 1e-4 of the mass.
    near(profile.distance_to(|x| droplet.height(x)), 1.0e-4, 2.0e-6);
    assert_eq!(film.state.rejected, 0);
}

#[test]
fn particles_converge_with_second_order() {
    let at = |spacing: f64| Particles::new(COMPLETE, spacing, 0.0, LatticeEnergy::Kept, FilmIntegrator::Stiff).at(1.0);
    let profiles = [0.01, 0.005, 0.0025].map(|spacing| at(spacing).profile(1.0, 6400));
    let error = |a: &Profile, b: &Profile| {
        a.height.iter().zip(&b.height).map(|(a, b)| (a - b).abs()).sum::<f64>() * 2.0 / 6400.0
    };
    let (coarse, fine) = (error(&profiles[0], &profiles[1]), error(&profiles[1], &profiles[2]));
    near(coarse, 5.847e-3, 2.0e-6);
    near(fine, 1.499e-3, 1.0e-6);
}

#[test]
fn more_particles_come_nearer_to_the_limit_as_known() {
    // 3200 nodes on [-2, 2], t = 50.
    let end = Particles::new(COMPLETE, 0.00125, 0.0, LatticeEnergy::Kept, FilmIntegrator::Stiff).at(50.0);
    near(end.last(), 1.182_439, 2.0e-6);
    near(end.center(), 0.156_810_3, 1.0e-6);
}

#[test]
fn taking_off_the_lattice_energy_gives_order_four() {
    let rest = Equilibrium::of_unit_slope(ALPHA).unwrap();
    let error = |spacing: f64| {
        let end =
            Particles::new(PARTIAL, spacing, rest.wetting(), LatticeEnergy::TakenOff, FilmIntegrator::Stiff).at(100.0);
        end.profile(2.0, 6400).distance_to(|x| rest.height(x))
    };
    let errors = [0.01, 0.005, 0.0025].map(error);
    near(errors[1], 2.1e-4, 1.0e-5);
    let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    assert!(orders.iter().all(|&order| order > 3.5), "{orders:?}");
}
