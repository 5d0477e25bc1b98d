//! Definition of a wetting law: parameters with keys, units and ranges, and the angle that follows from them.
//!
//! The file of a law declares its parameters once, by `law!`. The macro generates the law, whose values are present and in range; its table in a case file
//! (`raw`), in which every key is optional, so that one mistake does not hide another; and the conversion in both directions, with its checks. Parameters
//! keep the units of their keys, angles in degrees and temperatures in °C; the report has them in SI units and radians.

use meniscus_core::input::tables::Key;
use meniscus_core::input::{Checker, Problem};

/// The state of a contact line, the argument of a law.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LineState {
    /// Angle in rad, through the wetting phase, at which the interface meets the wall at the line.
    pub present: f64,
    /// Speed U of the line in m/s relative to the wall, positive where the wetting phase advances.
    pub speed: f64,
    /// Interfacial tension σ_wn in N/m.
    pub tension: f64,
    /// Dynamic viscosity of the wetting phase in Pa s.
    pub viscosity: f64,
    /// Dynamic viscosity of the other phase in Pa s.
    pub other_viscosity: f64,
    /// Length in m over which the numerical method resolves the angle: that of the circle fit, the smoothing length h.
    pub length: f64,
    /// Slip length in m of the simulated flow on walls near the line.
    pub slip_length: f64,
}

impl LineState {
    /// Ca = μ U/σ.
    pub(crate) fn capillary_number(&self) -> f64 {
        self.viscosity * self.speed / self.tension
    }

    /// The angle in rad with (cos θ_e − cos θ_d)/(cos θ_e + 1) = `change` on a line that advances from the `static_angle` θ_e, and −`change` on a receding
    /// one.
    pub(crate) fn angle_by_change_of_cosine(&self, static_angle: f64, change: f64) -> f64 {
        let cos_e = static_angle.cos();
        (cos_e - ((cos_e + 1.0) * change).copysign(self.speed)).clamp(-1.0, 1.0).acos()
    }
}

/// A wetting law. Angles are in rad, through the wetting phase.
pub(crate) trait WettingModel: Parameters {
    /// The angle at which the interface is to meet the wall.
    fn angle(&self, line: &LineState) -> f64;

    /// The static angle: the first parameter, in degrees, unless a law has another one; with hysteresis the equilibrium angle.
    fn static_angle(&self) -> f64 {
        self.first().to_radians()
    }

    /// The range of static angles: receding and advancing, equal without hysteresis.
    fn hysteresis_range(&self) -> [f64; 2] {
        [self.static_angle(); 2]
    }

    /// Whether the line is pinned while its angle is within the hysteresis range.
    fn pins(&self) -> bool {
        false
    }

    /// Whether the angle depends on the speed of the line.
    fn is_dynamic(&self) -> bool {
        true
    }

    /// Inconsistency of parameters that are each within range; the path is a key.
    fn contradiction(&self) -> Option<Problem> {
        None
    }
}

/// The conversion to SI units and radians for a key with another unit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InSi {
    /// Its name.
    pub name: &'static str,
    /// The SI value from that of the key.
    pub of: fn(f64) -> f64,
}

/// A parameter of a law.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parameter {
    /// Its key with the range of values.
    pub(crate) key: Key,
    /// The conversion to SI units and radians, if its key has another unit.
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

    /// Name and SI value of the parameter with this `value` of `field`.
    pub(crate) fn in_si(&self, field: &'static str, value: f64) -> (&'static str, f64) {
        self.si.map_or((field, value), |si| (si.name, (si.of)(value)))
    }
}

/// The parameters of a law as `law!` declares them.
pub trait Parameters: Sized {
    /// Its table in a case file.
    type Raw;
    /// The law in one line and, in parentheses, its source.
    const ABOUT: &'static str;
    /// Its fields and the ranges of their keys.
    const KEYS: &'static [(&'static str, Key)];

    /// The law, if all of its parameters are present and in range; `at` is the key path of the table.
    fn checked(raw: &Self::Raw, checker: &mut Checker, at: &str) -> Option<Self>;

    /// The table equivalent to the law.
    fn raw(&self) -> Self::Raw;

    /// The first parameter, in the unit of its key.
    fn first(&self) -> f64;

    /// Keys and values of the table.
    fn entries(raw: &mut Self::Raw) -> Vec<(String, &mut Option<f64>)>;
}

/// The law, if its parameters are present, in range and consistent; `at` is the key path of its table.
pub(super) fn checked<L: WettingModel>(raw: &L::Raw, checker: &mut Checker, at: &str) -> Option<L> {
    let law = L::checked(raw, checker, at)?;
    if let Some(Problem { path, message, help, .. }) = law.contradiction() {
        checker.refuse(format!("{at}.{path}"), message, help);
        return None;
    }
    Some(law)
}

/// The same law with other angles, by key, given in the table at the key path `at`.
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

/// Whether a key is an angle: patches of walls have their own angles; the other parameters are those of the model.
pub(super) fn is_angle(key: &str) -> bool {
    key.ends_with("angle-deg")
}

/// Declares the parameters of a law: the comment on the law ends with its source in parentheses, those on its fields become the reference of the case file,
/// and each field is followed by its [`Parameter`].
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

        /// In SI units and radians, as in the report.
        impl serde::Serialize for $law {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_map([$($parameter.in_si(stringify!($field), self.$field),)+])
            }
        }

        /// The table of the law in a case file.
        pub(super) mod raw {
            use super::*;

            meniscus_core::tables! {
                $(#[doc = $about])+
                pub struct $law { $($(#[doc = $doc])+ pub $field: f64 => $parameter.key,)+ }
            }
        }

        impl $crate::law::Parameters for $law {
            type Raw = raw::$law;
            const ABOUT: &'static str = concat!($($about),+);
            const KEYS: &'static [(&'static str, meniscus_core::input::tables::Key)] = raw::$law::KEYS;

            fn checked(raw: &Self::Raw, checker: &mut meniscus_core::input::Checker, at: &str) -> Option<Self> {
                let raw = raw.clone().in_range(checker, at);
                Some(Self { $($field: raw.$field.or($parameter.key.default)?,)+ })
            }

            fn raw(&self) -> Self::Raw {
                raw::$law { $($field: Some(self.$field),)+ }
            }

            fn first(&self) -> f64 {
                [$(self.$field),+][0]
            }

            fn entries(raw: &mut Self::Raw) -> Vec<(String, &mut Option<f64>)> {
                vec![$((meniscus_core::input::tables::name(stringify!($field)), &mut raw.$field),)+]
            }
        }
    };
}
pub(super) use law;
