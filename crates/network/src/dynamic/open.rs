//! Pores at open sides: filling pores at the inlet, and the invading phase between throat and outlet side.
//!
//! A meniscus past its event in a pore at the outlet advances along the walls until it touches the outlet side, where the invading phase
//! leaves. Until then it has the curvature at which it touches.

use super::capillary_curve::{CapillaryCurve, Reach};
use super::{Breakthrough, Dynamic, Meniscus};
use crate::cycles::Invasion;
use crate::displacement::FrontId;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::Curve;

impl Dynamic {
    /// Whether each element holds the defending phase and is open at given sides.
    pub(super) fn defending_at(&self, sides: [bool; 4]) -> Vec<bool> {
        let mut found = vec![false; self.displacement.elements().len()];
        for &(opening, element) in &self.space.openings {
            found[element] |= sides[self.space.network.openings[opening].side] && !self.is_invaded(element);
        }
        found
    }

    /// By gate and end, for gates into elements that are open at the outlet and not at the inlet.
    pub(super) fn reaches(&self) -> Vec<[Option<Reach>; 2]> {
        let of = |gate: usize| {
            [0, 1].map(|end| {
                if self.space.is_outlet[self.space.gates[gate].elements[end]] { self.reach((gate, end)) } else { None }
            })
        };
        (0..self.space.gates.len()).map(of).collect()
    }

    fn reach(&self, front: FrontId) -> Option<Reach> {
        let element = self.ahead_of(front);
        let (passage, own) = self.displacement.future_front(front);
        let event = self.curve(front, &passage, own)?.end().0;
        let lines =
            self.space.openings.iter().filter(|(_, at)| *at == element).filter_map(|(opening, _)| self.side(*opening));
        let touches =
            lines.filter_map(|line| passage.reach(&line)).map(|found| (passage.swept_area(&found), found.curvature));
        let (area, curvature) = touches.min_by(|a, b| a.0.total_cmp(&b.0))?;
        // The swept area never exceeds that of the element.
        let most = self.displacement.elements()[element].area.max(event);
        let curve = CapillaryCurve::level([event, event + most], curvature.min(own), self.space.gates[front.0].width);
        Some(Reach { area, curve: curve.between(&self.space.terms) })
    }

    /// An opening of the outlet as a line with the pore on its right.
    fn side(&self, opening: usize) -> Option<Curve> {
        let opening = &self.space.network.openings[opening];
        let [a, b] = opening.ends;
        let mut inwards = Vec2::zeros();
        inwards[opening.side / 2] = if opening.side.is_multiple_of(2) { 1.0 } else { -1.0 };
        let is_forward = (b - a).dot(&perpendicular(inwards)) > 0.0;
        self.space.terms.outlet[opening.side].then_some(if is_forward {
            Curve::Segment { a, b }
        } else {
            Curve::Segment { a: b, b: a }
        })
    }

    /// A meniscus past its event that has not yet touched the outlet, with its capillary curve.
    pub(super) fn approaching_outlet(&self, (gate, end): FrontId) -> Option<(Meniscus, &Reach)> {
        let meniscus = self.state.menisci[gate][end].filter(|meniscus| meniscus.has_burst && !meniscus.has_left)?;
        Some((meniscus, self.space.reaches[gate][end].as_ref()?))
    }

    /// All menisci past their events that have not yet touched the outlet.
    pub(super) fn all_approaching_outlet(&self) -> Vec<FrontId> {
        let gates = (0..self.space.gates.len()).flat_map(|gate| [(gate, 0), (gate, 1)]);
        gates.filter(|&front| self.approaching_outlet(front).is_some()).collect()
    }

    /// Area in m² left until a meniscus touches the outlet or the element is full, with areas by front.
    pub(super) fn remaining_to_outlet(&self, front: FrontId, area: impl Fn(FrontId) -> f64) -> f64 {
        let element = self.ahead_of(front);
        let reach = self.space.reaches[front.0][front.1].as_ref().map_or(0.0, |reach| reach.area);
        let room = self.displacement.elements()[element].area - self.in_outlet(element, &area);
        room.min(reach - area(front))
    }

    /// Area in m² of the invading phase in an element at the outlet, with areas by front.
    fn in_outlet(&self, element: usize, area: impl Fn(FrontId) -> f64) -> f64 {
        let gates = self.displacement.gates_of(element).iter();
        gates.filter(|(gate, end)| self.state.menisci[*gate][*end].is_some()).map(|&front| area(front)).sum()
    }

    /// Area in m² of menisci past their events in an element at the outlet.
    pub(super) fn passed_in_outlet(&self, element: usize) -> f64 {
        if !self.space.is_outlet[element] {
            return 0.0;
        }
        let menisci =
            self.displacement.gates_of(element).iter().filter_map(|&(gate, end)| self.state.menisci[gate][end]);
        menisci.filter(|meniscus| meniscus.has_burst).map(|meniscus| meniscus.area).sum()
    }

    /// A meniscus touches the outlet: further inflow leaves.
    pub(super) fn leave(&mut self, (gate, end): FrontId) {
        if let Some(meniscus) = &mut self.state.menisci[gate][end] {
            meniscus.has_left = true;
        }
        self.graph = None;
        if self.state.breakthrough.is_none() {
            self.state.breakthrough = Some(Breakthrough {
                time: self.state.time,
                saturation: self.invading_area() / self.space.pore_area,
                pressure: self.state.pressure,
            });
        }
    }

    /// The same displacement with an initial saturation `share` of the invading phase, in the elements open at the inlet and equal in each;
    /// the displacement must have been created without these.
    ///
    /// # Errors
    /// Their share of the pore space if it is less than `share`.
    pub fn beginning_with(mut self, share: f64) -> Result<Self, f64> {
        self.space.is_inlet = self.defending_at(self.space.terms.inlet);
        self.space.under_disc.iter().for_each(|&element| self.space.is_inlet[element] = true);
        let elements: Vec<usize> =
            (0..self.space.is_inlet.len()).filter(|&element| self.space.is_inlet[element]).collect();
        let area_of = |element: usize| self.displacement.elements()[element].area;
        let most = elements.iter().map(|&element| area_of(element)).sum::<f64>() / self.space.pore_area;
        // NaN if no pore is open.
        if !(share <= most) {
            return Err(most);
        }
        let areas: Vec<(usize, f64)> =
            elements.iter().map(|&element| (element, share / most * area_of(element))).collect();
        for (element, area) in areas {
            self.begin_filling(element, f64::INFINITY, false);
            if let Some(filling) = &mut self.state.filling[element] {
                filling.area = area;
            }
            self.space.is_outlet[element] = false;
        }
        self.space.first_area = self.invading_area();
        for element in elements {
            self.state.invasions[element] = Some(Invasion { sequence: 0, applied: f64::NAN, displaced: share });
        }
        Ok(self)
    }
}
