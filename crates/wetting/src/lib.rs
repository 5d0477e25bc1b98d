//! Wetting models: the contact angle imposed on the interface as a function of the motion of the contact line.
//!
//! Each law has its own file: its parameters with keys, units and ranges, and its formula. It is named once more here, in the list of `laws!`, which
//! generates the enum, the table `[sph.wetting]` or `[network.wetting]` of a case file, and the rows of `meniscus list`. The assignment of laws to parts of
//! the walls is in `case`; persistent contact lines and their forces are in `sph::wetting`.
#![warn(unreachable_pub)]

mod bracke;
mod cox;
mod cox_voinov;
mod hysteresis;
mod jiang;
mod kistler;
pub mod law;
mod line_friction;
mod molecular_kinetic;
mod tadmor;
#[cfg(test)]
mod tests;
mod young;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bracke::Bracke;
pub use cox::Cox;
pub use cox_voinov::CoxVoinov;
pub use hysteresis::Hysteresis;
pub use jiang::Jiang;
pub use kistler::Kistler;
pub use line_friction::LineFriction;
pub use molecular_kinetic::MolecularKinetic;
pub use tadmor::Tadmor;
pub use young::Young;

use law::{LineState, Parameters, WettingModel, checked, is_angle, parameter, with_angles};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, Value, name};

/// Makes the models from the list of their tables.
macro_rules! laws {
    (
        $(#[doc = $about:literal])+
        pub struct $tables:ident {
            $(pub $table:ident: $law:ident,)+
            $(#[doc = $patches_about:literal])+
            pub patches: Vec<Patch>,
        }
    ) => {
        /// The wetting models.
        #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum Wetting {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)+
        }

        $(#[doc = $about])+
        #[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
        #[schemars(rename = "RawWetting")]
        pub struct $tables<Patch: Default> {
            $(
                #[doc = concat!("See [`", stringify!($law), "`].")]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $table: Option<<$law as Parameters>::Raw>,
            )+
            $(#[doc = $patches_about])+
            #[serde(skip_serializing_if = "Option::is_none")]
            pub patches: Option<Vec<Patch>>,
        }

        impl Wetting {
            /// The angle in rad, through the wetting phase, at which the interface is to meet the wall.
            pub fn angle(&self, line: &LineState) -> f64 {
                match self { $(Self::$law(law) => law.angle(line),)+ }
            }

            /// The static contact angle in rad; with hysteresis the equilibrium angle between both bounds (Tadmor 2004).
            pub fn static_angle(&self) -> f64 {
                match self { $(Self::$law(law) => law.static_angle(),)+ }
            }

            /// The range of static angles in rad: receding and advancing, equal without hysteresis.
            pub fn hysteresis_range(&self) -> [f64; 2] {
                match self { $(Self::$law(law) => law.hysteresis_range(),)+ }
            }

            /// Whether the line is pinned while its angle is within the range.
            pub fn pins(&self) -> bool {
                match self { $(Self::$law(law) => law.pins(),)+ }
            }

            /// Whether the angle depends on the speed of the line.
            pub fn is_dynamic(&self) -> bool {
                match self { $(Self::$law(law) => law.is_dynamic(),)+ }
            }

            /// The name of its table, its parameters and its source.
            pub fn table(&self) -> LawTable {
                match self { $(Self::$law(_) => LawTable::of::<$law>(stringify!($table), stringify!($law)),)+ }
            }

            /// The parameter of a key, in the unit of that key; `None` if the model has no such key.
            pub fn parameter(&self, key: &str) -> Option<f64> {
                match self { $(Self::$law(law) => parameter(law, key),)+ }
            }

            /// The same model with other angles, by key, given in the table at the key path `at`; `None` if these are missing or invalid.
            pub fn with_angles(&self, checker: &mut Checker, at: &str, angles: &[(&str, Option<f64>)]) -> Option<Self> {
                match self { $(Self::$law(law) => with_angles(law, checker, at, angles).map(Self::$law),)+ }
            }
        }

        /// The table of a law is checked where that law is taken.
        impl<Patch: Default + Value> Value for $tables<Patch> {
            fn checked(self, _: &Key, checker: &mut Checker, path: &str) -> Option<Self> {
                let patches = Key::ANY.checked(checker, path, "patches", self.patches);
                Some(Self { patches, ..self })
            }
        }

        impl<Patch: Default> $tables<Patch> {
            /// The keys of the tables present, except those of patches.
            pub fn given(&self) -> Vec<String> {
                let all = [$((stringify!($table), self.$table.is_some()),)+];
                all.iter().filter(|(_, given)| *given).map(|(table, _)| name(table)).collect()
            }

            /// The model of the first table present; `at` is the key path of the tables. `None` if it is invalid.
            pub fn checked(&self, checker: &mut Checker, at: &str) -> Option<Wetting> {
                $(if let Some(raw) = &self.$table {
                    return checked(raw, checker, &format!("{at}.{}", name(stringify!($table)))).map(Wetting::$law);
                })+
                None
            }

            /// The table of a model.
            pub fn of(model: &Wetting, patches: Option<Vec<Patch>>) -> Self {
                let mut all = Self { $($table: None,)+ patches };
                match model { $(Wetting::$law(law) => all.$table = Some(law.raw()),)+ }
                all
            }
        }

        /// The tables of all laws.
        pub fn laws() -> Vec<LawTable> {
            vec![$(LawTable::of::<$law>(stringify!($table), stringify!($law)),)+]
        }
    };
}

laws! {
    /// Wetting models, exactly one of them, and parts of the walls that differ.
    pub struct RawWetting {
        pub young: Young,
        pub tadmor: Tadmor,
        pub line_friction: LineFriction,
        pub molecular_kinetic: MolecularKinetic,
        pub cox: Cox,
        pub cox_voinov: CoxVoinov,
        pub kistler: Kistler,
        pub jiang: Jiang,
        pub bracke: Bracke,
        pub hysteresis: Hysteresis,
        /// Parts of the walls with angles of their own, in the same model; later ones override earlier ones.
        pub patches: Vec<Patch>,
    }
}

impl Wetting {
    /// Whether the angle depends on the position of the line only, not on its motion or history.
    pub fn is_static(&self) -> bool {
        !self.is_dynamic() && !self.pins()
    }
}

/// The documentation of a law and its table in a case file.
#[derive(Debug, Clone)]
pub struct LawTable {
    /// The key of the table: `cox-voinov`.
    pub key: String,
    /// The name of its type.
    pub type_name: &'static str,
    /// The law in one line and, in parentheses, its source.
    pub about: &'static str,
    /// Its keys and their ranges.
    pub keys: Vec<(String, Key)>,
}

impl LawTable {
    fn of<L: WettingModel>(table: &str, type_name: &'static str) -> Self {
        let keys = L::KEYS.iter().map(|(field, key)| (name(field), *key)).collect();
        Self { key: name(table), type_name, about: L::ABOUT.trim(), keys }
    }

    /// The keys of its angles.
    pub fn angles(&self) -> Vec<&str> {
        self.keys.iter().map(|(key, _)| key.as_str()).filter(|key| is_angle(key)).collect()
    }

    /// The law in one line, and its source.
    pub fn what_and_source(&self) -> (&'static str, &'static str) {
        let (what, source) = self.about.rsplit_once(" (").unwrap_or((self.about, ""));
        (what, source.trim_end_matches(['.', ')']))
    }
}
