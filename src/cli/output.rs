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
    fn numbers_and_durations_are_short() {
        let numbers = [0.0, -0.0, 0.99999, 41.23456, 0.0276, 12345.678, 2.0e-5, -1.5e7, f64::NAN].map(readable);
        assert_eq!(numbers, ["0", "0", "1.000", "41.23", "0.02760", "12346", "2.000e-5", "-1.500e7", "NaN"]);
        assert_eq!([3.12, 75.0, 7322.0].map(duration), ["3.1 s", "1 min 15 s", "2 h 02 min"]);
    }
}
