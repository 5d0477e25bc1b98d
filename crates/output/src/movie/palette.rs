//! One palette for all frames.

use std::collections::HashMap;

use super::frame::{CLEAR, Rgb, Run};

/// Up to 255 colors, and which of them each color of the frames becomes.
pub(super) struct Palette {
    colors: Vec<Rgb>,
    indices: HashMap<Rgb, u8>,
}

impl Palette {
    /// Number of colors beside [`CLEAR`].
    const MOST: usize = 255;

    /// The palette of these runs: one after the other the color that those before represent worst.
    pub(super) fn of<'a>(runs: impl Iterator<Item = &'a Run>) -> Self {
        let mut counts: HashMap<Rgb, u64> = HashMap::new();
        runs.for_each(|(color, count)| *counts.entry(*color).or_default() += u64::from(*count));
        let mut sorted: Vec<(Rgb, u64)> = counts.into_iter().collect();
        // By the color, too, so that the same frames always give the same file.
        sorted.sort_unstable_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
        let colors = chosen(&sorted);
        let indices = sorted.iter().map(|&(color, _)| (color, nearest(&colors, color))).collect();
        Self { colors, indices }
    }

    pub(super) fn index(&self, color: Rgb) -> u8 {
        self.indices.get(&color).copied().unwrap_or(CLEAR)
    }

    /// Red, green and blue of all indices, that of [`CLEAR`] included.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.as_flattened().to_vec();
        bytes.resize(3 * (Self::MOST + 1), 0);
        bytes
    }
}

/// Of colors with their numbers of pixels the most frequent one, and then always that with the largest sum of squared errors.
fn chosen(sorted: &[(Rgb, u64)]) -> Vec<Rgb> {
    let mut chosen = Vec::new();
    let mut errors: Vec<f64> = sorted.iter().map(|&(_, count)| f64::INFINITY * count as f64).collect();
    while chosen.len() < Palette::MOST {
        // The first of equal ones.
        let worst = (0..sorted.len()).rev().max_by(|&a, &b| errors[a].total_cmp(&errors[b]));
        let Some(worst) = worst.filter(|&worst| errors[worst] > 0.0) else { break };
        let (color, _) = sorted[worst];
        chosen.push(color);
        for (error, &(other, count)) in errors.iter_mut().zip(sorted) {
            *error = error.min(count as f64 * f64::from(distance(color, other)));
        }
    }
    chosen
}

fn nearest(colors: &[Rgb], color: Rgb) -> u8 {
    let found = (0..).zip(colors).min_by_key(|(_, other)| distance(color, **other));
    found.map_or(CLEAR, |(index, _)| index)
}

/// Squared distance.
fn distance(a: Rgb, b: Rgb) -> i32 {
    (0..3).map(|i| (i32::from(a[i]) - i32::from(b[i])).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_colors_are_exact_and_the_others_near() {
        // Two fills, and more shades than there is room for.
        let shades = (0..=255_u8).flat_map(|k| [([k, k / 2, 0], 1), ([0, k, 255 - k], 1)]);
        let runs: Vec<Run> = [([230, 159, 0], 9000), ([86, 180, 233], 9000)].into_iter().chain(shades).collect();
        let palette = Palette::of(runs.iter());
        let bytes = palette.bytes();
        let found = |color: Rgb| {
            let at = 3 * usize::from(palette.index(color));
            [bytes[at], bytes[at + 1], bytes[at + 2]]
        };
        assert_eq!([found([230, 159, 0]), found([86, 180, 233])], [[230, 159, 0], [86, 180, 233]]);
        assert!(runs.iter().all(|(color, _)| distance(*color, found(*color)) <= 16));
        assert_eq!(bytes.len(), 768);
    }
}
