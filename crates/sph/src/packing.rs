//! Packs the fluid of a pore before time zero: particles move from dense to sparse regions until all have the same volume.
//!
//! Next to walls and interfaces that are not aligned with it, a lattice is too dense or too sparse. Two displacements alternate. One is down the
//! gradient of the concentration (Lind et al. 2012) and orders neighbors; wall particles are fixed, and straight walls on the lattice
//! have no gradient and leave it unchanged. The other is the gradient of a potential whose Laplacian is the density error, as in the
//! density-error correction of the pressure equation: it removes density differences between distant parts of the pore, for which
//! the first, a diffusion, would need many rounds. Far from such walls and interfaces particles remain on the lattice.

mod band;

use self::band::Band;
use crate::cells::Cells;
use crate::domain::Domain;
use crate::images::Images;
use crate::kernel::WendlandC2;
use crate::pairs::Pairs;
use crate::parallel::{each, values};
use crate::poisson::{PressureSolve, System, Tolerance, Unknowns, assemble, parts};
use crate::terms::{density, pressure_gradient};
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::offset_curves::UnfittedSurface;

/// Coefficient of the first displacement in units of h²; an explicit diffusion of the concentration is stable up to about a half.
const DIFFUSION: f64 = 0.2;

/// A particle moves by at most this fraction of the spacing per round.
const LARGEST_MOVE: f64 = 0.1;

/// Minimum distance of particles from a wall, a side or an interface aligned with the lattice, over the spacing.
const CLOSEST_TO_WALL: f64 = 0.25;

/// Minimum distance of particles from an interface with layers, over the spacing: the layers are at half a spacing.
const CLOSEST_TO_LAYERED: f64 = 0.75;

/// Rounds in which neighbors are ordered.
const ROUNDS: usize = 200;

/// The density is equalized every so many rounds.
const EVENED_EVERY: usize = 10;

/// Final rounds in which the density is equalized and nothing else.
const LAST_ROUNDS: usize = 10;

/// Fraction of the density error that is removed at a time.
const SHARE: f64 = 0.5;

/// Particles farther than this from all disturbances of the lattice are fixed, in spacings: they would not move, and the excess or deficit
/// at a wall spreads no farther.
const BAND: f64 = 24.0;

/// The lattice is disturbed where the first displacement is longer than this fraction of the spacing.
const DISTURBED: f64 = 1e-6;

/// The potential need not be exact: the next round removes the remaining error.
const TOLERANCE: Tolerance = Tolerance { residual: 1e-3, iterations: 100 };

/// Input of the packing of a pore.
pub(crate) struct Packing<'a> {
    /// Positions of fixed particles in m: walls, layers beside the interface, and buffers beyond open sides.
    pub(crate) fixed: &'a [Vec2],
    /// Box and sides.
    pub(crate) domain: &'a Domain,
    /// Smoothing kernel.
    pub(crate) kernel: &'a WendlandC2,
    /// Spacing dx in m.
    pub(crate) spacing: f64,
    /// V_0 in m², the volume of a particle.
    pub(crate) volume: f64,
    /// The pore.
    pub(crate) pore: &'a Geometry,
    /// The interface between two phases that has layers beside it.
    pub(crate) interface: Option<&'a UnfittedSurface<'a>>,
    /// Sides of the box that no particle crosses, open sides and mirrors: axis, and coordinate along it in m.
    pub(crate) sides: &'a [(usize, f64)],
}

/// The particles of a round with all their neighbors.
struct Round {
    /// Fluid, fixed particles, and the images of both, in m.
    points: Vec<Vec2>,
    /// Number of points that are not images.
    count: usize,
    images: Images,
    cells: Cells,
}

/// Displacement of a particle in a round.
#[derive(Debug, Clone, Copy)]
struct Move {
    /// Displacement in m, before it is limited by walls, interface and sides.
    by: Vec2,
    /// Whether a fixed particle is within the support.
    sees_fixed: bool,
}

impl Packing<'_> {
    /// Packs the particles at `fluid` (m) by shifting \[Lind2012\]. Reports the completed fraction of the rounds to `done`. Those farther than 24 spacings from
    /// all disturbances of the lattice remain where they are.
    pub(crate) fn pack(&self, fluid: &mut [Vec2], done: &mut dyn FnMut(f64)) {
        let moves = self.order(&self.round(fluid, self.fixed), fluid.len());
        let disturbed =
            fluid.iter().zip(&moves).filter(|(_, m)| m.by.norm() > DISTURBED * self.spacing).map(|(x, _)| *x);
        let band = Band::around(disturbed, BAND * self.spacing, self.domain);
        let near: Vec<usize> = (0..fluid.len()).filter(|&a| band.contains(fluid[a])).collect();
        if near.len() == fluid.len() {
            return self.pack_all(fluid, self.fixed, done);
        }
        let mut packed: Vec<Vec2> = near.iter().map(|&a| fluid[a]).collect();
        let far = fluid.iter().filter(|x| !band.contains(**x)).copied().collect::<Vec<_>>();
        let in_reach = band.grown(self.kernel.support());
        let fixed: Vec<Vec2> = self.fixed.iter().chain(&far).filter(|x| in_reach.contains(**x)).copied().collect();
        self.pack_all(&mut packed, &fixed, done);
        near.iter().zip(packed).for_each(|(&a, x)| fluid[a] = x);
    }

    /// Packs all particles at `fluid`, with those at `fixed` held fixed; all in m.
    fn pack_all(&self, fluid: &mut [Vec2], fixed: &[Vec2], done: &mut dyn FnMut(f64)) {
        let mut solve = PressureSolve::default();
        for round in 0..ROUNDS + LAST_ROUNDS {
            let around = self.round(fluid, fixed);
            let mut moves = self.order(&around, fluid.len());
            if round >= ROUNDS {
                moves.iter_mut().for_each(|m| m.by = Vec2::zeros());
            }
            if round % EVENED_EVERY == EVENED_EVERY - 1 || round >= ROUNDS {
                self.even(&around, &mut solve, &mut moves);
            }
            self.advance(&moves, fluid);
            done((round + 1) as f64 / (ROUNDS + LAST_ROUNDS) as f64);
        }
    }

    fn round(&self, fluid: &[Vec2], fixed: &[Vec2]) -> Round {
        let mut points = [fluid, fixed].concat();
        let count = points.len();
        let images = Images::append(&mut points, self.domain, self.kernel.support());
        let cells = Cells::build(&points, self.domain, self.kernel.support());
        Round { points, count, images, cells }
    }

    /// −D ∇C_a, ∇C_a = Σ_b V_0 ∇_a W_ab, of the first `fluids` particles. No pairs are stored: most rounds use them only once.
    fn order(&self, around: &Round, fluids: usize) -> Vec<Move> {
        let diffusion = DIFFUSION * self.kernel.h * self.kernel.h * self.volume;
        let reach2 = self.kernel.support() * self.kernel.support();
        values(fluids, |a| {
            let mut found = Move { by: Vec2::zeros(), sees_fixed: false };
            let x = around.points[a];
            let mut neighbors = Vec::with_capacity(64);
            around.cells.collect_within(x, reach2, a as u32, &mut neighbors);
            for b in neighbors {
                let r_ab = self.domain.separation(x, around.points[b as usize]);
                found.by += -diffusion * self.kernel.grad_w(r_ab);
                found.sees_fixed |= around.images.source(b as usize) >= fluids;
            }
            found
        })
    }

    /// Adds −∇φ with −∇²φ = the density error V_0/V − 1 of the fluid.
    fn even(&self, around: &Round, solve: &mut PressureSolve, moves: &mut [Move]) {
        let Round { points, count, images, cells } = around;
        let pairs = &mut Pairs::default();
        pairs.update(cells, points, *count, self.domain, self.kernel);
        let (n, fluids) = (*count, moves.len());
        let mut volume = density::volume(pairs, fluids);
        volume.resize(n, self.volume);
        let density_error = |a: usize| if a < fluids { self.volume / volume[a] - 1.0 } else { 0.0 };
        let mut source: Vec<f64> = (0..n).map(|a| SHARE * volume[a] * density_error(a)).collect();
        let volume = images.field(volume);
        let ones = vec![1.0; volume.len()];
        let matrix = assemble(pairs, images, &volume, &ones, |_, _| true);
        let part = parts(pairs, images, |_, _| true);
        let unknowns = Unknowns {
            matrix: &matrix,
            position: &points[..n],
            kind: &vec![0; n],
            part: &part,
            has_dirichlet: &[],
            spacing: self.spacing,
        };
        let mut potential = vec![0.0; n];
        let system = System { before: &[], b: &mut source, x: &mut potential, tolerance: TOLERANCE };
        solve.solve(&unknowns, &volume[..n], &mut [system]);
        let down = pressure_gradient::descent(pairs, &volume, &ones, &images.field(potential), fluids);
        moves.iter_mut().zip(&down).for_each(|(m, down)| m.by += down);
    }

    /// Moves the particles and keeps them off the interface, the walls and the sides.
    fn advance(&self, moves: &[Move], fluid: &mut [Vec2]) {
        let [largest, closest] = [LARGEST_MOVE, CLOSEST_TO_WALL].map(|share| share * self.spacing);
        let old = fluid.to_vec();
        each(fluid, |a| {
            let Move { by, sees_fixed } = moves[a];
            let mut x = old[a] + by * (largest / by.norm()).min(1.0);
            if sees_fixed {
                x += self.interface.map_or(Vec2::zeros(), |interface| self.back_from(interface, old[a], x));
                let wall = self.pore.wall(x);
                x += (closest - wall.distance).max(0.0) * wall.normal;
            }
            for &(axis, at) in self.sides {
                let inwards = (self.domain.bounds.center()[axis] - at).signum();
                x[axis] += inwards * (closest - inwards * (x[axis] - at)).max(0.0);
            }
            self.domain.wrapped(x)
        });
    }

    /// The displacement back of a particle that moved from `old` to `x` (m), too close to the interface or across it.
    fn back_from(&self, interface: &UnfittedSurface, old: Vec2, x: Vec2) -> Vec2 {
        let Some(near) = interface.near(x, self.spacing) else { return Vec2::zeros() };
        let side = interface.near(old, self.spacing).unwrap_or(near).distance.signum();
        let closest = if near.is_unfitted { CLOSEST_TO_LAYERED } else { CLOSEST_TO_WALL } * self.spacing;
        side * (closest - side * near.distance).max(0.0) * near.normal
    }
}
