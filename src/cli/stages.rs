//! Stages of a command without time steps: one line on standard error, if it takes long.
//!
//! Printed by a separate thread, so that a stage of many seconds is shown while it lasts. The progress within a stage is not known, only its number and the
//! total. On a terminal the line is rewritten in place.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::output::{duration, tell};
use super::progress::console_bar;

/// Nothing is printed before: most files are measured sooner.
const SILENT: Duration = Duration::from_secs(2);
/// Time between lines of the same stage without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(15);
/// Polling interval.
const POLLING_INTERVAL: Duration = Duration::from_millis(200);

/// The current stage: its number, from 1, its name, and whether the command is done.
#[derive(Default)]
struct Now {
    number: usize,
    name: &'static str,
    is_done: bool,
}

/// Prints the stages of a command from the second second on, until it is dropped.
pub(super) struct Stages {
    now: Arc<(Mutex<Now>, Condvar)>,
    teller: Option<JoinHandle<()>>,
}

impl Stages {
    /// Starts watching a command of `count` stages.
    pub(crate) fn of(count: usize) -> Self {
        let bar = console_bar(None, "{msg}");
        let show = move |line: &str, is_new: bool| match &bar {
            Some(bar) => bar.set_message(line.to_owned()),
            None if is_new => tell(line),
            None => {}
        };
        Self::telling(count, SILENT, show)
    }

    /// The same with another initial silence; `show` receives each line and whether a new stage or enough time warrants a separate line.
    fn telling(count: usize, silent: Duration, show: impl Fn(&str, bool) + Send + 'static) -> Self {
        let now = Arc::new((Mutex::new(Now::default()), Condvar::new()));
        let shared = Arc::clone(&now);
        let teller = std::thread::spawn(move || {
            let (begun, mut pause) = (Instant::now(), silent);
            let (mut shown, mut shown_at) = (0, begun);
            let mut state = shared.0.lock().unwrap_or_else(PoisonError::into_inner);
            while !state.is_done {
                let waited = shared.1.wait_timeout_while(state, pause, |now| !now.is_done);
                state = waited.unwrap_or_else(PoisonError::into_inner).0;
                if state.is_done {
                    break;
                }
                pause = POLLING_INTERVAL;
                let is_new = state.number != shown || shown_at.elapsed() >= BETWEEN_LINES;
                if is_new {
                    (shown, shown_at) = (state.number, Instant::now());
                }
                let seconds = begun.elapsed().as_secs_f64();
                show(&format!("{} of {count}: {}, {}", state.number, state.name, duration(seconds)), is_new);
            }
        });
        Self { now, teller: Some(teller) }
    }

    /// Starts the next stage.
    pub(crate) fn at(&self, name: &'static str) {
        let mut now = self.now.0.lock().unwrap_or_else(PoisonError::into_inner);
        now.number += 1;
        now.name = name;
    }
}

impl Drop for Stages {
    fn drop(&mut self) {
        self.now.0.lock().unwrap_or_else(PoisonError::into_inner).is_done = true;
        self.now.1.notify_all();
        // The bar ends with its thread, which cannot fail.
        let _ = self.teller.take().map(JoinHandle::join);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines that a command with one stage of 300 ms prints after this silence.
    fn lines(silent: Duration) -> Vec<String> {
        let lines = Arc::new(Mutex::new(Vec::new()));
        let kept = Arc::clone(&lines);
        let stages = Stages::telling(3, silent, move |line, is_new| {
            if is_new {
                kept.lock().unwrap().push(line.to_owned());
            }
        });
        stages.at("uniting the shapes");
        std::thread::sleep(Duration::from_millis(300));
        drop(stages);
        Arc::try_unwrap(lines).unwrap().into_inner().unwrap()
    }

    #[test]
    fn a_command_that_is_done_soon_tells_nothing() {
        assert_eq!(lines(Duration::from_secs(60)), Vec::<String>::new());
    }

    #[test]
    fn a_command_that_takes_long_tells_its_stage_once() {
        let shown = lines(Duration::from_millis(1));
        // The stage may start after the first poll.
        let last = shown.last().unwrap();
        assert!(last.starts_with("1 of 3: uniting the shapes, 0."), "{shown:?}");
        assert!(shown.len() <= 2, "{shown:?}");
    }
}
