//! A step: to the next event, or as far as it may go, by backward Euler.

use super::graph::{Graph, Link, Way};
use super::rise::Rise;
use super::{Drive, Dynamic};
use crate::network::laplacian::{Conductor, Flow, FlowError};

/// What a step may come to.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Goal {
    /// A meniscus reaches its own event: index of the advance, link of the meniscus.
    Own(usize, usize),
    /// Two menisci meet: index of the advance, links of both.
    Meeting(usize, [usize; 2]),
    /// Menisci that wait to enter an element cover all of it.
    Covered {
        element: usize,
        /// Links of the menisci.
        links: Vec<usize>,
        /// Area in m² of those to come, from elements that are being filled.
        held: f64,
    },
    /// An element is full.
    Full {
        element: usize,
        /// Links of menisci that have burst into it, and of those that wait to enter it.
        burst: Vec<usize>,
        entering: Vec<usize>,
        /// Area in m² of the invading phase when it is full, in the element and in the menisci that then wait in its gates.
        target: f64,
    },
}

/// The end of a step of the length `dt` in s.
#[derive(Debug, Clone)]
struct Trial {
    dt: f64,
    flow: Flow,
    /// Swept area in m² of the menisci that wait, by link.
    area: Vec<f64>,
    /// What is missing until each goal, as a share of the whole way.
    gaps: Vec<f64>,
}

/// What stays as it is while the length of a step is sought.
struct Known {
    goals: Vec<Goal>,
    /// Swept area in m² of the menisci before the step, by link.
    areas: Vec<f64>,
    /// By link: resistance in Pa s/m², and the pressure drop in Pa without flow, but for a meniscus that waits.
    drops: Vec<(f64, f64)>,
    /// Of each node in m²/s.
    sources: Vec<f64>,
}

/// What may be missing until an event, and what may be beyond it, as a share of the way to it. What is beyond is not lost: the invading
/// phase has it in the element ahead.
pub(super) const REACHED: f64 = 1e-3;
/// Largest difference between the curvature of a meniscus at the end of a step and that which the step took, as a share of its range.
const MATCHED: f64 = 1e-3;
/// Most rounds of Newton's method.
const ROUNDS: usize = 40;
/// From this share on a step of Newton's method is done as a whole.
const WHOLE: f64 = 1.0 - 1e-6;
/// First trial where an element is filled, over the shortest such step so far: there flows are what they are at the beginning.
const FIRST: f64 = 0.1;
/// Trials of one step.
const MOST_TRIALS: usize = 60;

/// How a step ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepEnd {
    /// At an event.
    Event,
    /// At the time asked for, or at the largest step.
    Time,
    /// Nothing can flow: the injected fluid has nowhere to go.
    Closed,
}

impl Dynamic {
    /// Goes on to the next event, at most to the time `until` in s; does the event.
    ///
    /// # Errors
    /// [`FlowError`].
    pub fn advance(&mut self, until: f64) -> Result<StepEnd, FlowError> {
        self.fire()?;
        let graph = self.current_graph()?;
        if graph.inlet.is_some_and(|inlet| !graph.laplacian.hangs_on_a_pressure(inlet)) {
            self.graph = Some(graph);
            return Ok(StepEnd::Closed);
        }
        let whole = until - self.state.time;
        let longest = self.longest_step().min(whole);
        let trial = self.trial_to_event(&graph, longest)?;
        let lands = trial.dt >= whole;
        self.commit(&graph, &trial);
        self.graph = Some(graph);
        if lands {
            self.state.time = until;
        }
        self.state.steps += 1;
        Ok(if self.fire()? { StepEnd::Event } else { StepEnd::Time })
    }

    /// The pressure at the inlet less that at the outlet in Pa, and the flow into the inlet in m²/s, in the last step.
    #[must_use]
    pub fn drive_now(&self) -> (f64, f64) {
        (self.state.pressure, self.state.inflow)
    }

    /// The conductors of the present state, found anew after an event.
    pub(super) fn current_graph(&mut self) -> Result<Graph, FlowError> {
        match self.graph.take() {
            Some(graph) => Ok(graph),
            None => self.graph(),
        }
    }

    /// In s.
    fn longest_step(&self) -> f64 {
        let flow = match self.terms.drive {
            Drive::Rate(rate) => rate,
            Drive::Pressure(_) => self.state.inflow.abs(),
        };
        let longest = self.terms.largest_step * self.pore_area / flow;
        if longest.is_finite() { longest } else { f64::INFINITY }
    }

    /// Resistance in Pa s/m² of a link, and the pressure drop along it in Pa without flow, but for a meniscus that waits.
    fn drop_without_rise(&self, link: &Link) -> (f64, f64) {
        let [a, b] = link.elements;
        let resistance = self.viscosity(a) * link.halves[0] + self.viscosity(b) * link.halves[1];
        let drop = match (link.way, self.terms.drive) {
            (Way::Inlet, Drive::Pressure(pressure)) => pressure,
            (Way::Meniscus((gate, end)), _) if self.state.menisci[gate][end].is_some_and(|it| it.has_burst) => {
                self.terms.tension * self.state.filling[b].as_ref().map_or(0.0, |filling| filling.curvature)
            }
            _ => 0.0,
        };
        (resistance, drop)
    }

    /// A link in a step of the length `dt` in s, with the curvature at its end linear about the area `from`.
    fn conductor(&self, link: &Link, (resistance, drop): (f64, f64), from: f64, dt: f64) -> Conductor {
        if let Way::Meniscus((gate, end)) = link.way
            && let (Some(meniscus), Some(rise)) = (&self.state.menisci[gate][end], &self.rises[gate][end])
            && !meniscus.has_burst
        {
            let (curvature, slope) = rise.curvature(from);
            let tension = self.terms.tension;
            return Conductor {
                conductance: 1.0 / (resistance + tension * slope * dt),
                jump: -tension * (curvature + slope * (meniscus.area - from)),
            };
        }
        Conductor { conductance: 1.0 / resistance, jump: -drop }
    }

    fn areas(&self, graph: &Graph) -> Vec<f64> {
        let area = |link: &Link| match link.way {
            Way::Meniscus((gate, end)) => self.state.menisci[gate][end].map_or(0.0, |meniscus| meniscus.area),
            _ => 0.0,
        };
        graph.links.iter().map(area).collect()
    }

    /// The step of the length `dt` in s: by Newton's method with an exact line search, beginning with the flows of another length.
    ///
    /// Its flows are those of least ½ Σ R q² dt + Σ σ ∫ k dv among all that balance in every node, a convex problem since curvatures rise.
    fn trial(&mut self, graph: &Graph, known: &Known, start: Option<&Trial>, dt: f64) -> Result<Trial, FlowError> {
        let areas = &known.areas;
        let mut through: Option<Vec<f64>> = start.map(|trial| trial.flow.through.clone());
        let mut round = 0;
        let flow = loop {
            self.state.solves += 1;
            round += 1;
            let about: Vec<f64> = match &through {
                Some(through) => areas.iter().zip(through).map(|(area, q)| area + q * dt).collect(),
                None => areas.clone(),
            };
            let links = graph.links.iter().zip(&known.drops).zip(&about);
            let conductors: Vec<Conductor> =
                links.map(|((link, &drop), &from)| self.conductor(link, drop, from, dt)).collect();
            let mut flow = graph.laplacian.solve(&conductors, &known.sources)?;
            let share =
                through.as_ref().map_or(1.0, |before| self.least_work(graph, known, [before, &flow.through], dt));
            if let Some(before) = through.filter(|_| share < 1.0) {
                flow.through.iter_mut().zip(before).for_each(|(new, old)| *new = old + share * (*new - old));
            }
            let matches = share == 1.0 && self.mismatch(graph, areas, &about, &flow.through, dt) <= MATCHED;
            if matches || round >= ROUNDS {
                break flow;
            }
            through = Some(flow.through);
        };
        let area: Vec<f64> = areas.iter().zip(&flow.through).map(|(area, q)| area + q * dt).collect();
        let gaps = known.goals.iter().map(|goal| self.gap(graph, goal, &area, Some((&flow, dt)))).collect();
        Ok(Trial { dt, flow, area, gaps })
    }

    /// The menisci that wait, with their links and the widths of their gates in m.
    fn waiting<'a>(&'a self, graph: &'a Graph) -> impl Iterator<Item = (usize, &'a Rise, f64)> + 'a {
        graph.links.iter().enumerate().filter_map(|(index, link)| {
            let Way::Meniscus((gate, end)) = link.way else { return None };
            self.state.menisci[gate][end].filter(|meniscus| !meniscus.has_burst)?;
            Some((index, self.rises[gate][end].as_ref()?, self.gates[gate].width))
        })
    }

    /// Largest difference between the curvature of a meniscus and that which a step took, as a share of its range.
    fn mismatch(&self, graph: &Graph, areas: &[f64], about: &[f64], through: &[f64], dt: f64) -> f64 {
        let of = |(index, rise, width): (usize, &Rise, f64)| {
            let area = areas[index] + through[index] * dt;
            let (curvature, slope) = rise.curvature(about[index]);
            let taken = curvature + slope * (area - about[index]);
            (rise.curvature(area).0 - taken).abs() / (rise.end().1 - rise.start().1).max(1.0 / width)
        };
        self.waiting(graph).map(of).fold(0.0, f64::max)
    }

    /// The share of the way from some flows to others at which the work is least.
    fn least_work(&self, graph: &Graph, known: &Known, [from, to]: [&[f64]; 2], dt: f64) -> f64 {
        const HALVINGS: usize = 40;
        let tension = self.terms.tension;
        let menisci: Vec<(usize, &Rise, f64)> = self.waiting(graph).collect();
        // The pressure drops along the links times the change of flows.
        let change = |share: f64| {
            let flow = |index: usize| from[index] + share * (to[index] - from[index]);
            let fixed = known
                .drops
                .iter()
                .enumerate()
                .map(|(index, (resistance, drop))| (resistance * flow(index) + drop) * (to[index] - from[index]));
            let rising = menisci.iter().map(|&(index, rise, _)| {
                tension * rise.curvature(known.areas[index] + flow(index) * dt).0 * (to[index] - from[index])
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

    /// What is missing until a goal, with the areas of menisci by link and the flow of a step; below 0 beyond it.
    fn gap(&self, graph: &Graph, goal: &Goal, area: &[f64], step: Option<(&Flow, f64)>) -> f64 {
        let rise = |link: usize| match graph.links[link].way {
            Way::Meniscus((gate, end)) => self.rises[gate][end].as_ref().map(|rise| (rise, self.gates[gate].width)),
            _ => None,
        };
        match goal {
            Goal::Own(_, link) => {
                rise(*link).map_or(f64::INFINITY, |(rise, _)| (rise.end().0 - area[*link]) / rise.scale())
            }
            Goal::Meeting(advance, links) => {
                let curvature =
                    |link: usize| rise(link).map_or(f64::NEG_INFINITY, |(rise, _)| rise.curvature(area[link]).0);
                let mean = 0.5 * (curvature(links[0]) + curvature(links[1]));
                let width = rise(links[0]).map_or(1.0, |(_, width)| width);
                (self.advances[*advance].curvature - mean) * width
            }
            Goal::Covered { element, links, held } => {
                let covered: f64 = held + links.iter().map(|&link| area[link]).sum::<f64>();
                1.0 - covered / self.displacement.elements()[*element].area
            }
            Goal::Full { element, burst, entering, target } => {
                let came: f64 = step.map_or(0.0, |(flow, dt)| burst.iter().map(|&link| flow.through[link] * dt).sum());
                let filled = self.state.filling[*element].as_ref().map_or(0.0, |filling| filling.area);
                // What a meniscus that recedes out of it takes along was in it before.
                let waiting: f64 = entering.iter().map(|&link| area[link].max(0.0)).sum();
                (target - filled - came - waiting) / self.displacement.elements()[*element].area
            }
        }
    }

    /// What is missing now until all goals.
    pub(super) fn gaps(&self, graph: &Graph, goals: &[Goal]) -> Vec<f64> {
        let area = self.areas(graph);
        goals.iter().map(|goal| self.gap(graph, goal, &area, None)).collect()
    }

    /// The step to the first event, or of the length `longest` in s where there is none before.
    fn trial_to_event(&mut self, graph: &Graph, longest: f64) -> Result<Trial, FlowError> {
        let mut sources = vec![0.0; graph.nodes];
        if let (Some(inlet), Drive::Rate(rate)) = (graph.inlet, self.terms.drive) {
            sources[inlet] = rate;
        }
        let drops = graph.links.iter().map(|link| self.drop_without_rise(link)).collect();
        let known = Known { goals: self.goals(graph), areas: self.areas(graph), drops, sources };
        let first = self.gaps(graph, &known.goals);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut before: Option<Trial> = None;
        let [loading, filling] = self.state.last_steps;
        let guess = if graph.is_filling { FIRST * filling } else { loading };
        let mut dt = if guess > 0.0 { guess.min(longest) } else { longest };
        for _ in 0..MOST_TRIALS {
            let trial = self.trial(graph, &known, before.as_ref(), dt)?;
            let least = trial.gaps.iter().copied().fold(f64::INFINITY, f64::min);
            if least >= -REACHED && (least <= REACHED || dt >= longest) {
                return Ok(trial);
            }
            if least < -REACHED {
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
        // As far as no event is passed; what is beyond an event is carried on by the areas.
        let dt = if low > 0.0 { low } else { dt };
        self.trial(graph, &known, before.as_ref(), dt)
    }

    fn commit(&mut self, graph: &Graph, trial: &Trial) {
        let dt = trial.dt;
        let mut inflow = 0.0;
        for ((link, &through), &area) in graph.links.iter().zip(&trial.flow.through).zip(&trial.area) {
            match link.way {
                Way::Open => {}
                Way::Inlet => inflow -= through,
                Way::Outlet => {
                    let phase = if self.is_invaded(link.elements[0]) { 1 } else { 2 };
                    self.state.passed[phase] += through * dt;
                }
                Way::Meniscus((gate, end)) => {
                    let Some(meniscus) = &mut self.state.menisci[gate][end] else { continue };
                    let ahead = link.elements[1];
                    if !meniscus.has_burst {
                        meniscus.area = area;
                    } else if self.is_outlet[ahead] {
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
        self.state.pressure = match (self.terms.drive, graph.inlet) {
            (Drive::Pressure(pressure), _) => pressure,
            (Drive::Rate(_), inlet) => inlet.map_or(f64::NAN, |inlet| trial.flow.pressure[inlet]),
        };
        self.state.time += dt;
        let [loading, filling] = &mut self.state.last_steps;
        if !graph.is_filling {
            *loading = dt;
        } else if *filling == 0.0 || dt < *filling {
            *filling = dt;
        }
    }
}

/// The length in s of the step that reaches the first goal, by one or two trials. What a meniscus moves in a step of backward Euler is
/// a d/(1 + b d) over its length d where one relaxation rules, so that reciprocals are on a line.
fn estimate(first: &[f64], before: Option<&Trial>, trial: &Trial) -> f64 {
    let mut found = f64::INFINITY;
    for (goal, (&start, &gap)) in first.iter().zip(&trial.gaps).enumerate() {
        let moved = start - gap;
        if !(moved > 0.0) || !start.is_finite() {
            continue;
        }
        let proportional = trial.dt * start / moved;
        let hyperbola = before.filter(|before| before.dt != trial.dt).and_then(|before| {
            let earlier = start - before.gaps[goal];
            let slope = (1.0 / earlier - 1.0 / moved) / (1.0 / before.dt - 1.0 / trial.dt);
            let reciprocal = 1.0 / trial.dt + (1.0 / start - 1.0 / moved) / slope;
            (earlier > 0.0 && slope > 0.0).then_some(if reciprocal > 0.0 { 1.0 / reciprocal } else { f64::INFINITY })
        });
        found = found.min(hyperbola.unwrap_or(proportional));
    }
    found
}
