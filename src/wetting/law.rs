//! What a wetting law is: parameters with keys, units and ranges, and the angle that follows from them.
//!
//! The file of a law declares its parameters by `law!`, once. From that come the law, whose values are there and in range; its table in
//! a case file (`raw`), in which every key is optional, so that one mistake does not hide another; the check that leads from the
//! one to the other, and the way back. Parameters keep the units of their keys, angles in degrees and temperatures in °C; the report tells them
//! in SI units and radians.

use crate::input::tables::Key;
use crate::input::{Checker, Problem};

/// What a law sees of a contact line.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LineState {
    /// Angle in rad, through the wetting phase, at which the interface meets the wall where the line stands.
    pub present: f64,
    /// Speed U of the line in m/s relative to the wall, positive where the wetting phase advances.
    pub speed: f64,
    /// Interfacial tension σ_wn in N/m.
    pub tension: f64,
    /// Dynamic viscosity of the wetting phase in Pa s.
    pub viscosity: f64,
    /// Dynamic viscosity of the other phase in Pa s.
    pub other_viscosity: f64,
    /// Length in m over which the numerical method sees the angle: that of the circle fit, the smoothing length h.
    pub length: f64,
    /// Slip length in m that the flow has on walls near the line.
    pub slip_length: f64,
}

impl LineState {
    /// Ca = μ U/σ.
    pub(crate) fn capillary_number(&self) -> f64 {
        self.viscosity * self.speed / self.tension
    }

    /// The angle in rad with (cos θ_e − cos θ_d)/(cos θ_e + 1) = `change` on a line that advances from the `static_angle` θ_e, and minus that
    /// on one that recedes.
    pub(crate) fn angle_by_change_of_cosine(&self, static_angle: f64, change: f64) -> f64 {
        let cos_e = static_angle.cos();
        (cos_e - ((cos_e + 1.0) * change).copysign(self.speed)).clamp(-1.0, 1.0).acos()
    }
}

/// A wetting law. Angles are in rad, through the wetting phase.
pub(crate) trait WettingModel: Parameters {
    /// The angle at which the interface is to meet the wall.
    fn angle(&self, line: &LineState) -> f64;

    /// The angle at rest; with hysteresis the one of equilibrium.
    fn static_angle(&self) -> f64;

    /// The angles between which a line at rest can stand: receding and advancing, equal but for a hysteresis range.
    fn hysteresis_range(&self) -> [f64; 2] {
        [self.static_angle(); 2]
    }

    /// Whether the line stays where it stands while its angle is within the hysteresis range.
    fn pins(&self) -> bool {
        false
    }

    /// Whether the angle depends on the speed of the line.
    fn is_dynamic(&self) -> bool {
        true
    }

    /// What is wrong with the parameters together, each of them in its range; the path is a key.
    fn contradiction(&self) -> Option<Problem> {
        None
    }
}

/// A value in SI units and radians whose key has another unit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InSi {
    /// Its name.
    pub name: &'static str,
    /// The value, from that of the key.
    pub of: fn(f64) -> f64,
}

/// A parameter of a law.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parameter {
    /// What its key may hold.
    pub(crate) key: Key,
    /// In SI units and radians, where its key has another unit.
    pub si: Option<InSi>,
}

impl Parameter {
    /// A static contact angle.
    pub(crate) const CONTACT_ANGLE: Self = Self::angle("contact_angle", "contact-angle-deg = 40.0");
    /// An advancing contact angle.
    pub(crate) const ADVANCING_ANGLE: Self = Self::angle("advancing", "advancing-angle-deg = 60.0");
    /// A receding contact angle.
    pub(crate) const RECEDING_ANGLE: Self = Self::angle("receding", "receding-angle-deg = 40.0");

    /// An angle in degrees, 0 to 180; `name` is that of the angle in rad.
    const fn angle(name: &'static str, example: &'static str) -> Self {
        let key = Key::within("an angle in degrees", 0.0, 180.0).example(example);
        Self { key, si: Some(InSi { name, of: f64::to_radians }) }
    }

    /// A number above zero.
    pub(crate) const fn positive(what: &'static str, example: &'static str) -> Self {
        Self { key: Key::positive(what).example(example), si: None }
    }

    /// Name and value in SI units and radians of what is the `value` of `field`.
    pub(crate) fn in_si(&self, field: &'static str, value: f64) -> (&'static str, f64) {
        self.si.map_or((field, value), |si| (si.name, (si.of)(value)))
    }
}

/// The parameters of a law as `law!` declares them.
pub(crate) trait Parameters: Sized {
    /// Its table in a case file.
    type Raw;
    /// What the law says and, in parentheses, who found it.
    const ABOUT: &'static str;
    /// Its fields and what their keys may hold.
    const KEYS: &'static [(&'static str, Key)];

    /// The law, where all of its parameters are there and in range; `at` is the key path of the table.
    fn checked(raw: &Self::Raw, checker: &mut Checker, at: &str) -> Option<Self>;

    /// The table that says the same.
    fn raw(&self) -> Self::Raw;

    /// Keys and values of the table.
    fn entries(raw: &mut Self::Raw) -> Vec<(String, &mut Option<f64>)>;
}

/// The law whose parameters are there, in range and without a contradiction; `at` is the key path of its table.
pub(super) fn checked<L: WettingModel>(raw: &L::Raw, checker: &mut Checker, at: &str) -> Option<L> {
    let law = L::checked(raw, checker, at)?;
    if let Some(Problem { path, message, help }) = law.contradiction() {
        checker.refuse(format!("{at}.{path}"), message, help);
        return None;
    }
    Some(law)
}

/// The same law with other angles, by key, which stand in the table at the key path `at`.
pub(super) fn with_angles<L: WettingModel>(
    law: &L,
    checker: &mut Checker,
    at: &str,
    angles: &[(&str, Option<f64>)],
) -> Option<L> {
    let mut raw = law.raw();
    for (key, value) in L::entries(&mut raw).into_iter().filter(|(key, _)| is_angle(key)) {
        *value = angles.iter().find(|(name, _)| *name == key).and_then(|(_, given)| *given);
    }
    checked(&raw, checker, at)
}

/// The parameter of a key, in the unit of that key.
pub(super) fn parameter<L: WettingModel>(law: &L, key: &str) -> Option<f64> {
    let mut raw = law.raw();
    L::entries(&mut raw).into_iter().find(|(name, _)| name == key).and_then(|(_, value)| *value)
}

/// Whether a key is an angle: patches of walls have angles of their own, and the other parameters of the model.
pub(super) fn is_angle(key: &str) -> bool {
    key.ends_with("angle-deg")
}

/// Declares the parameters of a law: the comment on the law ends with its source in parentheses, those on its fields are the reference
/// of the case file, and a field is followed by its [`Parameter`].
macro_rules! law {
    (
        $(#[doc = $about:literal])+
        pub struct $law:ident {
            $($(#[doc = $doc:literal])+ pub $field:ident: $parameter:expr,)+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $law {
            $($(#[doc = $doc])+ pub $field: f64,)+
        }

        /// In SI units and radians, as the report tells it.
        impl serde::Serialize for $law {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_map([$($parameter.in_si(stringify!($field), self.$field),)+])
            }
        }

        /// The table of the law in a case file.
        pub(super) mod raw {
            use super::*;

            $crate::input::tables::tables! {
                $(#[doc = $about])+
                pub(crate) struct $law { $($(#[doc = $doc])+ pub $field: f64 => $parameter.key,)+ }
            }
        }

        impl $crate::wetting::law::Parameters for $law {
            type Raw = raw::$law;
            const ABOUT: &'static str = concat!($($about),+);
            const KEYS: &'static [(&'static str, $crate::input::tables::Key)] = raw::$law::KEYS;

            fn checked(raw: &Self::Raw, checker: &mut $crate::input::Checker, at: &str) -> Option<Self> {
                let raw = raw.clone().in_range(checker, at);
                Some(Self { $($field: raw.$field.or($parameter.key.default)?,)+ })
            }

            fn raw(&self) -> Self::Raw {
                raw::$law { $($field: Some(self.$field),)+ }
            }

            fn entries(raw: &mut Self::Raw) -> Vec<(String, &mut Option<f64>)> {
                vec![$(($crate::input::tables::name(stringify!($field)), &mut raw.$field),)+]
            }
        }
    };
}
pub(super) use law;
