//! Extrapolation of fields from the fluid into the wall particles: Shepard averages over the fluid in reach, then layer by layer inwards.

use crate::images::Field;
use crate::neighborhood::Neighborhood;

/// The field of `values`, on the wall particles behind the first `fluids` particles Σ_b V_b f_b W_ab / Σ_b V_b W_ab over fluid; wall particles
/// without fluid in reach take the average of those with it. A wall particle with neither keeps its value.
pub(crate) fn into_walls(
    Neighborhood { pairs, images }: &Neighborhood,
    fluid_volume: &[f64],
    fluids: usize,
    values: Vec<f64>,
) -> Field<f64> {
    let mut field = images.field(values).to_vec();
    let average = |field: &[f64], a: usize, weight: &dyn Fn(usize) -> f64| {
        let (sum, norm) = pairs.of(a).fold((0.0, 0.0), |(sum, norm), ab| {
            let w = weight(ab.b) * ab.w;
            (sum + w * field[ab.b], norm + w)
        });
        (norm > 0.0).then(|| sum / norm)
    };
    let walls = fluids..pairs.rows();
    let mut known: Vec<bool> = vec![false; pairs.rows()];
    for a in walls.clone() {
        if let Some(value) = average(&field, a, &|b| fluid_volume[b]) {
            field[a] = value;
            known[a] = true;
        }
    }
    let front = known.clone();
    for a in walls.filter(|&a| !front[a]) {
        let is_front = |b: usize| if b < front.len() && front[b] { 1.0 } else { 0.0 };
        if let Some(value) = average(&field, a, &is_front) {
            field[a] = value;
        }
    }
    images.field(field)
}
