//! Progress of a run on standard error: a bar on a terminal, else a line now and then.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output::{duration, is_quiet, readable, tell};
use crate::run::simulation::{Progress, Watcher};
use meniscus_core::solver::Clock;

/// Length of the bar: per mille.
const LENGTH: u64 = 1000;
/// Time between lines without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(15);
/// Time between updates of the bar's text.
const BETWEEN_UPDATES: Duration = Duration::from_millis(200);

/// Shows the progress of a run, the remaining time and the limit that sets its time step.
pub(crate) struct ProgressDisplay {
    bar: Option<ProgressBar>,
    begun: Instant,
    shown: Instant,
    /// Time of the first observed step in s: a resumed run does not start at zero.
    from: Option<f64>,
}

impl ProgressDisplay {
    /// A display that starts now.
    pub(crate) fn new() -> Self {
        let bar = console_bar(Some(LENGTH), "{bar:30} {percent:>3} %  {msg}");
        Self { bar, begun: Instant::now(), shown: Instant::now(), from: None }
    }

    /// Shows the progress of packing particles before time zero.
    pub(crate) fn packed(&mut self, fraction: f64) {
        const TEXT: &str = "particles are packed to walls and interfaces";
        self.show(fraction, || TEXT.to_owned());
    }

    /// Shows the progress of the trial steps.
    pub(crate) fn trial(&mut self, fraction: f64) {
        self.show(fraction, || "first steps are tried".to_owned());
    }

    /// Shows the progress of drawing a movie.
    pub(crate) fn filmed(&mut self, fraction: f64) {
        self.show(fraction, || "frames are drawn".to_owned());
    }

    /// Shows a fraction of the work with a text, if enough time has passed since the last update.
    fn show(&mut self, fraction: f64, text: impl FnOnce() -> String) {
        let pause = if self.bar.is_some() { BETWEEN_UPDATES } else { BETWEEN_LINES };
        if self.shown.elapsed() < pause {
            return;
        }
        self.shown = Instant::now();
        match &self.bar {
            Some(bar) => {
                bar.set_position((LENGTH as f64 * fraction) as u64);
                bar.set_message(text());
            }
            None => tell(format_args!("{:3.0} %  {}", 100.0 * fraction, text())),
        }
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// Estimated seconds left, at the mean speed so far, if there is one.
    fn left(&self, progress: &Progress) -> Option<f64> {
        let done = progress.time - self.from?;
        (done > 0.0).then(|| self.begun.elapsed().as_secs_f64() * (progress.end - progress.time) / done)
    }
}

/// A bar on standard error, if that is a terminal and not to be quiet.
pub(super) fn console_bar(length: Option<u64>, template: &str) -> Option<ProgressBar> {
    if is_quiet() || !std::io::stderr().is_terminal() {
        return None;
    }
    let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::stderr());
    bar.set_style(ProgressStyle::with_template(template).ok()?.progress_chars("━━─"));
    Some(bar)
}

/// One line with the progress of a run.
fn line(progress: &Progress, left: Option<f64>) -> String {
    let Clock { symbol, unit, .. } = progress.clock;
    let left = left.map_or(String::new(), |seconds| format!(", about {} left", duration(seconds)));
    format!(
        "{symbol} = {} of {} {unit}, step {}, d{symbol} = {} {unit} ({}){left}",
        readable(progress.time),
        readable(progress.end),
        progress.step,
        readable(progress.dt),
        progress.limit
    )
}

impl Watcher for ProgressDisplay {
    fn stepped(&mut self, progress: &Progress) {
        self.from.get_or_insert(progress.time - progress.dt);
        let left = self.left(progress);
        self.show(progress.time / progress.end, || line(progress, left));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_names_the_limit_and_the_time_left() {
        let progress =
            Progress { clock: Clock::TIME, time: 0.005, end: 0.02, step: 120, dt: 4.1e-5, limit: "surface tension" };
        let expected = "t = 5.000e-3 of 0.02000 s, step 120, dt = 4.100e-5 s (surface tension), about 1 min 15 s left";
        assert_eq!(line(&progress, Some(75.0)), expected);
    }
}
