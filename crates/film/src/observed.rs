//! A film with everything needed to observe it, as input to tables, pictures, measures and warnings.

use super::equilibrium::Equilibrium;
use super::film::Film;
use super::history::{Frame, History};
use super::profile::{ContactLine, Profile};
use super::scales::Scales;

/// Points per filter length in the output profile of particles; the contact line is then accurate to 1e-7 of it.
const POINTS_PER_FILTER: f64 = 20.0;
/// Maximum number of points of that profile.
const MOST_POINTS: f64 = 2.0e4;

/// Intervals between the positions of a frame.
const FRAME_POINTS: u32 = 240;
/// Number of particles whose trajectories are kept.
const FOLLOWED: usize = 12;

/// Constant properties of the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surroundings {
    pub(crate) scales: Scales,
    /// Left and right end of the wall in m.
    pub(crate) wall: [f64; 2],
    /// Scaled length over which the film varies at its contact line: the filter length, or the grid spacing.
    pub(crate) resolution: f64,
    /// Scaled center of the droplet on the right.
    pub(crate) right: f64,
    /// Whether the film is axisymmetric about x = 0.
    pub(crate) about_axis: bool,
    /// Scaled equilibrium slope, in partial wetting.
    pub(crate) rest: Option<f64>,
    /// For a partially wetting droplet with a parabolic equilibrium: number of principal curvatures, 1 in the plane and 2 about an axis.
    pub(crate) cap_sides: Option<f64>,
    /// Whether the case corrects for the energy of the particle lattice.
    pub(crate) takes_lattice_off: bool,
    /// Initial number of droplets of a film in which they can only coalesce: a geometric one that is not pendent.
    pub(crate) most_droplets: Option<usize>,
    /// Whether the droplet becomes self-similar by surface tension.
    pub(crate) is_self_similar: bool,
    /// The equilibrium droplet, if its form is known.
    pub(crate) equilibrium: Option<Equilibrium>,
}

/// A film, scaled, and its history.
#[derive(Debug, Clone)]
pub(crate) struct ObservedFilm {
    pub(crate) film: Film,
    /// Its constant properties.
    pub(crate) surroundings: Surroundings,
    /// The path of the contact line.
    pub(crate) history: History,
    /// Time in s.
    pub(crate) time: f64,
}

impl ObservedFilm {
    /// The scaled profile over the wall.
    pub(crate) fn profile(&self) -> Profile {
        let [left, right] = self.surroundings.wall.map(|x| x / self.surroundings.scales.length);
        let wanted = POINTS_PER_FILTER * (right - left) / self.surroundings.resolution;
        let count = wanted.ceil().clamp(2.0, MOST_POINTS);
        let positions: Vec<f64> = (0..=count as usize).map(|i| left + (right - left) * i as f64 / count).collect();
        self.film.profile(&positions)
    }

    /// The scaled contact line on the right; `None` if its tangent meets the wall outside the domain, as for a film that covers all of it.
    pub(crate) fn contact_line(&self) -> Option<ContactLine> {
        let end = self.surroundings.wall[1] / self.surroundings.scales.length;
        self.profile().contact_line(self.surroundings.right).filter(|line| line.position <= end)
    }

    /// The scaled positions of the heights in frames, equidistant along the wall.
    pub(crate) fn frame_positions(&self) -> Vec<f64> {
        let [left, right] = self.surroundings.wall.map(|x| x / self.surroundings.scales.length);
        (0..=FRAME_POINTS).map(|i| left + (right - left) * f64::from(i) / f64::from(FRAME_POINTS)).collect()
    }

    pub(crate) fn frame(&self) -> Frame {
        let time = self.film.time();
        let heights = self.film.heights(&self.frame_positions());
        Frame { time, heights, particles: self.film.particle_positions(FOLLOWED) }
    }

    /// Column of the film's size, and its unit of scaled mass: an area in the plane, a volume if axisymmetric.
    pub(crate) fn mass_unit(&self) -> (&'static str, f64) {
        let s = &self.surroundings.scales;
        if self.surroundings.about_axis { ("volume_m3", s.area() * s.length) } else { ("area_m2", s.area()) }
    }

    pub(crate) fn fastest(&self) -> (f64, f64) {
        let fields = self.film.fields();
        let pairs = fields.velocity.iter().zip(&fields.x);
        pairs.map(|(v, x)| (v.abs(), *x)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a })
    }
}
