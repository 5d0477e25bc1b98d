//! The report page of the verified throats: one self-contained HTML file beside the pictures of the runs.

use std::fmt::Write;

use super::event_results::EventRow;
use super::plan::RUNS;
use super::results::Row;
use crate::io::html::{self, escaped};
use crate::study::table::Table;

/// The page of throats and events with their tables, as HTML.
pub(crate) fn page(title: &str, (table, rows): (&Table, &[Row]), events: Option<(&Table, &[EventRow])>) -> String {
    let mut html = format!(
        "<h1>{}</h1>\n<p>Formula of the network and direct simulation of the same throats. The same with all digits: \
         <a href=\"verify.csv\">verify.csv</a>.</p>\n<div class=\"wide\">\n{}</div>\n",
        escaped(title),
        table.html()
    );
    if let Some((table, _)) = events {
        html += "<p>Touches and overlaps, with all digits in <a href=\"verify_events.csv\">verify_events.csv</a>.</p>\n<div class=\"wide\">\n";
        html += &table.html();
        html += "</div>\n";
    }
    for row in rows {
        let chosen = &row.planned.chosen;
        html += &pictures(&format!("Throat {}", chosen.number), &chosen.reason, &row.status.to_string(), &row.runs);
    }
    for row in events.map_or(&[][..], |(_, rows)| rows) {
        let planned = row.planned;
        html += &pictures(&format!("Event {}", planned.number), &planned.reason, &row.status.to_string(), &row.runs);
    }
    html::page(title, &html)
}

fn pictures(head: &str, reason: &str, status: &str, runs: &[String]) -> String {
    let mut html = format!(
        "<h2>{head}</h2>\n<p>Chosen: {}. {}.</p>\n<div class=\"pictures\">\n",
        escaped(reason),
        escaped(status)
    );
    for run in runs {
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
