//! Thin-film equations in cells between walls, plane or axisymmetric, by conservative differences.
//!
//! h_t = −(1/xᵐ) ∂ₓ( xᵐ M ∂ₓ p ), m = 0 in the plane and 1 about an axis, with the mobility M and the disjoining pressure Π of the [`Model`]. Geometric: p =
//! ∇²h̄ − Bo h̄ and h = (1 − α²∇²)² h̄, solved for h̄; all others: p = ∇²h + Π(h) − Bo h, solved for h.
//!
//! Pressures are defined in cells, fluxes on the faces between them; the flux through the walls at both ends is zero. The mobility on a face vanishes with
//! the lower of its two heights, so that cells stay non-negative: 2a²b²/(a + b) for h³ and ab for h² (Zhornitskaya and Bertozzi 2000). Order 2 in space, 1 in
//! time. About an axis the geometric equation has no partial wetting: its wetting parameter is known for plane droplets only.

use std::f64::consts::{PI, TAU};

use super::backward_euler::Balance;
use super::droplet::Droplet;
use super::grid::Grid;
pub use super::model::Model;
use super::sparse::{Factors, Pattern, TooLarge};
use meniscus_case::film::{FilmSymmetry, FilmWeights};

/// The grid and the equation on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Left end; 0 about an axis.
    pub from: f64,
    /// Number of cells.
    pub count: usize,
    /// Width of a cell.
    pub spacing: f64,
    /// Symmetry of the film in the direction normal to the plane.
    pub symmetry: FilmSymmetry,
    /// Equation.
    pub model: Model,
    /// Bond number ρgL²/γ.
    pub bond: f64,
}

/// Half-width of the stencil of a balance in cells; the geometric equation reaches one cell farther.
const REACH: usize = 2;
const GEOMETRIC_REACH: usize = 3;
/// Half-width of the smoothing stencil in cells.
const SMOOTHING_REACH: usize = 2;
/// Largest negative height of a geometric film over its largest height that is rounding and truncation rather than a spurious root.
const NEGATIVE: f64 = -1.0e-4;
/// Below this fraction of the largest height the velocity is set to zero.
const BARE: f64 = 1.0e-3;

/// The cells and their equation.
#[derive(Debug, Clone)]
pub struct Cells {
    layout: Layout,
    /// Area or volume over height of each cell.
    size: Vec<f64>,
    /// Size of each face over the cell width; 0 for the first and last one, at the walls.
    face: Vec<f64>,
    /// The factors of (1 − α²∇²)² in the geometric equation.
    smoothing: Option<Factors>,
    /// The sparsity pattern of the Jacobians.
    pattern: Pattern,
}

impl Cells {
    /// Droplets in cells, with the heights for which the equation is solved; `weights` selects cell averages or the heights at cell centers.
    pub fn new(layout: Layout, droplets: &[Droplet], weights: FilmWeights) -> Result<(Self, Vec<f64>), TooLarge> {
        let Layout { from, count, spacing, symmetry, model, .. } = layout;
        let edge = |i: usize| from + i as f64 * spacing;
        let (size, face) = match symmetry {
            FilmSymmetry::Plane => (vec![spacing; count], (0..=count).map(|_| 1.0 / spacing).collect::<Vec<_>>()),
            FilmSymmetry::Axis => (
                (0..count).map(|i| PI * (edge(i + 1).powi(2) - edge(i).powi(2))).collect(),
                (0..=count).map(|i| TAU * edge(i) / spacing).collect(),
            ),
        };
        let reach = if matches!(model, Model::Geometric { .. }) { GEOMETRIC_REACH } else { REACH };
        let pattern =
            Pattern::new(count, (0..count).flat_map(|row| columns(row, reach, count).map(move |j| (row, j))))?;
        let mut cells = Self { layout, size, face, smoothing: None, pattern };
        cells.face[0] = 0.0;
        cells.face[count] = 0.0;
        let held = |i: usize| -> f64 {
            let mass = |droplet: &Droplet| match (weights, symmetry) {
                (FilmWeights::Point, _) => droplet.height(edge(i) + 0.5 * spacing),
                (FilmWeights::Cell, FilmSymmetry::Plane) => {
                    (droplet.mass_below(edge(i + 1)) - droplet.mass_below(edge(i))) / cells.size[i]
                }
                (FilmWeights::Cell, FilmSymmetry::Axis) => {
                    (droplet.volume_within(edge(i + 1)) - droplet.volume_within(edge(i))) / cells.size[i]
                }
            };
            droplets.iter().map(mass).sum()
        };
        let mut height: Vec<f64> = (0..count).map(held).collect();
        match model {
            Model::Geometric { .. } => {
                cells.smoothing = Some(cells.smoothing_factors()?);
                cells.smooth(&mut height);
            }
            Model::Slip { film, .. } | Model::Precursor { film, .. } => height.iter_mut().for_each(|h| *h += film),
        }
        Ok((cells, height))
    }

    fn count(&self) -> usize {
        self.layout.count
    }

    /// The row of ∇² at a cell: the coefficients of the previous, the present and the next height.
    fn laplace_row(&self, i: usize) -> [f64; 3] {
        let (before, after) = (self.face[i] / self.size[i], self.face[i + 1] / self.size[i]);
        [before, -before - after, after]
    }

    fn laplacian(&self, v: &[f64]) -> Vec<f64> {
        let n = v.len();
        let flow = |face: usize| if face == 0 || face == n { 0.0 } else { self.face[face] * (v[face] - v[face - 1]) };
        (0..n).map(|i| (flow(i + 1) - flow(i)) / self.size[i]).collect()
    }

    /// The row of (1 − α²∇²)² at a cell, from two cells before to two after; the identity without smoothing.
    fn smoothing_row(&self, i: usize) -> [f64; 5] {
        let Model::Geometric { alpha } = self.layout.model else { return [0.0, 0.0, 1.0, 0.0, 0.0] };
        let square = alpha * alpha;
        let once = |i: usize| {
            let [before, here, after] = self.laplace_row(i);
            [-square * before, 1.0 - square * here, -square * after]
        };
        let mut row = [0.0; 5];
        for (offset, factor) in once(i).into_iter().enumerate() {
            let Some(middle) = (i + offset).checked_sub(1).filter(|&j| j < self.count()) else { continue };
            for (step, value) in once(middle).into_iter().enumerate() {
                row[offset + step] += factor * value;
            }
        }
        row
    }

    fn smoothing_factors(&self) -> Result<Factors, TooLarge> {
        let count = self.count();
        let entries = (0..count).flat_map(|row| columns(row, SMOOTHING_REACH, count).map(move |j| (row, j)));
        let rows = (0..count).map(|row| self.smoothing_row(row));
        let values: Vec<f64> =
            rows.enumerate().flat_map(|(row, values)| within(row, SMOOTHING_REACH, count, values)).collect();
        // The matrix is a product of two diagonally dominant ones, so its factors exist.
        Pattern::new(count, entries)?.factor(&values).ok_or(TooLarge(count))
    }

    fn smooth(&self, v: &mut [f64]) {
        if let Some(factors) = &self.smoothing {
            factors.solve(v);
        }
    }

    /// h from the heights that are solved for.
    fn sharp(&self, v: &[f64]) -> Vec<f64> {
        if self.smoothing.is_none() {
            return v.to_vec();
        }
        let n = v.len();
        let at = |i: usize, offset: usize| (i + offset).checked_sub(2).filter(|&j| j < n).map_or(0.0, |j| v[j]);
        (0..n)
            .map(|i| self.smoothing_row(i).iter().enumerate().map(|(offset, value)| value * at(i, offset)).sum())
            .collect()
    }

    /// p in each cell.
    fn pressure(&self, v: &[f64]) -> Vec<f64> {
        let curvature = self.laplacian(v);
        let of = |(c, &h): (&f64, &f64)| c + self.layout.model.disjoining(h).0 - self.layout.bond * h;
        curvature.iter().zip(v).map(of).collect()
    }

    /// The sum of the magnitudes of the terms of a cell's pressure.
    fn pressure_terms(&self, i: usize, v: &[f64]) -> f64 {
        let at = |j: usize| v.get(j).map_or(0.0, |v| v.abs());
        let [before, here, after] = self.laplace_row(i).map(f64::abs);
        let curvature = before * i.checked_sub(1).map_or(0.0, at) + here * at(i) + after * at(i + 1);
        curvature + self.layout.model.disjoining_terms(v[i]) + (self.layout.bond * v[i]).abs()
    }

    fn face_mobility(&self, face: usize, v: &[f64], sharp: &[f64]) -> (f64, [f64; 2], [f64; 2]) {
        self.layout.model.mobility([v[face - 1], v[face]], [sharp[face - 1], sharp[face]])
    }
}

/// The columns of a row, from `reach` cells before it to `reach` after, limited by the walls.
fn columns(row: usize, reach: usize, count: usize) -> std::ops::Range<usize> {
    row.saturating_sub(reach)..(row + reach + 1).min(count)
}

/// The values of a row from `reach` cells before it to `reach` after, without those beyond a wall.
fn within<const WIDTH: usize>(
    row: usize,
    reach: usize,
    count: usize,
    values: [f64; WIDTH],
) -> impl Iterator<Item = f64> {
    columns(row, reach, count).map(move |column| values[column + reach - row])
}

impl Balance for Cells {
    /// The balance of each cell: H(v − vⁿ) + Δt/V Σ fluxes.
    fn residual(&self, v: &[f64], old: &[f64], dt: f64) -> Vec<f64> {
        let change: Vec<f64> = v.iter().zip(old).map(|(v, old)| v - old).collect();
        let mut residual = self.sharp(&change);
        let (pressure, sharp) = (self.pressure(v), self.sharp(v));
        for face in 1..self.count() {
            let (mobility, ..) = self.face_mobility(face, v, &sharp);
            let flow = dt * self.face[face] * mobility * (pressure[face] - pressure[face - 1]);
            residual[face - 1] += flow / self.size[face - 1];
            residual[face] -= flow / self.size[face];
        }
        residual
    }

    fn norm(&self, v: &[f64]) -> f64 {
        self.size.iter().zip(v).map(|(size, v)| size * v * v).sum::<f64>().sqrt()
    }

    fn size(&self, residual: &[f64]) -> f64 {
        let mut smoothed = residual.to_vec();
        self.smooth(&mut smoothed);
        self.norm(&smoothed)
    }

    /// Terms of the residual by magnitude: heights, and flows by the differences of pressures that cancel at rest.
    fn rounding(&self, v: &[f64], dt: f64) -> f64 {
        let sharp = self.sharp(v);
        let pressure: Vec<f64> = (0..v.len()).map(|i| self.pressure_terms(i, v)).collect();
        let mut terms: Vec<f64> = sharp.iter().map(|h| h.abs()).collect();
        for face in 1..self.count() {
            let (mobility, ..) = self.face_mobility(face, v, &sharp);
            let flow = dt * self.face[face] * mobility.abs() * (pressure[face] + pressure[face - 1]);
            terms[face - 1] += flow / self.size[face - 1];
            terms[face] += flow / self.size[face];
        }
        f64::EPSILON * self.size(&terms)
    }

    fn jacobian(&self, v: &[f64], dt: f64) -> Option<Factors> {
        let n = self.count();
        // From three cells before to three after.
        let mut rows = vec![[0.0; 2 * GEOMETRIC_REACH + 1]; n];
        for (i, row) in rows.iter_mut().enumerate() {
            row[1..6].copy_from_slice(&self.smoothing_row(i));
        }
        let (pressure, sharp) = (self.pressure(v), self.sharp(v));
        for face in 1..n {
            let (mobility, by_height, by_sharp) = self.face_mobility(face, v, &sharp);
            let drive = pressure[face] - pressure[face - 1];
            // Derivatives of the flow through this face with respect to the heights from three cells before it to three after.
            let mut flow = [0.0; 2 * GEOMETRIC_REACH];
            for (side, cell) in [face - 1, face].into_iter().enumerate() {
                let sign = if side == 0 { -1.0 } else { 1.0 };
                flow[2 + side] += by_height[side] * drive;
                flow[2 + side] += sign * mobility * (self.layout.model.disjoining(v[cell]).1 - self.layout.bond);
                for (offset, value) in self.laplace_row(cell).into_iter().enumerate() {
                    flow[1 + side + offset] += sign * mobility * value;
                }
                if by_sharp[side] != 0.0 {
                    for (offset, value) in self.smoothing_row(cell).into_iter().enumerate() {
                        flow[side + offset] += by_sharp[side] * drive * value;
                    }
                }
            }
            let scale = dt * self.face[face];
            for (offset, value) in flow.into_iter().enumerate() {
                rows[face - 1][offset + 1] += scale * value / self.size[face - 1];
                rows[face][offset] -= scale * value / self.size[face];
            }
        }
        let values: Vec<f64> = match self.smoothing {
            Some(_) => rows.into_iter().enumerate().flat_map(|(i, row)| within(i, GEOMETRIC_REACH, n, row)).collect(),
            None => {
                let inner = |row: [f64; 7]| [row[1], row[2], row[3], row[4], row[5]];
                rows.into_iter().enumerate().flat_map(|(i, row)| within(i, REACH, n, inner(row))).collect()
            }
        };
        self.pattern.factor(&values)
    }

    /// Films of slip and precursor models are positive; the geometric one nearly so.
    fn acceptable(&self, v: &[f64]) -> bool {
        let least = match self.layout.model {
            Model::Geometric { .. } => NEGATIVE * v.iter().copied().fold(0.0, f64::max),
            Model::Slip { .. } | Model::Precursor { .. } => 0.0,
        };
        v.iter().all(|&v| v > least)
    }
}

impl Grid for Cells {
    fn nodes(&self) -> Vec<f64> {
        let Layout { from, spacing, .. } = self.layout;
        (0..self.count()).map(|i| from + (i as f64 + 0.5) * spacing).collect()
    }

    fn sizes(&self) -> Vec<f64> {
        self.size.clone()
    }

    /// The slope is the central difference; at the ends the film is level.
    fn slope_and_curvature(&self, v: &[f64]) -> [Vec<f64>; 2] {
        let n = v.len();
        let at = |i: usize| v[i.clamp(1, n) - 1];
        let slope = (1..=n).map(|i| (at(i + 1) - at(i - 1)) / (2.0 * self.layout.spacing)).collect();
        [slope, self.laplacian(v)]
    }

    /// M/h ∂ₓp, the mean of both faces.
    fn velocity(&self, v: &[f64]) -> Vec<f64> {
        let (n, pressure, sharp) = (v.len(), self.pressure(v), self.sharp(v));
        let flux = |face: usize| {
            if face == 0 || face == n {
                return 0.0;
            }
            self.face_mobility(face, v, &sharp).0 * (pressure[face] - pressure[face - 1]) / self.layout.spacing
        };
        let bare = BARE * sharp.iter().copied().fold(0.0, f64::max);
        let speed = |i: usize| 0.5 * (flux(i) + flux(i + 1)) / sharp[i];
        (0..n).map(|i| if sharp[i] > bare { speed(i) } else { 0.0 }).collect()
    }

    /// ½ ∫ (hₓ h̄ₓ + Bo h h̄) + W(h), with W' = −Π and W = 0 far above the film.
    fn energy(&self, v: &[f64]) -> f64 {
        let (sharp, curvature) = (self.sharp(v), self.laplacian(v));
        let density =
            |i: usize| 0.5 * sharp[i] * (self.layout.bond * v[i] - curvature[i]) + self.layout.model.attraction(v[i]);
        (0..v.len()).map(|i| self.size[i] * density(i)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::backward_euler::StepRule;
    use super::super::grid::error_of_jacobian;
    use super::super::grid_film::GridFilm;
    use super::*;

    const MODELS: [Model; 4] = [
        Model::Geometric { alpha: 0.05 },
        Model::Slip { length: 0.02, film: 1.0e-3 },
        Model::Precursor { film: 0.02, slope: 0.0, slip: 0.0 },
        Model::Precursor { film: 0.02, slope: 1.0, slip: 0.01 },
    ];

    fn layout(symmetry: FilmSymmetry, model: Model, count: usize, bond: f64) -> Layout {
        let from = if symmetry == FilmSymmetry::Axis { 0.0 } else { -1.0 };
        Layout { from, count, spacing: (1.0 - from) / count as f64, symmetry, model, bond }
    }

    #[test]
    fn newton_steps_use_the_jacobian_of_the_residual() {
        let droplet = Droplet { area: 0.5, half_width: 0.5, center: 0.0 };
        for symmetry in [FilmSymmetry::Plane, FilmSymmetry::Axis] {
            for model in MODELS {
                let (cells, old) = Cells::new(layout(symmetry, model, 60, 3.0), &[droplet], FilmWeights::Cell).unwrap();
                let error = error_of_jacobian(&cells, &old);
                assert!(error < 1.0e-6, "{symmetry:?} {model:?}: {error}");
            }
        }
    }

    #[test]
    fn steps_keep_the_mass_and_lower_the_energy() {
        let droplet = Droplet { area: 0.5, half_width: 0.5, center: 0.0 };
        for symmetry in [FilmSymmetry::Plane, FilmSymmetry::Axis] {
            for model in MODELS {
                let (cells, height) =
                    Cells::new(layout(symmetry, model, 200, 3.0), &[droplet], FilmWeights::Cell).unwrap();
                let mut film = GridFilm::new(cells, height, StepRule::ADAPTIVE);
                let mass = film.mass();
                let mut energy = film.energy();
                for _ in 0..30 {
                    film.step(1.0).unwrap();
                    let now = film.energy();
                    assert!(now < energy, "{symmetry:?} {model:?}: {energy} {now}");
                    energy = now;
                }
                // Newton's method leaves a residual of 1e-9 per step.
                assert!((film.mass() / mass - 1.0).abs() < 1.0e-8, "{symmetry:?} {model:?}");
            }
        }
    }
}
