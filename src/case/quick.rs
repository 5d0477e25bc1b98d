//! A case of a network without a case file: a geometry and the keys of `[network]`.

use super::case_file::{Case, Model, RawCase, text};
use super::network::{RawNetwork, network};
use super::{depth, records, shapes};
use crate::geometry::spec::GeometrySpec;
use crate::input::{Checker, Problem};

/// The case and its text as a case file, with records at the start and at the end only.
///
/// # Errors
/// All problems of the keys, by their names in a case file.
pub(crate) fn quick(
    title: &str,
    geometry: GeometrySpec,
    depth: Option<f64>,
    raw: &RawNetwork,
) -> Result<(Case, String), Vec<Problem>> {
    let mut checker = Checker::default();
    let raw = raw.clone().in_range(&mut checker, "network");
    let mut found = network(&mut checker, &raw, Some(&geometry), None).map(|network| Model::Network(Box::new(network)));
    depth::depth(&mut checker, depth, found.as_mut(), Some(&geometry), false);
    shapes::refuse_images(&mut checker, Some(&geometry), found.as_ref().and_then(Model::sides));
    let raw_case = RawCase { network: Some(raw), ..RawCase::default() };
    let end = records::end(&mut checker, &raw_case, found.as_ref());
    let mut output = records::output(&mut checker, &raw_case, end, None);
    let (Some(model), Some(end), true) = (found, end, checker.problems.is_empty()) else {
        return Err(checker.problems);
    };
    // An interval above the end leaves only the end; it must be above 0 if there is no displacement.
    (output.vtk_every, output.restart_every) = (end.max(1.0), end.max(1.0));
    let case = Case { title: title.to_owned(), geometry, depth, model, end, steady: None, output, expect: Vec::new() };
    let resolved = text(&case);
    Ok((case, resolved))
}
