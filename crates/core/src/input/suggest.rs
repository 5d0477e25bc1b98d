//! The known word nearest to a misspelled one, by edit distance.

/// The candidate nearest to `word`, if near enough: at most a third of its letters differ, or it is the end of the word.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::levenshtein(word, candidate), candidate))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelled_word_finds_its_neighbor_and_a_foreign_one_finds_none() {
        assert_eq!(nearest("spacng", ["spacing", "gravity"]), Some("spacing"));
        assert_eq!(nearest("surface-tension", ["tension", "spacing"]), Some("tension"));
        assert_eq!(nearest("colour", ["spacing", "gravity"]), None);
    }
}
