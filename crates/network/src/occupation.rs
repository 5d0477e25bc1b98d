//! The state of a displacement at one moment for output, quasi-static or dynamic.

use std::borrow::Cow;

use super::cycles::{Cycles, FluidPhase, Invasion};
use super::displacement::{Displacement, Element, Phase};
use super::films::ObservedFilms;
use super::model::Configuration;
use meniscus_core::diagram::Through;
use meniscus_core::math::Vec2;

/// Phases of all elements, and their history.
#[derive(Debug, Clone)]
pub(crate) struct Occupation<'a> {
    /// The displacement, for its elements.
    pub(crate) displacement: &'a Displacement,
    /// The invading phase.
    pub(crate) invading: FluidPhase,
    /// Its saturation in each element.
    pub(crate) share: Vec<f64>,
    /// Whether an element holds the other phase without a path to the outlet.
    pub(crate) trapped: Vec<bool>,
    /// Invasions of elements in this displacement or half cycle, with the curvature in the plane towards the wetting phase.
    pub(crate) invasions: Cow<'a, [Option<Invasion>]>,
    /// The throat passed by each event of this displacement or half cycle, in order.
    pub(crate) passed: Vec<Option<usize>>,
    /// Direction in which the invading phase drives the flow through the left, right, bottom and top side; `None` if a side is closed.
    pub(crate) open: [Option<Through>; 4],
    /// Index of the half cycle.
    pub(crate) half_cycle: usize,
    /// The corner films, if any.
    pub(crate) films: Option<ObservedFilms>,
}

impl Occupation<'_> {
    /// The elements; they tile the pore space.
    pub(crate) fn elements(&self) -> &[Element] {
        self.displacement.elements()
    }

    /// Whether the invading phase holds most of an element.
    pub(crate) fn is_invaded(&self, element: usize) -> bool {
        self.share[element] > 0.5
    }

    /// The fluid that holds most of an element.
    pub(crate) fn fluid(&self, element: usize) -> FluidPhase {
        if self.is_invaded(element) { self.invading } else { self.invading.other() }
    }
}

impl Cycles {
    /// The present state.
    pub(crate) fn occupation(&self) -> Occupation<'_> {
        Occupation { films: self.observed_films(), ..self.occupation_without_films() }
    }

    /// The same, but for the lines of films in pictures.
    pub(crate) fn occupation_without_films(&self) -> Occupation<'_> {
        let displacement = &self.displacement;
        let elements = displacement.elements();
        let present = self.history().iter().filter(|entry| entry.half_cycle == self.half_cycle_index());
        Occupation {
            displacement,
            invading: self.half_cycle().invading,
            share: (0..elements.len()).map(|e| f64::from(u8::from(displacement.phase(e) == Phase::Invading))).collect(),
            trapped: (0..elements.len()).map(|e| displacement.is_trapped(e)).collect(),
            invasions: (&self.record.invasions[..]).into(),
            passed: present.map(|entry| entry.throat).collect(),
            open: self.half_cycle().open_sides(),
            half_cycle: self.half_cycle_index(),
            films: None,
        }
    }

    /// The half cycle with its saturation and capillary pressure, as text.
    pub(crate) fn progress(&self, config: &Configuration) -> String {
        let (half, number) = (self.half_cycle(), self.half_cycle_index() / 2 + 1);
        let pressure = self.applied().map(|applied| config.pressure(half.invading, applied)).filter(|p| p.is_finite());
        // Four digits.
        let rounded = |pressure: f64| format!("{pressure:.3e}").parse().unwrap_or(pressure);
        let pressure = pressure.map_or(String::new(), |p| format!(", capillary pressure {} Pa", rounded(p)));
        format!("{} {number}: wetting saturation {:.3}{pressure}", half.invading.process(), self.saturation())
    }

    /// All interfaces at the applied pressure, those around trapped regions included, each a polyline in m.
    pub(crate) fn all_menisci(&self, config: &Configuration) -> Vec<Vec<Vec2>> {
        const POINTS: u32 = 17;
        let (displacement, half) = (&self.displacement, self.half_cycle());
        let resting = displacement
            .resting_curvature(self.applied().map_or(0.0, |applied| half.invading.towards_wetting(applied)));
        let interfaces = displacement.interfaces(resting, config.bounds, config.periodic);
        let point = |k: u32| f64::from(k) / f64::from(POINTS - 1);
        interfaces.menisci.iter().map(|it| (0..POINTS).map(|k| it.curve.point(point(k))).collect()).collect()
    }

    /// The menisci at the applied pressure, each a polyline in m.
    pub(crate) fn menisci(&self) -> Vec<Vec<Vec2>> {
        let applied = self.applied().map_or(0.0, |applied| self.half_cycle().invading.towards_wetting(applied));
        self.displacement.menisci(applied)
    }
}
