//! `[sph.sides]` and `[sph.walls]`: the sides of the domain, and the properties of walls.

use super::open::RawOpenSides;
use super::side::{Side, Sides};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, checked_tables, tables};

tables! {
    /// The four sides of the domain.
    pub(crate) struct RawSides {
        /// Kind of the side (default `wall`).
        pub left: Side,
        /// Kind of the side (default `wall`).
        pub right: Side,
        /// Kind of the side (default `wall`).
        pub bottom: Side,
        /// Kind of the side (default `wall`).
        pub top: Side,
        /// Tangential speed of each wall side (default: at rest).
        pub speed: RawWallSpeeds,
        /// Drive of the flow through open sides, and the entering phase.
        pub open: RawOpenSides,
    }

    /// Tangential speeds of the walls at the sides.
    pub(crate) struct RawWallSpeeds {
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub left: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub right: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub bottom: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub top: f64,
    }
}

checked_tables! {
    /// Properties of all walls, those of shapes and those at the sides.
    pub struct RawWalls for Walls {
        /// Navier slip length of all walls in m (default 0.0).
        pub slip_length: f64 => Key::not_negative("a slip length in m"),
        /// Slip length near contact lines in m; needs a wetting model (default: `slip-length`, else one spacing).
        pub line_slip_length: f64 => Key::not_negative("a slip length in m"),
    }
}

/// The kinds of the sides.
pub(super) fn sides(checker: &mut Checker, raw: &mut RawSides) -> Sides {
    let given = [("left", raw.left), ("right", raw.right), ("bottom", raw.bottom), ("top", raw.top)];
    for pair in given.chunks_exact(2) {
        let [(a, side_a), (b, side_b)] = pair else { continue };
        let (one, other, missing) = match (side_a, side_b) {
            (Some(Side::Periodic), side) if *side != Some(Side::Periodic) => (a, b, side),
            (side, Some(Side::Periodic)) if *side != Some(Side::Periodic) => (b, a, side),
            _ => continue,
        };
        let found = if missing.is_none() { "is a wall by default" } else { "is not" };
        checker.refuse(
            format!("sph.sides.{one}"),
            format!("the side `{one}` is periodic and the opposite side `{other}` {found}"),
            format!("set {other} = \"periodic\" too"),
        );
    }
    let side = |side: &mut Option<Side>| *side.get_or_insert(Side::Wall);
    Sides {
        left: side(&mut raw.left),
        right: side(&mut raw.right),
        bottom: side(&mut raw.bottom),
        top: side(&mut raw.top),
    }
}

/// Speeds of the left, right, bottom and top wall; only a side that is a wall can have one.
pub(super) fn wall_speeds(checker: &mut Checker, raw: &mut RawSides) -> [f64; 4] {
    let speed = raw.speed.get_or_insert_default();
    let sides = [
        ("left", raw.left, speed.left),
        ("right", raw.right, speed.right),
        ("bottom", raw.bottom, speed.bottom),
        ("top", raw.top, speed.top),
    ];
    sides.map(|(key, side, speed)| {
        if speed.is_some() && side.is_some_and(|side| side != Side::Wall) {
            checker.refuse(
                format!("sph.sides.speed.{key}"),
                format!("the side `{key}` is not a wall and cannot move"),
                format!("set sides.{key} = \"wall\", or leave the speed out"),
            );
        }
        speed.unwrap_or_default()
    })
}

/// Slip lengths; `has_lines` is whether there can be contact lines on the walls, `spacing` in m.
pub(super) fn walls(checker: &mut Checker, raw: &mut RawWalls, has_lines: bool, spacing: Option<f64>) -> Walls {
    const LINE: &str = "sph.walls.line-slip-length";
    if checker.is_given(LINE, raw.line_slip_length.as_ref()) && !has_lines {
        checker.refuse(
            LINE,
            "there are no contact lines without a wetting model",
            "add [sph.wetting.young], or leave this out",
        );
    }
    // By default, a contact line slips by a spacing, so that it does not run over the adjacent particles.
    let default = if has_lines { spacing.unwrap_or_default() } else { 0.0 };
    let line_slip_length = raw.line_slip_length.or(raw.slip_length).unwrap_or(default);
    raw.line_slip_length = has_lines.then_some(line_slip_length);
    Walls { slip_length: *raw.slip_length.get_or_insert_default(), line_slip_length }
}
