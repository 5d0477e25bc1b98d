//! The page of a study: one HTML file that opens from the disk without a network. Curves and maps are inline; pictures are in the folders of the runs.

use std::fmt::Write;

use super::convergence::Convergence;
use super::definition::Study;
use super::page_of_samples::Uncertainty;
use super::results::{RunResult, RunState, moving};
use super::table::{Table, shown_measures};
use super::values::shown;
use super::verdict::{Judgment, Verdict, digits};
use super::wording::Wording;
use crate::run::compare::PAGE;
use meniscus_output::html::{self, escaped};
use meniscus_output::network_page;

/// Content of the page.
#[derive(Debug)]
pub(crate) struct Content<'a> {
    /// The study.
    pub(crate) study: &'a Study,
    /// Its runs.
    pub(crate) results: &'a [RunResult],
    /// The table for readers.
    pub(crate) table: &'a Table,
    /// The curves as SVG.
    pub(crate) curves: &'a [String],
    /// The maps as SVG.
    pub(crate) maps: &'a [String],
    /// The words of its parameters and measures.
    pub(crate) wording: &'a Wording,
    /// The expectations.
    pub(crate) judgments: &'a [Judgment],
    /// Errors along spacings.
    pub(crate) convergences: &'a [Convergence],
    /// The capillary pressure curves of all runs in one diagram as SVG, if runs have them.
    pub(crate) pressures: Option<&'a str>,
    /// File names of diagrams, a list per run.
    pub(crate) diagrams: &'a [Vec<String>],
    /// For each run, whether its folder has a page on which its displacement is played.
    pub(crate) pages: &'a [bool],
    /// For each run, whether it has a picture.
    pub(crate) pictures: &'a [bool],
    /// Capillary pressure over saturation of both models as SVG, one per complete run that was compared with a network.
    pub(crate) comparisons: &'a [(&'a RunResult, String)],
    /// The statistics of the samples, if there are any.
    pub(crate) uncertainty: Option<&'a Uncertainty<'a>>,
}

/// The page as HTML.
pub(crate) fn page(content: &Content<'_>) -> String {
    let title = escaped(&content.study.title);
    let done = content.results.iter().filter(|result| result.state.report().is_some()).count();
    let moving = match moving(content.results, &shown_measures(content.study, content.results)) {
        0 => String::new(),
        some => format!(" {some} of them with measures not at rest, marked in the table and hollow in curves."),
    };
    let all = if content.uncertainty.is_some() {
        "All samples with all digits: <a href=\"samples.csv\">samples.csv</a>."
    } else {
        "The same table with all digits: <a href=\"table.csv\">table.csv</a>."
    };
    let mut html = format!("<h1>{title}</h1>\n<p>{done} of {} runs done.{moving} {all}</p>\n", content.results.len());
    push_failures(&mut html, content.results);
    push_judgments(&mut html, content.judgments);
    push_convergences(&mut html, content.convergences);
    if !content.curves.is_empty() {
        html += "<h2>Curves</h2>\n<div class=\"curves\">\n";
        html.extend(content.curves.iter().map(String::as_str));
        html += "\n</div>\n";
    }
    if !content.maps.is_empty() {
        html += "<h2>Maps</h2>\n<div class=\"diagrams\">\n";
        html.extend(content.maps.iter().map(|map| format!("<figure>{map}</figure>\n")));
        html += "</div>\n";
    }
    if let Some(curves) = content.pressures {
        html += &format!("<h2>Capillary pressure of all runs</h2>\n<div class=\"curves\">\n{curves}\n</div>\n");
    }
    if let Some(uncertainty) = content.uncertainty {
        html += &uncertainty.html();
        return html::page(&content.study.title, &html);
    }
    html += "<h2>Table</h2>\n<div class=\"wide\">\n";
    html += &content.table.html();
    html += "</div>\n";
    if content.study.report.pictures && content.study.compare.is_some() {
        push_comparisons(&mut html, content.comparisons, content.wording);
    } else if content.study.report.pictures {
        push_pictures(&mut html, content);
        push_diagrams(&mut html, content.results, content.diagrams);
    } else {
        push_pages(&mut html, content);
    }
    html::page(&content.study.title, &html)
}

fn push_failures(html: &mut String, results: &[RunResult]) {
    let failed: Vec<(&str, &str)> = results
        .iter()
        .filter_map(|result| match &result.state {
            RunState::Failed(report) => Some((result.run.name.as_str(), report.error.as_deref().unwrap_or_default())),
            _ => None,
        })
        .collect();
    if failed.is_empty() {
        return;
    }
    html.push_str("<h2>Failed runs</h2>\n<ul>\n");
    for (name, error) in failed {
        // Writing to a string cannot fail.
        let _ = writeln!(html, "<li class=\"failed\">{}: {}</li>", escaped(name), escaped(error));
    }
    html.push_str("</ul>\n");
}

fn push_judgments(html: &mut String, judgments: &[Judgment]) {
    if judgments.is_empty() {
        return;
    }
    html.push_str(
        "<h2>Expectations</h2>\n<table>\n<tr><th>run</th><th>measure</th><th>expected</th><th>found</th><th></th></tr>\n",
    );
    for judgment in judgments {
        let class = match judgment.verdict {
            Verdict::Met => "met",
            Verdict::Missed => "missed",
            Verdict::Open => "open",
        };
        let [of, measure, expected, found] =
            [&judgment.of, &judgment.measure, &judgment.expected, &judgment.found].map(|text| escaped(text));
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<tr><td>{of}</td><td>{measure}</td><td>{expected}</td><td>{found}</td><td class=\"{class}\">{}</td></tr>",
            judgment.verdict.word()
        );
    }
    html.push_str("</table>\n");
}

fn push_convergences(html: &mut String, convergences: &[Convergence]) {
    if convergences.is_empty() {
        return;
    }
    html.push_str("<h2>Convergence</h2>\n");
    let row = |convergence: &Convergence| {
        let points: Vec<String> = convergence
            .points
            .iter()
            .map(|(parameter, error)| format!("{} ({})", digits(*error), shown(&(*parameter).into())))
            .collect();
        vec![convergence.of.clone(), convergence.measure.clone(), points.join(", "), convergence.order_text()]
    };
    let along = convergences.first().map_or("", |convergence| convergence.along.as_str());
    let heads = ["runs", "measure", &format!("error ({along})"), "observed order"].map(str::to_owned).to_vec();
    html.push_str(&Table { heads, rows: convergences.iter().map(row).collect() }.html());
}

fn push_pictures(html: &mut String, content: &Content<'_>) {
    let runs = content.results.iter().zip(content.pages).zip(content.pictures);
    let drawn: Vec<_> = runs.filter(|(_, has_picture)| **has_picture).map(|(run, _)| run).collect();
    if drawn.is_empty() {
        return;
    }
    html.push_str("<h2>Pictures</h2>\n<div class=\"pictures\">\n");
    for (result, &has_page) in drawn {
        let (name, caption) = (escaped(&result.run.name), caption(result, content.wording));
        let play = if has_page { format!(": {}", link(&name, "played")) } else { String::new() };
        *html += &html::figure_with_more(&format!("runs/{name}/picture.png"), &caption, &play);
    }
    html.push_str("</div>\n");
}

/// The pages of runs without pictures.
fn push_pages(html: &mut String, content: &Content<'_>) {
    let with_page = || content.results.iter().zip(content.pages).filter(|(_, has_page)| **has_page);
    if with_page().next().is_none() {
        return;
    }
    html.push_str("<h2>Displacements, event by event</h2>\n<ul>\n");
    for (result, _) in with_page() {
        let caption = caption(result, content.wording);
        let _ = writeln!(html, "<li>{}</li>", link(&escaped(&result.run.name), &caption));
    }
    html.push_str("</ul>\n");
}

/// A link to the page of a run; both are escaped.
fn link(name: &str, text: &str) -> String {
    format!("<a href=\"runs/{name}/{}\">{text}</a>", network_page::NAME)
}

/// The parameters of a run with their values.
fn caption(result: &RunResult, wording: &Wording) -> String {
    escaped(&wording.values(&result.run, |_| true))
}

/// The curves of network and direct simulation of each run; the whole comparison is in the folder of the run.
fn push_comparisons(html: &mut String, comparisons: &[(&RunResult, String)], wording: &Wording) {
    html.push_str("<h2>Network and direct simulation</h2>\n<div class=\"diagrams\">\n");
    for (result, curves) in comparisons {
        let (name, caption) = (escaped(&result.run.name), caption(result, wording));
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<figure>{curves}<figcaption>{caption}: <a href=\"runs/{name}/{PAGE}\">comparison</a></figcaption></figure>"
        );
    }
    html.push_str("</div>\n");
}

fn push_diagrams(html: &mut String, results: &[RunResult], diagrams: &[Vec<String>]) {
    for (result, files) in results.iter().zip(diagrams).filter(|(_, files)| !files.is_empty()) {
        let name = escaped(&result.run.name);
        let _ = writeln!(html, "<h2>{name}</h2>\n<div class=\"diagrams\">");
        for file in files.iter().map(|file| escaped(file)) {
            let link = format!("runs/{name}/{file}");
            let _ = writeln!(
                html,
                "<figure><a href=\"{link}\"><img loading=\"lazy\" src=\"{link}\" alt=\"{file}\"></a></figure>"
            );
        }
        html.push_str("</div>\n");
    }
}
