//! Checks of a case that need its actual geometry: whether the spacing resolves the narrowest throat, and whether the initial phases lie in the pore.

use super::case_file::{Case, Model};
use super::side::{SIDES, Side};
use super::sph::Sph;
use meniscus_core::input::Problem;
use meniscus_core::math::{Vec2, rounded_down};

/// Fewest particles across a throat: below, the kernels of both walls cover all of it.
pub(crate) const FEWEST_IN_THROAT: f64 = 5.0;

/// Largest number of points along a side of the domain at which an initial shape is sampled.
const MOST_SAMPLES: f64 = 2000.0;

/// Properties of the geometry required by the checks.
pub struct Facts<'a> {
    /// Width of the narrowest throat in m and its center; `None` if there is none.
    pub throat: Option<(f64, Vec2)>,
    /// Distance to the nearest wall in m, above 0 in the pore.
    pub wall_distance: &'a dyn Fn(Vec2) -> f64,
    /// Whether a point lies in the initial shape of the given index (`sph.initial.wetting[index]`, or that of `non-wetting`).
    pub in_initial_shape: &'a dyn Fn(usize, Vec2) -> bool,
}

impl std::fmt::Debug for Facts<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Facts").field("throat", &self.throat).finish_non_exhaustive()
    }
}

/// What is wrong with a case for its actual geometry.
pub fn check_against(case: &Case, facts: &Facts) -> Vec<Problem> {
    let Model::Sph(sph) = &case.model else { return Vec::new() };
    let mut problems: Vec<Problem> = throat(case, sph, facts).into_iter().collect();
    problems.extend(regions(case, sph, facts));
    problems
}

fn throat(case: &Case, sph: &Sph, facts: &Facts) -> Option<Problem> {
    let (width, center) = facts.throat?;
    let count = width / sph.spacing;
    (count < FEWEST_IN_THROAT).then(|| {
        let side = wall_side(case, width, center);
        let between =
            side.map_or(String::new(), |side| format!(", between a solid and the wall of the side `{side}`,"));
        let message = format!(
            "the narrowest throat is {width:.3e} m wide{between} at ({:.3e}, {:.3e}) m and has {count:.1} particles, \
             at least {FEWEST_IN_THROAT} are needed",
            center.x, center.y
        );
        let largest = rounded_down(width / FEWEST_IN_THROAT);
        let move_it = if side.is_some() { "move that side until it cuts the solid or is clear of it; " } else { "" };
        let help = format!("{move_it}a spacing of {largest:.2e} m or less would do");
        Problem::new("sph.spacing", message, help)
    })
}

/// The side of the domain whose wall is one of both walls of a throat of this width in m, if one is.
fn wall_side(case: &Case, width: f64, center: Vec2) -> Option<&'static str> {
    /// Rounding of a center that lies half a width from the side.
    const NEAR: f64 = 0.501;
    let (min, max) = (case.geometry.min, case.geometry.max);
    let distances = [center.x - min[0], max[0] - center.x, center.y - min[1], max[1] - center.y];
    let sides = SIDES.into_iter().zip(case.model.sides()?.each()).zip(distances);
    let mut walls = sides.filter(|((_, kind), _)| *kind == Side::Wall);
    walls.find(|(_, distance)| *distance <= NEAR * width).map(|((name, _), _)| name)
}

fn regions(case: &Case, sph: &Sph, facts: &Facts) -> Vec<Problem> {
    let count = sph.initial.wetting.len();
    let mut in_domain = vec![false; count];
    let mut in_pore = vec![false; count];
    for point in samples(case, sph.spacing) {
        for index in 0..count {
            if !in_pore[index] && (facts.in_initial_shape)(index, point) {
                in_domain[index] = true;
                in_pore[index] = (facts.wall_distance)(point) > 0.0;
            }
        }
        if in_pore.iter().all(|found| *found) {
            break;
        }
    }
    let lost = (0..count).filter(|index| !in_pore[*index]);
    lost.map(|index| {
        let message = if in_domain[index] {
            "the initial shape lies entirely inside the solid".to_owned()
        } else {
            format!("the initial shape contains no particle of the domain at a spacing of {:e} m", sph.spacing)
        };
        Problem::new(format!("{}[{index}]", sph.initial.key), message, "move it into the pore, or make it larger")
    })
    .collect()
}

/// The centers of the cells of the initial lattice, or of coarser cells if there are very many.
fn samples(case: &Case, spacing: f64) -> impl Iterator<Item = Vec2> {
    let min = Vec2::from(case.geometry.min);
    let size = Vec2::from(case.geometry.max) - min;
    let counts = size.map(|length| (length / spacing).round().clamp(1.0, MOST_SAMPLES));
    let step = size.component_div(&counts);
    let [columns, rows] = [counts.x as usize, counts.y as usize];
    (0..rows).flat_map(move |j| {
        (0..columns).map(move |i| min + step.component_mul(&Vec2::new(i as f64 + 0.5, j as f64 + 0.5)))
    })
}
