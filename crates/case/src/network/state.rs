//! The state of a displacement as a file: phases of all elements, exact menisci, and the geometry they belong to. Written by a network; the initial state of a
//! network or a direct simulation of the same geometry.

use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::fluid::FluidPhase;
use crate::side::{SIDES, Side, Sides};
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::spec::GeometrySpec;

/// The format of state files that this program reads and writes.
pub const FORMAT: u32 = 1;

/// A distance below this fraction of the longer side of the domain is rounding in a file.
const SAME_PLACE: f64 = 1e-7;

/// The state of a displacement. SI units; curvatures in 1/m, above 0 if the interface bulges into the wetting phase, so that tension times curvature is p_n -
/// p_w.
///
/// To be written without all of it in memory, the elements and the outline may be of other types that serialize to the same lists.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkState<Elements = Vec<ElementState>, Outline = Vec<Vec<f64>>> {
    /// Version of the format: [`FORMAT`].
    pub format: u32,
    /// The program that wrote it.
    pub version: String,
    /// Explanation of the numbers.
    pub note: String,
    /// [`Geometry::hash`] in hexadecimal digits.
    pub geometry_hash: String,
    /// Lower left and upper right corner of the domain.
    pub domain_m: [[f64; 2]; 2],
    /// The left, right, bottom and top side.
    pub sides: [Side; 4],
    /// The invading phase.
    pub invading: FluidPhase,
    /// Number of the half cycle, from 1.
    pub half_cycle: usize,
    /// Number of its events so far.
    pub events: usize,
    /// Interfacial tension.
    pub tension_n_per_m: f64,
    /// The applied curvature, at which all menisci are at rest except for those of trapped ganglia. During an avalanche it is that of the next event.
    pub applied_curvature_per_m: f64,
    /// Tension times the applied curvature; in a chip with a depth, floor and lid contribute in addition.
    pub capillary_pressure_pa: f64,
    /// The largest curvature applied so far; `None` before the first event.
    pub largest_applied_curvature_per_m: Option<f64>,
    /// Smallest and largest contact angle on the walls through the wetting phase, in degrees.
    pub contact_angles_deg: [f64; 2],
    /// Wetting saturation by elements.
    pub saturation: f64,
    /// The same including the areas swept by menisci beyond their gates; `None` if not known.
    pub saturation_with_menisci: Option<f64>,
    /// The parts of the pore space that events fill.
    pub elements: Elements,
    /// All menisci.
    pub menisci: Vec<MeniscusState>,
    /// Throats of the network before the merge that were closed by snap-off of films; they have no volume. Absent if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub snapped_throats: Vec<usize>,
    /// The boundary of the invading phase along walls and menisci, the phase on its left: numbers of segments and arcs.
    pub invading_outline: Outline,
}

/// A part of the pore space that is filled at once.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElementState {
    /// Its phase.
    pub phase: FluidPhase,
    /// Whether it is filled with trapped defending phase.
    pub trapped: bool,
    /// Curvature of the menisci around the trapped phase.
    pub trapped_curvature_per_m: Option<f64>,
    /// Area.
    pub area_m2: f64,
    /// Its oriented boundary, pore on the right: numbers of segments and arcs.
    pub boundary: Vec<Vec<f64>>,
}

/// An interface between two walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeniscusState {
    /// The element of the invading phase, and that of the defending phase.
    pub between: [usize; 2],
    /// Curvature; `None` if no meniscus is known, and the chord of the gate replaces it.
    pub curvature_per_m: Option<f64>,
    /// Contact points on the walls on the left and on the right in the direction of the advance.
    pub contacts_m: [[f64; 2]; 2],
    /// Signed angle between the chord of both contact points and the interface in rad, above 0 if it bulges into the defending phase.
    pub bend_rad: f64,
    /// Area between the chord of the gate and the interface, above 0 if the interface is ahead; `None` if not known.
    pub swept_area_m2: Option<f64>,
}

/// The initial state of a run.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Start {
    /// Its file.
    pub file: PathBuf,
    /// A hash of its content.
    pub digest: String,
    /// Its content.
    #[serde(skip)]
    pub state: Arc<NetworkState>,
}

impl NetworkState {
    /// Whether the domain is periodic along x and y.
    pub fn periodic(&self) -> [bool; 2] {
        [0, 2].map(|side| self.sides[side] == Side::Periodic)
    }

    /// The translations from a point in the domain to its nearest images in m, first the zero one.
    pub fn images(&self) -> Vec<Vec2> {
        let size = Vec2::from(self.domain_m[1]) - Vec2::from(self.domain_m[0]);
        let shifts = self.periodic().map(|is_joined| if is_joined { &[0.0, -1.0, 1.0][..] } else { &[0.0][..] });
        let rows = shifts[1];
        let image = |&dx: &f64| rows.iter().map(move |&dy| size.component_mul(&Vec2::new(dx, dy)));
        shifts[0].iter().flat_map(image).collect()
    }

    /// Parses a state.
    ///
    /// # Errors
    /// What is wrong, with line and column if known.
    pub fn read(text: &str) -> Result<Self, String> {
        let state: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if state.format != FORMAT {
            return Err(format!("expected format {FORMAT}, found {}", state.format));
        }
        let all = state.elements.iter().flat_map(|element| &element.boundary).chain(&state.invading_outline);
        if let Some(numbers) = all.into_iter().find(|numbers| Curve::from_numbers(numbers).is_none()) {
            return Err(format!("expected the four numbers of a segment or the five of an arc, found {numbers:?}"));
        }
        let count = state.elements.len();
        if let Some(element) = state.menisci.iter().flat_map(|it| it.between).find(|&element| element >= count) {
            return Err(format!("a meniscus borders on element {element}, and there are {count} elements"));
        }
        Ok(state)
    }

    /// The curves of an outline.
    pub fn curves(numbers: &[Vec<f64>]) -> Vec<Curve> {
        numbers.iter().filter_map(|numbers| Curve::from_numbers(numbers)).collect()
    }

    /// Why it is not a state of this geometry; `None` if it is.
    pub fn misfit(&self, spec: &GeometrySpec) -> Option<String> {
        if [spec.min, spec.max] != self.domain_m {
            let ([a, b], [c, d]) = (self.domain_m, [spec.min, spec.max]);
            return Some(format!("its domain reaches from {a:?} to {b:?} m, that of this case from {c:?} to {d:?} m"));
        }
        let geometry = Geometry::unchecked(spec);
        let hash = format!("{:016x}", geometry.hash());
        if hash == self.geometry_hash {
            return None;
        }
        // A drawing that was cut differently at the sides has another hash, but the same pores.
        let geometry = geometry.with_sides(self.periodic(), self.sides.map(|side| side == Side::Wall));
        let size = geometry.bounds().size().max();
        let curves = self.elements.iter().flat_map(|element| Self::curves(&element.boundary));
        let ends = curves.flat_map(|curve| [curve.point(0.0), curve.point(1.0)]);
        let farthest = ends
            .map(|x| (geometry.signed_distance(x).abs(), x))
            .fold((0.0, Vec2::zeros()), |far, next| if next.0 > far.0 { next } else { far });
        if farthest.0 > SAME_PLACE * size {
            return Some(format!(
                "its geometry has the hash {}, that of this case {hash}: a wall at ({:.4e}, {:.4e}) m is {:.1e} m off",
                self.geometry_hash, farthest.1.x, farthest.1.y, farthest.0
            ));
        }
        let (area, own) = (self.elements.iter().map(|element| element.area_m2).sum::<f64>(), geometry.porosity());
        let own = own.value * geometry.bounds().area();
        ((area - own).abs() > SAME_PLACE.sqrt() * own).then(|| {
            format!(
                "its pores have an area of {area:.6e} m2, those of this case {own:.6e} m2 (hash {hash}, {} there)",
                self.geometry_hash
            )
        })
    }

    /// The first of these sides that is incompatible with those of the state, and why.
    pub fn misfit_of_sides(&self, sides: &Sides) -> Option<(&'static str, String)> {
        let given = sides.each();
        let fits = |state: Side, side: Side| match state {
            Side::Periodic => side == Side::Periodic,
            Side::Wall => side == Side::Wall,
            // Open sides may be closed.
            _ => side != Side::Periodic,
        };
        let (name, state, side) = SIDES
            .into_iter()
            .zip(self.sides.into_iter().zip(given))
            .map(|(name, (state, side))| (name, state, side))
            .find(|&(_, state, side)| !fits(state, side))?;
        let kind = |side: Side| match side {
            Side::Periodic => "periodic",
            Side::Wall => "a wall",
            Side::Image => "an image wall",
            Side::Symmetry => "a symmetry line",
            Side::Inlet => "the inlet",
            Side::Outlet => "the outlet",
        };
        Some((name, format!("its side `{name}` is {}, that of this case {}", kind(state), kind(side))))
    }
}
