//! Packs the fluid of a pore before time zero: particles move from crowded to empty places until all have the same room.
//!
//! Beside walls and interfaces that no lattice fits, a lattice has gaps and crowds. Two displacements take turns. One goes down the gradient of the
//! concentration (Lind et al. 2012) and orders neighbors; walls hold still, and straight walls on the lattice have no gradient and
//! leave it as it is. The other is the gradient of a potential whose Laplacian is the density error, as the drift
//! source of the pressure equation: it evens out what is too much in one part of the pore and too little in another, which
//! the first, a diffusion, would take long for.

use crate::geometry::Geometry;
use crate::geometry::shells::UnfittedSurface;
use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::images::Images;
use crate::sph::kernel::WendlandC2;
use crate::sph::pairs::{Pairs, each};
use crate::sph::poisson::{PressureSolve, System, Tolerance, Unknowns, assemble, parts};
use crate::sph::terms::{density, pressure_gradient};

/// Coefficient of the first displacement in units of h²; an explicit diffusion of the concentration is stable up to about a half.
const DIFFUSION: f64 = 0.2;

/// A particle moves by at most this share of the spacing at a time.
const LARGEST_MOVE: f64 = 0.1;

/// No particle comes nearer to a wall, a side or an interface on the lattice than this share of the spacing.
const CLOSEST_TO_WALL: f64 = 0.25;

/// No particle comes nearer to an interface that has layers than this share of the spacing: these stand at half a spacing.
const CLOSEST_TO_LAYERED: f64 = 0.75;

/// Rounds in which neighbors are ordered.
const ROUNDS: usize = 200;

/// Every so many rounds the density is evened.
const EVENED_EVERY: usize = 10;

/// Rounds at the end in which the density is evened and nothing else.
const LAST_ROUNDS: usize = 10;

/// Share of the density error that is taken away at a time.
const SHARE: f64 = 0.5;

/// The potential need not be exact: the next round takes what is left.
const TOLERANCE: Tolerance = Tolerance { residual: 1e-3, iterations: 100 };

/// What does not move while a pore is packed.
pub struct Packing<'a> {
    /// Particles that hold still, in m: walls, layers beside the interface, and what stands beyond open sides.
    pub fixed: &'a [Vec2],
    /// Box and sides.
    pub domain: &'a Domain,
    /// Smoothing kernel.
    pub kernel: &'a WendlandC2,
    /// Spacing dx in m.
    pub spacing: f64,
    /// V_0 in m², the room of a particle.
    pub volume: f64,
    /// The pore.
    pub pore: &'a Geometry,
    /// The interface between two phases that has layers beside it.
    pub interface: Option<&'a UnfittedSurface<'a>>,
    /// Sides of the box that no particle crosses, open sides and mirrors: axis, and place along it in m.
    pub sides: &'a [(usize, f64)],
}

impl Packing<'_> {
    /// Moves the particles `fluid` (m) to their places.
    pub fn pack(&self, fluid: &mut [Vec2]) {
        let mut solve = PressureSolve::default();
        for round in 0..ROUNDS + LAST_ROUNDS {
            let mut points: Vec<Vec2> = fluid.iter().chain(self.fixed).copied().collect();
            let count = points.len();
            let images = Images::append(&mut points, self.domain, self.kernel.support());
            let pairs = Pairs::find(&points, count, self.domain, self.kernel);
            let mut by = vec![Vec2::zeros(); fluid.len()];
            if round < ROUNDS {
                self.order(&pairs, &mut by);
            }
            if round % EVENED_EVERY == EVENED_EVERY - 1 || round >= ROUNDS {
                self.even(&pairs, &images, &points[..count], &mut solve, &mut by);
            }
            self.advance(&pairs, &images, &by, fluid);
        }
    }

    /// −D ∇C_a, ∇C_a = Σ_b V_0 ∇_a W_ab, in m.
    fn order(&self, pairs: &Pairs, by: &mut [Vec2]) {
        let diffusion = DIFFUSION * self.kernel.h * self.kernel.h * self.volume;
        pairs.sum_into(by, |_, ab| -diffusion * ab.grad_w);
    }

    /// Adds −∇φ with −∇²φ = the density error V_0/V − 1 of the fluid.
    fn even(&self, pairs: &Pairs, images: &Images, points: &[Vec2], solve: &mut PressureSolve, by: &mut [Vec2]) {
        let (n, fluids) = (points.len(), by.len());
        let mut volume = vec![self.volume; n];
        density::volume(pairs, &mut volume[..fluids]);
        let crowding = |a: usize| if a < fluids { self.volume / volume[a] - 1.0 } else { 0.0 };
        let mut source: Vec<f64> = (0..n).map(|a| SHARE * volume[a] * crowding(a)).collect();
        images.extend(&mut volume);
        let ones = vec![1.0; volume.len()];
        assemble(&mut solve.matrix, (pairs, images), &volume, &ones, |_, _| true);
        let part = parts(pairs, images, |_, _| true);
        let unknowns =
            Unknowns { position: points, kind: &vec![0; n], part: &part, anchored: &[], spacing: self.spacing };
        let mut potential = vec![0.0; n];
        // What the solve leaves over, the next round takes.
        let system = System { b: &mut source, x: &mut potential, tolerance: TOLERANCE };
        solve.solve(&unknowns, &volume[..n], &mut [system]);
        images.extend(&mut potential);
        let down = pressure_gradient::down(pairs, &volume, &ones, &potential, fluids);
        by.iter_mut().zip(&down).for_each(|(by, down)| *by += down);
    }

    /// Moves the particles and keeps them off the interface, the walls and the sides.
    fn advance(&self, pairs: &Pairs, images: &Images, by: &[Vec2], fluid: &mut [Vec2]) {
        let [largest, closest] = [LARGEST_MOVE, CLOSEST_TO_WALL].map(|share| share * self.spacing);
        let fluids = fluid.len();
        let old = fluid.to_vec();
        each(fluid, |a| {
            let mut x = old[a] + by[a] * (largest / by[a].norm()).min(1.0);
            if pairs.of(a).any(|ab| images.source(ab.b) >= fluids) {
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

    /// The way back of a particle that came from `old` to `x` (m), too near to the interface or across it.
    fn back_from(&self, interface: &UnfittedSurface, old: Vec2, x: Vec2) -> Vec2 {
        let Some(near) = interface.near(x, self.spacing) else { return Vec2::zeros() };
        let side = interface.near(old, self.spacing).unwrap_or(near).distance.signum();
        let closest = if near.is_unfitted { CLOSEST_TO_LAYERED } else { CLOSEST_TO_WALL } * self.spacing;
        side * (closest - side * near.distance).max(0.0) * near.normal
    }
}
