//! Dynamic displacement: two incompressible phases, viscous flow through throats, and menisci as capacitors.
//!
//! After the moving capacitors of Primkulov et al. (2019, 2021) with the events of Cieplak and Robbins (1988, 1990).
//!
//! An element is a part of the pore space between at most three walls; it holds one phase or is filling. A node is a set of adjoining
//! elements of one region that hold the same phase, with one pressure p; a link carries the flow q between two nodes. A throat resists with
//! R = μ₁ r₁ + μ₂ r₂ (its two halves), and a meniscus in it that has swept the area v since the chord of its gate with σ κ(v), where the
//! curvature κ is exact for the walls (`capillary_curve.rs`) and includes that by floor and lid:
//!
//! R q = p_i − p_j − σ (κ(v) − h),  dv/dt = q,  and in each node outflow − inflow = source.
//!
//! Pressures are those in excess of the same phase at rest, so that gravity acts on menisci alone, by the head σ h of the density difference at their height.
//!
//! One step of [`Dynamic::advance`], by backward Euler with a step Δt that ends at the next event:
//!
//! 1. Process all events that are due (`process_events`).
//! 2. After an event, assemble nodes and links again (`current_graph`, `graph`). At a given rate, stop if no path connects inlet and outlet.
//! 3. Bound Δt by the injected area (`longest_step`) and the time requested.
//! 4. Collect what is constant during the step (`known`): resistances and driving pressures (`drop_without_rise`), the curve κ(v) of each
//!    meniscus and of each filling element (`law`), sources, and event functions, which fall to 0 at an event (`ends_of_step`, `value_of`).
//! 5. Find Δt together with p and q (`trial_along`). In each iteration:
//!    1. Linearize about areas a: with v before the step, a link has the conductance 1/(R + σ κ′(a) Δt) and the pressure jump
//!       −σ (κ(a) + κ′(a) (v − a)) (`conductors`).
//!    2. With one Cholesky factorization, solve for p, q and their derivatives with respect to Δt (`path`).
//!    3. Find the smallest Δt at which an event function is 0 (`first_along`); accept it if κ and p agree with the linearization (`accepted`).
//!    4. Otherwise find the next Δt with areas in equilibrium with the pressures (`equilibrium_area`, `filling`, `first_along`), limit the
//!       change of pressures by a line search (`damp`), and take the areas in equilibrium with them as the next a.
//! 6. If that does not converge, bracket Δt (`trial_between`, `estimate`), with Newton's method and a line search at each (`trial`, `least_work`).
//! 7. Add q Δt to the swept area of each meniscus, or, past its event, to the element that it fills (`commit`).
//! 8. Process the events that are due, bursts, touches and overlaps last and by rising curvature (`process_events`): a full element gets
//!    menisci in its other gates, at the same total area (`complete`); menisci together cover an element and enter it (`cover`); a meniscus
//!    touches the outlet (`leave`); one bursts, touches or overlaps and enters the element ahead (`pass`), which then fills at the curvature
//!    cos θ/R_j of its largest inscribed circle, or that of the event if it is smaller (`begin_filling`).
//!
//! Areas change by flow only, so both phases are conserved, and trapping needs no rule of its own. An element open at the outlet stays open
//! to the defending phase: the invading phase leaves it once its meniscus touches the side (`open.rs`).
//!
//! Left out: snap-off and retreat through a throat (a full element stays full), films, inertia, dynamic contact angles.

mod capillary_curve;
mod changes;
mod conductors;
mod cut_off;
mod event_functions;
mod events;
mod fingers;
mod graph;
mod known;
mod measures;
mod model;
mod open;
mod path;
mod playback;
pub(crate) mod solver;
mod state;
mod step;
mod terms;

use std::sync::Arc;

use self::capillary_curve::{CapillaryCurve, Reach};
use self::graph::Graph;
pub use self::state::{Breakthrough, Occurrence};
use self::state::{Filling, Meniscus, State};
pub use self::terms::Terms;
use super::conductance::{opening_resistances, resistances};
use super::cycles::Invasion;
use super::displacement::{Advance, Displacement, FrontId, GateFacts, Phase};
use super::graph::Network;
pub use meniscus_case::network::Drive;
use meniscus_geometry::interface::head::Head;
use meniscus_geometry::interface::menisci::Passage;

/// How a step ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepEnd {
    /// At an event.
    Event,
    /// At the time asked for or the longest step.
    Time,
    /// No flow is possible: no path leads from the inlet to the outlet.
    Closed,
}

/// The pore space, its fluids and what follows from them before the first step.
#[derive(Debug, Clone)]
struct PoreSpace {
    network: Arc<Network>,
    terms: Terms,
    gates: Vec<GateFacts>,
    /// Opening and its element.
    openings: Vec<(usize, usize)>,
    /// The elements under the disc that is the inlet.
    under_disc: Vec<usize>,
    /// In 1/m².
    resistances: Vec<[f64; 2]>,
    opening_resistances: Vec<f64>,
    pore_area: f64,
    /// Initial area in m² of the invading phase.
    first_area: f64,
    /// By element: whether it is open at the outlet and not at the inlet.
    is_outlet: Vec<bool>,
    /// By element: whether it is open at the inlet and was not full initially.
    is_inlet: Vec<bool>,
    /// By gate and end: where menisci touch the outlet.
    reaches: Vec<[Option<Reach>; 2]>,
    /// Hydrostatic heads in the middles of gates, and in the centers of elements.
    gate_heads: Vec<Head>,
    element_heads: Vec<Head>,
}

/// The menisci of the full elements, with their coming events. They follow from the order in which elements became full.
#[derive(Debug, Clone)]
struct Fronts {
    /// By gate and end.
    curves: Vec<[Option<Arc<CapillaryCurve>>; 2]>,
    /// Of filling elements: menisci that may form in their gates once they are full.
    ahead: Vec<Vec<(FrontId, Arc<CapillaryCurve>)>>,
    advances: Vec<Advance>,
    /// Overlaps of menisci that will form when filling elements are full.
    meetings_to_come: Vec<Advance>,
}

/// A dynamic displacement.
#[derive(Debug, Clone)]
pub struct Dynamic {
    displacement: Displacement,
    space: PoreSpace,
    fronts: Fronts,
    state: State,
    graph: Option<Graph>,
}

impl Dynamic {
    /// The pore space full of the defending phase, except elements open at an inlet, which have flat menisci in their gates. The displacement
    /// must be in its initial state, without trapping.
    pub fn new(network: Arc<Network>, displacement: Displacement, terms: Terms) -> Self {
        let elements = displacement.elements().len();
        let space = PoreSpace {
            openings: displacement.openings(),
            under_disc: terms.inlet_disc.map_or_else(Vec::new, |disc| displacement.elements_under(&disc)),
            resistances: resistances(&network),
            opening_resistances: opening_resistances(&network),
            pore_area: displacement.elements().iter().map(|element| element.area).sum(),
            first_area: 0.0,
            is_outlet: Vec::new(),
            is_inlet: vec![false; elements],
            reaches: Vec::new(),
            gate_heads: displacement.gates().iter().map(|gate| terms.head(gate.middle)).collect(),
            element_heads: (0..elements).map(|element| terms.head(displacement.center(element))).collect(),
            gates: displacement.gates(),
            network,
            terms,
        };
        let fronts = Fronts {
            curves: vec![const { [None, None] }; space.gates.len()],
            ahead: vec![Vec::new(); elements],
            advances: Vec::new(),
            meetings_to_come: Vec::new(),
        };
        let state = State {
            menisci: vec![[None; 2]; space.gates.len()],
            filling: vec![None; elements],
            invasions: vec![None; elements],
            ..State::default()
        };
        let mut dynamic = Self { displacement, space, fronts, state, graph: None };
        dynamic.space.is_outlet = dynamic.defending_at(terms.outlet);
        dynamic.space.reaches = dynamic.reaches();
        dynamic.begin();
        dynamic
    }

    fn begin(&mut self) {
        self.fronts.advances = self.displacement.new_advances();
        for front in self.displacement.waiting().collect::<Vec<_>>() {
            if let Some(curve) = self.rise_of(front) {
                let area = curve.area(0.0_f64.max(curve.start().1));
                self.state.menisci[front.0][front.1] = Some(Meniscus { area, has_burst: false, has_left: false });
                self.fronts.curves[front.0][front.1] = Some(curve);
            }
        }
        let invaded = (0..self.state.filling.len()).filter(|&e| self.is_invaded(e)).collect::<Vec<_>>();
        self.space.first_area = self.invading_area();
        let displaced = self.space.first_area / self.space.pore_area;
        invaded.into_iter().for_each(|element| {
            self.state.invasions[element] = Some(Invasion { sequence: 0, applied: f64::NAN, displaced });
        });
        if self.displacement.reached_outlet() {
            self.state.breakthrough = Some(Breakthrough { time: 0.0, saturation: displaced, pressure: f64::NAN });
        }
    }

    /// Restores a saved state: elements are filled again in the same order, so that the same menisci have the same events.
    fn restore(&mut self, state: State) -> Result<(), String> {
        let elements = self.state.filling.len();
        let counts = [
            state.menisci.len() == self.space.gates.len(),
            state.filling.len() == elements,
            state.invasions.len() == elements,
        ];
        if counts != [true; 3] || state.completed.iter().any(|&element| element >= elements) {
            return Err("it is that of another network".to_owned());
        }
        state.completed.iter().for_each(|&element| self.finish(element));
        self.state = state;
        for (gate, end) in self.displacement.waiting().collect::<Vec<_>>() {
            self.fronts.curves[gate][end] = self.rise_of((gate, end));
        }
        for element in (0..elements).filter(|&element| self.state.filling[element].is_some()).collect::<Vec<_>>() {
            self.fronts.ahead[element] = self.menisci_ahead(element);
        }
        self.graph = None;
        Ok(())
    }

    fn rise_of(&self, front: FrontId) -> Option<Arc<CapillaryCurve>> {
        let (passage, own) = self.displacement.passage_of(front)?;
        self.curve(front, passage, own)
    }

    fn curve(&self, front: FrontId, passage: &Passage, own: f64) -> Option<Arc<CapillaryCurve>> {
        Some(CapillaryCurve::new(passage, own, self.space.gates[front.0].width)?.between(&self.space.terms))
    }

    /// Elements, gates, and phases of full elements.
    pub fn displacement(&self) -> &Displacement {
        &self.displacement
    }

    /// Fluids and drive.
    pub(crate) fn terms(&self) -> &Terms {
        &self.space.terms
    }

    /// The time in s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// All events so far.
    pub fn history(&self) -> &[Occurrence] {
        &self.state.history
    }

    /// When each element began to fill; `applied` is the curvature of the meniscus that entered it.
    pub fn invasions(&self) -> &[Option<Invasion>] {
        &self.state.invasions
    }

    /// When the invading phase reached the outlet.
    pub fn breakthrough(&self) -> Option<Breakthrough> {
        self.state.breakthrough
    }

    /// Initial saturation of the invading phase.
    pub(crate) fn first_saturation(&self) -> f64 {
        self.space.first_area / self.space.pore_area
    }

    /// Area of all pores in m².
    pub fn pore_area(&self) -> f64 {
        self.space.pore_area
    }

    fn is_invaded(&self, element: usize) -> bool {
        self.displacement.phase(element) == Phase::Invading
    }

    /// Area in m² of the invading phase in a filling element.
    fn filled_area(&self, element: usize, filling: &Filling) -> f64 {
        filling.area + self.entering(element).map(|(_, meniscus)| meniscus.area).sum::<f64>()
    }

    /// The menisci at the gates of an element that have not yet entered it.
    fn entering(&self, element: usize) -> impl Iterator<Item = (FrontId, Meniscus)> + '_ {
        let fronts = self.displacement.gates_of(element).iter().copied();
        let meniscus = |front: FrontId| self.state.menisci[front.0][front.1].map(|meniscus| (front, meniscus));
        fronts.filter_map(meniscus).filter(|(_, meniscus)| !meniscus.has_burst)
    }

    /// Saturation of the invading phase in an element: 1 if full, above 0 if it is filling or a meniscus bulges into it.
    pub(crate) fn share(&self, element: usize) -> f64 {
        if self.is_invaded(element) {
            return 1.0;
        }
        let area = self.displacement.elements()[element].area;
        let came = self.state.filling[element].as_ref().map_or(0.0, |filling| filling.area);
        let waiting: f64 = self.entering(element).map(|(_, meniscus)| meniscus.area).sum();
        ((came + waiting + self.passed_in_outlet(element)) / area).clamp(0.0, 1.0)
    }

    /// Area in m² of the invading phase.
    pub fn invading_area(&self) -> f64 {
        let elements = self.displacement.elements().iter().enumerate();
        let full: f64 = elements.filter(|(index, _)| self.is_invaded(*index)).map(|(_, element)| element.area).sum();
        let filling: f64 = self.state.filling.iter().flatten().map(|filling| filling.area).sum();
        let menisci = self.state.menisci.iter().flatten().flatten().filter(|meniscus| !meniscus.has_burst);
        let outlet: f64 = (0..self.space.is_outlet.len()).map(|element| self.passed_in_outlet(element)).sum();
        full + filling + menisci.map(|meniscus| meniscus.area).sum::<f64>() + outlet + self.state.excess
    }

    /// Relative error of the area balance: gain of the invading phase less its net inflow, over its area. Nonzero only by rounding.
    pub fn balance_error(&self) -> f64 {
        let [inflow, outflow, _] = self.state.passed;
        let area = self.invading_area();
        (area - self.space.first_area - (inflow - outflow)) / area.abs().max(f64::MIN_POSITIVE)
    }

    /// The menisci, each a polyline in m.
    pub(crate) fn menisci(&self) -> Vec<Vec<meniscus_core::math::Vec2>> {
        const POINTS: usize = 17;
        self.arcs().map(|arc| arc.points(POINTS)).collect()
    }

    /// The menisci before their events.
    fn arcs(&self) -> impl Iterator<Item = meniscus_geometry::interface::menisci::Meniscus> + '_ {
        self.displacement.waiting().filter_map(|front| {
            let meniscus = self.state.menisci[front.0][front.1].filter(|meniscus| !meniscus.has_burst)?;
            let curve = self.fronts.curves[front.0][front.1].as_ref()?;
            let (passage, own) = self.displacement.passage_of(front)?;
            passage.at(curve.curvature(meniscus.area).min(own))
        })
    }
}
