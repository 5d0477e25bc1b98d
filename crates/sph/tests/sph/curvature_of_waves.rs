//! The curvature applied to waves of a flat interface, over the exact one: what the color, the circle fit and the average leave of it.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::equal_fluids::equal_fluids;
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
        let (degrees, tangent, shift) = match self {
            Self::Straight => (0.0, Vec2::x(), 0.0),
            Self::Diagonal => (45.0, Vec2::repeat(1.0).normalize(), 0.2 * SPACING),
        };
        let mut flow = flow(&format!(
            "{}[sph.numerics]\nfitted-interface = false\n[[sph.initial.wetting]]\n\
             half-plane = {{ point = [0.0, {shift:e}], rotation-deg = {degrees} }}\n",
            equal_fluids(0.5 * width, SPACING, 1.0e-3)
        ));
        let wavenumber = TAU * f64::from(waves) / width / tangent.amax();
        let amplitude = 1.0e-4 * SPACING;
        let wave = |x: Vec2| (wavenumber * tangent.dot(&x) + 0.3).cos();
        let straight = flow.fields.interface.curvature.clone();
        for x in &mut flow.state.particles.position {
            *x = (*x + amplitude * wave(*x) * perpendicular(tangent))
                .map(|v| (v + 0.5 * width).rem_euclid(width) - 0.5 * width);
        }
        flow.prepare();
        let (position, curvature) = (&flow.state.particles.position, &flow.fields.interface.curvature);
        // The other interface of the box, and the corners where both meet, are left out.
        let is_near =
            |x: Vec2| perpendicular(tangent).dot(&x).abs() < 1.5 * SPACING && tangent.dot(&x).abs() < 0.45 * width;
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
        let mut before = 1.0;
        let responses = (1..).map(|waves| row.response(waves)).take_while(|(length, _)| *length > shortest);
        for (length, response) in responses {
            println!("{row:?} row, waves of {length:.2} spacings: {response:.4}");
            assert!(response > -1e-6, "{response:e} for waves of {length} spacings");
            assert!(response < before + 2e-5, "{response} for waves of {length} spacings, {before} for longer ones");
            before = response;
        }
        assert!(before.abs() < 6e-4, "{before} of the shortest wave");
    }
}

/// A wave of two equal deep fluids has the frequency ω² = σk³/(2ρ) times the response, and a symplectic step is stable up to ω Δt = 2.
#[test]
fn the_stiffest_wave_of_a_row_has_five_spacings() {
    for (row, length, measured) in [(Row::Straight, 5.0, 4.41), (Row::Diagonal, 4.71, 4.57)] {
        // 2/ω over sqrt(ρ h³/(2πσ)).
        let limit = |(length, response): (f64, f64)| 4.0 * PI.sqrt() / ((TAU * H / length).powi(3) * response).sqrt();
        let (stiffest, limit) = (6..16)
            .map(|waves| row.response(waves))
            .map(|wave| (wave.0, limit(wave)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert!((stiffest - length).abs() < 0.01, "{stiffest}");
        assert!((limit - measured).abs() < 0.01, "{limit}");
    }
}

/// A free drop at La = ρσR/μ² = 12000. With weights whose transform changes sign the currents are 4.5e-7 at this time, and grow by 18 per s.
#[test]
fn currents_of_a_thin_liquid_decay() {
    const VISCOSITY: f64 = 1.1547e-3;
    const TENSION: f64 = 0.02;
    let mut solver = solver(&format!(
        "{}[[sph.initial.wetting]]\ndisc = {{ center = [0.0, 0.0], radius = 4.0e-4 }}\n",
        equal_fluids(8.0e-4, 4.0e-5, VISCOSITY)
    ));
    let speed = |solver: &mut SphSolver, time: f64| {
        while solver.time() < time {
            solver.step(time).unwrap();
        }
        let row = solver.sample();
        row.iter().find(|sample| sample.name == "max_relative_speed_m_per_s").unwrap().value
    };
    let currents = [0.05, 0.1].map(|time| VISCOSITY * speed(&mut solver, time) / TENSION);
    assert!(currents[1] < 5e-8 && currents[1] < 0.7 * currents[0], "{currents:?}");
}
