//! State changes at events: menisci enter elements, and full elements get new menisci.

use std::sync::Arc;

use super::capillary_curve::CapillaryCurve;
use super::event_functions::{Areas, EventFunction, REACHED};
use super::{Dynamic, Filling, Meniscus, Occurrence};
use crate::cycles::Invasion;
use crate::displacement::{Advance, EventKind, FrontId, Phase};
use meniscus_geometry::interface::head::Head;

/// A meniscus that forms in a gate of an element when it is full.
pub(super) struct NewMeniscus {
    pub(crate) front: FrontId,
    pub(crate) curve: Arc<CapillaryCurve>,
    /// Upper bound of its curvature in 1/m.
    most: f64,
    /// Upper bound of its swept area in m².
    free: f64,
    /// The head in its gate less that in the element behind.
    head: Head,
}

impl NewMeniscus {
    /// Swept area in m² at a curvature in 1/m in the element behind.
    pub(crate) fn area(&self, behind: f64) -> f64 {
        self.curve.area(self.head.local(behind).min(self.most)).min(self.free)
    }

    /// Curvature in 1/m in the element behind at its event.
    pub(crate) fn event(&self) -> f64 {
        self.head.applied(self.curve.end().1)
    }
}

impl Dynamic {
    /// Swept area in m² of a meniscus.
    pub(super) fn area_now(&self, (gate, end): FrontId) -> f64 {
        self.state.menisci[gate][end].map_or(0.0, |meniscus| meniscus.area)
    }

    /// Overlaps of the menisci that will form when filling elements are full, with one another and with present ones.
    pub(super) fn find_future_meetings(&self) -> Vec<Advance> {
        let filling: Vec<usize> = (0..self.state.filling.len())
            .filter(|&element| self.state.filling[element].is_some() && !self.space.is_outlet[element])
            .collect();
        if filling.is_empty() {
            return Vec::new();
        }
        let mut full = self.displacement.clone();
        filling.into_iter().for_each(|element| full.complete(element));
        full.new_advances().into_iter().filter(|advance| advance.fronts.1.is_some()).collect()
    }

    /// Area in m² of the invading phase in an element when it is full, including the menisci that then form in its gates.
    pub(super) fn target(&self, element: usize, filling: &Filling) -> f64 {
        let menisci: f64 = self.future_menisci(element).iter().map(|it| it.area(filling.curvature)).sum();
        self.displacement.elements()[element].area + menisci
    }

    /// The menisci that will form in the gates of a filling element once it is full.
    pub(super) fn future_menisci(&self, element: usize) -> Vec<NewMeniscus> {
        let ahead = self.fronts.ahead[element].iter().filter(|(front, _)| !self.is_invaded(self.ahead_of(*front)));
        ahead
            .map(|(front, curve)| {
                let into = self.ahead_of(*front);
                let held = self.state.filling[into].as_ref().map_or(0.0, |filling| filling.area)
                    + self.entering(into).map(|(_, meniscus)| meniscus.area.max(0.0)).sum::<f64>()
                    + self.passed_in_outlet(into);
                let free = (self.displacement.elements()[into].area - held).max(0.0);
                let (most, head) = (curve.end().1, self.head_ahead(*front));
                NewMeniscus { front: *front, curve: Arc::clone(curve), most, free, head }
            })
            .collect()
    }

    /// The area in m² that filling neighbors hold in excess of their own belongs to menisci yet to form: those that will enter an element, each with its part.
    pub(super) fn excess_areas(&self, into: usize) -> Vec<(FrontId, f64)> {
        let overhang = |&front: &FrontId| {
            let neighbor = self.origin(front);
            let filling = self.state.filling[neighbor].as_ref()?;
            let beyond = self.filled_area(neighbor, filling) - self.displacement.elements()[neighbor].area;
            if beyond <= 0.0 {
                return None;
            }
            let future_menisci = self.future_menisci(neighbor);
            let all: f64 = future_menisci.iter().map(|it| it.area(filling.curvature)).sum();
            let area = future_menisci.iter().find(|it| it.front == front)?.area(filling.curvature);
            (all > 0.0).then(|| (front, beyond.min(all) * area / all))
        };
        self.displacement.gates_of(into).iter().filter_map(overhang).collect()
    }

    /// The head in the gate of a meniscus less that in the element from which it comes.
    fn head_ahead(&self, front: FrontId) -> Head {
        self.space.gate_heads[front.0].above(self.space.element_heads[self.origin(front)])
    }

    /// The element that a meniscus enters.
    pub(super) fn ahead_of(&self, (gate, end): FrontId) -> usize {
        self.space.gates[gate].elements[end]
    }

    /// The element that a meniscus comes from.
    pub(super) fn origin(&self, (gate, end): FrontId) -> usize {
        self.space.gates[gate].elements[1 - end]
    }

    /// Processes all events that are due, one after the other; returns whether there was one.
    pub(super) fn process_events(&mut self) -> bool {
        let mut has_event = false;
        loop {
            let event_functions = self.event_functions();
            let now = Areas { front: |front| self.area_now(front), filling_pore: |_| 0.0 };
            // Full elements come first, then the event of the lowest curvature.
            let curvature = |function: &EventFunction| match function {
                EventFunction::Own(advance, _) | EventFunction::Meeting(advance, _) => {
                    self.fronts.advances[*advance].curvature
                }
                _ => f64::NEG_INFINITY,
            };
            let due = event_functions.iter().filter(|function| self.value_of(&[], function, &now) <= REACHED);
            let Some(first) = due.min_by(|a, b| curvature(a).total_cmp(&curvature(b))).cloned() else {
                return has_event;
            };
            has_event = true;
            match first {
                EventFunction::Own(advance, _) | EventFunction::Meeting(advance, _) => self.pass(advance),
                EventFunction::Covered { element, .. } => self.cover(element),
                EventFunction::Full { element, .. } => self.complete(element),
                EventFunction::Leaves(front) => self.leave(front),
                // These only end a step; the events of the menisci that form then follow.
                EventFunction::Beyond(_) | EventFunction::ToMeet(..) => return has_event,
            }
        }
    }

    /// Records an event of a meniscus at a curvature in 1/m.
    fn note(&mut self, kind: EventKind, front: FrontId, curvature: f64) -> Invasion {
        let saturation = self.invading_area() / self.space.pore_area;
        self.state.history.push(Occurrence {
            time: self.state.time,
            kind,
            throat: self.space.gates[front.0].throat,
            curvature,
            saturation,
            pressure: self.state.pressure,
        });
        Invasion { sequence: self.state.history.len(), applied: curvature, displaced: saturation }
    }

    /// All menisci at the gates of an element enter it: together they cover it, so they have met.
    fn cover(&mut self, element: usize) {
        let waiting: Vec<(FrontId, f64)> = self
            .entering(element)
            .filter_map(|(front, meniscus)| {
                Some((front, self.fronts.curves[front.0][front.1].as_ref()?.curvature(meniscus.area)))
            })
            .collect();
        let future_menisci = self
            .excess_areas(element)
            .into_iter()
            .filter_map(|(front, _)| Some((front, self.state.filling[self.origin(front)].as_ref()?.curvature)));
        let all = waiting.iter().copied().chain(future_menisci);
        let Some((first, curvature)) = all.max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        let invasion = self.note(EventKind::Overlap, first, curvature);
        if self.state.filling[element].is_none() {
            self.begin_filling(element, self.space.gate_heads[first.0].applied(curvature), false);
        }
        self.state.invasions[element].get_or_insert(invasion);
        waiting.into_iter().for_each(|(front, _)| self.burst(front));
    }

    /// The menisci of an advance enter the elements ahead.
    fn pass(&mut self, index: usize) {
        let advance = self.fronts.advances[index].clone();
        let (front, partner) = advance.fronts;
        let invasion = self.note(advance.kind, front, advance.curvature);
        let is_joined = advance.fills.len() > 1;
        for &element in &advance.fills {
            if self.state.filling[element].is_none() {
                let applied = self.space.gate_heads[front.0].applied(advance.curvature);
                self.begin_filling(element, applied, is_joined);
                self.state.invasions[element].get_or_insert(invasion);
            }
        }
        [Some(front), partner].into_iter().flatten().for_each(|front| self.burst(front));
    }

    /// The invading phase enters an element after an event at an applied curvature in 1/m.
    pub(super) fn begin_filling(&mut self, element: usize, applied: f64, is_joined: bool) {
        self.fronts.ahead[element] = self.menisci_ahead(element);
        let curvature = self.body_curvature(element).min(self.space.element_heads[element].local(applied));
        self.state.filling[element] = Some(Filling { area: 0.0, curvature, is_joined });
        self.graph = None;
    }

    /// The menisci that may form in the gates of an element once it is full.
    pub(super) fn menisci_ahead(&self, element: usize) -> Vec<(FrontId, Arc<CapillaryCurve>)> {
        let gates = self.displacement.gates_of(element).iter().map(|&(gate, end)| (gate, 1 - end));
        let ahead = gates.filter(|&front| self.ahead_of(front) != element && !self.is_invaded(self.ahead_of(front)));
        ahead
            .filter_map(|front| {
                let (passage, own) = self.displacement.future_front(front);
                Some((front, self.curve(front, &passage, own)?))
            })
            .collect()
    }

    /// Curvature in 1/m of the invading phase in the largest inscribed circle of an element: the mean of cos θ along its walls over the radius.
    fn body_curvature(&self, element: usize) -> f64 {
        let angles = self.displacement.angles();
        let (mut length, mut sum) = (0.0, 0.0);
        for piece in self.displacement.walls(element) {
            let cos = angles.get(piece.shape as usize).map_or(0.0, |angle| angle.cos());
            length += piece.curve.length();
            sum += piece.curve.length() * cos;
        }
        let radius = self.space.network.regions[self.displacement.region(element)].radius;
        if length > 0.0 { sum / (length * radius) } else { 0.0 }
    }

    fn burst(&mut self, front: FrontId) {
        let element = self.ahead_of(front);
        if let (Some(meniscus), Some(filling)) =
            (&mut self.state.menisci[front.0][front.1], &mut self.state.filling[element])
            && !std::mem::replace(&mut meniscus.has_burst, true)
            && !self.space.is_outlet[element]
        {
            filling.area += meniscus.area;
        }
        self.graph = None;
    }

    /// An element is full: menisci form in its gates, and the area of the invading phase is conserved.
    fn complete(&mut self, element: usize) {
        for (front, area) in self.excess_areas(element) {
            for (holder, change) in [(self.origin(front), -area), (element, area)] {
                if let Some(filling) = &mut self.state.filling[holder] {
                    filling.area += change;
                }
            }
        }
        let Some(filling) = self.state.filling[element].take() else { return };
        let mut left = self.filled_area(element, &filling) - self.displacement.elements()[element].area;
        for &(gate, end) in self.displacement.gates_of(element) {
            self.state.menisci[gate][end] = None;
            self.fronts.curves[gate][end] = None;
        }
        self.finish(element);
        let cut_off = self.trapped();
        let new: Vec<NewMeniscus> = std::mem::take(&mut self.fronts.ahead[element])
            .into_iter()
            .filter(|(front, _)| self.displacement.passage_of(*front).is_some())
            .map(|(front, curve)| {
                // The phase that fills an element cut off from the outlet rises no further.
                let head = self.head_ahead(front);
                let most = if cut_off[self.ahead_of(front)] { head.local(filling.curvature) } else { f64::INFINITY };
                NewMeniscus { front, curve, most, free: f64::INFINITY, head }
            })
            .collect();
        // The excess goes to the first to reach its event among those with a path to the outlet.
        let going_on = new.iter().filter(|begun| begun.most == f64::INFINITY);
        let first = going_on.map(|it| (it.event(), it.front)).min_by(|a, b| a.0.total_cmp(&b.0));
        let curvature = common_curvature(&new, left, first.map_or(filling.curvature, |(curvature, _)| curvature));
        left -= new.iter().map(|begun| begun.area(curvature)).sum::<f64>();
        for begun in new {
            let mut area = begun.area(curvature);
            let NewMeniscus { front, curve, .. } = begun;
            if first.is_some_and(|(_, first)| first == front) {
                area += std::mem::take(&mut left);
            }
            self.state.menisci[front.0][front.1] = Some(Meniscus { area, has_burst: false, has_left: false });
            self.fronts.curves[front.0][front.1] = Some(curve);
            if self.state.filling[self.ahead_of(front)].as_ref().is_some_and(|filling| filling.is_joined) {
                self.burst(front);
            }
        }
        self.state.excess += left;
        self.state.completed.push(element);
        self.graph = None;
    }

    /// Marks an element as full in the displacement and updates the pending events.
    pub(super) fn finish(&mut self, element: usize) {
        self.displacement.complete(element);
        debug_assert_eq!(self.displacement.phase(element), Phase::Invading);
        let new = self.displacement.new_advances();
        self.fronts.advances.extend(new);
        let displacement = &self.displacement;
        self.fronts.advances.retain(|advance| displacement.is_pending(advance));
    }
}

/// The common curvature in 1/m at which menisci together hold an area in m², at most `most`.
fn common_curvature(menisci: &[NewMeniscus], area: f64, most: f64) -> f64 {
    const HALVINGS: usize = 80;
    let held = |k: f64| menisci.iter().map(|begun| begun.area(k)).sum::<f64>();
    let mut high = most;
    if menisci.is_empty() || held(high) <= area {
        return high;
    }
    let mut low = menisci.iter().map(|begun| begun.head.applied(begun.curve.start().1)).fold(high, f64::min);
    let mut reach = (high - low).max(high.abs()).max(f64::MIN_POSITIVE);
    while held(low) > area && reach.is_finite() {
        low -= reach;
        reach *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if held(middle) > area {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}
