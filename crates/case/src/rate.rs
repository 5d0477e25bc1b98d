//! Flow rates: numbers in SI units, or texts with a unit such as `"5 uL/min"`, as pumps show them.

use std::fmt;

use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, Value};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Units of volume in m³ and of area in m², in lower case, µ written as u.
const VOLUMES: [(&str, f64); 9] = [
    ("m3", 1.0),
    ("cm3", 1.0e-6),
    ("mm3", 1.0e-9),
    ("um3", 1.0e-18),
    ("l", 1.0e-3),
    ("ml", 1.0e-6),
    ("ul", 1.0e-9),
    ("nl", 1.0e-12),
    ("pl", 1.0e-15),
];
const AREAS: [(&str, f64); 4] = [("m2", 1.0), ("cm2", 1.0e-4), ("mm2", 1.0e-6), ("um2", 1.0e-12)];
/// Units of time in s.
const TIMES: [(&str, f64); 5] = [("s", 1.0), ("min", 60.0), ("h", 3600.0), ("hr", 3600.0), ("day", 86400.0)];

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Volume,
    Area,
}

/// A flow rate in m³/s, or in m²/s per meter of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rate {
    value: f64,
    /// That of its unit, if it was written with one.
    of: Option<Of>,
}

impl Rate {
    /// The number in SI units.
    pub(crate) fn value(self) -> f64 {
        self.value
    }

    /// A problem at `path` if its unit is not that of a chip with or without a depth.
    pub(super) fn refuse_other_unit(self, checker: &mut Checker, path: &str, has_depth: bool) {
        match (self.of, has_depth) {
            (Some(Of::Volume), false) => {
                let message = "a rate in volume per time needs the depth of the chip, and none is given";
                checker.refuse(path, message, "add depth = 50e-6 # m to [geometry], or give m2/s per meter of depth");
            }
            (Some(Of::Area), true) => {
                let message = "a rate in area per time is one per meter of depth, and the chip has a depth";
                checker.refuse(path, message, "give the volume per time, as in \"5 uL/min\"");
            }
            _ => {}
        }
    }

    fn parse(text: &str) -> Option<Self> {
        let text = text.trim().replace(['µ', 'μ'], "u").replace('²', "2").replace('³', "3").replace('^', "");
        let start = text
            .find(|letter: char| letter.is_whitespace())
            .or_else(|| text.find(['m', 'u', 'n', 'p', 'c', 'l', 'L']))?;
        let number: f64 = text[..start].trim().parse().ok()?;
        let (amount, time) = text[start..].trim().split_once('/')?;
        let of = |units: &[(&str, f64)], name: &str| {
            let name = name.trim().to_ascii_lowercase();
            units.iter().find(|unit| unit.0 == name).map(|unit| unit.1)
        };
        let seconds = of(&TIMES, time)?;
        let (amount, kind) = match of(&VOLUMES, amount) {
            Some(volume) => (volume, Of::Volume),
            None => (of(&AREAS, amount)?, Of::Area),
        };
        Some(Self { value: number * amount / seconds, of: Some(kind) }).filter(|rate| rate.value.is_finite())
    }
}

impl Serialize for Rate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Rate {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrText;
        impl Visitor<'_> for NumberOrText {
            type Value = Rate;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a rate in SI units or with its unit, as in 3.0e-12 or \"5 uL/min\" (m3, cm3, mm3, mL, uL, nL, mm2 per s, min, h)")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Rate, E> {
                Ok(Rate { value, of: None })
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Rate, E> {
                self.visit_f64(value as f64)
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Rate, E> {
                Rate::parse(text).ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(text), &self))
            }
        }
        deserializer.deserialize_any(NumberOrText)
    }
}

impl schemars::JsonSchema for Rate {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Rate".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": ["number", "string"] })
    }

    fn inline_schema() -> bool {
        true
    }
}

impl Value for Rate {
    fn checked(self, key: &Key, checker: &mut Checker, path: &str) -> Option<Self> {
        self.value.checked(key, checker, path).map(|_| self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_read_in_the_units_of_pumps() {
        let read = |text: &str| Rate::parse(text).map(Rate::value);
        let minute = 1.0e-9 / 60.0;
        for text in
            ["1 uL/min", "1 µL/min", "1ul/min", "1.0 μl / min", "1e-3 mL/min", "1 mm3/min", "1 mm^3/min", "1 mm³/min"]
        {
            let found = read(text).unwrap();
            assert!((found / minute - 1.0).abs() < 1e-14, "{text}: {found}");
        }
        assert_eq!(read("2 mm²/s"), Some(2.0e-6));
        assert_eq!(read("3.6 nL/h"), Some(3.6 * 1.0e-12 / 3600.0));
        for text in ["", "uL/min", "1", "1 uL", "1 uL/week", "1 kg/s", "one uL/min", "1 uL/min/m", "inf uL/min"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
