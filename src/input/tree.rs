//! Traversal of a TOML tree: by path, by byte range, and in full.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::path::Step;

/// Visitor of a path, the byte range of its key if it ends in one, and its value.
type See<'s> = dyn FnMut(&[Step], Option<Range<usize>>, &Spanned<DeValue<'_>>) + 's;

/// The byte range of the value at a key path or, if absent, that of the nearest table around it.
pub(super) fn span_at(root: &DeTable<'_>, steps: &[Step]) -> Range<usize> {
    let Some((Step::Key(first), rest)) = steps.split_first() else { return 0..0 };
    let Some(mut node) = root.get(first.as_str()) else { return 0..0 };
    for step in rest {
        let next = match (step, node.get_ref()) {
            (Step::Key(key), DeValue::Table(table)) => table.get(key.as_str()),
            (Step::Index(index), DeValue::Array(array)) => array.get(*index),
            _ => None,
        };
        let Some(next) = next else { break };
        node = next;
    }
    node.span()
}

/// A node with children.
pub(super) enum Container<'a, 't> {
    Table(&'a mut DeTable<'t>),
    Array(&'a mut DeArray<'t>),
    Neither,
}

/// The table or array at a path.
pub(super) fn container<'a, 't>(root: &'a mut DeTable<'t>, steps: &[Step]) -> Container<'a, 't> {
    let Some((Step::Key(first), rest)) = steps.split_first() else { return Container::Table(root) };
    let Some(mut here) = root.get_mut(first.as_str()) else { return Container::Neither };
    for step in rest {
        let next = match (step, here.get_mut()) {
            (Step::Key(key), DeValue::Table(table)) => table.get_mut(key.as_str()),
            (Step::Index(index), DeValue::Array(array)) => array.get_mut(*index),
            _ => None,
        };
        let Some(next) = next else { return Container::Neither };
        here = next;
    }
    match here.get_mut() {
        DeValue::Table(table) => Container::Table(table),
        DeValue::Array(array) => Container::Array(array),
        _ => Container::Neither,
    }
}

/// The value at a path.
pub(super) fn node<'a, 't>(root: &'a DeTable<'t>, steps: &[Step]) -> Option<&'a DeValue<'t>> {
    let (Step::Key(first), rest) = steps.split_first()? else { return None };
    let mut here = root.get(first.as_str())?;
    for step in rest {
        here = match (step, here.get_ref()) {
            (Step::Key(key), DeValue::Table(table)) => table.get(key.as_str())?,
            (Step::Index(index), DeValue::Array(array)) => array.get(*index)?,
            _ => return None,
        };
    }
    Some(here.get_ref())
}

/// The byte range of the value at a path.
pub(super) fn node_span(root: &DeTable<'_>, steps: &[Step]) -> Option<Range<usize>> {
    let mut span = None;
    visit_entries(root, &mut Vec::new(), &mut |here, _, value| {
        if here == steps {
            span = Some(value.span());
        }
    });
    span
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
