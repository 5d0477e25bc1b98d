//! A case of a network without a case file: a geometry and the keys of `[network]`.

use super::check::network;
use super::raw::RawNetwork;
use crate::case::check;
use crate::case::checked::{Case, Model};
use crate::case::raw::RawCase;
use crate::case::{resolve, shapes};
use crate::geometry::spec::GeometrySpec;
use crate::input::{Checker, Problem};

/// The case and its text as a case file, with records at the beginning and at the end only.
///
/// # Errors
/// All problems of the keys, by the names that they have in a case file.
pub fn quick(title: &str, geometry: GeometrySpec, raw: &RawNetwork) -> Result<(Case, String), Vec<Problem>> {
    let mut checker = Checker::default();
    let found = network(&mut checker, raw, Some(&geometry), None).map(|network| Model::Network(Box::new(network)));
    shapes::refuse_images(&mut checker, Some(&geometry), found.as_ref());
    let whole = RawCase { network: Some(raw.clone()), ..RawCase::default() };
    let end = check::end(&mut checker, &whole, found.as_ref());
    let mut output = check::output(&mut checker, &whole, end, None);
    let (Some(model), Some(end), true) = (found, end, checker.problems.is_empty()) else {
        return Err(checker.problems);
    };
    // An interval above the end leaves the end; it must stay above 0 where nothing is displaced.
    (output.vtk_every, output.restart_every) = (end.max(1.0), end.max(1.0));
    let case = Case { title: title.to_owned(), geometry, model, end, steady: None, output, expect: Vec::new() };
    let resolved = resolve::text(&case);
    Ok((case, resolved))
}
