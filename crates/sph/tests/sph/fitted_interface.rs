//! Particles that follow the initial interface, and the packing of both fluids to them, for interfaces of different kinds.

use std::f64::consts::PI;

use crate::support::flow::flow;
use meniscus_core::math::Vec2;
use meniscus_sph::flow::Flow;
use meniscus_sph::particles::Phase;

const SPACING: f64 = 2.0e-5;

/// A box of 1 mm with two fluids; `wetting` shapes in m.
fn fluids(wetting: &str, sides: &str, more: &str) -> Flow {
    flow(&format!(
        "format = 1\ntitle = \"Two fluids\"\n[geometry]\nmin = [-5.0e-4, -5.0e-4]\nmax = [5.0e-4, 5.0e-4]\n\
         [time]\nend = 1.0\n[sph]\nspacing = {SPACING:e}\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
         [sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n[sph.interface]\ntension = 0.02\n\
         [sph.wetting.young]\ncontact-angle-deg = 60.0\n\
         [sph.sides]\n{sides}\n[[sph.initial.wetting]]\n{wetting}\n{more}"
    ))
}

const PERIODIC: &str = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"";
const ALONG_X: &str = "left = \"periodic\"\nright = \"periodic\"";
const DISC: &str = "disc = { center = [1.0e-5, 0.4e-5], radius = 2.53e-4 }";

/// A distance from the interface in m, of the sign of the shapes.
type Distance = fn(Vec2) -> f64;

/// Name, shape, sides, distance from the interface in m, area of the wetting phase in m², length of the interface in m.
fn interfaces() -> [(&'static str, &'static str, &'static str, Distance, f64, f64); 7] {
    let cap = |r: f64, down: f64| {
        let half = (down / r).acos();
        r * r * (half - half.sin() * half.cos())
    };
    [
        (
            "a disc",
            DISC,
            PERIODIC,
            |x| (x - Vec2::new(1.0e-5, 0.4e-5)).norm() - 2.53e-4,
            PI * 2.53e-4_f64.powi(2),
            2.0 * PI * 2.53e-4,
        ),
        (
            "a flat cap on the floor",
            "disc = { center = [0.0, -1.0e-3], radius = 6.1e-4 }",
            "",
            |x| (x - Vec2::new(0.0, -1.0e-3)).norm() - 6.1e-4,
            cap(6.1e-4, 5.0e-4),
            2.0 * 6.1e-4 * (5.0_f64 / 6.1).acos(),
        ),
        (
            "a cap of an obtuse angle",
            "disc = { center = [0.0, -4.0e-4], radius = 2.0e-4 }",
            "",
            |x| (x - Vec2::new(0.0, -4.0e-4)).norm() - 2.0e-4,
            PI * 2.0e-4_f64.powi(2) - cap(2.0e-4, 1.0e-4),
            2.0 * PI * 2.0e-4 * (2.0 / 3.0),
        ),
        (
            "a level between two rows",
            "half-plane = { point = [0.0, 1.3e-5] }",
            ALONG_X,
            |x| x.y - 1.3e-5,
            5.13e-7,
            1.0e-3,
        ),
        (
            "a rectangle with its sides on the walls",
            "rectangle = { center = [-2.0e-4, 0.0], size = [6.06e-4, 1.0e-3] }",
            "",
            |x| x.x - 1.03e-4,
            6.03e-7,
            1.0e-3,
        ),
        (
            "a front between two open sides",
            "rectangle = { center = [-5.0e-4, 0.0], size = [1.214e-3, 2.0e-3] }",
            "left = \"inlet\"\nright = \"outlet\"\nopen.left = { pressure = 0.0, phase = \"wetting\" }",
            |x| x.x - 1.07e-4,
            6.07e-7,
            1.0e-3,
        ),
        (
            "a slope across the box",
            "half-plane = { point = [0.0, 0.0], rotation-deg = 20.0 }",
            "",
            |x| x.y * 20_f64.to_radians().cos() - x.x * 20_f64.to_radians().sin(),
            5.0e-7,
            1.0e-3 / 20_f64.to_radians().cos(),
        ),
    ]
}

#[test]
fn each_phase_has_as_many_particles_as_its_area_has_room_for() {
    for (name, shape, sides, _, area, _) in interfaces() {
        let flow = fluids(shape, sides, "");
        // Beyond open sides there are particles too.
        let in_box = |a: &usize| flow.state.particles.position[*a].amax() < 5.0e-4;
        let fluids: Vec<usize> = (0..flow.state.particles.fluids).filter(in_box).collect();
        let wetting = fluids.iter().filter(|a| flow.state.particles.phase[**a] == Phase::Wetting).count();
        let room = area / (SPACING * SPACING);
        assert!((wetting as f64 - room).abs() < 0.6, "{name}: {wetting} particles in the room of {room}");
        assert_eq!(fluids.len(), 2500, "{name}");
    }
}

#[test]
fn the_particles_nearest_to_the_interface_stand_half_a_spacing_from_it() {
    for (name, shape, sides, distance, _, length) in interfaces() {
        let flow = fluids(shape, sides, "");
        let mut layers = [0, 0];
        for x in flow.state.particles.position[..flow.state.particles.fluids].iter().filter(|x| x.amax() < 5.0e-4) {
            let d = distance(*x) / SPACING;
            assert!(d.abs() > 0.499, "{name}: {d} spacings from the interface at {x:?}");
            assert!(!(0.501..0.7).contains(&d.abs()), "{name}: {d} spacings from the interface at {x:?}");
            layers[usize::from(d > 0.0)] += usize::from(d.abs() < 0.501);
        }
        assert!(
            layers.iter().all(|count| (*count as f64 - length / SPACING).abs() < 4.0),
            "{name}: {layers:?} of {length:e} m"
        );
    }
}

/// [Lind2012]
#[test]
fn both_fluids_are_packed_evenly() {
    for (name, shape, sides, ..) in interfaces() {
        let flow = fluids(shape, sides, "");
        let closest = (0..flow.state.particles.fluids)
            .map(|a| (flow.config.wall)(flow.state.particles.position[a]).0)
            .fold(1.0, f64::min);
        assert!(closest > 0.24 * SPACING, "{name}: {closest:e} m from the wall");
        let errors =
            flow.fields.bulk.volume[..flow.state.particles.fluids].iter().map(|v| flow.config.method.volume / v - 1.0);
        let (square, largest) = errors.fold((0.0, 0.0_f64), |(s, l), e| (s + e * e, l.max(e.abs())));
        let spread = (square / flow.state.particles.fluids as f64).sqrt();
        // Largest in the tip of the flat cap.
        assert!(spread < 5e-3 && largest < 0.1, "{name}: spread {spread:.1e}, largest {largest:.1e}");
    }
}

#[test]
fn an_interface_that_the_lattice_fits_or_is_too_small_leaves_it_as_it_is() {
    let strip = "rectangle = { center = [0.0, 0.0], size = [2.0e-4, 1.2e-4] }";
    let speck = "disc = { center = [0.0, 0.0], radius = 0.9e-5 }";
    for shape in [strip, speck] {
        let [fitted, cut] = ["", "[sph.numerics]\nfitted-interface = false\n"]
            .map(|more| fluids(shape, PERIODIC, more).state.particles);
        assert_eq!(fitted.position, cut.position);
        assert_eq!(fitted.phase, cut.phase);
    }
}

/// On the lattice the drop below swings and creeps: after these steps it is at 3e-3.
#[test]
fn a_drop_that_starts_as_a_disc_rests() {
    let mut flow = fluids(DISC, PERIODIC, "");
    for _ in 0..200 {
        flow.step(1.0).unwrap();
    }
    let fastest = flow.state.particles.fluid_speed();
    let capillary_number = 5.0e-3 * fastest / 0.02;
    assert!(capillary_number < 1e-4, "{capillary_number:.1e}");
}
