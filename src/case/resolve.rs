//! A checked case written out as one case file: no defaults, presets, overrides or other files left.

use super::checked::{
    Case, Compression, Drive, Fluid, InitialVelocity, LineDelta, Model, Numerics, Open, Output, PressureSteps, Profile,
    Side, Sides, Sph, SurfaceForce, ViscousStep, ViscousTerm,
};
use super::raw::{
    Empty, RawCase, RawCompression, RawCsf, RawEvery, RawExpectation, RawFluid, RawGeometry, RawGrid, RawInitial,
    RawInterface, RawLineDelta, RawNumerics, RawOpenSide, RawOpenSides, RawOutput, RawPhase, RawPhases,
    RawPressureJump, RawPressureSteps, RawProfile, RawSide, RawSides, RawSph, RawSurfaceForce, RawTaylorGreen, RawTime,
    RawVelocity, RawViscousStep, RawViscousTerm, RawVtk, RawWallSpeeds, RawWalls,
};
use super::{steady, wetting};

/// The case as TOML that loads to the same case (angles to the last bit of a degree).
pub(super) fn text(case: &Case) -> String {
    // Every value of a checked case can be written as TOML: numbers, texts and tables with text keys.
    toml::to_string(&raw(case)).unwrap_or_default()
}

fn raw(case: &Case) -> RawCase {
    let (sph, thin_film, network) = match &case.model {
        Model::Sph(sph) => (Some(raw_sph(sph)), None, None),
        Model::ThinFilm(film) => (None, Some(super::film::resolved(film)), None),
        Model::Network(network) => (None, None, Some(super::network::resolved(network))),
    };
    let is_quasi_static = matches!(&case.model, Model::Network(network) if !network.is_dynamic());
    let geometry = &case.geometry;
    RawCase {
        format: Some(1),
        title: Some(case.title.clone()),
        geometry: Some(RawGeometry {
            min: Some(geometry.min),
            max: Some(geometry.max),
            solid: Some(geometry.solid),
            shapes: Some(geometry.shapes.clone()),
            ..RawGeometry::default()
        }),
        sph,
        thin_film,
        time: (!is_quasi_static)
            .then_some(RawTime { end: Some(case.end), steady: case.steady.as_ref().map(steady::raw) }),
        output: Some(raw_output(&case.output, matches!(&case.model, Model::Network(_)), is_quasi_static)),
        network,
        expect: Some(
            case.expect
                .iter()
                .map(|expect| RawExpectation {
                    measure: Some(expect.measure.clone()),
                    value: Some(expect.value),
                    tolerance: Some(expect.tolerance),
                })
                .collect(),
        ),
    }
}

fn raw_output(output: &Output, is_network: bool, by_volume: bool) -> RawOutput {
    let every = |interval| {
        let interval = Some(interval);
        let none = RawEvery::default();
        Some(if by_volume {
            RawEvery { every_pore_volume: interval, ..none }
        } else {
            RawEvery { every_time: interval, ..none }
        })
    };
    let compression = match output.vtk_compression {
        Compression::None => RawCompression::None,
        Compression::Zlib => RawCompression::Zlib,
        Compression::Lz4 => RawCompression::Lz4,
    };
    RawOutput {
        vtk: every(output.vtk_every).map(|every| RawVtk {
            every_time: every.every_time,
            every_pore_volume: every.every_pore_volume,
            compression: Some(compression),
        }),
        series: every(output.series_every),
        grid: (!is_network).then_some(RawGrid { ratio: Some(output.grid_ratio) }),
        restart: every(output.restart_every),
    }
}

fn raw_sph(sph: &Sph) -> RawSph {
    let two_phases = sph.non_wetting.is_some();
    let by_shapes = two_phases && sph.initial.network.is_none();
    let background = if sph.initial.wetting_is_background { RawPhase::Wetting } else { RawPhase::NonWetting };
    RawSph {
        spacing: Some(sph.spacing),
        smoothing_ratio: Some(sph.smoothing_ratio),
        reference_length: sph.reference_length,
        gravity: Some(sph.gravity.into()),
        phases: Some(RawPhases {
            wetting: Some(raw_fluid(&sph.wetting)),
            non_wetting: sph.non_wetting.as_ref().map(raw_fluid),
        }),
        interface: two_phases.then_some(RawInterface { tension: Some(sph.tension) }),
        surface_force: sph
            .surface_force
            .map(|force| RawSurfaceForce { csf: csf(force), pressure_jump: pressure_jump(force) }),
        wetting: sph.wetting_model.map(|model| wetting::raw(&model, &sph.wetting_patches)),
        sides: Some(raw_sides(&sph.sides, sph.wall_speeds, sph.open)),
        walls: Some(RawWalls {
            slip_length: Some(sph.walls.slip_length),
            line_slip_length: sph.wetting_model.map(|_| sph.walls.line_slip_length),
        }),
        initial: Some(RawInitial {
            background: by_shapes.then_some(background),
            wetting: by_shapes.then(|| sph.initial.wetting.clone()),
            network: sph.initial.network.as_ref().map(|start| start.file.clone()),
            velocity: Some(raw_velocity(&sph.initial.velocity)),
        }),
        numerics: Some(raw_numerics(&sph.numerics)),
        measure: Some(sph.measure.to_raw()),
    }
}

pub(super) fn raw_fluid(fluid: &Fluid) -> RawFluid {
    RawFluid { preset: None, temperature_c: None, density: Some(fluid.density), viscosity: Some(fluid.viscosity) }
}

fn raw_sides(sides: &Sides, speeds: [f64; 4], open: [Option<Open>; 4]) -> RawSides {
    let side = |side| {
        Some(match side {
            Side::Periodic => RawSide::Periodic,
            Side::Wall => RawSide::Wall,
            Side::Image => RawSide::Image,
            Side::Symmetry => RawSide::Symmetry,
            Side::Inlet => RawSide::Inlet,
            Side::Outlet => RawSide::Outlet,
        })
    };
    // A side that is not a wall has no speed, not even 0.
    let given = |side, speed| (side == Side::Wall && speed != 0.0).then_some(speed);
    let [left, right, bottom, top] = speeds;
    let speed = RawWallSpeeds {
        left: given(sides.left, left),
        right: given(sides.right, right),
        bottom: given(sides.bottom, bottom),
        top: given(sides.top, top),
    };
    RawSides {
        left: side(sides.left),
        right: side(sides.right),
        bottom: side(sides.bottom),
        top: side(sides.top),
        speed: Some(speed),
        open: open.iter().any(Option::is_some).then(|| {
            let [left, right, bottom, top] = open.map(|open| open.map(raw_open));
            RawOpenSides { left, right, bottom, top }
        }),
    }
}

fn raw_open(open: Open) -> RawOpenSide {
    let profile = |profile| {
        Some(match profile {
            Profile::Plug => RawProfile::Plug,
            Profile::Parabolic => RawProfile::Parabolic,
        })
    };
    let given = match open.drive {
        Drive::Pressure(pressure) => RawOpenSide { pressure: Some(pressure), ..RawOpenSide::default() },
        Drive::Velocity(mean, shape) => {
            RawOpenSide { velocity: Some(mean), profile: profile(shape), ..RawOpenSide::default() }
        }
        Drive::FlowRate(rate, shape) => {
            RawOpenSide { flow_rate: Some(rate), profile: profile(shape), ..RawOpenSide::default() }
        }
    };
    let phase = |wetting| if wetting { RawPhase::Wetting } else { RawPhase::NonWetting };
    let steps = |steps: PressureSteps| RawPressureSteps { rise: Some(steps.rise), every_time: Some(steps.every_time) };
    RawOpenSide { phase: open.enters_wetting.map(phase), pressure_steps: open.pressure_steps.map(steps), ..given }
}

fn raw_velocity(velocity: &InitialVelocity) -> RawVelocity {
    match *velocity {
        InitialVelocity::Rest => RawVelocity { rest: Some(Empty {}), ..RawVelocity::default() },
        InitialVelocity::Uniform(velocity) => RawVelocity { uniform: Some(velocity.into()), ..RawVelocity::default() },
        InitialVelocity::TaylorGreen(speed) => {
            RawVelocity { taylor_green: Some(RawTaylorGreen { speed: Some(speed) }), ..RawVelocity::default() }
        }
    }
}

fn raw_numerics(numerics: &Numerics) -> RawNumerics {
    RawNumerics {
        viscous_term: Some(match numerics.viscous_term {
            ViscousTerm::Szewc => RawViscousTerm::Szewc,
            ViscousTerm::Morris => RawViscousTerm::Morris,
            ViscousTerm::Stress => RawViscousTerm::Stress,
        }),
        viscous_step: Some(match numerics.viscous_step {
            ViscousStep::Implicit => RawViscousStep::Implicit,
            ViscousStep::Explicit => RawViscousStep::Explicit,
        }),
        density_error_correction: Some(numerics.density_error_correction),
        density_error_shifting: Some(numerics.density_error_shifting),
        background_pressure: Some(numerics.background_pressure),
        shifting: Some(numerics.shifting),
        anti_clustering: Some(numerics.anti_clustering),
        wall_stretch: Some(numerics.wall_stretch),
        fitted_walls: Some(numerics.fitted_walls),
        fitted_interface: Some(numerics.fitted_interface),
        pressure_tolerance: Some(numerics.pressure_tolerance),
        time_step_factor: Some(numerics.time_step_factor),
    }
}

/// The table of the continuum surface force, where it is the one chosen.
fn csf(force: SurfaceForce) -> Option<RawCsf> {
    match force {
        SurfaceForce::Csf { line_delta: LineDelta::Normalized } => Some(RawCsf::default()),
        SurfaceForce::Csf { line_delta: LineDelta::Local } => Some(RawCsf { line_delta: Some(RawLineDelta::Local) }),
        SurfaceForce::PressureJump { .. } => None,
    }
}

/// The table of the pressure jump, where it is the one chosen.
fn pressure_jump(force: SurfaceForce) -> Option<RawPressureJump> {
    match force {
        SurfaceForce::PressureJump { curvature } => Some(RawPressureJump { curvature }),
        SurfaceForce::Csf { .. } => None,
    }
}
