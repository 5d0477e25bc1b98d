//! The page of the verified throats: one HTML file that opens from the disk without a network, beside the pictures of the runs.

use std::fmt::Write;

use super::event_results::EventRow;
use super::plan::RUNS;
use super::results::Row;
use crate::study::table::Table;

/// Look of the page.
const STYLE: &str = "body{font:16px/1.45 system-ui,sans-serif;margin:2em auto;max-width:86em;padding:0 1em;color:#222}\
table{border-collapse:collapse;margin:1em 0;font-variant-numeric:tabular-nums}\
th,td{border:1px solid #ccc;padding:.3em .6em;text-align:left;vertical-align:top}th{background:#f2f2f2}.wide{overflow-x:auto}\
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(17em,1fr));gap:1em}\
figure{margin:0}figure img{width:100%;border:1px solid #ddd}figcaption{font-size:.85em;color:#444}";

/// The page of throats and events, each with their table, as HTML.
pub(crate) fn page(title: &str, (table, rows): (&Table, &[Row]), events: Option<(&Table, &[EventRow])>) -> String {
    let title = escaped(title);
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>Formula of the network and direct simulation \
         of the same throats. The same with all digits: <a href=\"verify.csv\">verify.csv</a>.</p>\n<div class=\"wide\">\n<table>\n"
    );
    html += &lines(table);
    html += "</table>\n</div>\n";
    if let Some((table, _)) = events {
        html += "<p>Touches and overlaps, with all digits in <a href=\"verify_events.csv\">verify_events.csv</a>.</p>\n<div class=\"wide\">\n<table>\n";
        html += &lines(table);
        html += "</table>\n</div>\n";
    }
    for row in rows {
        let chosen = &row.planned.chosen;
        html += &pictures(&format!("Throat {}", chosen.number), &chosen.reason, &row.status.to_string(), &row.runs);
    }
    for row in events.map_or(&[][..], |(_, rows)| rows) {
        let planned = row.planned;
        html += &pictures(&format!("Event {}", planned.number), &planned.reason, &row.status.to_string(), &row.runs);
    }
    html + "</body>\n</html>\n"
}

fn lines(table: &Table) -> String {
    let line = |cells: &[String], tag: &str| {
        let cells: String = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let mut html = line(&table.heads, "th");
    html.extend(table.rows.iter().map(|cells| line(cells, "td")));
    html
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
        let place = format!("{RUNS}/runs/{run}/picture.png");
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<figure><a href=\"{place}\"><img loading=\"lazy\" src=\"{place}\" alt=\"{caption}\"></a><figcaption>{caption}</figcaption></figure>"
        );
    }
    html + "</div>\n"
}

/// The text with the signs of HTML written out.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
