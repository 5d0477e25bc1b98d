//! Traversal of a TOML tree: by path, by byte range, and in full.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::path::Step;

/// Visitor of a path, the byte range of its key if it ends in one, and its value.
type See<'s> = dyn FnMut(&[Step], Option<Range<usize>>, &Spanned<DeValue<'_>>) + 's;

/// The nodes along a key path, as far as it leads.
fn along<'a, 't>(root: &'a DeTable<'t>, steps: &'a [Step]) -> impl Iterator<Item = &'a Spanned<DeValue<'t>>> {
    let mut here: Option<&Spanned<DeValue>> = None;
    steps.iter().map_while(move |step| {
        here = match (step, here.map(Spanned::get_ref)) {
            (Step::Key(key), None) => root.get(key.as_str()),
            (Step::Key(key), Some(DeValue::Table(table))) => table.get(key.as_str()),
            (Step::Index(index), Some(DeValue::Array(array))) => array.get(*index),
            _ => None,
        };
        here
    })
}

/// The byte range of the value at a key path or, if absent, that of the nearest table around it.
pub(super) fn span_at(root: &DeTable<'_>, steps: &[Step]) -> Range<usize> {
    along(root, steps).last().map_or(0..0, Spanned::span)
}

/// The value at a path.
pub(super) fn node<'a, 't>(root: &'a DeTable<'t>, steps: &'a [Step]) -> Option<&'a Spanned<DeValue<'t>>> {
    along(root, steps).nth(steps.len().checked_sub(1)?)
}

/// A node with children.
pub(super) enum Container<'a, 't> {
    Table(&'a mut DeTable<'t>),
    Array(&'a mut DeArray<'t>),
    Neither,
}

impl<'a, 't> Container<'a, 't> {
    /// The value as a node with children.
    pub(super) fn of(value: &'a mut DeValue<'t>) -> Self {
        match value {
            DeValue::Table(table) => Self::Table(table),
            DeValue::Array(array) => Self::Array(array),
            _ => Self::Neither,
        }
    }
}

/// The table or array at a path.
pub(super) fn container<'a, 't>(root: &'a mut DeTable<'t>, steps: &[Step]) -> Container<'a, 't> {
    steps.iter().fold(Container::Table(root), |here, step| {
        let next = match (step, here) {
            (Step::Key(key), Container::Table(table)) => table.get_mut(key.as_str()),
            (Step::Index(index), Container::Array(array)) => array.get_mut(*index),
            _ => None,
        };
        next.map_or(Container::Neither, |next| Container::of(next.get_mut()))
    })
}

/// The value at a path of a plain tree.
pub(super) fn value_at<'v>(root: &'v toml::Value, steps: &[Step]) -> Option<&'v toml::Value> {
    steps.iter().try_fold(root, |here, step| match step {
        Step::Key(key) => here.get(key.as_str()),
        Step::Index(index) => here.get(*index),
    })
}

/// The deepest node whose key or value has exactly this byte range; the root if there is none.
pub(super) fn find(root: &DeTable<'_>, span: &Range<usize>) -> Vec<Step> {
    let mut found: Vec<Step> = Vec::new();
    visit_entries(root, &mut Vec::new(), &mut |steps, key, value| {
        let is_it = value.span() == *span || key.is_some_and(|key| key == *span);
        if is_it && steps.len() > found.len() {
            found = steps.to_vec();
        }
    });
    found
}

/// Visits every value with its path.
pub(super) fn visit(root: &DeTable<'_>, see: &mut impl FnMut(&[Step], &Spanned<DeValue<'_>>)) {
    visit_entries(root, &mut Vec::new(), &mut |steps, _, value| see(steps, value));
}

fn visit_entries(table: &DeTable<'_>, steps: &mut Vec<Step>, see: &mut See<'_>) {
    for (key, value) in table {
        steps.push(Step::Key(key.get_ref().to_string()));
        see(steps, Some(key.span()), value);
        visit_value(value, steps, see);
        steps.pop();
    }
}

fn visit_value(value: &Spanned<DeValue<'_>>, steps: &mut Vec<Step>, see: &mut See<'_>) {
    match value.get_ref() {
        DeValue::Table(table) => visit_entries(table, steps, see),
        DeValue::Array(array) => {
            for (index, value) in array.iter().enumerate() {
                steps.push(Step::Index(index));
                see(steps, None, value);
                visit_value(value, steps, see);
                steps.pop();
            }
        }
        _ => {}
    }
}
