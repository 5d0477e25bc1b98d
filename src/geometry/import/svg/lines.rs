//! Lines of an SVG text, to say where an element stands.

use roxmltree::Node;

/// Where the lines of a text begin.
pub(crate) struct Lines(Vec<usize>);

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect())
    }

    /// `line 12`.
    pub(crate) fn place(&self, node: Node) -> String {
        format!("line {}", self.0.partition_point(|&start| start <= node.range().start))
    }
}
