//! Checks of `[sph.sides]` and `[sph.walls]`: what stands at the sides of the domain, and what walls are like.

use super::checked::{Side, Sides, Walls};
use super::raw::{RawSide, RawSides, RawWalls};
use crate::input::{Checker, Range};

pub(super) fn sides(checker: &mut Checker, raw: &RawSides) -> Sides {
    let given = [("left", raw.left), ("right", raw.right), ("bottom", raw.bottom), ("top", raw.top)];
    for pair in given.chunks_exact(2) {
        let [(a, side_a), (b, side_b)] = pair else { continue };
        let (one, other, missing) = match (side_a, side_b) {
            (Some(RawSide::Periodic), side) if *side != Some(RawSide::Periodic) => (a, b, side),
            (side, Some(RawSide::Periodic)) if *side != Some(RawSide::Periodic) => (b, a, side),
            _ => continue,
        };
        let found = if missing.is_none() { "is a wall by default" } else { "is not" };
        checker.refuse(
            format!("sph.sides.{one}"),
            format!("the side `{one}` is periodic and the opposite side `{other}` {found}"),
            format!("set {other} = \"periodic\" too"),
        );
    }
    let side = |side: Option<RawSide>| match side {
        None | Some(RawSide::Wall) => Side::Wall,
        Some(RawSide::Periodic) => Side::Periodic,
        Some(RawSide::Image) => Side::Image,
        Some(RawSide::Symmetry) => Side::Symmetry,
        Some(RawSide::Inlet) => Side::Inlet,
        Some(RawSide::Outlet) => Side::Outlet,
    };
    Sides { left: side(raw.left), right: side(raw.right), bottom: side(raw.bottom), top: side(raw.top) }
}

/// Speeds of the left, right, bottom and top wall; only a side that is a wall can have one.
pub(super) fn wall_speeds(checker: &mut Checker, raw: &RawSides) -> [f64; 4] {
    let speed = raw.speed.clone().unwrap_or_default();
    let sides = [
        ("left", raw.left, speed.left),
        ("right", raw.right, speed.right),
        ("bottom", raw.bottom, speed.bottom),
        ("top", raw.top, speed.top),
    ];
    sides.map(|(key, side, speed)| {
        if speed.is_some() && side.is_some_and(|side| side != RawSide::Wall) {
            checker.refuse(
                format!("sph.sides.speed.{key}"),
                format!("the side `{key}` is not a wall and cannot move"),
                format!("set sides.{key} = \"wall\", or leave the speed out"),
            );
        }
        speed.unwrap_or_default()
    })
}

/// Slip lengths; `has_lines` where contact lines can stand on the walls, `spacing` in m.
pub(super) fn walls(checker: &mut Checker, raw: &RawWalls, has_lines: bool, spacing: Option<f64>) -> Walls {
    const LINE: &str = "sph.walls.line-slip-length";
    let mut length =
        |path: &str, given: Option<f64>| checker.in_range(path, given, Range::AtLeast(0.0), "a slip length in m");
    let slip_length = length("sph.walls.slip-length", raw.slip_length);
    let of_lines = length(LINE, raw.line_slip_length);
    if of_lines.is_some() && !has_lines {
        checker.refuse(
            LINE,
            "there are no contact lines without a wetting model",
            "add [sph.wetting.young], or leave this out",
        );
    }
    // A contact line on walls of which nothing is said slips by a spacing, so that it does not run over the particles next to them.
    let unsaid = if has_lines { spacing.unwrap_or_default() } else { 0.0 };
    Walls { slip_length: slip_length.unwrap_or_default(), line_slip_length: of_lines.or(slip_length).unwrap_or(unsaid) }
}
