//! Wall particles that follow the signed distance, and the packing of the fluid to them, on pores of different kinds.

use crate::support::flow::flow;
use meniscus_core::math::Vec2;
use meniscus_sph::flow::Flow;

const SPACING: f64 = 2.0e-5;

/// A box of 1 mm with one fluid; `shapes` in m.
fn pore(shapes: &str, sides: &str, numerics: &str) -> Flow {
    pore_of(SPACING, shapes, sides, numerics)
}

/// The same with another `spacing` (m).
fn pore_of(spacing: f64, shapes: &str, sides: &str, numerics: &str) -> Flow {
    flow(&format!(
        "format = 1\ntitle = \"A pore\"\n[geometry]\nmin = [-5.0e-4, -5.0e-4]\nmax = [5.0e-4, 5.0e-4]\nshapes = [{shapes}]\n\
         [time]\nend = 1.0\n[sph]\nspacing = {spacing:e}\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n\
         [sph.sides]\n{sides}\n[sph.numerics]\n{numerics}\n"
    ))
}

const PERIODIC: &str = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"";

const DISC: &str = "{ disc = { center = [0.0, 0.0], radius = 2.5e-4 } }";

/// Name, shapes, sides.
const PORES: [(&str, &str, &str); 6] = [
    ("a disc in a periodic cell", DISC, PERIODIC),
    ("a disc across a periodic side", "{ disc = { center = [-4.3e-4, 4.1e-4], radius = 2.3e-4 } }", PERIODIC),
    ("a disc on the floor", "{ disc = { center = [3.0e-5, -4.0e-4], radius = 3.0e-4 } }", ""),
    (
        "discs that overlap, and a polygon",
        "{ disc = { center = [-2.0e-4, 0.0], radius = 1.5e-4 } }, { disc = { center = [-0.5e-4, 1.0e-4], radius = 1.4e-4 } }, \
         { polygon = { outer = [[1.5e-4, -3.0e-4], [3.5e-4, -2.0e-4], [2.5e-4, 1.0e-4]] } }",
        PERIODIC,
    ),
    ("an oblique wall", "{ half-plane = { point = [0.0, -2.0e-4], rotation-deg = 27.0 } }", ""),
    (
        "a plate between two rows",
        "{ rectangle = { center = [7.0e-6, 3.0e-6], size = [1.5e-4, 2.5e-4] } }",
        "left = \"symmetry\"",
    ),
];

fn density_errors(flow: &Flow) -> Vec<f64> {
    flow.fields.bulk.volume[..flow.state.particles.fluids].iter().map(|v| flow.config.method.volume / v - 1.0).collect()
}

fn spread(errors: &[f64]) -> [f64; 3] {
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let rms = (errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / errors.len() as f64).sqrt();
    [mean, rms, errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()))]
}

/// [Lind2012]
#[test]
fn the_density_of_a_packed_pore_is_even() {
    for (name, shapes, sides) in PORES {
        let [mean, rms, largest] = spread(&density_errors(&pore(shapes, sides, "")));
        // Half a particle of two thousand, and what sums over layers of another period than the fluid's leave.
        assert!(
            mean.abs() < 2.5e-3 && rms < 4e-3 && largest < 0.03,
            "{name}: mean {mean:.1e}, spread {rms:.1e}, largest {largest:.1e}"
        );
    }
}

#[test]
fn the_lattice_far_from_walls_stays_and_all_is_as_even_as_in_a_pore_without_such_places() {
    let fine = 0.2 * SPACING;
    for (name, shapes, sides) in [PORES[0], PORES[2]] {
        let flow = pore_of(fine, shapes, sides, "");
        let fluid = &flow.state.particles.position[..flow.state.particles.fluids];
        // A particle is in the middle of a cell of the lattice.
        let is_on_lattice = |x: &Vec2| x.iter().all(|v| ((v / fine - 0.5).round() - (v / fine - 0.5)).abs() < 1e-9);
        let far: Vec<&Vec2> = fluid.iter().filter(|x| (flow.config.wall)(**x).0 > 60.0 * fine).collect();
        assert!(far.len() > 1000 && far.into_iter().all(is_on_lattice), "{name}");
        let moved = fluid.iter().filter(|x| !is_on_lattice(x)).count();
        assert!(moved > 5000 && 4 * moved < 3 * fluid.len(), "{name}: {moved} of {} were packed", fluid.len());
        let [mean, rms, largest] = spread(&density_errors(&flow));
        assert!(
            mean.abs() < 1e-4 && rms < 1e-3 && largest < 0.03,
            "{name}: mean {mean:.1e}, spread {rms:.1e}, largest {largest:.1e}"
        );
    }
}

#[test]
fn wall_particles_stand_in_layers_half_a_spacing_below_the_wall_and_deeper() {
    for (name, shapes, sides) in PORES {
        let flow = pore(shapes, sides, "");
        let walls = flow.state.particles.fluids..flow.state.particles.len();
        for (a, depth) in walls.zip(&flow.state.wall_depth) {
            let x = flow.state.particles.position[a];
            let found = -(flow.config.wall)(x).0;
            assert!((found - depth).abs() < 1e-2 * SPACING, "{name}: {found:e} in place of {depth:e} at {x:?}");
            let layer = depth / SPACING - 0.5;
            // Beyond a corner of the box the lattice has its diagonal depths.
            let is_beyond = x.iter().all(|v| v.abs() > 5.0e-4);
            assert!((layer - layer.round()).abs() < 1e-6 || is_beyond, "{name}: layer {layer} at {x:?}");
        }
    }
}

#[test]
fn no_particle_starts_in_a_wall_or_on_another_one() {
    for (name, shapes, sides) in PORES {
        let flow = pore(shapes, sides, "");
        let nearest = (0..flow.state.particles.fluids)
            .map(|a| (flow.config.wall)(flow.state.particles.position[a]).0)
            .fold(1.0, f64::min);
        assert!(nearest > 0.24 * SPACING, "{name}: {nearest:e} m from the wall");
        let apart = |a: usize, b: usize| {
            flow.config.domain.separation(flow.state.particles.position[a], flow.state.particles.position[b]).norm()
        };
        let n = flow.state.particles.len();
        let closest = (0..n).flat_map(|a| {
            flow.neighborhood.pairs.of(a).map(move |ab| (a, ab.b)).filter(|p| p.1 < n).map(|p| apart(p.0, p.1))
        });
        let closest = closest.fold(1.0, f64::min);
        assert!(closest > 0.45 * SPACING, "{name}: {closest:e} m between two particles");
    }
}

#[test]
fn the_fluid_particles_fill_the_area_of_the_pore() {
    let flow = pore(DISC, PERIODIC, "");
    let area = 1.0e-6 - std::f64::consts::PI * 2.5e-4_f64.powi(2);
    let count = flow.state.particles.fluids as f64 * SPACING * SPACING;
    assert!((count - area).abs() <= 0.5 * SPACING * SPACING, "{count:e} of {area:e} m²");
}

#[test]
fn straight_walls_on_the_lattice_stay_on_it() {
    let plate = "{ rectangle = { center = [0.0, 2.0e-5], size = [2.0e-4, 1.2e-4] } }";
    for sides in ["", PERIODIC, "left = \"symmetry\"\nbottom = \"image\""] {
        let (fitted, cut) = (pore(plate, sides, ""), pore(plate, sides, "fitted-walls = false"));
        assert_eq!(fitted.state.particles, cut.state.particles);
        assert_eq!(fitted.state.wall_depth, cut.state.wall_depth);
    }
}

#[test]
fn a_packing_is_the_same_bits_for_any_number_of_threads() {
    let places = |threads| -> Vec<Vec2> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| pore(DISC, PERIODIC, "").state.particles.position)
    };
    assert_eq!(places(1), places(2));
}
