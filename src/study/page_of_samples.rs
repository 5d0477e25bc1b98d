//! The part of the page of a study on the uncertainty of its results.

use super::ensemble::bands::Figures;
use super::ensemble::statistics::Statistics;
use meniscus_output::html::escaped;

/// The statistics and figures of the samples.
#[derive(Debug)]
pub(crate) struct Uncertainty<'f> {
    /// Quantiles, indices and their convergence, for readers.
    pub(crate) statistics: Statistics,
    /// The distribution of the saturation at breakthrough as SVG, if runs have one.
    pub(crate) distribution: Option<String>,
    /// Bands and maps, a part for each combination of the other axes; empty if runs are processes.
    pub(crate) figures: &'f [Figures],
}

impl Uncertainty<'_> {
    /// The part of the page.
    pub(crate) fn html(&self) -> String {
        let mut html = String::from("<h2>Uncertainty</h2>\n");
        for figures in self.figures {
            if !figures.name.is_empty() {
                html += &format!("<h3>{}</h3>\n", escaped(&figures.name));
            }
            html += "<div class=\"diagrams\">\n";
            html.extend(figures.diagrams.iter().map(|svg| format!("<figure>{svg}</figure>\n")));
            html.extend(figures.map.iter().map(|file| {
                let file = escaped(file);
                format!(
                    "<figure><a href=\"{file}\"><img src=\"{file}\" alt=\"probability of invasion\"></a></figure>\n"
                )
            }));
            html += "</div>\n";
        }
        if let Some(svg) = &self.distribution {
            html += &format!("<div class=\"curves\">{svg}</div>\n");
        }
        html += "<h3>Quantiles</h3>\n<p>All digits: <a href=\"quantiles.csv\">quantiles.csv</a>.</p>\n<div class=\"wide\">\n";
        html += &self.statistics.quantiles.html();
        html += "</div>\n";
        if let Some(indices) = &self.statistics.indices {
            html += "<h3>Sobol indices</h3>\n<p>Share of the variance that an input causes alone (first order), and with all its interactions (total).\n\
                     All digits: <a href=\"indices.csv\">indices.csv</a>.</p>\n";
            html += &indices.html();
        }
        html += "<h3>Convergence</h3>\n<p>The estimates from an eighth, a quarter, half and all of the samples: \
                 <a href=\"convergence.csv\">convergence.csv</a>.</p>\n<div class=\"wide\">\n";
        html += &self.statistics.convergence.html();
        html + "</div>\n"
    }
}
