//! The data of a step: capillary laws, resistances, sources and event functions.

use std::sync::Arc;

use super::capillary_curve::CapillaryCurve;
use super::event_functions::{EventFunction, FillingPore};
use super::graph::{Graph, Link, LinkKind};
use super::{Drive, Dynamic};
use crate::displacement::FrontId;

/// What is constant during the search for the step length.
pub(super) struct Known {
    pub(crate) event_functions: Vec<EventFunction>,
    /// Whether a full element may end the step.
    pub(crate) fills: bool,
    pub(crate) filling_pores: Vec<FillingPore>,
    /// Links that resist by a curvature.
    pub(crate) laws: Vec<CapillaryLaw>,
    /// By link: index of its law.
    pub(crate) law_of: Vec<Option<usize>>,
    /// By filling pore: index of its law.
    pub(crate) law_of_body: Vec<usize>,
    /// By link: viscous resistance in Pa s/m², and pressure drop in Pa without flow and without its law.
    pub(crate) drops: Vec<(f64, f64)>,
    /// Source of each node in m²/s.
    pub(crate) sources: Vec<f64>,
}

/// A link that resists by a curvature: a meniscus or a filling pore.
pub(super) struct CapillaryLaw {
    pub(crate) link: usize,
    pub(crate) curve: Arc<CapillaryCurve>,
    /// Area in m² before the step.
    pub(crate) area: f64,
    /// Initial guess in m² of the area after the step.
    pub(crate) start: f64,
    /// Scale of errors of the curvature in 1/m.
    pub(crate) scale: f64,
    /// Of a filling pore: area in m² at which its element is full, and whether the step may continue then.
    pub(crate) full: Option<f64>,
    pub(crate) passes: bool,
    /// Of a filling pore: laws of the menisci at the gates of its element, whose swept areas count too.
    pub(crate) entering: Vec<usize>,
}

impl Known {
    /// Area in m² swept during the step by the menisci at the gates of a filling pore, with areas by law.
    pub(crate) fn swept(&self, law: usize, area: &impl Fn(usize) -> f64) -> f64 {
        let swept = |&entering: &usize| area(entering).max(0.0) - self.laws[entering].area.max(0.0);
        self.laws[law].entering.iter().map(swept).sum()
    }
}

/// Longest time to fill an element, over the length of the last step, for a step to continue when it is full.
const QUICK: f64 = 0.2;

impl Dynamic {
    /// The data of the next step.
    pub(super) fn known(&self, graph: &Graph) -> Known {
        let drops: Vec<(f64, f64)> = graph.links.iter().map(|link| self.drop_without_rise(link)).collect();
        let open = self.open_fillings(&graph.outflow);
        let filling_pores = self.bodies_with_links(graph, &drops, &open);
        let mut laws: Vec<CapillaryLaw> =
            graph.links.iter().enumerate().filter_map(|(index, link)| self.law(&filling_pores, index, link)).collect();
        let mut law_of = vec![None; graph.links.len()];
        laws.iter().enumerate().for_each(|(index, law)| law_of[law.link] = Some(index));
        for law in &mut laws {
            if let LinkKind::FillingPore(element) = graph.links[law.link].kind {
                let fronts = self.entering(element).filter_map(|((gate, _), _)| graph.link_of[gate]);
                law.entering = fronts.filter_map(|link| law_of[link]).collect();
            }
        }
        let mut sources = vec![0.0; graph.nodes];
        if let (Some(inlet), Drive::Rate(rate)) = (graph.inlet, self.space.terms.drive) {
            sources[inlet] = rate;
        }
        let fills =
            filling_pores.iter().any(|filling_pore| !filling_pore.passes && open.contains(&filling_pore.element));
        let law_of_body = (0..laws.len()).filter(|&law| laws[law].full.is_some()).collect();
        Known {
            event_functions: self.ends_of_step(&filling_pores),
            fills,
            filling_pores,
            laws,
            law_of,
            law_of_body,
            drops,
            sources,
        }
    }

    /// The filling pores in the order of their links. A step may continue past a full element if that alone is filling, and quickly.
    fn bodies_with_links(&self, graph: &Graph, drops: &[(f64, f64)], open: &[usize]) -> Vec<FillingPore> {
        let only = open.first().copied().filter(|&e| open.len() == 1 && self.entering(e).next().is_none());
        let with_link = |(link, &(resistance, _)): (&Link, &(f64, f64))| {
            let LinkKind::FillingPore(element) = link.kind else { return None };
            let filling_pore = self.filling_pore(element, self.state.filling[element].as_ref()?, &graph.outflow);
            let rate = self.filling_rate(graph, &filling_pore, resistance);
            let is_quick = rate * self.state.last_steps[0] * QUICK > filling_pore.full - filling_pore.area;
            let passes = is_quick && only == Some(element);
            let constant =
                || CapillaryCurve::constant(filling_pore.curve.curvature(filling_pore.area)).between(&self.space.terms);
            Some(FillingPore {
                passes,
                curve: if passes { Arc::clone(&filling_pore.curve) } else { constant() },
                ..filling_pore
            })
        };
        graph.links.iter().zip(drops).filter_map(with_link).collect()
    }

    /// The capillary law of a link, if it has one.
    fn law(&self, filling_pores: &[FillingPore], index: usize, link: &Link) -> Option<CapillaryLaw> {
        match link.kind {
            LinkKind::Meniscus((gate, end)) => {
                let (meniscus, curve) = match self.approaching_outlet((gate, end)) {
                    Some((meniscus, reach)) => (meniscus, Arc::clone(&reach.curve)),
                    None => {
                        let waiting = self.state.menisci[gate][end].filter(|meniscus| !meniscus.has_burst)?;
                        (waiting, Arc::clone(self.fronts.curves[gate][end].as_ref()?))
                    }
                };
                Some(CapillaryLaw {
                    link: index,
                    area: meniscus.area,
                    start: meniscus.area,
                    scale: (curve.end().1 - curve.start().1).max(1.0 / self.space.gates[gate].width),
                    curve,
                    full: None,
                    passes: false,
                    entering: Vec::new(),
                })
            }
            LinkKind::FillingPore(element) => {
                let filling_pore = filling_pores.iter().find(|filling_pore| filling_pore.element == element)?;
                Some(CapillaryLaw {
                    link: index,
                    curve: Arc::clone(&filling_pore.curve),
                    area: filling_pore.area,
                    start: if filling_pore.passes { filling_pore.just_above_full() } else { filling_pore.area },
                    scale: 1.0 / self.displacement.elements()[element].area.sqrt(),
                    full: Some(filling_pore.full),
                    passes: filling_pore.passes,
                    entering: Vec::new(),
                })
            }
            _ => None,
        }
    }

    /// Rate in m²/s at which menisci past their events would fill an element, driven by their curvature at the event.
    fn filling_rate(&self, graph: &Graph, filling_pore: &FillingPore, resistance: f64) -> f64 {
        let now = filling_pore.curve.curvature(filling_pore.area);
        let rate = |&(gate, end): &FrontId| {
            self.state.menisci[gate][end].filter(|meniscus| meniscus.has_burst)?;
            let own = self.drop_without_rise(&graph.links[graph.link_of[gate]?]).0;
            let event = self.fronts.curves[gate][end].as_ref()?.end().1;
            let head = self.space.element_heads[filling_pore.element].above(self.space.gate_heads[gate]).signed();
            Some(self.space.terms.tension * (event - now + head).max(0.0) / (own + resistance))
        };
        self.displacement.gates_of(filling_pore.element).iter().filter_map(rate).sum()
    }
}
