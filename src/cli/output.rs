//! Printing that never panics. A pipe closed by its reader is not an error of ours; a failing device is one, and is remembered until the end.

use std::fmt::Display;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why results could not be printed, for the first failure.
static NOT_PRINTED: OnceLock<io::Error> = OnceLock::new();

/// Whether progress, notes and warnings are suppressed.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// From now on, only errors go to standard error.
pub(crate) fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// Whether progress, notes and warnings are suppressed.
pub(crate) fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// A line of results, on standard output.
pub(crate) fn say(line: impl Display) {
    let mut out = io::stdout();
    printed(writeln!(out, "{line}").and_then(|()| out.flush()));
}

/// Records the outcome of a print to standard output.
pub(crate) fn printed(result: io::Result<()>) {
    match result {
        // After a closed pipe, as by `| head`, nobody reads a message.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => drop(NOT_PRINTED.set(error)),
        _ => {}
    }
}

/// Why some results could not be printed, if so.
pub(crate) fn not_printed() -> Option<&'static io::Error> {
    NOT_PRINTED.get()
}

/// A line of progress, a note or a warning, on standard error.
pub(crate) fn tell(line: impl Display) {
    if !is_quiet() {
        print_error(line);
    }
}

/// An error, on standard error.
pub(crate) fn print_error(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// The word in red if standard error is a terminal with colors.
pub(crate) fn red(word: &str) -> String {
    if io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none() {
        format!("\u{1b}[1;31m{word}\u{1b}[0m")
    } else {
        word.to_owned()
    }
}

/// A number in readable form: four significant digits, an exponent only where it is shorter.
pub(crate) fn readable(value: f64) -> String {
    const FIXED: std::ops::Range<i32> = -2..5;
    if value == 0.0 {
        // Minus zero is printed as zero.
        return "0".into();
    }
    // The exponent after rounding: 0.99999 has that of 1.
    let scientific = format!("{value:.3e}");
    match scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok()) {
        Some(exponent) if FIXED.contains(&exponent) => format!("{value:.*}", (3 - exponent).max(0) as usize),
        _ => scientific,
    }
}

/// The same with as many digits as a `tolerance` is resolved with.
pub(crate) fn readable_within(value: f64, tolerance: f64) -> String {
    /// Most significant digits of a number.
    const MOST: f64 = 15.0;
    let digits = (value.abs() / tolerance).log10().ceil();
    // Four digits tell it, or the value or the tolerance is zero or infinite.
    if !(digits > 2.0) || !digits.is_finite() {
        return readable(value);
    }
    let decimals = (1.0 - tolerance.log10().floor()).max(0.0) as usize;
    if digits + 2.0 > MOST || value.abs() < 1e-2 || value.abs() >= 1e7 {
        return format!("{value:.*e}", (digits + 1.0).min(MOST) as usize);
    }
    format!("{value:.decimals$}")
}

/// A duration in readable form.
pub(crate) fn duration(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 3600.0;
    if seconds < MINUTE {
        format!("{seconds:.1} s")
    } else if seconds < HOUR {
        format!("{} min {:02} s", (seconds / MINUTE).floor(), (seconds % MINUTE).floor())
    } else {
        format!("{} h {:02} min", (seconds / HOUR).floor(), (seconds % HOUR / MINUTE).floor())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_beside_its_tolerance_has_the_digits_to_tell_whether_it_is_within() {
        for (value, tolerance, expected) in [
            (3015.004, 0.01, "3015.004"),
            (3015.0, 0.01, "3015.000"),
            (68.14, 2.5, "68.14"),
            (0.999_999_5, 1e-6, "0.9999995"),
            (1.234_567_8e-9, 1e-14, "1.2345678e-9"),
            (0.0, 1e-3, "0"),
            (12.0, 0.0, "12.00"),
        ] {
            assert_eq!(readable_within(value, tolerance), expected);
        }
    }

    #[test]
    fn numbers_and_durations_are_short() {
        let numbers = [0.0, -0.0, 0.99999, 41.23456, 0.0276, 12345.678, 2.0e-5, -1.5e7, f64::NAN].map(readable);
        assert_eq!(numbers, ["0", "0", "1.000", "41.23", "0.02760", "12346", "2.000e-5", "-1.500e7", "NaN"]);
        assert_eq!([3.12, 75.0, 7322.0].map(duration), ["3.1 s", "1 min 15 s", "2 h 02 min"]);
    }
}
