//! Where a closed contour begins: at every crossing from which it reads the same, in either sense. An image and its mirror image, or one turned by a quarter
//! turn, then have the same walls, and a symmetric grain has symmetric walls.

use std::cmp::Ordering;

use super::contour::{Grid, Line};

/// A symbol of the cyclic word of a contour: a crossing by the solid fractions at its solid and its pore pixel, or the turn to the next crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Symbol {
    Crossing { solid: u32, pore: u32 },
    Turn(i8),
}

/// The crossings of a closed line from which its word, in one sense or the other, is the least of all. There is one unless the line is symmetric.
pub(super) fn starts(grid: &Grid<'_>, line: &Line) -> Vec<usize> {
    let count = line.crossings.len();
    // Solid fractions are not negative: their bits have their order.
    let bits = |node: usize| grid.solid.share[node].to_bits();
    let word: Vec<Symbol> = (0..2 * count)
        .map(|k| {
            let at = line.crossings[k / 2];
            if k % 2 == 0 {
                return Symbol::Crossing { solid: bits(at.solid as usize), pore: bits(grid.pore(at)) };
            }
            let next = line.crossings[(k / 2 + 1) % count];
            Symbol::Turn(((next.heading + 5 - at.heading) % 4) as i8 - 1)
        })
        .collect();
    // Backwards from the first crossing.
    let back: Vec<Symbol> = (0..word.len()).map(|k| word[(word.len() - k) % word.len()]).collect();
    let (ahead, behind) = (least_rotations(&word), least_rotations(&back));
    let read =
        |word: &[Symbol], from: usize| -> Vec<Symbol> { word[from..].iter().chain(&word[..from]).copied().collect() };
    let order = read(&word, ahead[0]).cmp(&read(&back, behind[0]));
    let mut found = Vec::new();
    if order != Ordering::Greater {
        found.extend(ahead.iter().map(|k| k / 2));
    }
    if order != Ordering::Less {
        found.extend(behind.iter().map(|k| (count - k / 2) % count));
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// All rotations of a cyclic word that are lexicographically least. The first is found by comparing two candidates, of which one moves on past each
/// difference (Booth 1980 solves the same problem); the others follow at the period of the word.
fn least_rotations(word: &[Symbol]) -> Vec<usize> {
    let n = word.len();
    let at = |k: usize| word[k % n];
    let (mut i, mut j, mut same) = (0, 1, 0);
    while i < n && j < n && same < n {
        match at(i + same).cmp(&at(j + same)) {
            Ordering::Equal => {
                same += 1;
                continue;
            }
            Ordering::Greater => i += same + 1,
            Ordering::Less => j += same + 1,
        }
        if i == j {
            j += 1;
        }
        same = 0;
    }
    let first = i.min(j);
    // With `same == n` the two candidates are the first two of the least rotations.
    let period = if same >= n { i.abs_diff(j) } else { n };
    (first..n).step_by(period.max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(text: &str) -> Vec<Symbol> {
        text.bytes().map(|b| Symbol::Turn(b as i8)).collect()
    }

    #[test]
    fn least_rotations_are_those_of_all_rotations_compared() {
        for text in
            ["a", "aa", "ab", "ba", "abab", "baba", "aabaab", "abcabd", "cbacba", "bbaabba", "abaabaaab", "aaaa"]
        {
            let word = word(text);
            let all: Vec<Vec<Symbol>> = (0..word.len()).map(|k| [&word[k..], &word[..k]].concat()).collect();
            let least = all.iter().min().unwrap();
            let expected: Vec<usize> = (0..word.len()).filter(|&k| &all[k] == least).collect();
            assert_eq!(least_rotations(&word), expected, "{text}");
        }
    }
}
