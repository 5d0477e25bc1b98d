//! Checks of `[sph.wetting]`, and the way back: which model, with which angles, on which part of the walls.

use super::check::Checker;
use super::checked::{PatchedWall, Side, Sides, Stripes, WettingModel, WettingPatch};
use super::raw::{
    RawAxis, RawContactAngle, RawCoxVoinov, RawHysteresisRange, RawLineFriction, RawMolecularKinetic, RawSideName,
    RawStripes, RawWetting, RawWettingPatch,
};
use crate::geometry::spec::GeometrySpec;

/// 0 degrees Celsius in K.
const FREEZING: f64 = 273.15;

/// Temperatures in degrees Celsius at which lines of liquids are measured.
const TEMPERATURES: (f64, f64) = (-100.0, 500.0);

/// Temperature in degrees Celsius where the case says nothing.
const DEFAULT_TEMPERATURE: f64 = 20.0;

/// The wetting model of a case, none where there is no table or it is wrong.
///
/// `table` is where it is written: `sph.wetting` or `network.wetting`.
pub(super) fn model(
    checker: &mut Checker,
    table: &str,
    raw: Option<&RawWetting>,
    tension: Option<f64>,
) -> Option<WettingModel> {
    let raw = raw?;
    let given = [
        ("young", raw.young.is_some()),
        ("tadmor", raw.tadmor.is_some()),
        ("line-friction", raw.line_friction.is_some()),
        ("molecular-kinetic", raw.molecular_kinetic.is_some()),
        ("cox-voinov", raw.cox_voinov.is_some()),
        ("kistler", raw.kistler.is_some()),
        ("jiang", raw.jiang.is_some()),
        ("hysteresis", raw.hysteresis.is_some()),
    ];
    let given: Vec<&str> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
    let [name] = given[..] else {
        let (found, help) = match given.len() {
            0 => ("none".to_owned(), format!("add the table [{table}.young]")),
            count => (count.to_string(), format!("keep one of {}", given.join(", "))),
        };
        checker.refuse(table, format!("expected exactly one wetting model, found {found}"), help);
        return None;
    };
    let at = format!("{table}.{name}");
    let model = if let Some(raw) = &raw.young {
        let contact_angle = contact_angle(checker, &at, raw.contact_angle_deg)?;
        WettingModel::Young { contact_angle }
    } else if let Some(raw) = &raw.kistler {
        let contact_angle = contact_angle(checker, &at, raw.contact_angle_deg)?;
        WettingModel::Kistler { contact_angle }
    } else if let Some(raw) = &raw.jiang {
        let contact_angle = contact_angle(checker, &at, raw.contact_angle_deg)?;
        WettingModel::Jiang { contact_angle }
    } else if let Some(raw) = &raw.line_friction {
        line_friction(checker, &at, raw)?
    } else if let Some(raw) = &raw.molecular_kinetic {
        molecular_kinetic(checker, &at, raw)?
    } else if let Some(raw) = &raw.cox_voinov {
        cox_voinov(checker, &at, raw)?
    } else if let Some(raw) = &raw.tadmor {
        let [receding, advancing] = hysteresis_range(checker, &at, raw)?;
        WettingModel::Tadmor { advancing, receding }
    } else {
        let [receding, advancing] = hysteresis_range(checker, &at, raw.hysteresis.as_ref()?)?;
        WettingModel::Hysteresis { advancing, receding }
    };
    if tension == Some(0.0) {
        let key = if model.has_hysteresis() { "advancing-angle-deg" } else { "contact-angle-deg" };
        checker.refuse(
            format!("{at}.{key}"),
            "a contact angle needs a tension above 0",
            "raise sph.interface.tension, or leave [sph.wetting] out",
        );
    }
    Some(model)
}

impl WettingModel {
    /// Whether it has an advancing and a receding angle in the place of a single one.
    fn has_hysteresis(&self) -> bool {
        matches!(self, Self::Tadmor { .. } | Self::Hysteresis { .. })
    }

    /// The same model with other angles in rad: the receding one counts only where there are two.
    fn with_angles(self, [new_receding, new_advancing]: [f64; 2]) -> Self {
        let mut model = self;
        match &mut model {
            Self::Young { contact_angle }
            | Self::LineFriction { contact_angle, .. }
            | Self::MolecularKinetic { contact_angle, .. }
            | Self::CoxVoinov { contact_angle, .. }
            | Self::Kistler { contact_angle }
            | Self::Jiang { contact_angle } => *contact_angle = new_advancing,
            Self::Tadmor { advancing, receding } | Self::Hysteresis { advancing, receding } => {
                (*advancing, *receding) = (new_advancing, new_receding);
            }
        }
        model
    }
}

fn angle(checker: &mut Checker, path: &str, degrees: Option<f64>, example: &str) -> Option<f64> {
    let degrees = checker.require(path, degrees, example);
    checker.within(path, degrees, (0.0, 180.0), "an angle in degrees").map(f64::to_radians)
}

fn contact_angle(checker: &mut Checker, at: &str, degrees: Option<f64>) -> Option<f64> {
    angle(checker, &format!("{at}.contact-angle-deg"), degrees, "contact-angle-deg = 40.0")
}

fn hysteresis_range(checker: &mut Checker, at: &str, raw: &RawHysteresisRange) -> Option<[f64; 2]> {
    let path = |key: &str| format!("{at}.{key}-angle-deg");
    let advancing = angle(checker, &path("advancing"), raw.advancing_angle_deg, "advancing-angle-deg = 60.0");
    let receding = angle(checker, &path("receding"), raw.receding_angle_deg, "receding-angle-deg = 40.0");
    let (advancing, receding) = (advancing?, receding?);
    if receding > advancing {
        checker.refuse(
            path("receding"),
            format!(
                "the receding angle of {:.1} degrees is above the advancing one of {:.1}",
                receding.to_degrees(),
                advancing.to_degrees()
            ),
            "a line recedes at the smaller angle: exchange the two",
        );
        return None;
    }
    Some([receding, advancing])
}

fn line_friction(checker: &mut Checker, at: &str, raw: &RawLineFriction) -> Option<WettingModel> {
    let contact_angle = contact_angle(checker, at, raw.contact_angle_deg);
    let path = format!("{at}.friction");
    let friction = checker.require_positive(&path, raw.friction, "friction = 0.05 # Pa s", "a friction in Pa s");
    Some(WettingModel::LineFriction { contact_angle: contact_angle?, friction: friction? })
}

fn cox_voinov(checker: &mut Checker, at: &str, raw: &RawCoxVoinov) -> Option<WettingModel> {
    let contact_angle = contact_angle(checker, at, raw.contact_angle_deg);
    let path = format!("{at}.slip-length");
    let slip_length =
        checker.require_positive(&path, raw.slip_length, "slip-length = 1.0e-9 # m", "a slip length in m");
    Some(WettingModel::CoxVoinov { contact_angle: contact_angle?, slip_length: slip_length? })
}

fn molecular_kinetic(checker: &mut Checker, at: &str, raw: &RawMolecularKinetic) -> Option<WettingModel> {
    let contact_angle = contact_angle(checker, at, raw.contact_angle_deg);
    let path = |key: &str| format!("{at}.{key}");
    let frequency =
        checker.require_positive(&path("frequency"), raw.frequency, "frequency = 1.0e6 # 1/s", "a frequency in 1/s");
    let jump =
        checker.require_positive(&path("jump-length"), raw.jump_length, "jump-length = 1.0e-9 # m", "a length in m");
    let celsius =
        checker.within(&path("temperature-c"), raw.temperature_c, TEMPERATURES, "a temperature in degrees Celsius");
    Some(WettingModel::MolecularKinetic {
        contact_angle: contact_angle?,
        frequency: frequency?,
        jump_length: jump?,
        temperature: celsius.unwrap_or(DEFAULT_TEMPERATURE) + FREEZING,
    })
}

/// The patches that are whole; `sides` and `geometry` are missing where they were wrong.
pub(super) fn patches(
    checker: &mut Checker,
    table: &str,
    raw: Option<&RawWetting>,
    model: WettingModel,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Vec<WettingPatch> {
    let raw = raw.and_then(|raw| raw.patches.as_ref()).into_iter().flatten().enumerate();
    raw.filter_map(|(index, raw)| {
        let at = format!("{table}.patches[{index}]");
        let on = patched_wall(checker, &at, raw, sides, geometry);
        let stripes = raw.stripes.as_ref().map(|raw| stripes(checker, &format!("{at}.stripes"), raw));
        let angles = patch_angles(checker, &at, raw, model);
        let stripes = match stripes {
            Some(stripes) => Some(stripes?),
            None => None,
        };
        Some(WettingPatch { on: on?, stripes, model: model.with_angles(angles?) })
    })
    .collect()
}

/// Receding and advancing angle in rad; equal for models with a single one.
fn patch_angles(checker: &mut Checker, at: &str, raw: &RawWettingPatch, model: WettingModel) -> Option<[f64; 2]> {
    let given = [
        ("contact-angle-deg", raw.contact_angle_deg, !model.has_hysteresis()),
        ("advancing-angle-deg", raw.advancing_angle_deg, model.has_hysteresis()),
        ("receding-angle-deg", raw.receding_angle_deg, model.has_hysteresis()),
    ];
    for (key, value, fits) in given {
        if value.is_some() && !fits {
            let keys =
                if model.has_hysteresis() { "advancing-angle-deg and receding-angle-deg" } else { "contact-angle-deg" };
            checker.refuse(
                format!("{at}.{key}"),
                format!("the wetting model has no `{key}`"),
                format!("a patch of this model has {keys}"),
            );
        }
    }
    if model.has_hysteresis() {
        let range = RawHysteresisRange {
            advancing_angle_deg: raw.advancing_angle_deg,
            receding_angle_deg: raw.receding_angle_deg,
        };
        return hysteresis_range(checker, at, &range);
    }
    contact_angle(checker, at, raw.contact_angle_deg).map(|angle| [angle; 2])
}

fn patched_wall(
    checker: &mut Checker,
    at: &str,
    raw: &RawWettingPatch,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Option<PatchedWall> {
    match (raw.shape, raw.side) {
        (None, None) => Some(PatchedWall::All),
        (Some(_), Some(_)) => {
            checker.refuse(format!("{at}.side"), "`shape` and `side` are both given", "keep one of them");
            None
        }
        (Some(shape), None) => {
            let count = geometry.map_or(u32::MAX, |geometry| geometry.shapes.len() as u32);
            if shape >= count {
                checker.refuse(
                    format!("{at}.shape"),
                    format!("there is no shape {shape} among the {count} of the geometry"),
                    "shapes are counted from 0 on, in the order of the file",
                );
                return None;
            }
            Some(PatchedWall::Shape(shape))
        }
        (None, Some(side)) => {
            let (number, name) = numbered(side);
            let kind = sides.map(|sides| [sides.left, sides.right, sides.bottom, sides.top][number as usize]);
            if kind.is_some_and(|kind| kind != Side::Wall) {
                checker.refuse(
                    format!("{at}.side"),
                    format!("the side `{name}` is not a wall and has no contact angle"),
                    format!("set sides.{name} = \"wall\", or leave the patch out"),
                );
                return None;
            }
            Some(PatchedWall::Side(number))
        }
    }
}

fn numbered(side: RawSideName) -> (u32, &'static str) {
    match side {
        RawSideName::Left => (0, "left"),
        RawSideName::Right => (1, "right"),
        RawSideName::Bottom => (2, "bottom"),
        RawSideName::Top => (3, "top"),
    }
}

fn stripes(checker: &mut Checker, at: &str, raw: &RawStripes) -> Option<Stripes> {
    let path = |key: &str| format!("{at}.{key}");
    let width = checker.require_positive(&path("width"), raw.width, "width = 1.0e-4 # m", "a width in m");
    let period = raw.period.map(|period| checker.positive(&path("period"), Some(period), "a period in m"));
    let period = match period {
        Some(period) => Some(period?),
        None => None,
    };
    let width = width?;
    if period.is_some_and(|period| period < width) {
        checker.refuse(path("period"), "the stripes are wider than their period", "a period of at least the width");
        return None;
    }
    let axis = usize::from(raw.along == Some(RawAxis::Y));
    Some(Stripes { axis, start: raw.start.unwrap_or_default(), width, period })
}

/// Model and patches as they are written.
pub(super) fn raw(model: &WettingModel, patches: &[WettingPatch]) -> RawWetting {
    let degrees = |angle: f64| Some(angle.to_degrees().clamp(0.0, 180.0));
    let single = |contact_angle| Some(RawContactAngle { contact_angle_deg: degrees(contact_angle) });
    let range = |advancing, receding| {
        Some(RawHysteresisRange { advancing_angle_deg: degrees(advancing), receding_angle_deg: degrees(receding) })
    };
    let none = RawWetting {
        patches: (!patches.is_empty()).then(|| patches.iter().map(raw_patch).collect()),
        ..RawWetting::default()
    };
    match *model {
        WettingModel::Young { contact_angle } => RawWetting { young: single(contact_angle), ..none },
        WettingModel::Kistler { contact_angle } => RawWetting { kistler: single(contact_angle), ..none },
        WettingModel::Jiang { contact_angle } => RawWetting { jiang: single(contact_angle), ..none },
        WettingModel::Tadmor { advancing, receding } => RawWetting { tadmor: range(advancing, receding), ..none },
        WettingModel::Hysteresis { advancing, receding } => {
            RawWetting { hysteresis: range(advancing, receding), ..none }
        }
        WettingModel::LineFriction { contact_angle, friction } => RawWetting {
            line_friction: Some(RawLineFriction {
                contact_angle_deg: degrees(contact_angle),
                friction: Some(friction),
            }),
            ..none
        },
        WettingModel::CoxVoinov { contact_angle, slip_length } => RawWetting {
            cox_voinov: Some(RawCoxVoinov {
                contact_angle_deg: degrees(contact_angle),
                slip_length: Some(slip_length),
            }),
            ..none
        },
        WettingModel::MolecularKinetic { contact_angle, frequency, jump_length, temperature } => RawWetting {
            molecular_kinetic: Some(RawMolecularKinetic {
                contact_angle_deg: degrees(contact_angle),
                frequency: Some(frequency),
                jump_length: Some(jump_length),
                temperature_c: Some(temperature - FREEZING),
            }),
            ..none
        },
    }
}

fn raw_patch(patch: &WettingPatch) -> RawWettingPatch {
    let degrees = |angle: f64| Some(angle.to_degrees().clamp(0.0, 180.0));
    let [receding, advancing] = patch.model.angles();
    let names = [RawSideName::Left, RawSideName::Right, RawSideName::Bottom, RawSideName::Top];
    let two = patch.model.has_hysteresis();
    RawWettingPatch {
        shape: match patch.on {
            PatchedWall::Shape(shape) => Some(shape),
            PatchedWall::All | PatchedWall::Side(_) => None,
        },
        side: match patch.on {
            PatchedWall::Side(side) => names.get(side as usize).copied(),
            PatchedWall::All | PatchedWall::Shape(_) => None,
        },
        stripes: patch.stripes.map(|stripes| RawStripes {
            along: Some(if stripes.axis == 0 { RawAxis::X } else { RawAxis::Y }),
            start: Some(stripes.start),
            width: Some(stripes.width),
            period: stripes.period,
        }),
        contact_angle_deg: if two { None } else { degrees(advancing) },
        advancing_angle_deg: if two { degrees(advancing) } else { None },
        receding_angle_deg: if two { degrees(receding) } else { None },
    }
}
