//! Which kind of TOML file one is: a case names a geometry and a model in tables, a shape file has its keys at the top.

/// The tables of which a case file has at least one, and a shape file none.
const TABLES: [&str; 4] = ["geometry", "sph", "thin-film", "network"];

/// Whether a text is a case file rather than a shape file. A text that is no TOML counts as what its table headers look like.
#[must_use]
pub fn is_case(text: &str) -> bool {
    match text.trim_start_matches('\u{feff}').parse::<toml::Table>() {
        Ok(table) => TABLES.iter().any(|name| table.contains_key(*name)),
        Err(_) => text.lines().any(|line| {
            let header = line.trim_start().trim_start_matches('[');
            line.trim_start().starts_with('[')
                && TABLES
                    .iter()
                    .any(|name| header.strip_prefix(name).is_some_and(|rest| rest.starts_with([']', '.', ' '])))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_told_from_a_shape_file_by_its_tables_even_with_mistakes_in_it() {
        assert!(is_case("format = 1\n[geometry]\nfile = 'a.toml'\n"));
        assert!(is_case("format = 1\ngeometry.file = 'a.toml'\n"));
        assert!(is_case("format = = 1\n  [sph.sides]\n"));
        assert!(!is_case("format = 1\nmin = [0, 0]\nshapes = [{ disc = { center = [0, 0], radius = 1 } }]\n"));
        assert!(!is_case("min = = [0, 0]\n[[shapes]]\n[geometry-of-another-kind]\n"));
    }
}
