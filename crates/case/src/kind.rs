//! The kind of a TOML file: a case has tables of a geometry and a model, a shape file has its keys at the top level, a study has axes.

use std::path::Path;

use meniscus_core::input::{Mistake, Problem};
use meniscus_drawings::import::Format;

/// A case file has at least one of these tables, a shape file none.
const TABLES: [&str; 4] = ["geometry", "sph", "thin-film", "network"];

/// Whether a text is a case file rather than a shape file. Invalid TOML is judged by what look like table headers.
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

/// Top-level keys of a study file, which no case has.
const STUDY: [&str; 3] = ["axis", "case", "trend"];

/// The problem of a text that is read as a case but is a shape file or a study; otherwise all its keys would be mistakes.
pub(super) fn other_than_a_case(text: &str) -> Option<Problem> {
    let table = text.trim_start_matches('\u{feff}').parse::<toml::Table>().ok()?;
    let has = |names: &[&str]| names.iter().any(|name| table.contains_key(*name));
    if has(&TABLES) {
        return None;
    }
    if has(&["shapes"]) {
        let help = "name it in the [geometry] of a case, file = \"...\"; `meniscus geometry` measures a shape file";
        return Some(Problem::new("", "this is a shape file, and a case was expected", help));
    }
    let help = "`meniscus study plan` and `meniscus study run` take it";
    has(&STUDY).then(|| Problem::new("", "this is a study, and a case was expected", help))
}

/// The mistake of a file that is read as a case but is a drawing; of a list of discs only its text tells.
pub(super) fn drawing_in_place_of_a_case(path: &Path) -> Option<Mistake> {
    let is_other = |format| format == Format::Toml || format == Format::List;
    Format::of(path).filter(|format| !is_other(*format))?;
    let help = "`meniscus geometry` measures a drawing, `meniscus network FILE --inlet left --outlet right` drains it, and a case names it in [geometry], file = \"...\"";
    Some(Mistake::of_file(&path.display().to_string(), "this is a drawing, and a case was expected".into(), help))
}

/// The problem of a text that is read as a study but is a case.
pub fn other_than_a_study(text: &str) -> Option<Problem> {
    let table = text.trim_start_matches('\u{feff}').parse::<toml::Table>().ok()?;
    let has = |names: &[&str]| names.iter().any(|name| table.contains_key(*name));
    let help = "name it in a study, case = \"...\", beside what varies; `meniscus run` runs a case";
    (has(&TABLES) && !has(&STUDY)).then(|| Problem::new("", "this is a case, and a study was expected", help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_another_kind_is_told_as_such() {
        let message = |problem: Option<Problem>| problem.map(|problem| problem.message);
        let (shapes, case) = ("min = [0, 0]\nshapes = []\n", "format = 1\n[sph]\nspacing = 1\n");
        let study = "format = 1\ncase = 'a.toml'\n[[axis]]\nkey = 'sph.spacing'\n";
        assert!(message(other_than_a_case(shapes)).unwrap().contains("a shape file"));
        assert!(message(other_than_a_case(study)).unwrap().contains("a study"));
        assert!(message(other_than_a_study(case)).unwrap().contains("a case"));
        assert_eq!((message(other_than_a_case(case)), message(other_than_a_study(study))), (None, None));
        // Ordinary mistakes are reported elsewhere.
        assert_eq!((message(other_than_a_case("titel = 1")), message(other_than_a_study("titel = 1"))), (None, None));
    }

    #[test]
    fn a_case_is_told_from_a_shape_file_by_its_tables_even_with_mistakes_in_it() {
        assert!(is_case("format = 1\n[geometry]\nfile = 'a.toml'\n"));
        assert!(is_case("format = 1\ngeometry.file = 'a.toml'\n"));
        assert!(is_case("format = = 1\n  [sph.sides]\n"));
        assert!(!is_case("format = 1\nmin = [0, 0]\nshapes = [{ disc = { center = [0, 0], radius = 1 } }]\n"));
        assert!(!is_case("min = = [0, 0]\n[[shapes]]\n[geometry-of-another-kind]\n"));
    }
}
