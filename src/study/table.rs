//! The table of a study: a row per run, as CSV with all digits and as Markdown for readers.

use super::definition::Study;
use super::resolution::Resolution;
use super::results::{RunResult, measures};
use super::values::shown;
use super::verdict::{digits, significant};
use super::wording::Wording;
use meniscus_output::FileError;
use meniscus_output::html::escaped;

/// A table with its numbers as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Table {
    /// Heads.
    pub heads: Vec<String>,
    /// Rows, each as long as the heads.
    pub rows: Vec<Vec<String>>,
}

/// A head, and the text of a cell below it for an item.
type Column<'c, T> = (&'c str, &'c dyn Fn(&T) -> String);

impl Table {
    /// A row for each item.
    pub(crate) fn of<T>(items: &[T], columns: &[Column<T>]) -> Self {
        let heads = columns.iter().map(|column| column.0.to_owned()).collect();
        let rows = items.iter().map(|item| columns.iter().map(|column| column.1(item)).collect()).collect();
        Self { heads, rows }
    }

    /// The table as HTML.
    pub(crate) fn html(&self) -> String {
        let row = |cells: &[String], tag: &str| {
            let cells: String = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let rows: String = self.rows.iter().map(|cells| row(cells, "td")).collect();
        format!("<table>\n{}{rows}</table>\n", row(&self.heads, "th"))
    }
}

/// The measures in the table: the requested ones, or all that the runs have.
pub(crate) fn shown_measures(study: &Study, results: &[RunResult]) -> Vec<String> {
    study.report.measures.clone().unwrap_or_else(|| measures(results).into_keys().collect())
}

/// The table for other programs: all digits; with each measure its uncertainty in the run and that due to the spacing, if known, the rate in its unit per s if
/// it is not at rest, and an empty field if there is no value. It does not depend on how often the study was interrupted.
pub(crate) fn full(study: &Study, results: &[RunResult], resolution: &Resolution) -> Table {
    let names = shown_measures(study, results);
    let has_uncertainty = |name: &str| results.iter().any(|result| result.uncertainty(name).is_some());
    let moves = |name: &str| results.iter().any(|result| result.motion(name).is_some());
    let mut heads = vec!["run".to_owned()];
    heads.extend(study.parameters().map(|column| column.name.clone()));
    heads.push("status".to_owned());
    for name in &names {
        heads.push(name.clone());
        if has_uncertainty(name) {
            heads.push(format!("{name}-uncertainty"));
        }
        if moves(name) {
            heads.push(format!("{name}-not-at-rest"));
        }
        if resolution.has(name) {
            heads.push(format!("{name}-discretization-uncertainty"));
        }
    }
    let digits = |number: f64| if number.fract() == 0.0 { format!("{number}") } else { format!("{number:?}") };
    let text = |number: Option<f64>| number.map_or(String::new(), digits);
    let row = |result: &RunResult| {
        let mut row = vec![result.run.name.clone()];
        row.extend(result.run.parameters.iter().map(|parameter| shown(&parameter.value)));
        row.push(result.state.word().to_owned());
        for name in &names {
            row.push(text(result.number(name)));
            if has_uncertainty(name) {
                row.push(text(result.uncertainty(name)));
            }
            if moves(name) {
                row.push(text(result.motion(name).map(|motion| motion.rate)));
            }
            if resolution.has(name) {
                row.push(text(resolution.uncertainty(result, name)));
            }
        }
        row
    };
    Table { heads, rows: results.iter().map(row).collect() }
}

/// The table for readers: four digits with the uncertainty, that due to the spacing included, words and units in the heads; measures that are not at rest are marked.
pub(crate) fn short(study: &Study, results: &[RunResult], resolution: &Resolution, wording: &Wording) -> Table {
    let names = shown_measures(study, results);
    let head = |name: &String| wording.label(name).to_string();
    let mut heads: Vec<String> = study.parameters().map(|column| head(&column.name)).collect();
    heads.push("status".to_owned());
    heads.extend(names.iter().map(head));
    let uncertainty = |result: &RunResult, name: &str| {
        let both = [result.uncertainty(name), resolution.uncertainty(result, name)];
        both.into_iter().flatten().reduce(f64::hypot)
    };
    let value = |result: &RunResult, name: &str| match (result.number(name), uncertainty(result, name)) {
        (Some(value), Some(uncertainty)) => format!("{} ± {}", digits(value), significant(uncertainty, 2)),
        (Some(value), None) => digits(value),
        (None, _) => "–".to_owned(),
    };
    let cell = |result: &RunResult, name: &str| match result.motion(name) {
        Some(_) => format!("{}, not at rest", value(result, name)),
        None => value(result, name),
    };
    let row = |result: &RunResult| {
        let mut row: Vec<String> = result.run.parameters.iter().map(|parameter| shown(&parameter.value)).collect();
        row.push(result.state.word().to_owned());
        row.extend(names.iter().map(|name| cell(result, name)));
        row
    };
    Table { heads, rows: results.iter().map(row).collect() }
}

impl Table {
    /// The table as CSV.
    pub(crate) fn csv(&self) -> Result<Vec<u8>, FileError> {
        let failed = |what: String| FileError::Format { path: "table.csv".into(), what };
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in std::iter::once(&self.heads).chain(&self.rows) {
            writer.write_record(row).map_err(|error| failed(error.to_string()))?;
        }
        writer.into_inner().map_err(|error| failed(error.to_string()))
    }

    /// The table as Markdown, its columns aligned.
    pub(crate) fn markdown(&self) -> String {
        let escaped = |text: &String| text.replace('|', "\\|");
        let rows: Vec<Vec<String>> =
            std::iter::once(&self.heads).chain(&self.rows).map(|row| row.iter().map(escaped).collect()).collect();
        let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.heads.len()).map(width).collect();
        let line = |row: &Vec<String>| {
            let cells: Vec<String> =
                row.iter().zip(&widths).map(|(cell, &width)| format!(" {cell:<width$} ")).collect();
            format!("|{}|\n", cells.join("|"))
        };
        let rule: Vec<String> = widths.iter().map(|width| "-".repeat(width + 2)).collect();
        let mut lines = rows.iter().map(line);
        let head = lines.next().unwrap_or_default();
        format!("{head}|{}|\n{}", rule.join("|"), lines.collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, number, study};
    use super::super::results::RunState;
    use super::*;

    #[test]
    fn a_table_has_all_digits_for_programs_and_four_for_people() {
        let study = study(
            "[[axis]]\nkey = 'dx'\nvalues = [1e-5, 0.25]\n[report]\nmeasures = ['m', 'steps', 'wall-time-s', 'other']\n",
        );
        let mut results = complete(&study, |_| 1.0 / 3.0);
        results[1].state = RunState::Partial;
        let csv = String::from_utf8(full(&study, &results, &Resolution::of(&study, &results)).csv().unwrap()).unwrap();
        assert_eq!(
            csv,
            "run,dx,status,m,m-uncertainty,steps,wall-time-s,other\n\
             dx=1e-5,1e-5,done,0.3333333333333333,0.1,10,1.5,\n\
             dx=0.25,0.25,partial,,,,,\n"
        );
        assert_eq!(
            short(&study, &results, &Resolution::of(&study, &results), &Wording::of(&study, &results)).markdown(),
            "| dx   | status  | m (degrees)   | steps | wall time (s) | other |\n\
             |------|---------|---------------|-------|---------------|-------|\n\
             | 1e-5 | done    | 0.3333 ± 0.10 | 10    | 1.500         | –     |\n\
             | 0.25 | partial | –             | –     | –             | –     |\n"
        );
    }

    #[test]
    fn what_is_not_at_rest_is_marked_in_both_tables() {
        let study = study("[[axis]]\nkey = 'dx'\nvalues = [1, 2, 3]\n[report]\nmeasures = ['m']\n");
        let mut results = complete(&study, |_| 1.0 / 3.0);
        super::super::mock::set_moving(&mut results[1], -2.5);
        let csv = String::from_utf8(full(&study, &results, &Resolution::of(&study, &results)).csv().unwrap()).unwrap();
        assert!(csv.starts_with("run,dx,status,m,m-uncertainty,m-not-at-rest\n"), "{csv}");
        let last: Vec<&str> = csv.lines().skip(1).map(|row| row.rsplit(',').next().unwrap()).collect();
        assert_eq!(last, ["", "-2.5", ""]);
        let people = short(&study, &results, &Resolution::of(&study, &results), &Wording::of(&study, &results));
        let marked: Vec<bool> = people.rows.iter().map(|row| row[2].ends_with(", not at rest")).collect();
        assert_eq!(marked, [false, true, false]);
        assert_eq!(super::super::results::moving(&results, &shown_measures(&study, &results)), 1);
    }

    #[test]
    fn three_spacings_widen_the_bars() {
        let study =
            study("[[axis]]\nname = 'dx'\nkey = 'sph.spacing'\nvalues = [4, 2, 1]\n[report]\nmeasures = ['m']\n");
        let results = complete(&study, |run| 1.0 + number(run, "dx"));
        let csv = String::from_utf8(full(&study, &results, &Resolution::of(&study, &results)).csv().unwrap()).unwrap();
        let known: Vec<f64> = csv.lines().skip(1).map(|row| row.rsplit(',').next().unwrap().parse().unwrap()).collect();
        assert!(csv.starts_with("run,dx,status,m,m-uncertainty,m-discretization-uncertainty\n"), "{csv}");
        assert!(known.iter().zip([2.5, 1.25, 0.625]).all(|(found, known)| (found - known).abs() < 1e-9), "{csv}");
        let people =
            short(&study, &results, &Resolution::of(&study, &results), &Wording::of(&study, &results)).markdown();
        assert!(people.contains("± 2.5") && people.contains("± 0.63"), "{people}");
    }
}
