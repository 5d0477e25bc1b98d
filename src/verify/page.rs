//! The report page of the verified throats: one self-contained HTML file beside the pictures of the runs.

use std::fmt::Write;

use super::plan::RUNS;
use super::results::Row;
use crate::io::html::{self, escaped};
use crate::study::table::Table;

/// The page of throats with their table, as HTML.
pub(crate) fn page(title: &str, table: &Table, rows: &[Row]) -> String {
    let mut html = format!(
        "<h1>{}</h1>\n<p>Formula of the network and direct simulation of the same throats. The same with all digits: \
         <a href=\"verify.csv\">verify.csv</a>.</p>\n<div class=\"wide\">\n{}</div>\n",
        escaped(title),
        table.html()
    );
    rows.iter().for_each(|row| html += &pictures(row));
    html::page(title, &html)
}

fn pictures(row: &Row) -> String {
    let chosen = &row.planned.chosen;
    let mut html = format!(
        "<h2>Throat {}</h2>\n<p>Chosen: {}. {}.</p>\n<div class=\"pictures\">\n",
        chosen.number,
        escaped(&chosen.reason),
        escaped(&row.status.to_string())
    );
    for run in &row.runs {
        let run = escaped(run);
        let caption = run.trim_start_matches("cut-out=").trim_end_matches(".toml");
        let picture = format!("{RUNS}/runs/{run}/picture.png");
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<figure><a href=\"{picture}\"><img loading=\"lazy\" src=\"{picture}\" alt=\"{caption}\"></a><figcaption>{caption}</figcaption></figure>"
        );
    }
    html + "</div>\n"
}
