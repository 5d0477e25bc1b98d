//! Point location in elements.

use super::displacement::{centroid, contains, edges};
use meniscus_core::math::{Bounds, Vec2};

/// A point within an outline: its centroid if inside, else the middle of the longest segment of a line across it.
pub(super) fn inner_point(outline: &[Vec2]) -> Vec2 {
    let centroid = centroid(outline);
    if contains(outline, centroid) {
        return centroid;
    }
    let Some(bounds) = Bounds::around(outline.iter().copied()) else { return centroid };
    // Off the middle, where a vertex is unlikely.
    const SHARE: f64 = 0.508;
    let y = bounds.min.y + SHARE * bounds.size().y;
    let mut crossings: Vec<f64> = edges(outline)
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
        .collect();
    crossings.sort_by(f64::total_cmp);
    let widest = crossings.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    widest.map_or(centroid, |piece| Vec2::new(0.5 * (piece[0] + piece[1]), y))
}

/// Cells of a regular grid with the elements that overlap them.
struct Cells<'e> {
    outlines: &'e [Vec<Vec2>],
    bounds: Bounds,
    count: usize,
    within: Vec<Vec<u32>>,
}

impl<'e> Cells<'e> {
    fn new(outlines: &'e [Vec<Vec2>]) -> Option<Self> {
        let bounds = Bounds::around(outlines.iter().flatten().copied())?;
        let count = (outlines.len() as f64).sqrt().ceil() as usize;
        let mut cells = Self { outlines, bounds, count, within: vec![Vec::new(); count * count] };
        for (index, outline) in outlines.iter().enumerate() {
            let Some(around) = Bounds::around(outline.iter().copied()) else { continue };
            let ([left, low], [right, high]) = (cells.cell(around.min), cells.cell(around.max));
            for (row, column) in (low..=high).flat_map(|row| (left..=right).map(move |column| (row, column))) {
                cells.within[row * count + column].push(index as u32);
            }
        }
        Some(cells)
    }

    fn cell(&self, x: Vec2) -> [usize; 2] {
        let (size, last) = (self.bounds.size(), self.count - 1);
        [0, 1].map(|axis| {
            let share = (x[axis] - self.bounds.min[axis]) / size[axis];
            ((share * self.count as f64).max(0.0) as usize).min(last)
        })
    }

    fn at(&self, x: Vec2) -> Option<usize> {
        if !self.bounds.contains(x) {
            return None;
        }
        let [column, row] = self.cell(x);
        let candidates = self.within[row * self.count + column].iter().map(|&index| index as usize);
        candidates.into_iter().find(|&index| contains(&self.outlines[index], x))
    }
}

/// For each point in m the outline in which it lies, or `None`. Outlines may extend past the domain, which has these periods.
pub(super) fn located(outlines: &[Vec<Vec2>], points: &[Vec2], periods: [Option<f64>; 2]) -> Vec<Option<usize>> {
    let Some(cells) = Cells::new(outlines) else { return vec![None; points.len()] };
    let shifts = periods.map(|period| period.map_or(vec![0.0], |period| vec![0.0, period, -period]));
    let find = |point: &Vec2| {
        let mut images = shifts[0].iter().flat_map(|&x| shifts[1].iter().map(move |&y| Vec2::new(x, y)));
        images.find_map(|shift| cells.at(point + shift))
    };
    points.iter().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[[f64; 2]]) -> Vec<Vec2> {
        points.iter().map(|&point| Vec2::from(point)).collect()
    }

    #[test]
    fn an_inner_point_lies_within_even_where_the_centroid_does_not() {
        // A horseshoe open to the right.
        let horseshoe =
            outline(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 3.0], [4.0, 3.0], [4.0, 4.0], [0.0, 4.0]]);
        assert!(!contains(&horseshoe, centroid(&horseshoe)) && contains(&horseshoe, inner_point(&horseshoe)));
    }

    #[test]
    fn places_are_found_in_their_elements_across_periods_too() {
        let square = |x: f64| outline(&[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
        let outlines = [square(0.0), square(1.0), square(2.0)];
        let points = [Vec2::new(1.5, 0.5), Vec2::new(-0.5, 0.5), Vec2::new(0.5, 2.0)];
        assert_eq!(located(&outlines, &points, [Some(3.0), None]), [Some(1), Some(2), None]);
        assert_eq!(located(&outlines, &points, [None; 2]), [Some(1), None, None]);
    }
}
