//! From the tree of SVG elements to filled areas: groups, copies (`use`), nested pages, visibility and layers.

mod area;

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use super::lines::Lines;
use super::page::{self, Along, Page, Viewport};
use super::placement;
use super::shape;
use super::style::{self, Fill, Style, StyleSheet};
use crate::import::affine::Affine;
use crate::import::drawing::{Drawing, Nesting, Paint, Refusal};
use crate::import::limits::Budget;
use crate::import::paint::mark_overlaid;
use meniscus_core::math::Vec2;

/// Maximum nesting depth of elements, including copies; drawing programs stay below twenty.
const DEEPEST: usize = 200;
/// Number of messages after which reading stops.
const MOST_REFUSALS: usize = 20;
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
/// Elements whose content is drawn only by reference from another element.
const NOT_DRAWN: [&str; 14] = [
    "defs",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "symbol",
    "linearGradient",
    "radialGradient",
    "filter",
    "style",
    "title",
    "desc",
    "metadata",
    "script",
];

/// The drawing of a document.
pub(crate) fn drawing(
    document: &Document,
    lines: &Lines,
    bytes: usize,
    layers: Option<&[String]>,
) -> Result<Drawing, Vec<Refusal>> {
    let root = document.root_element();
    let page = Page::of(root).map_err(|found| {
        let expected = "lengths above 0 with one of the units mm, cm, in, pt, pc, px or none";
        vec![Refusal::new(lines.location(root), found, expected)]
    })?;
    let sheet = StyleSheet::of(document);
    if let Some(selector) = sheet.overfull() {
        let found = format!("more than {} rules for `{selector}`", style::MOST_RULES);
        return Err(vec![Refusal::new("style sheet", found, "a plain style sheet")]);
    }
    let mut ids = BTreeMap::new();
    for node in document.descendants() {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let mut walk = Walk {
        lines,
        sheet: &sheet,
        ids,
        layers,
        found_layers: vec![false; layers.map_or(0, <[String]>::len)],
        budget: Budget::of_file(bytes),
        copying: Vec::new(),
        drawing: Drawing {
            unit: page.unit.clone(),
            frame: page.frame,
            has_page: true,
            nesting: Nesting::ByRule,
            ..Drawing::default()
        },
        colors: Vec::new(),
        tally: Tally::default(),
        refusals: Vec::new(),
        is_over: false,
    };
    let start = Context {
        map: page.map,
        viewport: page.viewport,
        style: Style::default(),
        layer: None,
        is_chosen: layers.is_none(),
        depth: 0,
    };
    let style = start.style.of_child(root, &sheet);
    if walk.map(root, Viewport { size: None }).is_some_and(|map| map != Affine::identity()) {
        walk.refuse(root, "a transform of the page", "transforms of groups and shapes: put all into a group (`g`)");
    }
    walk.children(root, &Context { style, ..start.clone() });
    walk.finish()
}

/// Whether the conditions of an element are met by a program without extensions, in English (SVG 1.1, 5.8).
fn is_shown(node: &Node) -> bool {
    let is_english = |languages: &str| {
        let mut languages = languages.split(',').map(|language| language.trim().to_ascii_lowercase());
        languages.any(|language| language == "en" || language.starts_with("en-"))
    };
    node.attribute("requiredExtensions").is_none() && node.attribute("systemLanguage").is_none_or(is_english)
}

/// Properties that an element inherits from its parents.
#[derive(Clone)]
struct Context<'a> {
    map: Affine,
    viewport: Viewport,
    style: Style,
    layer: Option<&'a str>,
    is_chosen: bool,
    depth: usize,
}

/// Counts for the notes.
#[derive(Default)]
struct Tally {
    strokes: usize,
    clipped: usize,
    not_closed: usize,
}

struct Walk<'a, 'input> {
    lines: &'a Lines,
    sheet: &'a StyleSheet,
    ids: BTreeMap<&'a str, Node<'a, 'input>>,
    layers: Option<&'a [String]>,
    found_layers: Vec<bool>,
    budget: Budget,
    /// The elements being copied, to detect recursive copies.
    copying: Vec<Node<'a, 'input>>,
    drawing: Drawing,
    /// The fill of each entity of the drawing.
    colors: Vec<Fill>,
    tally: Tally,
    refusals: Vec<Refusal>,
    /// Whether reading has stopped.
    is_over: bool,
}

impl<'a, 'input> Walk<'a, 'input> {
    fn refuse(&mut self, node: Node, found: impl Into<String>, expected: &str) {
        self.refusals.push(Refusal::new(self.lines.location(node), found, expected));
    }

    fn count(&mut self, kind: &str) {
        self.drawing.count(kind, 1);
    }

    fn children(&mut self, node: Node<'a, 'input>, context: &Context<'a>) {
        for child in node.children().filter(Node::is_element) {
            self.element(child, context);
        }
    }

    fn element(&mut self, node: Node<'a, 'input>, parent: &Context<'a>) {
        self.is_over |= self.refusals.len() >= MOST_REFUSALS;
        let is_foreign = node.tag_name().namespace().is_some_and(|space| space != SVG);
        if self.is_over || is_foreign {
            return;
        }
        if !is_shown(&node) {
            return self.count("elements for other programs or languages");
        }
        let name = node.tag_name().name();
        if NOT_DRAWN.contains(&name) {
            return;
        }
        if parent.depth >= DEEPEST {
            let found = format!("an element within {DEEPEST} others, copies included");
            return self.refuse(node, found, "groups that are not nested that deep");
        }
        if !self.budget.spend(1) {
            return self.refuse_size(node);
        }
        let Some(own) = self.map(node, parent.viewport) else { return };
        let style = parent.style.of_child(node, self.sheet);
        let mut context = Context { map: parent.map.after(&own), style, depth: parent.depth + 1, ..parent.clone() };
        if style.is_removed {
            return self.count("hidden elements");
        }
        self.tally.clipped += usize::from(style.is_clipped);
        match name {
            "g" | "a" => {
                self.enter_layer(node, parent, &mut context);
                self.children(node, &context);
            }
            "switch" => {
                let is_drawn = |child: &Node| child.is_element() && child.tag_name().name() != "foreignObject";
                if let Some(child) = node.children().find(|child| is_drawn(child) && is_shown(child)) {
                    self.element(child, &context);
                }
            }
            "svg" if self.viewport(node, node, &mut context).is_some() => self.children(node, &context),
            "use" => self.copy(node, context),
            "text" | "image" | "foreignObject" => self.count(name),
            _ if shape::SHAPES.contains(&name) => {
                self.choose(node, &mut context);
                self.shape(node, &context);
            }
            _ => {}
        }
    }

    /// The map of an element; `None`, with a message, if it is not understood.
    fn map(&mut self, node: Node, viewport: Viewport) -> Option<Affine> {
        placement::map(node, self.sheet, viewport).map_err(|(found, expected)| self.refuse(node, found, expected)).ok()
    }

    fn refuse_size(&mut self, node: Node) {
        let found = format!("copies that unfold into more than {} elements and vertices", self.budget.total);
        self.refuse(node, found, "a drawing with fewer copies of copies (`use`)");
        self.is_over = true;
    }

    /// The names of a group: the Inkscape label and the id.
    fn names(node: Node<'a, 'input>) -> [Option<&'a str>; 2] {
        [node.attribute((INKSCAPE, "label")), node.attribute("id")]
    }

    fn choose(&mut self, node: Node<'a, 'input>, context: &mut Context) {
        for (i, layer) in self.layers.unwrap_or_default().iter().enumerate() {
            if Self::names(node).contains(&Some(layer.as_str())) {
                self.found_layers[i] = true;
                context.is_chosen = true;
            }
        }
    }

    fn enter_layer(&mut self, node: Node<'a, 'input>, parent: &Context<'a>, context: &mut Context<'a>) {
        self.choose(node, context);
        let is_layer = node.attribute((INKSCAPE, "groupmode")) == Some("layer");
        if is_layer || parent.layer.is_none() {
            let [label, id] = Self::names(node);
            context.layer = label.or(id).or(parent.layer);
        }
    }

    /// Sets up the viewport of `node`; width and height may be those of the `use` that copies it.
    fn viewport(&mut self, node: Node<'a, 'input>, sized: Node<'a, 'input>, context: &mut Context) -> Option<()> {
        let side = |name: &str, along| match context.viewport.length(sized, name, along)? {
            Some(length) => Ok(Some(length)),
            None => context.viewport.length(node, name, along),
        };
        let read = || {
            let corner =
                [("x", Along::X), ("y", Along::Y)].map(|(name, along)| context.viewport.length(node, name, along));
            let [x, y] = corner;
            let corner = Vec2::new(x?.unwrap_or(0.0), y?.unwrap_or(0.0));
            let size = [side("width", Along::X)?, side("height", Along::Y)?];
            let view_box = page::view_box(node)?;
            let outer = context.viewport.size.or(view_box.map(|view_box| Vec2::new(view_box.w, view_box.h)));
            let size = outer.map(|outer| Vec2::new(size[0].unwrap_or(outer.x), size[1].unwrap_or(outer.y)));
            let inner = match (view_box, size) {
                (Some(view_box), Some(size)) => {
                    let inner = Viewport { size: Some(Vec2::new(view_box.w, view_box.h)) };
                    (page::fit(node, view_box, size)?, inner)
                }
                _ => (Affine::identity(), Viewport { size }),
            };
            Ok::<_, String>((Affine::translation(corner).after(&inner.0), inner.1))
        };
        match read() {
            Ok((map, viewport)) => {
                context.map = context.map.after(&map);
                context.viewport = viewport;
                Some(())
            }
            Err(found) => {
                self.refuse(node, found, "a length and a view box of four numbers");
                None
            }
        }
    }

    fn copy(&mut self, node: Node<'a, 'input>, mut context: Context<'a>) {
        self.choose(node, &mut context);
        let href = node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default().trim();
        let Some(&target) = href.strip_prefix('#').and_then(|id| self.ids.get(id)) else {
            let found = format!("use of `{}`", page::shortened(href));
            return self.refuse(node, found, "`#` and the id of an element of this file");
        };
        if self.copying.contains(&target) || node.ancestors().any(|around| around == target) {
            let found = format!("`{}` copies itself", page::shortened(href));
            return self.refuse(node, found, "copies (`use`) of other elements");
        }
        let corner = [("x", Along::X), ("y", Along::Y)].map(|(name, along)| context.viewport.length(node, name, along));
        let [Ok(x), Ok(y)] = corner else {
            return self.refuse(node, "x or y that is not a length", "a length");
        };
        context.map = context.map.after(&Affine::translation(Vec2::new(x.unwrap_or(0.0), y.unwrap_or(0.0))));
        self.copying.push(target);
        if matches!(target.tag_name().name(), "symbol" | "svg") {
            context.style = context.style.of_child(target, self.sheet);
            context.map = context.map.after(&self.map(target, context.viewport).unwrap_or_else(Affine::identity));
            if self.viewport(target, node, &mut context).is_some() {
                self.children(target, &context);
            }
        } else {
            self.element(target, &context);
        }
        self.copying.pop();
    }

    fn finish(mut self) -> Result<Drawing, Vec<Refusal>> {
        self.refusals.dedup();
        for (i, layer) in self.layers.unwrap_or_default().iter().enumerate() {
            if !self.found_layers[i] {
                let known = self.drawing.layers.keys().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
                let known = if known.is_empty() { "no groups with a name".to_owned() } else { known };
                let expected = format!("the label or id of a group: {}", page::shortened(&known));
                self.refusals.push(Refusal::new("layers", format!("`{layer}`, which is not in the file"), expected));
            }
        }
        if !self.refusals.is_empty() {
            return Err(self.refusals);
        }
        let drawing = &mut self.drawing;
        let number = |paint: fn(&Paint) -> bool| drawing.entities.iter().filter(|one| paint(&one.paint)).count();
        let (white, unfilled) =
            (number(|paint| *paint == Paint::White), number(|paint| matches!(paint, Paint::Unfilled { .. })));
        let is_white = white == drawing.entities.len();
        let outlines = if white + unfilled == drawing.entities.len() { unfilled } else { 0 };
        if is_white {
            drawing.entities.iter_mut().for_each(|one| one.paint = Paint::Filled);
        }
        mark_overlaid(&mut drawing.entities, &self.colors);
        let Tally { strokes, clipped, not_closed } = self.tally;
        let counts = [
            (outlines, "closed outlines without fill are taken for shapes"),
            (not_closed, "open outlines with a fill are closed by a straight line, as they are drawn"),
            (strokes, "shapes have a stroke beside the fill; its width is not part of them"),
            (clipped, "elements have a clip or a mask, which is not applied"),
            (self.sheet.left_out, "selectors of style sheets are not understood and left out"),
        ];
        for (number, sentence) in counts.into_iter().filter(|(number, _)| *number > 0) {
            drawing.notes.push(format!("{number} {sentence}."));
        }
        if drawing.unit.as_ref().is_some_and(|unit| unit.name == "px") {
            drawing.notes.push(
                "The unit is the px, 1/96 in; where the drawing means another one, give the key `unit`.".to_owned(),
            );
        }
        Ok(self.drawing)
    }
}
