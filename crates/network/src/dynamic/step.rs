//! One step of backward Euler, to the next event or of the longest length allowed.

use super::event_functions::{Areas, REACHED};
use super::graph::{Graph, Link, LinkKind};
use super::known::{CapillaryLaw, Known};
use super::{Drive, Dynamic, StepEnd};
use crate::displacement::FrontId;
use crate::laplacian::{Flow, FlowError};

/// Flows of a step of the length `dt` in s and event functions at its end.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    pub(crate) dt: f64,
    pub(crate) flow: Flow,
    /// Event functions, dimensionless: above 0 before an event, 0 at it.
    pub(crate) values: Vec<f64>,
}

impl Trial {
    fn least_gap(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Whether the step reaches an event and overshoots none, or has the length `longest` in s.
    pub(super) fn ends(&self, longest: f64) -> bool {
        let least = self.least_gap();
        least >= -REACHED && (least <= REACHED || self.dt >= longest)
    }
}

/// Largest area injected in one step over the mean area of an element: the order of events then changes little with shorter steps.
const LONGEST: f64 = 0.5;
/// Least remembered step length over the one remembered before.
const SHORTER: f64 = 0.1;
/// Tolerance of curvatures and pressures at the end of a step from their linearization, relative to their range.
pub(super) const MATCHED: f64 = 5e-3;
/// Maximum number of Newton iterations.
const ROUNDS: usize = 40;
/// From this fraction on, a full Newton step is taken.
const WHOLE: f64 = 1.0 - 1e-6;
/// Maximum number of trial lengths of one step.
const MOST_TRIALS: usize = 60;

impl Dynamic {
    /// Advances to the next event, at most to the time `until` in s, and processes the event.
    pub fn advance(&mut self, until: f64) -> Result<StepEnd, FlowError> {
        self.process_events();
        let graph = self.current_graph()?;
        if graph.inlet.is_some_and(|inlet| !graph.laplacian.is_connected_to_pressure(inlet)) {
            self.graph = Some(graph);
            return Ok(StepEnd::Closed);
        }
        let remaining = until - self.state.time;
        let longest = self.longest_step().min(remaining);
        let trial = self.trial_to_event(&graph, longest)?;
        let reaches_end = trial.dt >= remaining;
        self.commit(&graph, &trial);
        self.graph = Some(graph);
        if reaches_end {
            self.state.time = until;
        }
        self.state.steps += 1;
        Ok(if self.process_events() { StepEnd::Event } else { StepEnd::Time })
    }

    /// The pressure at the inlet less that at the outlet in Pa, and the flow into the inlet in m²/s, in the last step.
    pub fn drive_now(&self) -> (f64, f64) {
        (self.state.pressure, self.state.inflow)
    }

    /// The graph of the present state, assembled again after an event.
    pub(super) fn current_graph(&mut self) -> Result<Graph, FlowError> {
        if let Some(graph) = self.graph.take() {
            return Ok(graph);
        }
        self.fronts.meetings_to_come = self.find_future_meetings();
        self.graph()
    }

    /// Longest step in s.
    fn longest_step(&self) -> f64 {
        let flow = match self.space.terms.drive {
            Drive::Rate(rate) => rate,
            Drive::PressureDrop(_) => self.state.inflow.abs(),
        };
        let element = LONGEST / self.state.filling.len() as f64;
        let longest = self.space.terms.largest_step.min(element) * self.space.pore_area / flow;
        if longest.is_finite() { longest } else { f64::INFINITY }
    }

    /// Viscous resistance in Pa s/m² of a link, and the pressure drop in Pa along it without flow and without its capillary law.
    pub(super) fn drop_without_rise(&self, link: &Link) -> (f64, f64) {
        let [a, b] = link.elements;
        let resistance = self.viscosity(a) * link.halves[0] + self.viscosity(b) * link.halves[1];
        let drop = match (link.kind, self.space.terms.drive) {
            (LinkKind::Inlet, Drive::PressureDrop(pressure)) => pressure,
            // Beyond the outlet the depth is the same, and menisci are flat in the plane.
            (LinkKind::Outlet, _) if self.is_invaded(a) => {
                let flat = self.space.terms.with_depth(0.0);
                self.space.terms.tension * (flat - self.space.element_heads[a].signed())
            }
            (LinkKind::Meniscus((gate, end)), _) => {
                let has_left = self.state.menisci[gate][end].is_some_and(|meniscus| meniscus.has_left);
                let head = if has_left { self.space.element_heads[b] } else { self.space.gate_heads[gate] };
                -self.space.terms.tension * head.signed()
            }
            (LinkKind::FillingPore(element), _) => {
                -self.space.terms.tension * self.space.element_heads[element].signed()
            }
            _ => 0.0,
        };
        (resistance, drop)
    }

    /// Conductances in m²/(Pa s) and jumps in Pa of the links in a step of the length `dt` in s, capillary laws linearized about areas in m².
    pub(super) fn conductors(&self, known: &Known, about: &[f64], dt: f64) -> (Vec<f64>, Vec<f64>) {
        let tension = self.space.terms.tension;
        let mut conductances: Vec<f64> = known.drops.iter().map(|(resistance, _)| 1.0 / resistance).collect();
        let mut jumps: Vec<f64> = known.drops.iter().map(|(_, drop)| -drop).collect();
        for (law, &from) in known.laws.iter().zip(about) {
            let (curvature, slope) = law.curve.resistance(from);
            conductances[law.link] = 1.0 / (known.drops[law.link].0 + tension * slope * dt);
            jumps[law.link] -= tension * (curvature + slope * (law.area - from));
        }
        (conductances, jumps)
    }

    /// Event functions at given areas, by law.
    pub(super) fn values(&self, graph: &Graph, known: &Known, area: impl Fn(usize) -> f64) -> Vec<f64> {
        let at = self.areas(graph, known, &area);
        known.event_functions.iter().map(|function| self.value_of(&known.filling_pores, function, &at)).collect()
    }

    /// Areas by law as areas of menisci and filling elements.
    pub(super) fn areas<'a, A: Fn(usize) -> f64 + 'a>(
        &'a self,
        graph: &'a Graph,
        known: &'a Known,
        area: &'a A,
    ) -> Areas<impl Fn(FrontId) -> f64 + 'a, impl Fn(usize) -> f64 + 'a> {
        let law = |front: FrontId| graph.link_of[front.0].and_then(|link| known.law_of[link]);
        Areas {
            front: move |front: FrontId| law(front).map_or_else(|| self.area_now(front), area),
            filling_pore: move |filling_pore: usize| {
                area(known.law_of_body[filling_pore]) + known.swept(known.law_of_body[filling_pore], area)
            },
        }
    }

    /// The step of `dt` (s) with menisci as capacitors \[Primkulov2019\], by Newton's method with an exact line search from the flows of another length.
    ///
    /// Its flows minimize ½ Σ R q² dt + Σ σ ∫ κ dv among all that balance in every node, a convex problem since κ(v) rises.
    fn trial(&mut self, graph: &Graph, known: &Known, start: Option<&Trial>, dt: f64) -> Result<Trial, FlowError> {
        let area = |law: &CapillaryLaw, through: &[f64]| self::area(law, through, dt);
        let mut through: Option<Vec<f64>> = start.map(|trial| trial.flow.through.clone());
        let mut round = 0;
        let flow = loop {
            self.state.solves += 1;
            round += 1;
            let about: Vec<f64> = match &through {
                Some(through) => known.laws.iter().map(|law| area(law, through)).collect(),
                None => known.laws.iter().map(|law| law.area).collect(),
            };
            let (conductances, jumps) = self.conductors(known, &about, dt);
            let factored = graph.laplacian.factor(conductances)?;
            let mut flow = factored.solve(&jumps, &known.sources)?;
            factored.balance(&mut flow, &known.sources)?;
            let share = through.as_ref().map_or(1.0, |before| self.least_work(known, [before, &flow.through], dt));
            if let Some(before) = through.filter(|_| share < 1.0) {
                flow.through.iter_mut().zip(before).for_each(|(new, old)| *new = old + share * (*new - old));
            }
            let matches = known.laws.iter().zip(&about).all(|(law, &about)| {
                let area = area(law, &flow.through);
                let (curvature, slope) = law.curve.resistance(about);
                let taken = curvature + slope * (area - about);
                (law.curve.resistance(area).0 - taken).abs() <= MATCHED * law.scale
            });
            if (share == 1.0 && matches) || round >= ROUNDS {
                break flow;
            }
            through = Some(flow.through);
        };
        let values = self.values(graph, known, |law| area(&known.laws[law], &flow.through));
        Ok(Trial { dt, flow, values })
    }

    /// The line search between two sets of flows: the fraction of the Newton step that minimizes the work.
    fn least_work(&self, known: &Known, [from, to]: [&[f64]; 2], dt: f64) -> f64 {
        const HALVINGS: usize = 40;
        let tension = self.space.terms.tension;
        // Derivative of the work: pressure drops along the links times the change of flows.
        let change = |share: f64| {
            let flow = |index: usize| from[index] + share * (to[index] - from[index]);
            let fixed = known
                .drops
                .iter()
                .enumerate()
                .map(|(index, (resistance, drop))| (resistance * flow(index) + drop) * (to[index] - from[index]));
            let rising = known.laws.iter().map(|law| {
                let curvature = law.curve.resistance(law.area + flow(law.link) * dt).0;
                tension * curvature * (to[law.link] - from[law.link])
            });
            fixed.sum::<f64>() + rising.sum::<f64>()
        };
        if change(1.0) <= 0.0 {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if change(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        if high > WHOLE { 1.0 } else { low }
    }

    /// The step to the first event, or of the length `longest` in s if there is none before.
    fn trial_to_event(&mut self, graph: &Graph, longest: f64) -> Result<Trial, FlowError> {
        let known = self.known(graph);
        let trial = match self.trial_along(graph, &known, longest)? {
            Some(trial) => trial,
            None => self.trial_between(graph, &known, longest)?,
        };
        self.note_length(&known, trial.dt);
        Ok(trial)
    }

    /// The same by bracketing the length, with a nonlinear solve at each.
    fn trial_between(&mut self, graph: &Graph, known: &Known, longest: f64) -> Result<Trial, FlowError> {
        let first = self.values(graph, known, |law| known.laws[law].area);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut before: Option<Trial> = None;
        let mut dt = self.first_length(known, longest);
        for _ in 0..MOST_TRIALS {
            let trial = self.trial(graph, known, before.as_ref(), dt)?;
            if trial.ends(longest) {
                return Ok(trial);
            }
            if trial.least_gap() < -REACHED {
                high = dt;
            } else {
                low = dt;
            }
            let next = estimate(&first, before.as_ref(), &trial).min(longest);
            let is_between = next > low && (next < high || high > longest);
            dt = match is_between {
                true => next,
                false if high.is_finite() => 0.5 * (low + high),
                false => longest,
            };
            before = Some(trial);
        }
        // Take the longest step before any event; an overshoot is conserved in the areas.
        let dt = if low > 0.0 { low } else { dt };
        self.trial(graph, known, before.as_ref(), dt)
    }

    /// Initial guess of the step length in s.
    pub(super) fn first_length(&self, known: &Known, longest: f64) -> f64 {
        let guess = self.state.last_steps[usize::from(known.fills)];
        if guess > 0.0 { guess.min(longest) } else { longest }
    }

    /// Remembers the length of a step in s, bounded below: simultaneous events say little about the next length.
    fn note_length(&mut self, known: &Known, dt: f64) {
        let last = &mut self.state.last_steps[usize::from(known.fills)];
        *last = dt.max(SHORTER * *last);
    }

    fn commit(&mut self, graph: &Graph, trial: &Trial) {
        let dt = trial.dt;
        let mut inflow = 0.0;
        for (link, &through) in graph.links.iter().zip(&trial.flow.through) {
            match link.kind {
                LinkKind::Open | LinkKind::FillingPore(_) => {}
                LinkKind::Inlet => {
                    inflow -= through;
                    let element = link.elements[0];
                    if let Some(filling) = self.state.filling[element].as_mut().filter(|_| self.space.is_inlet[element])
                    {
                        filling.area -= through * dt;
                    }
                }
                LinkKind::Outlet => {
                    let phase = if self.is_invaded(link.elements[0]) { 1 } else { 2 };
                    self.state.passed[phase] += through * dt;
                }
                LinkKind::Meniscus((gate, end)) => {
                    let Some(meniscus) = &mut self.state.menisci[gate][end] else { continue };
                    let ahead = link.elements[1];
                    if !meniscus.has_burst || (self.space.is_outlet[ahead] && !meniscus.has_left) {
                        meniscus.area += through * dt;
                    } else if self.space.is_outlet[ahead] {
                        self.state.passed[1] += through * dt;
                        self.state.passed[2] -= through * dt;
                    } else if let Some(filling) = &mut self.state.filling[ahead] {
                        filling.area += through * dt;
                    }
                }
            }
        }
        self.state.passed[0] += inflow * dt;
        self.state.inflow = inflow;
        self.state.pressure = match (self.space.terms.drive, graph.inlet) {
            (Drive::PressureDrop(pressure), _) => pressure,
            (Drive::Rate(_), inlet) => inlet.map_or(f64::NAN, |inlet| trial.flow.pressure[inlet]),
        };
        self.state.time += dt;
    }
}

/// Area in m² of a law at the end of a step of the length `dt` in s.
fn area(law: &CapillaryLaw, through: &[f64], dt: f64) -> f64 {
    law.area + through[law.link] * dt
}

/// Estimate in s of the step length to the first event, from one or two trials. With one relaxation time, a meniscus moves by a d/(1 + b d)
/// in a backward Euler step of the length d, so 1/displacement is linear in 1/d.
fn estimate(first: &[f64], before: Option<&Trial>, trial: &Trial) -> f64 {
    let mut found = f64::INFINITY;
    for (function, (&start, &value)) in first.iter().zip(&trial.values).enumerate() {
        let moved = start - value;
        if !(moved > 0.0) || !start.is_finite() {
            continue;
        }
        let proportional = trial.dt * start / moved;
        let hyperbola = before.filter(|before| before.dt != trial.dt).and_then(|before| {
            let earlier = start - before.values[function];
            let slope = (1.0 / earlier - 1.0 / moved) / (1.0 / before.dt - 1.0 / trial.dt);
            let reciprocal = 1.0 / trial.dt + (1.0 / start - 1.0 / moved) / slope;
            (earlier > 0.0 && slope > 0.0).then_some(if reciprocal > 0.0 { 1.0 / reciprocal } else { f64::INFINITY })
        });
        found = found.min(hyperbola.unwrap_or(proportional));
    }
    found
}
