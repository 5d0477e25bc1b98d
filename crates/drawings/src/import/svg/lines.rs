//! Line numbers in an SVG text, for the source locations of elements.

use roxmltree::Node;

/// The starts of the lines of a text.
pub(crate) struct Lines(Vec<usize>);

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect())
    }

    /// `line 12`.
    pub(crate) fn location(&self, node: Node) -> String {
        format!("line {}", self.0.partition_point(|&start| start <= node.range().start))
    }
}
