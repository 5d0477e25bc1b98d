//! Volume of the corner films of a chip: in elements of the non-wetting phase they count as wetting phase.
//!
//! Each wall of such an element has two films, at floor and lid, with the cross-section r² S each, r = σ/(p_n - p_w). Their thickness is
//! bounded by contact with another film, on the same wall or, on average over the element, on a plate. Films around trapped ganglia, and those of rings that
//! are cut off, keep the pressure at which they were; all others follow the applied one.

use super::displacement::{Beginning, Displacement, FilmPaths, Phase};
use super::film_sums::FilmSums;
use super::graph::{Network, Throat, WallPiece};
use super::gravity::Gravity;
use meniscus_case::FluidPhase;
use meniscus_case::network::FilmModel;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::interface::films::{WallFilms, meeting};

/// The films of a chip for an invading phase.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FilmTerms {
    /// Contribution of floor and lid to the curvature of menisci.
    pub(crate) depth: Depth,
    /// By wall.
    pub(crate) walls: Vec<WallFilms>,
    /// Flow along the films of each wall at unit radius, over the depth, times viscosity over pressure gradient.
    pub(crate) conductances: Vec<f64>,
    /// Gravity, by which the pressure of films changes with their height.
    pub(crate) gravity: Option<Gravity>,
}

impl FilmTerms {
    /// (p_n - p_w)/σ at a point less than the applied one, in 1/m.
    pub(crate) fn head(&self, at: Vec2) -> f64 {
        self.gravity.map_or(0.0, |gravity| gravity.curvature(at))
    }

    /// For each throat the applied curvature in the plane (1/m, positive if it bulges into the defending phase) at which its films meet; infinite without
    /// films.
    fn meeting(&self, network: &Network, invading: FluidPhase) -> Vec<f64> {
        let throat = |throat: &Throat| {
            let walls = throat.shapes.map(|shape| &self.walls[shape as usize]);
            let curvature = meeting(throat.width, self.depth.distance(), walls);
            if curvature > 0.0 {
                invading.towards_wetting(self.depth.plane(curvature - self.head(throat.middle())))
            } else {
                f64::INFINITY
            }
        };
        network.throats.iter().map(throat).collect()
    }

    /// Largest radius in m of films along these walls around a pore space of an area in m²: they meet on a wall or, on average, on a plate.
    pub(crate) fn largest_radius<'a>(&self, walls: impl Iterator<Item = &'a WallPiece>, area: f64) -> f64 {
        let (mut largest, mut on_plates) = (f64::INFINITY, [0.0; 2]);
        for piece in walls {
            let (films, length) = (&self.walls[piece.shape as usize], piece.curve.length());
            largest = largest.min(self.depth.distance() / films.along_wall());
            let along = films.along_plates();
            on_plates = [0, 1].map(|plate| on_plates[plate] + length * along[plate]);
        }
        on_plates.into_iter().fold(largest, |largest, along| largest.min(area / along))
    }

    /// What the films connect.
    pub(crate) fn paths(&self, network: &Network, invading: FluidPhase, model: FilmModel) -> FilmPaths {
        let rings = (model == FilmModel::Rings).then(|| self.walls.iter().map(WallFilms::exist).collect());
        FilmPaths { meeting: self.meeting(network, invading), rings }
    }
}

/// A point of the curve of capillary pressure over saturation, with the films at every pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CurvePoint {
    /// Index of its half cycle.
    pub(crate) half_cycle: usize,
    /// (p_n - p_w)/σ in 1/m.
    pub(crate) curvature: f64,
    /// Saturation of the wetting phase.
    pub(crate) saturation: f64,
    /// Corner films as a fraction of the pore space, part of the saturation.
    pub(crate) film_saturation: f64,
}

/// Films of one element that share a connection: those along the walls of one ring, or, if all films are joined, all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    ring: Option<u32>,
    /// Volume over the depth at a radius of 1 m, in m² per m².
    unit: f64,
    state: Film,
}

/// The films of one element.
#[derive(Debug, Clone, PartialEq, Default)]
struct ElementFilms {
    parts: Vec<Part>,
    /// Largest radius in m.
    largest: f64,
    /// (p_n - p_w)/σ in its center less than the applied one, in 1/m.
    head: f64,
    /// The number of its first part among those of all elements.
    first: usize,
}

impl ElementFilms {
    fn new(displacement: &Displacement, element: usize, terms: &FilmTerms) -> Self {
        let area = displacement.elements()[element].area;
        let mut parts = Vec::new();
        for (k, piece) in displacement.wall_pieces(element).enumerate() {
            let (films, length) = (&terms.walls[piece.shape as usize], piece.curve.length());
            let ring = displacement.rings().and_then(|rings| rings.of_piece[element][k]);
            let index = parts.iter().position(|part: &Part| part.ring == ring).unwrap_or_else(|| {
                parts.push(Part { ring, unit: 0.0, state: Film::Absent });
                parts.len() - 1
            });
            parts[index].unit += length * films.area() / terms.depth.distance();
        }
        Self {
            parts,
            largest: terms.largest_radius(displacement.wall_pieces(element), area),
            head: terms.head(displacement.center(element)),
            first: 0,
        }
    }

    /// Radius in m while (p_n - p_w)/σ is `applied`, in 1/m.
    fn radius(&self, applied: f64) -> f64 {
        let curvature = applied + self.head;
        if curvature > 0.0 { (1.0 / curvature).min(self.largest) } else { self.largest }
    }

    /// Volume over the depth in m² of a part at (p_n - p_w)/σ in 1/m.
    fn area(&self, part: &Part, curvature: f64) -> f64 {
        if part.unit > 0.0 { part.unit * self.radius(curvature).powi(2) } else { 0.0 }
    }

    /// The state of the films of a ring.
    fn state(&self, ring: Option<u32>) -> Film {
        self.parts.iter().find(|part| part.ring == ring).map_or(Film::Absent, |part| part.state)
    }
}

/// Whether there are films, and which pressure they have.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Film {
    /// None: the wetting phase fills the element.
    Absent,
    /// They follow the applied pressure.
    Free,
    /// They keep this (p_n - p_w)/σ in 1/m.
    Kept(f64),
}

impl Film {
    /// The curvature that they keep in 1/m.
    fn kept(self) -> Option<f64> {
        match self {
            Self::Kept(kept) => Some(kept),
            Self::Absent | Self::Free => None,
        }
    }

    /// (p_n - p_w)/σ in 1/m while `applied` is the applied one.
    fn curvature(self, applied: f64) -> Option<f64> {
        match self {
            Self::Absent => None,
            Self::Free => Some(applied),
            Self::Kept(kept) => Some(kept),
        }
    }
}

/// All films at one moment.
#[derive(Debug, Clone)]
pub(crate) struct Films {
    terms: FilmTerms,
    elements: Vec<ElementFilms>,
    /// Their sums; `None` with gravity, with which films of one radius have different pressures.
    sums: Option<FilmSums>,
    /// Fraction of each element that counts in saturations.
    shares: Vec<f64>,
    /// (p_n - p_w)/σ in 1/m.
    pub(crate) curvature: f64,
    /// Element, number of the part, and the curvature that it keeps or NaN, since this was last emptied.
    pub(super) log: Vec<(usize, usize, f64)>,
}

impl Films {
    /// Initial films: at zero capillary pressure in drainage, infinite in imbibition.
    pub(crate) fn new(displacement: &Displacement, invading: FluidPhase, terms: FilmTerms, shares: Vec<f64>) -> Self {
        let curvature = if invading == FluidPhase::Wetting { f64::INFINITY } else { 0.0 };
        let elements = vec![ElementFilms::default(); displacement.elements().len()];
        Self { elements, sums: None, shares, curvature, terms, log: Vec::new() }.with_terms(displacement, None)
    }

    /// The same at the initial pressure of a displacement that continues another one.
    pub(crate) fn begun(mut self, invading: FluidPhase, initial: Option<&Beginning>) -> Self {
        let known = initial.and_then(|initial| {
            let held = initial.held.iter().copied();
            std::iter::once(initial.applied).chain(held).find(|curvature| curvature.is_finite())
        });
        self.curvature = known.map_or(self.curvature, |known| self.curvature_at(invading.towards_wetting(known)));
        self
    }

    /// The same with the other phase invading.
    pub(crate) fn with_terms(mut self, displacement: &Displacement, terms: Option<FilmTerms>) -> Self {
        self.terms = terms.unwrap_or(self.terms);
        let mut largest = Vec::new();
        for (element, before) in self.elements.iter_mut().enumerate() {
            let mut films = ElementFilms::new(displacement, element, &self.terms);
            films.parts.iter_mut().for_each(|part| part.state = before.state(part.ring));
            films.first = largest.len();
            largest.extend(films.parts.iter().map(|_| films.largest));
            *before = films;
        }
        self.sums = self.terms.gravity.is_none().then(|| FilmSums::of(&largest));
        (0..self.elements.len()).for_each(|element| self.sum(element));
        self
    }

    /// Takes the films of an element into the sums.
    fn sum(&mut self, element: usize) {
        let (films, share) = (&self.elements[element], self.shares[element]);
        let Some(sums) = &mut self.sums else { return };
        for (part, number) in films.parts.iter().zip(films.first..) {
            match part.state {
                Film::Absent => sums.set_free(number, 0.0),
                Film::Free => sums.set_free(number, share * part.unit),
                Film::Kept(curvature) => sums.set_kept(number, share * films.area(part, curvature)),
            }
        }
    }

    /// Updates the films of elements, in order, to the present phases at the present curvature.
    pub(crate) fn update(
        &mut self,
        displacement: &Displacement,
        invading: FluidPhase,
        elements: impl Iterator<Item = usize>,
    ) {
        for element in elements {
            let films = &mut self.elements[element];
            let is_wetting = (displacement.phase(element) == Phase::Invading) == (invading == FluidPhase::Wetting);
            let is_cut_off = displacement.is_cut_off(element);
            for (number, part) in films.parts.iter_mut().enumerate() {
                let before = part.state.kept();
                part.state = match part.state {
                    _ if is_wetting => Film::Absent,
                    _ if !is_cut_off && part.ring.is_none_or(|ring| displacement.is_fed(ring)) => Film::Free,
                    Film::Kept(curvature) => Film::Kept(curvature),
                    Film::Absent | Film::Free => Film::Kept(self.curvature),
                };
                if part.state.kept() != before {
                    self.log.push((element, number, part.state.kept().unwrap_or(f64::NAN)));
                }
            }
            self.sum(element);
        }
    }

    /// (p_n - p_w)/σ in 1/m at a meniscus of this curvature in the plane towards the wetting phase.
    pub(crate) fn curvature_at(&self, in_plane: f64) -> f64 {
        self.terms.depth.curvature(in_plane)
    }

    /// Volume over the depth in m² of all films that count if (p_n - p_w)/σ were `curvature` in 1/m.
    pub(crate) fn area_at(&self, curvature: f64) -> f64 {
        self.sums.as_ref().map_or_else(|| self.area_of_each(curvature), |sums| sums.at(curvature))
    }

    /// The same, from each film.
    pub(super) fn area_of_each(&self, curvature: f64) -> f64 {
        (0..self.elements.len()).map(|element| self.shares[element] * self.area_of(element, curvature)).sum()
    }

    /// Whether others have the same states.
    #[cfg(test)]
    pub(super) fn is_as(&self, other: &Self) -> bool {
        self.elements == other.elements
    }

    fn area_of(&self, element: usize, curvature: f64) -> f64 {
        let films = &self.elements[element];
        let area = |part: &Part| part.state.curvature(curvature).map_or(0.0, |curvature| films.area(part, curvature));
        films.parts.iter().map(area).sum()
    }

    /// The same at the present curvature of films that cannot leave an element of the invading non-wetting phase.
    pub(crate) fn kept_area(&self, displacement: &Displacement) -> f64 {
        let kept = |element: usize| {
            let films = &self.elements[element];
            let area = |part: &Part| match (part.ring, part.state) {
                (Some(ring), Film::Kept(curvature)) if !displacement.is_fed(ring) => films.area(part, curvature),
                _ => 0.0,
            };
            self.shares[element] * films.parts.iter().map(area).sum::<f64>()
        };
        (0..self.elements.len()).map(kept).sum()
    }

    /// The same at the present curvature.
    pub(crate) fn area(&self) -> f64 {
        self.area_at(self.curvature)
    }

    /// The same of films around trapped ganglia.
    pub(crate) fn trapped_area(&self, displacement: &Displacement) -> f64 {
        let trapped = (0..self.elements.len()).filter(|&element| displacement.is_trapped(element));
        trapped.map(|element| self.shares[element] * self.area_of(element, self.curvature)).sum()
    }

    /// The films for pictures and tables.
    pub(crate) fn observed(&self, displacement: &Displacement) -> ObservedFilms {
        let count = self.elements.len();
        let volume = |element| self.terms.depth.distance() * self.area_of(element, self.curvature);
        let strips = (0..count).flat_map(|element| self.strips(displacement, element)).collect();
        ObservedFilms { volume: (0..count).map(volume).collect(), strips }
    }

    /// The films of an element from above: for each wall the middle line of the wider film, and its width in m.
    fn strips(&self, displacement: &Displacement, element: usize) -> Vec<(Vec<Vec2>, f64)> {
        const LARGEST_TURN: f64 = 0.1;
        let films = &self.elements[element];
        let strip = |(k, piece): (usize, &WallPiece)| {
            let ring = displacement.rings().and_then(|rings| rings.of_piece[element][k]);
            let radius = films.radius(films.state(ring).curvature(self.curvature)?);
            let [floor, lid] = self.terms.walls[piece.shape as usize].along_plates();
            let width = radius * floor.max(lid);
            let turn = match piece.curve {
                Curve::Segment { .. } => 0.0,
                Curve::Arc { sweep, .. } => sweep.abs(),
            };
            let parts = (turn / LARGEST_TURN).ceil().max(1.0);
            let point = |k: usize| {
                let at = k as f64 / parts;
                piece.curve.point(at) + 0.5 * width * piece.curve.normal(at)
            };
            (width > 0.0).then(|| ((0..=parts as usize).map(point).collect(), width))
        };
        displacement.wall_pieces(element).enumerate().filter_map(strip).collect()
    }
}

impl Films {
    /// The largest radius of films in an element in m, and what gravity adds to the curvature there, in 1/m.
    pub(super) fn limits(&self, element: usize) -> [f64; 2] {
        [self.elements[element].largest, self.elements[element].head]
    }

    /// The width over the radius of the wider film along a wall of an element, and the number of its part.
    pub(super) fn along(&self, displacement: &Displacement, element: usize, piece: usize, shape: u32) -> (f64, usize) {
        let ring = displacement.rings().and_then(|rings| rings.of_piece[element][piece]);
        let [floor, lid] = self.terms.walls[shape as usize].along_plates();
        let part = self.elements[element].parts.iter().position(|part| part.ring == ring);
        (floor.max(lid), part.unwrap_or(0))
    }
}

/// Films for pictures and tables.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ObservedFilms {
    /// Volume in m³ in each element.
    pub(crate) volume: Vec<f64>,
    /// Along the walls: the middle line of each film in m, and its width in m.
    pub(crate) strips: Vec<(Vec<Vec2>, f64)>,
}
