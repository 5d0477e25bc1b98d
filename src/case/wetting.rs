//! Checks of `[sph.wetting]`, and the way back: which model, with which angles, on which part of the walls.

use super::checked::{PatchedWall, Side, Sides, Stripes, WettingPatch};
use super::raw::{RawAxis, RawSideName, RawStripes, RawWetting, RawWettingPatch};
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;
use crate::wetting::Wetting;

/// The wetting model of a case, none where there is no table or it is wrong.
///
/// `table` is where it is written: `sph.wetting` or `network.wetting`.
pub(super) fn model(
    checker: &mut Checker,
    table: &str,
    raw: Option<&RawWetting>,
    tension: Option<f64>,
) -> Option<Wetting> {
    let raw = raw?;
    let given = raw.given();
    if given.len() != 1 {
        let (found, help) = match given.len() {
            0 => ("none".to_owned(), format!("add the table [{table}.young]")),
            count => (count.to_string(), format!("keep one of {}", given.join(", "))),
        };
        checker.refuse(table, format!("expected exactly one wetting model, found {found}"), help);
        return None;
    }
    let model = raw.checked(checker, table)?;
    if tension == Some(0.0) {
        let law = model.table();
        checker.refuse(
            format!("{table}.{}.{}", law.key, law.angles()[0]),
            "a contact angle needs a tension above 0",
            "raise sph.interface.tension, or leave [sph.wetting] out",
        );
    }
    Some(model)
}

/// The patches that are whole; `sides` and `geometry` are missing where they were wrong.
pub(super) fn patches(
    checker: &mut Checker,
    table: &str,
    raw: Option<&RawWetting>,
    model: Wetting,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Vec<WettingPatch> {
    let raw = raw.and_then(|raw| raw.patches.as_ref()).into_iter().flatten().enumerate();
    raw.filter_map(|(index, raw)| {
        let at = format!("{table}.patches[{index}]");
        let on = patched_wall(checker, &at, raw, sides, geometry);
        let stripes = raw.stripes.as_ref().map(|raw| stripes(checker, &format!("{at}.stripes"), raw));
        let model = patch_model(checker, &at, raw, model);
        let stripes = match stripes {
            Some(stripes) => Some(stripes?),
            None => None,
        };
        Some(WettingPatch { on: on?, stripes, model: model? })
    })
    .collect()
}

/// The model with the angles of a patch.
fn patch_model(checker: &mut Checker, at: &str, raw: &RawWettingPatch, model: Wetting) -> Option<Wetting> {
    let given = [
        ("contact-angle-deg", raw.contact_angle_deg),
        ("advancing-angle-deg", raw.advancing_angle_deg),
        ("receding-angle-deg", raw.receding_angle_deg),
    ];
    let law = model.table();
    let known = law.angles();
    for (key, _) in given.iter().filter(|(key, value)| value.is_some() && !known.contains(key)) {
        checker.refuse(
            format!("{at}.{key}"),
            format!("the wetting model has no `{key}`"),
            format!("a patch of this model has {}", known.join(" and ")),
        );
    }
    model.with_angles(checker, at, &given)
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
pub(super) fn raw(model: &Wetting, patches: &[WettingPatch]) -> RawWetting {
    RawWetting::of(model, (!patches.is_empty()).then(|| patches.iter().map(raw_patch).collect()))
}

fn raw_patch(patch: &WettingPatch) -> RawWettingPatch {
    let names = [RawSideName::Left, RawSideName::Right, RawSideName::Bottom, RawSideName::Top];
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
        contact_angle_deg: patch.model.parameter("contact-angle-deg"),
        advancing_angle_deg: patch.model.parameter("advancing-angle-deg"),
        receding_angle_deg: patch.model.parameter("receding-angle-deg"),
    }
}
