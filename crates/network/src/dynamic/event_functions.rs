//! Event functions: dimensionless, above 0 before an event and 0 at it; the first zero ends a step.

use std::sync::Arc;

use super::Dynamic;
use super::capillary_curve::CapillaryCurve;
use crate::displacement::{Advance, FrontId, Outflow};

/// An event function.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum EventFunction {
    /// A meniscus reaches its own event: index of the advance.
    Own(usize, FrontId),
    /// Two menisci meet: index of the advance.
    Meeting(usize, [FrontId; 2]),
    /// Menisci at the gates of an element together cover it.
    Covered {
        element: usize,
        fronts: Vec<FrontId>,
        /// Area in m² of those yet to form, from filling elements.
        held: f64,
    },
    /// An element is full.
    Full {
        element: usize,
        /// Area in m² of the invading phase when it is full, in the element and in the menisci that then form in its gates.
        target: f64,
    },
    /// A meniscus in an element at the outlet touches the outlet side.
    Leaves(FrontId),
    /// An element is full, or, if it fills quickly, the first meniscus that then forms reaches its event: index of the filling pore.
    Beyond(usize),
    /// A meniscus yet to form meets another one, each by filling pore or front, at a curvature in 1/m.
    ToMeet([Side; 2], f64),
}

/// One of two menisci that meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    /// A present meniscus.
    Front(FrontId),
    /// One yet to form: index of the filling pore.
    FillingPore(usize),
}

/// The invading phase in a filling element.
#[derive(Debug, Clone)]
pub(super) struct FillingPore {
    pub(crate) element: usize,
    /// Curvature over area: constant until the element is full, then the common curvature of the menisci in its gates.
    pub(crate) curve: Arc<CapillaryCurve>,
    /// Area in m² now, when the element is full, and when the first meniscus ahead reaches its event.
    pub(crate) area: f64,
    pub(crate) full: f64,
    pub(crate) first: Option<f64>,
    /// Whether a step may continue when the element is full.
    pub(crate) passes: bool,
}

impl FillingPore {
    /// Area in m² just above that at which the element is full.
    pub(crate) fn just_above_full(&self) -> f64 {
        self.full * (1.0 + 1e-9)
    }
}

/// The areas in m² at which event functions are evaluated.
pub(super) struct Areas<F: Fn(FrontId) -> f64, B: Fn(usize) -> f64> {
    /// Swept by a meniscus.
    pub(crate) front: F,
    /// Of a filling pore, by its index.
    pub(crate) filling_pore: B,
}

/// Tolerance of an event function at the end of a step. An overshoot is not lost: it belongs to the element ahead.
pub(super) const REACHED: f64 = 1e-3;
/// Tolerance of the area of an element with menisci ahead over that of one without.
const LOOSE: f64 = 10.0;
/// Points of the capillary curve of a filling pore past full.
const POINTS: usize = 9;
/// Least area assumed for the menisci ahead of an element until the first event, over that of the element.
const LEAST_BEYOND: f64 = 1e-2;
/// Capacity dA/dκ of a filling pore at the end of its curve, over the area of its element to the power 3/2.
const CLOSED: f64 = 1e-3;

impl Dynamic {
    fn waits(&self, (gate, end): FrontId) -> bool {
        self.state.menisci[gate][end].is_some_and(|meniscus| !meniscus.has_burst)
    }

    /// The functions of all events of the present menisci and elements.
    pub(super) fn event_functions(&self) -> Vec<EventFunction> {
        let mut event_functions = Vec::new();
        for (index, advance) in self.fronts.advances.iter().enumerate() {
            match advance.fronts {
                (front, _) if !self.waits(front) => {}
                (front, None) => event_functions.push(EventFunction::Own(index, front)),
                (front, Some(partner)) if self.waits(partner) && self.is_new(advance) => {
                    event_functions.push(EventFunction::Meeting(index, [front, partner]));
                }
                _ => {}
            }
        }
        for element in
            (0..self.state.filling.len()).filter(|&element| !self.is_invaded(element) && self.is_near(element))
        {
            let fronts: Vec<FrontId> = self.entering(element).map(|(front, _)| front).collect();
            // An element at the outlet is never full: the invading phase leaves it.
            let is_leaving = self.space.is_outlet[element] && !fronts.is_empty();
            if self.state.filling[element].is_some() && !is_leaving {
                continue;
            }
            let excess_areas = self.excess_areas(element);
            if fronts.len() + excess_areas.len() > 1 || self.state.filling[element].is_some() {
                let held = excess_areas.iter().map(|(_, area)| area).sum::<f64>() + self.passed_in_outlet(element);
                event_functions.push(EventFunction::Covered { element, fronts, held });
            }
        }
        for (element, filling) in self.state.filling.iter().enumerate() {
            let Some(filling) = filling.as_ref().filter(|_| !self.space.is_outlet[element]) else { continue };
            let excess_areas: f64 = self.excess_areas(element).iter().map(|(_, area)| area).sum();
            let target = self.target(element, filling) - excess_areas;
            event_functions.push(EventFunction::Full { element, target });
        }
        event_functions.extend(self.all_approaching_outlet().into_iter().map(EventFunction::Leaves));
        event_functions
    }

    /// Whether the invading phase is in an element or beside it, so that menisci may meet there.
    fn is_near(&self, element: usize) -> bool {
        let beside = |&(gate, end): &FrontId| {
            self.state.menisci[gate][end].is_some()
                || self.state.filling[self.space.gates[gate].elements[1 - end]].is_some()
        };
        self.state.filling[element].is_some() || self.displacement.gates_of(element).iter().any(beside)
    }

    /// Whether an advance lets the invading phase into an element.
    fn is_new(&self, advance: &Advance) -> bool {
        advance.fills.iter().any(|&element| self.state.filling[element].is_none())
    }

    /// The functions whose zeros end a step, in which elements may become full.
    pub(super) fn ends_of_step(&self, filling_pores: &[FillingPore]) -> Vec<EventFunction> {
        let mut event_functions = self.event_functions();
        let has_body = |element: usize| filling_pores.iter().any(|filling_pore| filling_pore.element == element);
        event_functions
            .retain(|function| !matches!(function, EventFunction::Full { element, .. } if has_body(*element)));
        event_functions.extend((0..filling_pores.len()).map(EventFunction::Beyond));
        let side = |front: FrontId| {
            let behind = self.origin(front);
            let filling_pore =
                filling_pores.iter().position(|filling_pore| filling_pore.element == behind).map(Side::FillingPore);
            filling_pore.or_else(|| self.waits(front).then_some(Side::Front(front)))
        };
        for advance in &self.fronts.meetings_to_come {
            if let (front, Some(partner)) = advance.fronts
                && let (Some(one), Some(other)) = (side(front), side(partner))
                && self.is_new(advance)
            {
                event_functions.push(EventFunction::ToMeet([one, other], advance.curvature));
            }
        }
        event_functions
    }

    /// The filling elements from which the defending phase has a path to an outlet.
    pub(super) fn open_fillings(&self, outflow: &Outflow) -> Vec<usize> {
        let fills = |&e: &usize| self.state.filling[e].is_some() && !self.space.is_outlet[e] && outflow.is_open(e);
        (0..self.state.filling.len()).filter(fills).collect()
    }

    /// The invading phase in a filling element.
    pub(super) fn filling_pore(&self, element: usize, filling: &super::Filling, outflow: &Outflow) -> FillingPore {
        let own = self.displacement.elements()[element].area;
        let excess_areas: f64 = self.excess_areas(element).iter().map(|(_, area)| area).sum();
        // Menisci ahead of elements that the full element cuts off from the outlet do not advance.
        let (stopped, ahead): (Vec<_>, Vec<_>) = self
            .future_menisci(element)
            .into_iter()
            .partition(|it| self.is_cut_off(outflow, self.ahead_of(it.front), element));
        let stopped: f64 = stopped.iter().map(|it| it.area(filling.curvature)).sum();
        let first = ahead.iter().map(|it| it.event()).reduce(f64::min);
        let held = |k: f64| ahead.iter().map(|it| it.area(k)).sum::<f64>() + stopped + own - excess_areas;
        let full = held(filling.curvature);
        let mut points = vec![(full, filling.curvature)];
        let last = first.map_or(filling.curvature, |first| first.max(filling.curvature));
        for point in 1..POINTS {
            let left = 1.0 - point as f64 / (POINTS - 1) as f64;
            let k = last - (last - filling.curvature) * left * left;
            let (area, before) = (held(k), points[points.len() - 1]);
            if area > before.0 + 1e-6 * own && k > before.1 {
                points.push((area, k));
            }
        }
        FillingPore {
            element,
            area: self.filled_area(element, filling),
            full,
            passes: false,
            first: first.map(|_| points[points.len() - 1].0),
            curve: CapillaryCurve::of_body(&points, 1.0 / (CLOSED * own * own.sqrt())).between(&self.space.terms),
        }
    }

    /// Scale in m² of errors of the area in an element: larger if menisci ahead can take an excess.
    fn scale_of_filling(&self, element: usize) -> f64 {
        let loose = if self.fronts.ahead[element].is_empty() { 1.0 } else { LOOSE };
        loose * self.displacement.elements()[element].area
    }

    /// The value of an event function, below 0 past the event.
    pub(super) fn value_of<F: Fn(FrontId) -> f64, B: Fn(usize) -> f64>(
        &self,
        filling_pores: &[FillingPore],
        function: &EventFunction,
        at: &Areas<F, B>,
    ) -> f64 {
        let curve = |front: FrontId| self.fronts.curves[front.0][front.1].as_ref();
        let curvature = |front: FrontId| curve(front).map_or(f64::NEG_INFINITY, |it| it.curvature((at.front)(front)));
        let element_area = |element: usize| self.displacement.elements()[element].area;
        match function {
            EventFunction::Own(_, front) => {
                curve(*front).map_or(f64::INFINITY, |curve| (curve.end().0 - (at.front)(*front)) / curve.scale())
            }
            EventFunction::Meeting(advance, fronts) => {
                let mean = 0.5 * (curvature(fronts[0]) + curvature(fronts[1]));
                (self.fronts.advances[*advance].curvature - mean) * self.space.gates[fronts[0].0].width
            }
            EventFunction::Covered { element, fronts, held } => {
                let covered: f64 = held + fronts.iter().map(|&front| (at.front)(front)).sum::<f64>();
                1.0 - covered / element_area(*element)
            }
            EventFunction::Full { element, target } => {
                let filled = self.state.filling[*element].as_ref().map_or(0.0, |filling| filling.area);
                // The area of a meniscus that recedes was in the element before.
                let waiting: f64 = self.entering(*element).map(|(front, _)| (at.front)(front).max(0.0)).sum();
                (target - filled - waiting) / self.scale_of_filling(*element)
            }
            EventFunction::Leaves(front) => {
                self.remaining_to_outlet(*front, &at.front) / element_area(self.ahead_of(*front))
            }
            EventFunction::Beyond(index) => {
                let FillingPore { element, full, first, passes, .. } = &filling_pores[*index];
                match first.filter(|_| *passes) {
                    Some(first) => {
                        (first - (at.filling_pore)(*index)) / (first - full).max(LEAST_BEYOND * element_area(*element))
                    }
                    None => (full - (at.filling_pore)(*index)) / self.scale_of_filling(*element),
                }
            }
            EventFunction::ToMeet(sides, event) => {
                let mut missing = f64::NEG_INFINITY;
                let mut side = |side: &Side| match *side {
                    Side::Front(front) => (curvature(front), self.space.gates[front.0].width),
                    Side::FillingPore(index) => {
                        let (filling_pore, area) = (&filling_pores[index], (at.filling_pore)(index));
                        let own = element_area(filling_pore.element);
                        missing = missing.max((filling_pore.full - area) / own);
                        (filling_pore.curve.curvature(area), own.sqrt())
                    }
                };
                let [(one, width), (other, _)] = [side(&sides[0]), side(&sides[1])];
                ((event - 0.5 * (one + other)) * width).max(missing)
            }
        }
    }
}
