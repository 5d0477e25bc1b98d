//! Shifts of walls to their periodic images by whole periods.

use meniscus_core::math::Vec2;

/// Numbers of periods along x and y.
pub type Shift = [i32; 2];

/// The sum of two shifts.
pub fn plus(a: Shift, b: Shift) -> Shift {
    [a[0] + b[0], a[1] + b[1]]
}

/// The difference of two shifts.
pub fn minus(a: Shift, b: Shift) -> Shift {
    [a[0] - b[0], a[1] - b[1]]
}

/// The period that contains `at`, a position over the size of the domain; 0 along non-periodic axes.
pub(super) fn period_of(at: Vec2, periodic: [bool; 2]) -> Shift {
    [0, 1].map(|i| if periodic[i] { floor_near(at[i]) } else { 0 })
}

/// The integer part of `x`; a value that is an integer up to rounding counts as that.
fn floor_near(x: f64) -> i32 {
    const ROUNDING: f64 = 1e-9;
    let whole = x.round();
    if (x - whole).abs() < ROUNDING { whole as i32 } else { x.floor() as i32 }
}
