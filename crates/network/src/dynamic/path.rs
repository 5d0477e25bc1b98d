//! A step directly to its event: Newton's method with the step length as an additional unknown.
//!
//! Linearized about given areas, flows and pressures are linear in the step length to first order. At a low rate the pressures of a
//! cluster are those of its menisci, whatever the length, so the first event follows from the change of pressures, and the length from the
//! areas at these pressures. Each iteration linearizes about the areas of menisci in equilibrium with the pressures at the event.

use super::Dynamic;
use super::graph::Graph;
use super::known::{CapillaryLaw, Known};
use super::step::{MATCHED, Trial};
use crate::laplacian::{Factored, Flow, FlowError};

/// Maximum number of iterations.
const ROUNDS: i32 = 16;
/// Largest ratio of consecutive lengths at first and at last; it shrinks from iteration to iteration to avoid cycles.
const FAR: f64 = 30.0;
const NEAR: f64 = 1.5;
/// Iterations with the largest ratio.
const FREE: i32 = 3;
/// Relative tolerance of the length at an event along a path.
const EXACT: f64 = 1e-9;

/// Flows and pressure drops, linear in the step length about `dt`.
struct Path<'a> {
    dt: f64,
    flow: Flow,
    rates: Flow,
    /// By link: pressure drop in Pa and its derivative with respect to the length in Pa/s.
    drops: Vec<(f64, f64)>,
    factored: Factored<'a>,
}

impl Path<'_> {
    /// Area in m² that passes a link in a step of the length `dt` in s.
    fn passed(&self, link: usize, dt: f64) -> f64 {
        self.flow.through[link] * self.dt + self.rate(link) * (dt - self.dt)
    }

    /// Its derivative with respect to the length in m²/s.
    fn rate(&self, link: usize) -> f64 {
        self.flow.through[link] + self.dt * self.rates.through[link]
    }

    /// Pressure in Pa of a node.
    fn pressure(&self, node: usize, dt: f64) -> f64 {
        self.flow.pressure[node] + self.rates.pressure[node] * (dt - self.dt)
    }

    /// Pressure drop in Pa.
    fn drop(&self, link: usize, dt: f64) -> f64 {
        let (drop, rate) = self.drops[link];
        drop + rate * (dt - self.dt)
    }
}

/// Pressure drops in Pa by link, and the inlet pressure in Pa if a rate is given.
struct Pressures {
    drops: Vec<f64>,
    inlet: f64,
}

impl Dynamic {
    /// The step to the first event, or of the length `longest` in s if there is none before; `None` without convergence.
    pub(super) fn trial_along(
        &mut self,
        graph: &Graph,
        known: &Known,
        longest: f64,
    ) -> Result<Option<Trial>, FlowError> {
        let mut dt = self.first_length(known, longest);
        let mut about: Vec<f64> = known.laws.iter().map(|law| law.start).collect();
        let mut before: Option<Pressures> = None;
        for round in 0..ROUNDS {
            self.state.solves += 1;
            let path = self.path(graph, known, &about, dt)?;
            let far = NEAR.max(FAR * 0.25_f64.powi((round - FREE).max(0)));
            let range = [dt / far, longest.min(dt * far)];
            let linear = |law: usize, dt: f64| known.laws[law].area + path.passed(known.laws[law].link, dt);
            let end = self.first_along(graph, known, range, linear);
            if let Some(trial) = self.accepted(graph, known, &path, end, longest)? {
                return Ok(Some(trial));
            }
            let at_equilibrium = |law: usize, dt: f64| {
                let equilibrium = self.equilibrium_area(known, law, path.drop(known.laws[law].link, dt), dt);
                self.filling(known, &path, law, equilibrium, about[law], dt)
            };
            dt = self.first_along(graph, known, range, at_equilibrium);
            let mut next = Pressures {
                drops: (0..known.drops.len()).map(|link| path.drop(link, dt)).collect(),
                inlet: graph.inlet.map_or(0.0, |inlet| path.pressure(inlet, dt)),
            };
            if let Some(before) = &before {
                next = self.damp(known, [before, &next], dt).unwrap_or(next);
            }
            about = (0..known.laws.len())
                .map(|law| self.equilibrium_area(known, law, next.drops[known.laws[law].link], dt))
                .collect();
            before = Some(next);
        }
        Ok(None)
    }

    /// The area in m² of a law at the end of a step of the length `dt` in s, in equilibrium with a pressure drop in Pa.
    fn equilibrium_area(&self, known: &Known, law: usize, drop: f64, dt: f64) -> f64 {
        let (law, tension) = (&known.laws[law], self.space.terms.tension);
        let (resistance, without) = known.drops[law.link];
        law.curve.balanced_area(law.area, resistance / (tension * dt), (drop - without) / tension)
    }

    /// The same for a filling element that is not full: with one relaxation time, the inflow during a time d is a d/(1 + b d).
    fn filling(&self, known: &Known, path: &Path, law: usize, equilibrium: f64, about: f64, dt: f64) -> f64 {
        let law = &known.laws[law];
        let Some(full) = law.full.filter(|&full| !law.passes || about < full) else { return equilibrium };
        let (passed, rate) = (path.passed(law.link, path.dt), path.rate(law.link));
        let share = rate * path.dt / passed;
        let found = if share > 0.0 && share < 1.0 && passed > 0.0 {
            // share = 1/(1 + b d)
            let slowing = (1.0 / share - 1.0) / path.dt;
            law.area + passed / (share * path.dt) * dt / (1.0 + slowing * dt)
        } else {
            law.area + path.passed(law.link, dt)
        };
        if law.passes && found >= full { equilibrium.max(full) } else { found }
    }

    /// Line search between two sets of pressures: maximizes the concave dual function, whose derivatives are the residuals of the nodes.
    /// `None` if its maximum does not lie in between.
    fn damp(&self, known: &Known, [from, to]: [&Pressures; 2], dt: f64) -> Option<Pressures> {
        let change = |link: usize| to.drops[link] - from.drops[link];
        // Its derivative along the line is linear except for the capillary laws.
        let (mut level, mut rise) = (-(to.inlet - from.inlet) * known.sources.iter().sum::<f64>() * dt, 0.0);
        for (link, (resistance, drop)) in
            known.drops.iter().enumerate().filter(|(link, _)| known.law_of[*link].is_none())
        {
            level += change(link) * (from.drops[link] - drop) / resistance * dt;
            rise += change(link) * change(link) / resistance * dt;
        }
        let left = |share: f64| {
            let laws = known.laws.iter().enumerate().map(|(index, law)| {
                let drop = from.drops[law.link] + share * change(law.link);
                change(law.link) * (self.equilibrium_area(known, index, drop, dt) - law.area)
            });
            level + share * rise + laws.sum::<f64>()
        };
        let (at_start, at_end) = (left(0.0), left(1.0));
        if !(at_start < 0.0 && at_end > 0.0) {
            return None;
        }
        let share = root(|share| -left(share), [(0.0, -at_start), (1.0, -at_end)], 1e-6);
        Some(Pressures {
            drops: (0..to.drops.len()).map(|link| from.drops[link] + share * change(link)).collect(),
            inlet: from.inlet + share * (to.inlet - from.inlet),
        })
    }

    fn path<'a>(&self, graph: &'a Graph, known: &Known, about: &[f64], dt: f64) -> Result<Path<'a>, FlowError> {
        let (conductances, jumps) = self.conductors(known, about, dt);
        let factored = graph.laplacian.factor(conductances)?;
        let flow = factored.solve(&jumps, &known.sources)?;
        let mut changes = vec![0.0; jumps.len()];
        for (law, &about) in known.laws.iter().zip(about) {
            changes[law.link] = -self.space.terms.tension * law.curve.resistance(about).1 * flow.through[law.link];
        }
        let rates = factored.solve(&changes, &vec![0.0; graph.nodes])?;
        // With a stiff capillary law the drop is inaccurate from flows, with a small resistance from pressures.
        let drop = |link: usize| {
            let conductance = factored.conductances()[link];
            match known.law_of[link] {
                Some(_) => [&flow, &rates].map(|of| graph.laplacian.drop(link, &of.pressure)).into(),
                None => (flow.through[link] / conductance - jumps[link], rates.through[link] / conductance),
            }
        };
        let drops = (0..jumps.len()).map(drop).collect();
        Ok(Path { dt, flow, rates, drops, factored })
    }

    /// The length in s at the first zero of an event function within a range, with areas by law and length.
    fn first_along(
        &self,
        graph: &Graph,
        known: &Known,
        [least, most]: [f64; 2],
        area: impl Fn(usize, f64) -> f64,
    ) -> f64 {
        let value_of = |function: usize, dt: f64| {
            let area = |law| area(law, dt);
            let at = self.areas(graph, known, &area);
            self.value_of(&known.filling_pores, &known.event_functions[function], &at)
        };
        let mut first = most;
        for function in 0..known.event_functions.len() {
            let beyond = value_of(function, first);
            if beyond >= 0.0 || first <= least {
                continue;
            }
            let before = value_of(function, least);
            first = if before <= 0.0 {
                least
            } else {
                root(|dt| value_of(function, dt), [(least, before), (first, beyond)], EXACT)
            };
        }
        first
    }

    /// The step of the length `dt` in s along a path, if it ends at an event or has the length `longest`, and the linearization is accurate.
    fn accepted(
        &self,
        graph: &Graph,
        known: &Known,
        path: &Path,
        dt: f64,
        longest: f64,
    ) -> Result<Option<Trial>, FlowError> {
        let tension = self.space.terms.tension;
        let area = |law: usize| known.laws[law].area + path.passed(known.laws[law].link, dt);
        let matches = |(index, law): (usize, &CapillaryLaw)| {
            let curvature = law.curve.resistance(area(index)).0;
            let (resistance, without) = known.drops[law.link];
            let taken = resistance * path.passed(law.link, dt) / dt + tension * curvature + without;
            (taken - path.drop(law.link, dt)).abs() <= MATCHED * tension * law.scale
        };
        if !known.laws.iter().enumerate().all(matches) {
            return Ok(None);
        }
        let scale = tension * known.laws.iter().map(|law| law.scale).sum::<f64>() / known.laws.len().max(1) as f64;
        let flows = |(link, &(resistance, drop)): (usize, &(f64, f64))| {
            let viscous = resistance * path.passed(link, dt) / dt;
            known.law_of[link].is_some()
                || (viscous + drop - path.drop(link, dt)).abs() <= MATCHED * scale.max(viscous.abs())
        };
        if !known.drops.iter().enumerate().all(flows) {
            return Ok(None);
        }
        let mut flow = Flow {
            pressure: (0..graph.nodes).map(|node| path.pressure(node, dt)).collect(),
            through: (0..graph.links.len()).map(|link| path.passed(link, dt) / dt).collect(),
        };
        path.factored.balance(&mut flow, &known.sources)?;
        let values = self.values(graph, known, |law| known.laws[law].area + flow.through[known.laws[law].link] * dt);
        let trial = Trial { dt, flow, values };
        Ok(trial.ends(longest).then_some(trial))
    }
}

/// A root between two points with values above and below 0, by the Illinois variant of regula falsi.
fn root(value: impl Fn(f64) -> f64, [(mut low, mut above), (mut high, mut below)]: [(f64, f64); 2], exact: f64) -> f64 {
    const ROUNDS: usize = 60;
    let mut side = 0;
    for _ in 0..ROUNDS {
        let middle = (low * below - high * above) / (below - above);
        let middle = if middle > low && middle < high { middle } else { 0.5 * (low + high) };
        let found = value(middle);
        if found == 0.0 || high - low <= exact * high {
            return middle;
        }
        if found > 0.0 {
            (low, above) = (middle, found);
            if side == 1 {
                below *= 0.5;
            }
            side = 1;
        } else {
            (high, below) = (middle, found);
            if side == -1 {
                above *= 0.5;
            }
            side = -1;
        }
    }
    low
}
