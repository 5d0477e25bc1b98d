//! The known word nearest to a misspelled one, by edit distance.

/// The candidate nearest to `word`, where one is near enough to be meant: at most a third of its letters differ, or it
/// is the end of the word.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .filter(|(distance, candidate)| {
            *distance <= candidate.chars().count().div_ceil(3) || is_end_of(candidate, word)
        })
        .min()
        .map(|(_, candidate)| candidate)
}

/// Whether `word` is `candidate` with words before it: `surface-tension` for `tension`.
fn is_end_of(candidate: &str, word: &str) -> bool {
    word.strip_suffix(candidate).is_some_and(|before| before.ends_with('-'))
}

/// Levenshtein distance: the least number of letters put in, taken out or replaced.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter_a) in a.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (slot, letter_b) in row.iter_mut().skip(1).zip(&b) {
            let replaced = diagonal + usize::from(letter_a != *letter_b);
            diagonal = *slot;
            left = replaced.min(*slot + 1).min(left + 1);
            *slot = left;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distances_are_those_worked_out_by_hand() {
        for (a, b, distance) in [("", "", 0), ("abc", "", 3), ("", "abc", 3), ("kitten", "sitting", 3), ("ab", "ba", 2)]
        {
            assert_eq!(edit_distance(a, b), distance, "{a} {b}");
        }
    }

    #[test]
    fn a_misspelled_word_finds_its_neighbor_and_a_foreign_one_finds_none() {
        assert_eq!(nearest("spacng", ["spacing", "gravity"]), Some("spacing"));
        assert_eq!(nearest("surface-tension", ["tension", "spacing"]), Some("tension"));
        assert_eq!(nearest("colour", ["spacing", "gravity"]), None);
    }
}
