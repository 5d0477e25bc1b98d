//! Notes on a drawing, in few lines: unit, counts, repairs, unused entities, domain.

use std::fmt::Display;

use crate::import::drawing::Drawing;
use crate::import::options::Options;
use meniscus_core::math::Bounds;
use meniscus_geometry::spec::ShapeSpec;
use meniscus_geometry::weld::WELD;

/// Statistics of the conversion of a drawing.
#[derive(Debug, Clone, Default)]
pub(crate) struct Counts {
    discs: usize,
    polygons: usize,
    curved: usize,
    holes: usize,
    /// Rings recognized as circles.
    pub(crate) recognized: usize,
    smoothed: usize,
    /// Areas of the smoothed rings before and after.
    areas: [f64; 2],
    /// Number of duplicate vertices removed.
    pub(crate) doubled: usize,
    /// Number of corners joined with other shapes that they nearly touch.
    pub(crate) welded: usize,
    /// Number of rings of zero area.
    pub(crate) without_area: usize,
    /// Shapes outside of the window.
    pub(crate) outside: usize,
}

impl Counts {
    /// Counts a smoothed ring by its areas before and after.
    pub(crate) fn smooth(&mut self, before: f64, after: f64) {
        self.smoothed += 1;
        self.areas[0] += before.abs();
        self.areas[1] += after.abs();
    }

    /// Counts the final shapes.
    pub(crate) fn shapes<'s>(&mut self, shapes: impl Iterator<Item = &'s ShapeSpec>) {
        for shape in shapes {
            match shape {
                ShapeSpec::Disc(_) => self.discs += 1,
                ShapeSpec::Polygon(polygon) => {
                    self.polygons += 1;
                    self.holes += polygon.holes.len();
                }
                ShapeSpec::CurvedPolygon(polygon) => {
                    self.curved += 1;
                    self.holes += polygon.holes.len();
                }
                _ => self.curved += 1,
            }
        }
    }
}

/// The notes of a drawing in preparation.
#[derive(Debug, Clone)]
pub(crate) struct Notes {
    /// Statistics of its shapes.
    pub(crate) counts: Counts,
    first: Vec<String>,
    unused: Vec<String>,
    of_reader: Vec<String>,
    domain: String,
}

impl Notes {
    /// Starts with the unit and the notes of the reader.
    pub(crate) fn new(unit: String, drawing: &Drawing) -> Self {
        let count = |(kind, number): (&String, &usize)| format!("{kind} ({number})");
        let mut first = vec![unit];
        if !drawing.layers.is_empty() {
            first.push(format!("layers: {}", drawing.layers.iter().map(count).collect::<Vec<_>>().join(", ")));
        }
        let unused = drawing.unused.iter().filter(|(_, number)| **number > 0).map(count).collect();
        Self { counts: Counts::default(), first, unused, of_reader: drawing.notes.clone(), domain: String::new() }
    }

    /// Entities that were read but not used.
    pub(crate) fn unused(&self) -> String {
        let mut unused = self.unused.clone();
        if self.counts.without_area > 0 {
            unused.push(format!("rings without area ({})", self.counts.without_area));
        }
        if unused.is_empty() { "nothing".into() } else { unused.join(", ") }
    }

    /// Adds a sentence after those of the reader.
    pub(crate) fn add(&mut self, sentence: String) {
        self.of_reader.push(sentence);
    }

    /// Reports the domain, and its origin.
    pub(crate) fn domain(&mut self, domain: Bounds, from: &str) {
        let size = domain.size();
        self.domain = format!("domain {:.4e} x {:.4e} m, {from}", size.x, size.y);
    }

    /// All notes, one sentence each.
    pub(crate) fn lines(self, options: &Options) -> Vec<String> {
        let counts = &self.counts;
        let mut read: Vec<String> =
            [("disc", counts.discs), ("polygon", counts.polygons), ("curved polygon", counts.curved)]
                .into_iter()
                .filter(|(_, number)| *number > 0)
                .map(|(kind, number)| of(number, kind))
                .collect();
        if read.is_empty() {
            read.push("no shape".into());
        }
        let mut line = format!("read: {}", read.join(", "));
        if counts.recognized > 0 {
            line += &format!(" ({} recognized in polygons)", of(counts.recognized, "circle"));
        }
        if counts.holes > 0 {
            line += &format!("; they enclose {}", of(counts.holes, "hole"));
        }
        if counts.outside > 0 {
            line += &format!("; outside of the domain: {}", of(counts.outside, "shape"));
        }
        if !self.unused.is_empty() || counts.without_area > 0 {
            line += &format!("; not used: {}", self.unused());
        }
        let mut lines = self.first;
        lines.push(line);
        if counts.smoothed > 0 {
            let change = 100.0 * (counts.areas[1] / counts.areas[0] - 1.0);
            let below = options.smooth_below().to_degrees();
            lines.push(format!(
                "smoothed: vertices of {} that turn less than {below:.0} degrees became arcs, area {change:+.3} % \
                 (off by smooth-below-deg = 0)",
                of(counts.smoothed, "ring")
            ));
        }
        if counts.doubled > 0 {
            lines.push(format!("repaired: {} taken out", of(counts.doubled, "doubled vertex")));
        }
        if counts.welded > 0 {
            lines.push(format!(
                "joined: {} within {WELD:.0e} of the domain's size of another outline",
                of(counts.welded, "corner")
            ));
        }
        lines.extend(self.of_reader);
        lines.push(self.domain);
        lines
    }
}

/// `1 disc`, `2 discs`, `2 vertices`.
fn of(number: usize, noun: impl Display) -> String {
    let noun = noun.to_string();
    match number {
        1 => format!("1 {noun}"),
        _ => match noun.strip_suffix("ex") {
            Some(stem) => format!("{number} {stem}ices"),
            None => format!("{number} {noun}s"),
        },
    }
}
