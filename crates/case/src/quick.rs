//! A case of a network without a case file: a geometry and the keys of `[network]`.

use super::case_file::{Case, Model, RawCase, text};
use super::network::{RawNetwork, RawRegion, RegionExtent, network, pack_between_manifolds};
use super::output::{RawEvery, RawOutput, RawVtk};
use super::{depth, records, shapes};
use meniscus_core::input::{Checker, Problem};
use meniscus_geometry::spec::GeometrySpec;

/// The case and its text as a case file, with records at the start and at the end only.
///
/// # Errors
/// All problems of the keys, by their names in a case file.
pub fn quick(
    title: &str,
    geometry: GeometrySpec,
    depth: Option<f64>,
    raw: &RawNetwork,
) -> Result<(Case, String), Vec<Problem>> {
    let mut checker = Checker::default();
    let mut raw = raw.clone().in_range(&mut checker, "network");
    let mut found =
        network(&mut checker, &mut raw, Some(&geometry), None).map(|network| Model::Network(Box::new(network)));
    if let Some(Model::Network(network)) = &mut found
        && raw.region.is_none()
        && network.displacement.is_some()
        && !network.is_dynamic()
    {
        network.region = pack_between_manifolds(&network.sides, &geometry);
        let extent = network.region.map(|_| RegionExtent::Pack);
        raw.region = extent.map(|extent| RawRegion { extent: Some(extent), ..RawRegion::default() });
    }
    depth::depth(&mut checker, depth, found.as_mut(), Some(&geometry), false);
    shapes::refuse_images(&mut checker, Some(&geometry), found.as_ref().and_then(Model::sides));
    let mut raw = RawCase {
        format: Some(1),
        title: Some(title.to_owned()),
        network: Some(raw),
        expect: Some(Vec::new()),
        ..RawCase::default()
    };
    let end = records::end(&mut checker, &raw, found.as_ref());
    // An interval above the end leaves only the end; it must be above 0 if there is no displacement.
    let interval = end.map(|end| end.max(1.0));
    raw.output = Some(RawOutput {
        vtk: Some(RawVtk { every_pore_volume: interval, ..RawVtk::default() }),
        restart: Some(RawEvery { every_pore_volume: interval, ..RawEvery::default() }),
        ..RawOutput::default()
    });
    let output = records::output(&mut checker, &mut raw, end, None);
    let (Some(model), Some(end), true) = (found, end, checker.problems.is_empty()) else {
        return Err(checker.problems);
    };
    let case = Case { title: title.to_owned(), geometry, depth, model, end, steady: None, output, expect: Vec::new() };
    let resolved = text(raw, &case, case.geometry.shapes.clone());
    Ok((case, resolved))
}
