//! Key paths such as `shapes[2].disc.radius`: parsing and formatting.

use std::fmt::Write;

/// One step of a key path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    /// Into a table.
    Key(String),
    /// Into an array.
    Index(usize),
}

/// Most steps of a path; no file format of ours is a quarter as deep.
const MOST_STEPS: usize = 64;

/// The steps of a path; `None` if malformed.
pub(super) fn parse(path: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    if path.is_empty() {
        return Some(steps);
    }
    for part in path.split('.') {
        let mut pieces = part.split('[');
        let key = pieces.next().filter(|key| is_bare_key(key))?;
        steps.push(Step::Key(key.to_owned()));
        for piece in pieces {
            steps.push(Step::Index(piece.strip_suffix(']')?.parse().ok()?));
        }
    }
    (steps.len() <= MOST_STEPS).then_some(steps)
}

/// The path as text.
pub(super) fn write(steps: &[Step]) -> String {
    let mut path = String::new();
    for step in steps {
        // Writing to a string cannot fail.
        let _ = match step {
            Step::Key(key) if path.is_empty() => write!(path, "{key}"),
            Step::Key(key) => write!(path, ".{key}"),
            Step::Index(index) => write!(path, "[{index}]"),
        };
    }
    path
}

/// Whether `inner` is `outer` or lies in it.
pub(super) fn is_within(inner: &str, outer: &str) -> bool {
    inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

fn is_bare_key(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_written_as_it_was_read() {
        for path in ["", "a", "a.b-c", "shapes[2].disc.radius", "a[0][1].b"] {
            assert_eq!(parse(path).map(|steps| write(&steps)).as_deref(), Some(path));
        }
    }

    #[test]
    fn what_is_not_a_path_is_refused() {
        for path in [".", "a.", "a[", "a[x]", "a[1]b", "[1]", "a b", "a[-1]"] {
            assert_eq!(parse(path), None, "{path}");
        }
    }

    #[test]
    fn only_whole_keys_lie_within_a_path() {
        assert!(is_within("a.b", "a") && is_within("a[1]", "a") && is_within("a", "a"));
        assert!(!is_within("ab", "a"));
    }
}
