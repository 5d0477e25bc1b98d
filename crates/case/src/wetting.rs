//! `[sph.wetting]` and `[network.wetting]`: the model, its angles, and the walls they apply to. The tables of the models are in `meniscus_wetting`.

use super::side::{SIDES, Side, SideName, Sides};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, tables, words};
use meniscus_core::math::Vec2;
use meniscus_geometry::spec::GeometrySpec;
use meniscus_wetting::Wetting;

/// `[sph.wetting]` and `[network.wetting]`.
pub(crate) type RawWetting = meniscus_wetting::RawWetting<RawWettingPatch>;

tables! {
    /// A part of the walls with its own angles, those of the model.
    pub(crate) struct RawWettingPatch {
        /// Shape whose surface is the patch, counted from 0; not with `side` (default: all walls).
        pub shape: u32,
        /// Wall side that is the patch (default: all walls).
        pub side: SideName,
        /// Floor or lid of a chip that has a depth (default: both have the angles of the walls).
        pub plate: Plate,
        /// Stripes of the patch (default: the whole patch).
        pub stripes: RawStripes,
        /// Static angle in degrees (required if the model has one).
        pub contact_angle_deg: f64 => Key::within("an angle in degrees", 0.0, 180.0),
        /// Advancing angle in degrees (required if the model has one).
        pub advancing_angle_deg: f64 => Key::within("an angle in degrees", 0.0, 180.0),
        /// Receding angle in degrees, 0 to the advancing one (required if the model has one).
        pub receding_angle_deg: f64 => Key::within("an angle in degrees", 0.0, 180.0),
    }

    /// Stripes of a wall.
    pub(crate) struct RawStripes {
        /// Coordinate across the stripes (default `x`).
        pub along: RawAxis,
        /// Start of the first stripe in m (default 0).
        pub start: f64,
        /// Width of a stripe in m.
        pub width: f64 => Key::positive("a width in m").example("width = 1.0e-4 # m"),
        /// Distance from stripe to stripe in m, at least the width (default: a single stripe).
        pub period: f64 => Key::positive("a period in m"),
    }
}

words! {
    /// Floor or lid of a chip.
    pub enum Plate {
        /// The floor.
        Floor,
        /// The lid.
        Lid,
    }

    /// An axis.
    pub(crate) enum RawAxis {
        /// The first coordinate.
        X,
        /// The second coordinate.
        Y,
    }
}

/// A part of the walls with its own angles (`[[sph.wetting.patches]]`); later ones override earlier ones.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct WettingPatch {
    /// The walls.
    pub on: PatchedWall,
    /// The part of them; `None`: all.
    pub stripes: Option<Stripes>,
    /// The model with the angles of the patch.
    pub model: Wetting,
}

/// The walls of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PatchedWall {
    /// All of them.
    All,
    /// A shape by its index, from 0.
    Shape(u32),
    /// The left, right, bottom or top side, 0 to 3.
    Side(u32),
    /// Floor or lid.
    Plate(Plate),
}

/// Stripes across an axis: where (coordinate − `start`) modulo `period` is below `width`.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Stripes {
    /// 0: along x, 1: along y.
    pub axis: usize,
    /// Start of a stripe in m.
    pub start: f64,
    /// Width in m.
    pub width: f64,
    /// Distance from one to the next in m; `None`: a single stripe.
    pub period: Option<f64>,
}

/// The angles of floor and lid by `angle`: those of all walls unless a patch overrides them.
pub fn on_plates(model: &Wetting, patches: &[WettingPatch], angle: impl Fn(&Wetting) -> f64) -> [f64; 2] {
    [Plate::Floor, Plate::Lid].map(|plate| {
        let lies_there = |patch: &&WettingPatch| match patch.on {
            PatchedWall::All => patch.stripes.is_none(),
            on => on == PatchedWall::Plate(plate),
        };
        angle(patches.iter().rfind(lies_there).map_or(model, |patch| &patch.model))
    })
}

impl Stripes {
    /// Whether a point of the wall with the given coordinates in m lies in a stripe.
    pub fn contains(&self, x: Vec2) -> bool {
        let along = x[self.axis] - self.start;
        let along = self.period.map_or(along, |period| along.rem_euclid(period));
        (0.0..self.width).contains(&along)
    }
}

/// The wetting model of a case, `None` if there is no table or it is wrong.
///
/// `table` is its key path: `sph.wetting` or `network.wetting`.
pub(super) fn model(
    checker: &mut Checker,
    table: &str,
    raw: Option<&mut RawWetting>,
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
    *raw = RawWetting::of(&model, raw.patches.take());
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

/// The complete patches; `sides` and `geometry` are missing if they were wrong.
pub(super) fn patches(
    checker: &mut Checker,
    table: &str,
    raw: Option<&mut RawWetting>,
    model: Wetting,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Vec<WettingPatch> {
    let raw = raw.and_then(|raw| raw.patches.as_mut()).into_iter().flatten().enumerate();
    raw.filter_map(|(index, raw)| {
        let at = format!("{table}.patches[{index}]");
        let on = patched_wall(checker, &at, raw, sides, geometry);
        let stripes = raw.stripes.as_mut().map(|raw| stripes(checker, &format!("{at}.stripes"), raw));
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
    for (key, value) in given.iter().filter(|(key, _)| !known.contains(key)) {
        if !checker.is_given(&format!("{at}.{key}"), value.as_ref()) {
            continue;
        }
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
    match (raw.shape, raw.side, raw.plate) {
        (None, None, None) => Some(PatchedWall::All),
        (None, None, Some(_)) if raw.stripes.is_some() => {
            let message = "floor and lid have one angle everywhere, and `stripes` are given";
            checker.refuse(format!("{at}.stripes"), message, "leave `stripes` or `plate` out");
            None
        }
        (None, None, Some(plate)) => Some(PatchedWall::Plate(plate)),
        (Some(shape), None, None) => {
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
        (None, Some(side), None) => {
            let (number, name) = (side.number(), SIDES[side.number()]);
            let kind = sides.map(|sides| sides.each()[number]);
            if kind.is_some_and(|kind| kind != Side::Wall) {
                checker.refuse(
                    format!("{at}.side"),
                    format!("the side `{name}` is not a wall and has no contact angle"),
                    format!("set sides.{name} = \"wall\", or leave the patch out"),
                );
                return None;
            }
            Some(PatchedWall::Side(number as u32))
        }
        (shape, side, _) => {
            let given = [("shape", shape.is_some()), ("side", side.is_some()), ("plate", raw.plate.is_some())];
            let given: Vec<&str> = given.into_iter().filter(|(_, given)| *given).map(|(key, _)| key).collect();
            let message = format!("`{}` and `{}` are both given", given[0], given[1]);
            checker.refuse(format!("{at}.{}", given[1]), message, "keep one of them");
            None
        }
    }
}

fn stripes(checker: &mut Checker, at: &str, raw: &mut RawStripes) -> Option<Stripes> {
    let width = raw.width?;
    if raw.period.is_some_and(|period| period < width) {
        checker.refuse(
            format!("{at}.period"),
            "the stripes are wider than their period",
            "a period of at least the width",
        );
        return None;
    }
    let axis = *raw.along.get_or_insert(RawAxis::X) as usize;
    Some(Stripes { axis, start: *raw.start.get_or_insert_default(), width, period: raw.period })
}
