//! Corner films along the half cycles: between events they swell or shrink with the capillary pressure, which adds points between events
//! to the curve of capillary pressure over saturation.

use super::cycles::{Cycles, tidy};
use super::films::{CurvePoint, ObservedFilms};

/// Curvatures in 1/m from one to another, including the last one, close enough for a smooth curve.
fn places_between(from: f64, to: f64) -> Vec<f64> {
    const RATIO: f64 = 0.05;
    const MOST: f64 = 64.0;
    let ratio = (to / from).ln();
    if from == to {
        return Vec::new();
    }
    if !(from > 0.0 && to > 0.0 && ratio.is_finite()) {
        return vec![to];
    }
    let count = (ratio.abs() / RATIO).ceil().clamp(1.0, MOST);
    (1..=count as u32)
        .map(|k| if f64::from(k) == count { to } else { from * (ratio * f64::from(k) / count).exp() })
        .collect()
}

impl Cycles {
    /// Sets the thickness of films by a curvature in the plane (1/m) into the defending phase; both phases otherwise stay in place.
    pub(super) fn set_film_curvature(&mut self, applied: f64) {
        let half = self.half_cycle();
        let Some(films) = &self.films else { return };
        let to = films.curvature_at(half.invading.towards_wetting(applied));
        let points: Vec<CurvePoint> = places_between(films.curvature, to)
            .into_iter()
            .map(|curvature| self.curve_point(curvature, films.area_at(curvature)))
            .collect();
        self.record.curve.extend(points);
        if let Some(films) = &mut self.films {
            films.curvature = to;
        }
    }

    /// Updates the films to the present phases and connections.
    pub(super) fn update_films(&mut self) {
        let changed = self.displacement.take_changed();
        self.update_films_of(changed.into_iter());
    }

    /// The same at the beginning of a displacement.
    pub(super) fn update_all_films(&mut self) {
        if self.films.is_some() {
            self.displacement.watch_changes();
        }
        self.update_films_of(0..self.displacement.elements().len());
    }

    fn update_films_of(&mut self, elements: impl Iterator<Item = usize>) {
        let invading = self.half_cycle().invading;
        let Some(films) = &mut self.films else { return };
        films.update(&self.displacement, invading, elements);
        let curvature = films.curvature;
        self.film_area = films.area();
        if curvature.is_finite() {
            self.record.curve.push(self.curve_point(curvature, self.film_area));
        }
    }

    fn curve_point(&self, curvature: f64, films: f64) -> CurvePoint {
        CurvePoint {
            half_cycle: self.half_cycle,
            curvature,
            saturation: tidy((self.counted_wetting + films) / self.counted.sum),
            film_saturation: films / self.counted.sum,
        }
    }

    /// After the last event, films follow to the pressure at which the half cycle ends, if given.
    pub(super) fn raise_to_final_pressure(&mut self) {
        let half = self.half_cycle();
        let end = half.conditions.largest_curvature;
        if self.films.is_none() || !end.is_finite() || self.record.outcomes[self.half_cycle].last.is_some() {
            return;
        }
        let applied = half.invading.towards_wetting(end);
        self.set_film_curvature(end);
        self.displacement.apply(end);
        self.update_films();
        self.note_changes(&[]);
        self.record.outcomes[self.half_cycle].last = Some(applied);
    }

    /// Corner films as a fraction of the pore space.
    pub(crate) fn film_saturation(&self) -> f64 {
        self.film_area / self.counted.sum
    }

    /// Whether there are films in corners.
    pub(crate) fn has_films(&self) -> bool {
        self.films.is_some()
    }

    /// Films for pictures and tables.
    pub(crate) fn observed_films(&self) -> Option<ObservedFilms> {
        self.films.as_ref().map(|films| films.observed(&self.displacement))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::setup::build_quasi_static;
    use meniscus_case::{Model, load};
    use meniscus_core::input::Overrides;

    #[test]
    fn films_of_what_an_event_changes_are_those_of_all_elements() {
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/network/carbon-dioxide.toml");
        let kinds = [
            "network.films='rings'",
            "network.films='joined'",
            "network.trapping=false",
            "network.wetting.hysteresis.advancing-angle-deg=30.0",
        ];
        for kind in kinds {
            let set = Overrides::parse(&[kind, "network.cycles=2"]).unwrap();
            let case = load(&case, &set).unwrap().case;
            let Model::Network(wanted) = &case.model else { panic!("a network") };
            let mut cycles = build_quasi_static(&case, wanted).unwrap().cycles().unwrap().clone();
            let mut events = 0;
            loop {
                let films = cycles.films.as_ref().unwrap();
                let mut all = films.clone();
                all.log.clear();
                all.update(&cycles.displacement, cycles.half_cycle().invading, 0..cycles.displacement.elements().len());
                assert!(all.log.is_empty(), "{kind}, after {events} events: {:?}", all.log);
                assert!(all.is_as(films), "{kind}, after {events} events");
                let (found, each) = (films.area(), films.area_of_each(films.curvature));
                assert!((found - each).abs() <= 1.8e-15 * each, "{kind}, after {events} events: {found} {each}");
                if cycles.advance().is_none() {
                    break;
                }
                events += 1;
            }
            assert!(events > 100, "{kind}");
        }
    }
}
