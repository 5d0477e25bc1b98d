//! The style properties that determine whether an SVG element is a shape, and where: `display`, `visibility`, fill, stroke, fill rule and transform, from
//! attributes, `style` and style sheets.
//!
//! Selectors may name an element, an id and classes (`circle.grain`, `#a`, `*`); those with combinators or conditions are counted and ignored. Media rules
//! are ignored.

use std::collections::{BTreeMap, BTreeSet};

/// Properties in a style sheet that would move or reshape an element.
pub(crate) const REFUSED: [&str; 14] =
    ["translate", "rotate", "scale", "offset-path", "cx", "cy", "r", "rx", "ry", "x", "y", "width", "height", "d"];

use roxmltree::{Document, Node};
use svgtypes::{Color, Paint};

use crate::import::drawing::FillRule;
use meniscus_core::math::{FNV1A_BASIS, fnv1a};

/// The relevant properties, also as attributes.
const PROPERTIES: [&str; 17] = [
    "color",
    "stop-color",
    "stop-opacity",
    "display",
    "visibility",
    "fill",
    "fill-rule",
    "fill-opacity",
    "stroke",
    "stroke-width",
    "stroke-opacity",
    "opacity",
    "clip-path",
    "mask",
    "transform",
    "transform-origin",
    "transform-box",
];

/// Source of a property: numbers of attributes need no unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Source {
    /// An attribute of the element.
    Attribute,
    /// Its `style`, or a style sheet.
    Css,
}

/// Maximum number of rules for one class, id or kind of element; each is tested for each of its elements.
pub(crate) const MOST_RULES: usize = 200;

/// Fill of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fill {
    /// Nothing.
    None,
    White,
    /// Any other color, as red, green and blue, or a number for a gradient or a pattern.
    Color(u32),
}

/// The style of an element, including inherited properties.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Style {
    /// `display="none"` or zero opacity: its children are not drawn either.
    pub(crate) is_removed: bool,
    /// Whether it is visible by `visibility`.
    pub(crate) is_visible: bool,
    pub(crate) fill: Fill,
    /// Its fill rule.
    pub(crate) rule: FillRule,
    /// Whether its outline is drawn.
    pub(crate) has_stroke: bool,
    /// Whether it has a clip or a mask of its own.
    pub(crate) is_clipped: bool,
    /// The property `color`, which `currentColor` names.
    color: Fill,
    paint: [Fill; 2],
    opacity: [f64; 2],
    stroke_width: f64,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            is_removed: false,
            is_visible: true,
            fill: Fill::Color(0),
            rule: FillRule::NonZero,
            has_stroke: false,
            is_clipped: false,
            color: Fill::Color(0),
            paint: [Fill::Color(0), Fill::None],
            opacity: [1.0; 2],
            stroke_width: 1.0,
        }
    }
}

impl Style {
    /// The style of an element whose parent has this style.
    pub(crate) fn of_child(&self, node: Node, sheet: &StyleSheet) -> Self {
        let mut style = Self { is_removed: false, is_clipped: false, ..*self };
        // Other properties may refer to the color.
        sheet.for_each(node, |_, name, value| {
            if name == "color" && value != "inherit" {
                style.color = paint(value, self.color, sheet);
            }
        });
        sheet.for_each(node, |_, name, value| style.set(name, value, self, sheet));
        style.fill = if style.opacity[0] > 0.0 { style.paint[0] } else { Fill::None };
        style.has_stroke = style.paint[1] != Fill::None && style.opacity[1] > 0.0 && style.stroke_width > 0.0;
        style
    }

    fn set(&mut self, name: &str, value: &str, parent: &Self, sheet: &StyleSheet) {
        let inherits = value == "inherit";
        match name {
            "display" => self.is_removed |= value == "none",
            "opacity" => self.is_removed |= number(value) == Some(0.0),
            "visibility" if inherits => self.is_visible = parent.is_visible,
            "visibility" => self.is_visible = value == "visible",
            "fill" => self.paint[0] = if inherits { parent.paint[0] } else { paint(value, self.color, sheet) },
            "stroke" => self.paint[1] = if inherits { parent.paint[1] } else { paint(value, self.color, sheet) },
            "fill-rule" if inherits => self.rule = parent.rule,
            "fill-rule" => self.rule = if value == "evenodd" { FillRule::EvenOdd } else { FillRule::NonZero },
            "fill-opacity" => self.opacity[0] = number(value).unwrap_or(parent.opacity[0]),
            "stroke-opacity" => self.opacity[1] = number(value).unwrap_or(parent.opacity[1]),
            "clip-path" | "mask" => self.is_clipped |= value != "none",
            "stroke-width" => self.stroke_width = number(value).unwrap_or(parent.stroke_width),
            _ => {}
        }
    }
}

/// The number at the start of a value; the unit is irrelevant, as only zero matters.
fn number(value: &str) -> Option<f64> {
    let end = value.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+'))).unwrap_or(value.len());
    value[..end].parse().ok()
}

/// Smallest value of a channel of a color that counts as white.
const WHITE: u8 = 250;

/// The fill by a value; `current` is that of `currentColor`.
fn paint(value: &str, current: Fill, sheet: &StyleSheet) -> Fill {
    // A color of a printer may follow one of a screen.
    let value = value.split("icc-color").next().unwrap_or_default().trim();
    match Paint::from_str(value) {
        Ok(Paint::None) => Fill::None,
        Ok(Paint::CurrentColor) => current,
        Ok(Paint::Color(Color { alpha: 0, .. })) => Fill::None,
        Ok(Paint::Color(Color { red, green, blue, .. })) if red.min(green).min(blue) >= WHITE => Fill::White,
        Ok(Paint::FuncIRI(id, _)) if sheet.white_gradients.contains(id) => Fill::White,
        Ok(Paint::Color(Color { red, green, blue, .. })) => Fill::Color(u32::from_be_bytes([0, red, green, blue])),
        // What is no color is black, as programs that draw pages have it.
        Err(_) => Fill::Color(0),
        _ => Fill::Color(fnv1a(FNV1A_BASIS, value.bytes()) as u32 | 0xff00_0000),
    }
}

/// The rules of all `style` elements.
#[derive(Debug, Default)]
pub(crate) struct StyleSheet {
    /// Property and value by the last simple selector's key (`*`, `circle`, `.grain`, `#a`), with specificity and order.
    rules: BTreeMap<String, Vec<Rule>>,
    /// Number of rules.
    number: usize,
    /// Number of selectors that are not understood.
    pub(crate) left_out: usize,
    /// The ids of gradients whose stops are all white.
    white_gradients: BTreeSet<String>,
}

#[derive(Debug, Clone)]
struct Rule {
    selector: Selector,
    /// Specificity, then order in the file.
    rank: (usize, usize),
    properties: Vec<(String, String)>,
}

/// A compound selector.
#[derive(Debug, Clone, Default)]
struct Selector {
    element: Option<String>,
    id: Option<String>,
    classes: Vec<String>,
}

impl StyleSheet {
    /// The rules of a document.
    pub(crate) fn of(document: &Document) -> Self {
        let mut sheet = Self::default();
        for node in document.descendants().filter(|node| node.tag_name().name() == "style") {
            let text: String = node.children().filter_map(|child| child.text()).collect();
            sheet.read(&without_comments(&text));
        }
        sheet.white_gradients = sheet.white_gradients_of(document);
        sheet
    }

    fn white_gradients_of(&self, document: &Document) -> BTreeSet<String> {
        let is_gradient = |node: &Node| matches!(node.tag_name().name(), "linearGradient" | "radialGradient");
        let gradients: BTreeMap<&str, Node> =
            document.descendants().filter(is_gradient).filter_map(|node| Some((node.attribute("id")?, node))).collect();
        let is_white = |stop: Node| {
            let mut fill = Fill::None;
            self.for_each(stop, |_, name, value| {
                if name == "stop-color" {
                    fill = paint(value, Fill::None, self);
                }
            });
            fill == Fill::White
        };
        let stops = |gradient: &Node| {
            let mut gradient = *gradient;
            // A gradient without stops has those of the one that it refers to.
            for _ in 0..gradients.len() {
                let own: Vec<bool> =
                    gradient.children().filter(|child| child.tag_name().name() == "stop").map(is_white).collect();
                let href = gradient.attributes().find(|attribute| attribute.name() == "href");
                let id = href.as_ref().and_then(|href| href.value().trim().strip_prefix('#'));
                match id.and_then(|id| gradients.get(id)) {
                    Some(next) if own.is_empty() => gradient = *next,
                    _ => return own,
                }
            }
            Vec::new()
        };
        let white = gradients.iter().filter(|(_, gradient)| {
            let stops = stops(gradient);
            !stops.is_empty() && stops.iter().all(|is_white| *is_white)
        });
        white.map(|(id, _)| (*id).to_owned()).collect()
    }

    /// A selector with more rules than are tested.
    pub(crate) fn overfull(&self) -> Option<&str> {
        self.rules.iter().find(|(_, rules)| rules.len() > MOST_RULES).map(|(key, _)| key.as_str())
    }

    fn read(&mut self, text: &str) {
        let mut rest = text;
        while let Some((selectors, after)) = rest.split_once('{') {
            if selectors.trim_start().starts_with('@') {
                rest = after_block(after);
                continue;
            }
            let (body, after) = after.split_once('}').unwrap_or((after, ""));
            let properties = declarations(body);
            rest = after;
            if properties.is_empty() {
                continue;
            }
            for text in selectors.split(',') {
                let Some(selector) = Selector::parse(text.trim()) else {
                    self.left_out += 1;
                    continue;
                };
                let rank = (selector.specificity(), self.number);
                self.number += 1;
                self.rules.entry(selector.key()).or_default().push(Rule {
                    selector,
                    rank,
                    properties: properties.clone(),
                });
            }
        }
    }

    /// Passes each property of an element to `set`, the strongest last.
    pub(crate) fn for_each(&self, node: Node, mut set: impl FnMut(Source, &str, &str)) {
        for name in PROPERTIES {
            if let Some(value) = node.attribute(name) {
                set(Source::Attribute, name, value.trim());
            }
        }
        if !self.rules.is_empty() {
            let classes = node.attribute("class").unwrap_or_default();
            let keys = classes.split_whitespace().map(|class| format!(".{class}"));
            let keys = keys
                .chain(node.attribute("id").map(|id| format!("#{id}")))
                .chain([node.tag_name().name().to_owned(), "*".to_owned()]);
            let rules = keys.filter_map(|key| self.rules.get(&key)).flatten();
            let mut rules: Vec<&Rule> = rules.filter(|rule| rule.selector.matches(node)).collect();
            rules.sort_by_key(|rule| rule.rank);
            for (name, value) in rules.iter().flat_map(|rule| &rule.properties) {
                set(Source::Css, name, value);
            }
        }
        if let Some(text) = node.attribute("style") {
            for (name, value) in pairs(text) {
                set(Source::Css, name, value);
            }
        }
    }
}

impl Selector {
    fn parse(text: &str) -> Option<Self> {
        let mut selector = Self::default();
        let is_name = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_') || !c.is_ascii();
        let mut rest = text.strip_prefix('*').unwrap_or(text);
        if rest.is_empty() && text.is_empty() {
            return None;
        }
        while !rest.is_empty() {
            let (mark, tail) = match rest.strip_prefix(['.', '#']) {
                Some(tail) => (rest.as_bytes()[0], tail),
                None => (b' ', rest),
            };
            let end = tail.find(|c| !is_name(c)).unwrap_or(tail.len());
            let (name, after) = tail.split_at(end);
            if name.is_empty() {
                return None;
            }
            match mark {
                b'.' => selector.classes.push(name.to_owned()),
                b'#' => selector.id = Some(name.to_owned()),
                _ => selector.element = Some(name.to_owned()),
            }
            rest = after;
        }
        Some(selector)
    }

    fn specificity(&self) -> usize {
        let classes = self.classes.len().min(99);
        10_000 * usize::from(self.id.is_some()) + 100 * classes + usize::from(self.element.is_some())
    }

    /// A simple selector that is necessary for a match.
    fn key(&self) -> String {
        match (&self.id, self.classes.first(), &self.element) {
            (Some(id), ..) => format!("#{id}"),
            (None, Some(class), _) => format!(".{class}"),
            (None, None, Some(element)) => element.clone(),
            (None, None, None) => "*".to_owned(),
        }
    }

    fn matches(&self, node: Node) -> bool {
        let classes = node.attribute("class").unwrap_or_default();
        self.element.as_deref().is_none_or(|element| element == node.tag_name().name())
            && self.id.as_deref().is_none_or(|id| node.attribute("id") == Some(id))
            && self.classes.iter().all(|class| classes.split_whitespace().any(|own| own == class))
    }
}

/// The relevant `name: value` pairs.
fn pairs(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split(';').filter_map(|declaration| {
        let (name, value) = declaration.split_once(':')?;
        let value = value.split('!').next().unwrap_or_default().trim();
        let name = name.trim();
        (PROPERTIES.contains(&name) || REFUSED.contains(&name)).then_some((name, value))
    })
}

fn declarations(body: &str) -> Vec<(String, String)> {
    pairs(body).map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
}

fn without_comments(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("/*") {
        kept.push_str(before);
        rest = after.split_once("*/").map_or("", |(_, after)| after);
    }
    kept + rest
}

/// The text after the closing brace of the current block.
fn after_block(text: &str) -> &str {
    let mut depth = 1;
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &text[at + 1..];
        }
    }
    ""
}
