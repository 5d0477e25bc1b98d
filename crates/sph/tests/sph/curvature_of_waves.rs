//! The curvature applied to waves of a flat interface, over the exact one: what the color, the circle fit and the average leave of it.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::support::flow::{flow, solver};
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_core::solver::Solver;
use meniscus_sph::solver::SphSolver;

const SPACING: f64 = 1.0e-5;

/// Width of the periodic box over the spacing.
const WIDTH: f64 = 60.0;

/// Smoothing length over spacing.
const H: f64 = 1.5;

/// A row of particles at an interface.
#[derive(Debug, Clone, Copy)]
enum Row {
    Straight,
    Diagonal,
}

impl Row {
    /// The wavelength in spacings and the response for a number of `waves` in the box.
    fn response(self, waves: u32) -> (f64, f64) {
        let width = WIDTH * SPACING;
        let middle = Vec2::repeat(0.5 * width);
        let (degrees, tangent, shift) = match self {
            Self::Straight => (0.0, Vec2::x(), 0.0),
            Self::Diagonal => (45.0, Vec2::repeat(1.0).normalize(), 0.2 * SPACING),
        };
        let sides = ["left", "right", "bottom", "top"].map(|side| format!("{side} = \"periodic\"\n")).concat();
        let fluid = "density = 1000.0\nviscosity = 1.0e-3\n";
        let mut flow = flow(&format!(
            "format = 1\ntitle = \"A row\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [{width:e}, {width:e}]\n[time]\nend = 1.0\n\
             [sph]\nspacing = {SPACING:e}\n[sph.phases.wetting]\n{fluid}[sph.phases.non-wetting]\n{fluid}\
             [sph.interface]\ntension = 0.02\n[sph.numerics]\nfitted-interface = false\n[sph.sides]\n{sides}\
             [[sph.initial.wetting]]\nhalf-plane = {{ point = [{:e}, {:e}], rotation-deg = {degrees} }}\n",
            middle.x,
            middle.y + shift
        ));
        let wavenumber = TAU * f64::from(waves) / width / tangent.amax();
        let amplitude = 1.0e-4 * SPACING;
        let wave = |x: Vec2| (wavenumber * tangent.dot(&(x - middle)) + 0.3).cos();
        let straight = flow.fields.interface.curvature.clone();
        for x in &mut flow.state.particles.position {
            *x = (*x + amplitude * wave(*x) * perpendicular(tangent)).map(|v| v.rem_euclid(width));
        }
        flow.prepare();
        let (position, curvature) = (&flow.state.particles.position, &flow.fields.interface.curvature);
        // The other interface of the box, and the corners where both meet, are left out.
        let is_near = |x: Vec2| {
            perpendicular(tangent).dot(&(x - middle)).abs() < 1.5 * SPACING
                && tangent.dot(&(x - middle)).abs() < 0.45 * width
        };
        let near = (0..position.len()).filter(|&a| is_near(position[a])).map(|a| (wave(position[a]), a));
        let (applied, exact) = near.fold((0.0, 0.0), |(applied, exact), (wave, a)| {
            let change = curvature[a] - straight[a];
            (applied + change * wave, exact + amplitude * wavenumber.powi(2) * wave * wave)
        });
        (TAU / wavenumber / SPACING, applied / exact)
    }
}

/// With a negative response a wave drives itself, and grows in a liquid of low viscosity.
#[test]
fn the_curvature_of_a_wave_is_never_of_the_wrong_sign() {
    for (row, shortest) in [(Row::Straight, 2.0), (Row::Diagonal, SQRT_2)] {
        let mut before = 1.0 + 1e-3;
        let responses = (1..).map(|waves| row.response(waves)).take_while(|(length, _)| *length > shortest);
        for (length, response) in responses {
            println!("{row:?} row, waves of {length:.2} spacings: {response:.4}");
            assert!(response > -1e-6, "{response:e} for waves of {length} spacings");
            assert!(response < before + 1e-6, "{response} for waves of {length} spacings, {before} for longer ones");
            before = response;
        }
        assert!(before.abs() < 2e-3, "{before} of the shortest wave");
    }
}

/// A wave of two equal deep fluids has the frequency ω² = σk³/(2ρ) times the response, and a symplectic step is stable up to ω Δt = 2.
#[test]
fn the_stiffest_wave_of_a_row_has_five_spacings() {
    for row in [Row::Straight, Row::Diagonal] {
        // 2/ω over sqrt(ρ h³/(2πσ)).
        let limit = |(length, response): (f64, f64)| 4.0 * PI.sqrt() / ((TAU * H / length).powi(3) * response).sqrt();
        let (stiffest, limit) = (6..16)
            .map(|waves| row.response(waves))
            .map(|wave| (wave.0, limit(wave)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert!((4.5..5.5).contains(&stiffest), "{stiffest}");
        assert!((4.35..4.65).contains(&limit), "{limit}");
    }
}

/// A free drop at La = ρσR/μ² = 12000. With weights whose transform changes sign the currents are 4.5e-7 at this time, and grow by 18 per s.
#[test]
fn currents_of_a_thin_liquid_decay() {
    const VISCOSITY: f64 = 1.1547e-3;
    const TENSION: f64 = 0.02;
    let sides = ["left", "right", "bottom", "top"].map(|side| format!("{side} = \"periodic\"\n")).concat();
    let fluid = format!("density = 1000.0\nviscosity = {VISCOSITY}\n");
    let mut solver = solver(&format!(
        "format = 1\ntitle = \"A drop\"\n[geometry]\nmin = [-8.0e-4, -8.0e-4]\nmax = [8.0e-4, 8.0e-4]\n[time]\nend = 1.0\n\
         [sph]\nspacing = 4.0e-5\n[sph.phases.wetting]\n{fluid}[sph.phases.non-wetting]\n{fluid}\
         [sph.interface]\ntension = {TENSION}\n[sph.sides]\n{sides}\
         [[sph.initial.wetting]]\ndisc = {{ center = [0.0, 0.0], radius = 4.0e-4 }}\n"
    ));
    let speed = |solver: &mut SphSolver, time: f64| {
        while solver.time() < time {
            solver.step(time).unwrap();
        }
        let row = solver.sample();
        row.iter().find(|sample| sample.name == "max_relative_speed_m_per_s").unwrap().value
    };
    let currents = [0.05, 0.1].map(|time| VISCOSITY * speed(&mut solver, time) / TENSION);
    assert!(currents[1] < 6e-8 && currents[1] < 0.8 * currents[0], "{currents:?}");
}
