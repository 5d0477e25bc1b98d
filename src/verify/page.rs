//! The report page of the verified throats: one self-contained HTML file beside the pictures of the runs.

use super::plan::RUNS;
use super::results::Row;
use crate::study::table::Table;
use meniscus_output::html::{self, escaped};

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
        html += &html::figure(&format!("{RUNS}/runs/{run}/picture.png"), caption);
    }
    html + "</div>\n"
}
