//! Measures in a study file: expectations, trends, curves and maps, which refer to parameters by the names of the axes.

use std::collections::BTreeMap;

use toml::Value;

use super::definition::{Axis, Choice, Curve, Expectation, MapPlan, Quantity, ReportPlan, Sampling, Trend};
use super::raw::{RawCurve, RawExpectation, RawMap, RawReport, RawTrend};
use super::values::{number_of, numbers, same, shown};
use meniscus_core::input::tables::Key;
use meniscus_core::input::{Checker, nearest};

/// The parameters that expectations and curves can refer to.
pub(super) struct Names<'a> {
    /// The axes.
    pub(crate) axes: &'a [Axis],
    /// The samples, if any.
    pub(crate) sampling: Option<&'a Sampling>,
    /// Whether all axes are valid.
    pub(crate) complete: bool,
}

impl Names<'_> {
    fn is_known(&self, name: &str) -> bool {
        !self.complete || self.values(name).is_some()
    }

    fn values(&self, name: &str) -> Option<&[Value]> {
        self.axes.iter().flat_map(|axis| &axis.columns).find(|column| column.name == name).map(|c| c.values.as_slice())
    }

    /// Whether all values of a parameter are numbers; true if not known.
    fn is_numeric(&self, name: &str) -> bool {
        self.values(name).is_none_or(|values| values.iter().all(|value| number_of(value).is_some()))
    }

    fn refuse_unknown(&self, checker: &mut Checker, at: &str, name: &str) {
        let known: Vec<&str> = self.axes.iter().flat_map(|axis| &axis.columns).map(|c| c.name.as_str()).collect();
        let meant =
            nearest(name, known.iter().copied()).map_or(String::new(), |near| format!("did you mean `{near}`? "));
        let list = if known.is_empty() { "there are none".to_owned() } else { known.join(", ") };
        checker.refuse(at, format!("`{name}` is not a parameter of this study"), format!("{meant}parameters: {list}"));
    }

    fn parameter(&self, checker: &mut Checker, at: &str, name: &str) -> Option<String> {
        if !self.is_known(name) {
            self.refuse_unknown(checker, at, name);
            return None;
        }
        Some(name.to_owned())
    }

    /// A numeric parameter.
    fn numeric(&self, checker: &mut Checker, at: &str, name: &str) -> Option<String> {
        let name = self.parameter(checker, at, name)?;
        if !self.is_numeric(&name) {
            checker.refuse(at, format!("expected a parameter with numbers, `{name}` has others"), "");
            return None;
        }
        Some(name)
    }

    fn quantity(&self, checker: &mut Checker, at: &str, value: &Value) -> Option<Quantity> {
        match value {
            Value::String(name) => self.numeric(checker, at, name).map(Quantity::Parameter),
            other => match number_of(other) {
                Some(number) => Some(Quantity::Number(number)),
                None => {
                    let found = other.type_str();
                    checker.refuse(at, format!("expected a number or the name of a parameter, found {found}"), "");
                    None
                }
            },
        }
    }

    fn choice(&self, checker: &mut Checker, at: &str, only: Option<&BTreeMap<String, Value>>) -> Option<Choice> {
        let mut chosen = Some(Vec::new());
        for (name, value) in only.into_iter().flatten() {
            let at = format!("{at}.where.{name}");
            let Some(name) = self.parameter(checker, &at, name) else {
                chosen = None;
                continue;
            };
            if self.values(&name).is_some_and(|values| !values.iter().any(|other| same(other, value))) {
                checker.refuse(&at, format!("`{name}` is never {}", shown(value)), "name one of its values");
                chosen = None;
            }
            if let Some(chosen) = &mut chosen {
                chosen.push((name, value.clone()));
            }
        }
        chosen.map(Choice)
    }

    pub(crate) fn expectation(&self, checker: &mut Checker, raw: &RawExpectation, at: &str) -> Option<Expectation> {
        let key = format!("{at}.value");
        let value = raw.value.as_ref().and_then(|value| self.quantity(checker, &key, value));
        let key = format!("{at}.tolerance");
        let tolerance = raw.tolerance.as_ref().and_then(|value| self.quantity(checker, &key, value));
        if let Some(Quantity::Number(number)) = tolerance {
            Key::positive("a tolerance").checked(checker, at, "tolerance", Some(number));
        }
        let only = self.choice(checker, at, raw.only.as_ref());
        Some(Expectation { measure: raw.measure.clone()?, value: value?, tolerance: tolerance?, only: only? })
    }

    pub(crate) fn trend(&self, checker: &mut Checker, raw: &RawTrend, at: &str) -> Option<Trend> {
        let reference = match &raw.reference {
            Some(value) => self.quantity(checker, &format!("{at}.reference"), value),
            None => Some(Quantity::Number(0.0)),
        };
        let key = format!("{at}.along");
        let along = raw.along.as_ref().and_then(|name| self.numeric(checker, &key, name));
        let only = self.choice(checker, at, raw.only.as_ref());
        Some(Trend {
            measure: raw.measure.clone()?,
            reference: reference?,
            along: along?,
            order: raw.order,
            floor: raw.floor.unwrap_or(0.0),
            only: only?,
        })
    }

    pub(crate) fn report(&self, checker: &mut Checker, raw: Option<&RawReport>) -> Option<ReportPlan> {
        let raw = raw.cloned().unwrap_or_default();
        let curves = raw.curve.iter().flatten().enumerate();
        let curves: Vec<Option<Curve>> =
            curves.map(|(index, raw)| self.curve(checker, raw, &format!("report.curve[{index}]"))).collect();
        let maps = raw.map.iter().flatten().enumerate();
        let maps: Vec<Option<MapPlan>> =
            maps.map(|(index, raw)| self.map(checker, raw, &format!("report.map[{index}]"))).collect();
        Some(ReportPlan {
            measures: raw.measures,
            curves: curves.into_iter().collect::<Option<_>>()?,
            maps: maps.into_iter().collect::<Option<_>>()?,
            pictures: raw.pictures.unwrap_or(true),
        })
    }

    fn curve(&self, checker: &mut Checker, raw: &RawCurve, at: &str) -> Option<Curve> {
        if let Some(x) = raw.x.as_deref().filter(|x| !self.is_numeric(x)) {
            checker.refuse(format!("{at}.x"), format!("expected a parameter with numbers, `{x}` has others"), "");
        }
        let series = match &raw.series {
            Some(name) => Some(self.parameter(checker, &format!("{at}.series"), name)?),
            None => None,
        };
        let reference = match &raw.reference {
            Some(value) => Some(self.quantity(checker, &format!("{at}.reference"), value)?),
            None => None,
        };
        let (x, y) = (raw.x.clone()?, raw.y.clone()?);
        let error = raw.error.unwrap_or(false);
        Some(Curve {
            title: raw.title.clone(),
            x,
            y,
            series,
            reference,
            error,
            x_scale: raw.x_scale.unwrap_or_default(),
            y_scale: raw.y_scale.unwrap_or_default(),
        })
    }

    /// A parameter along an axis of a map.
    fn side(&self, checker: &mut Checker, at: &str, name: &str) -> Option<String> {
        let name = self.numeric(checker, at, name)?;
        if self.sampling.is_some_and(|sampling| sampling.has(&name)) {
            let message = format!("expected a parameter with values or a range, `{name}` is sampled");
            checker.refuse(at, message, "give its axis `values` or a `range` in place of its distribution");
        } else if self.values(&name).is_some_and(|values| numbers(values).len() < 2) {
            checker.refuse(at, format!("expected a parameter with several values, `{name}` has one"), "");
        }
        Some(name)
    }

    fn map(&self, checker: &mut Checker, raw: &RawMap, at: &str) -> Option<MapPlan> {
        let x = raw.x.as_ref().map(|name| self.side(checker, &format!("{at}.x"), name));
        let y = raw.y.as_ref().map(|name| self.side(checker, &format!("{at}.y"), name));
        let (x, y) = (x??, y??);
        if x == y {
            let others: Vec<&str> = self.axes.iter().flat_map(|axis| &axis.columns).map(|c| c.name.as_str()).collect();
            let others = others.into_iter().filter(|name| *name != x && self.is_numeric(name)).collect::<Vec<_>>();
            let help = match &others[..] {
                [] => "the study has no other parameter with numbers: draw a curve".to_owned(),
                others => format!("name another parameter: {}", others.join(", ")),
            };
            checker.refuse(format!("{at}.y"), format!("`{y}` is along x already"), help);
        }
        Some(MapPlan {
            title: raw.title.clone(),
            x,
            y,
            measure: raw.measure.clone()?,
            x_scale: raw.x_scale.unwrap_or_default(),
            y_scale: raw.y_scale.unwrap_or_default(),
            scale: raw.scale.unwrap_or_default(),
        })
    }
}
