//! A call from Python: the work runs in its own threads without the interpreter's lock, while the calling thread handles signals and progress.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;

use meniscus::run::simulation::{Progress, Watcher};
use meniscus::{Snapshot, Solver};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;

use crate::data::Data;
use crate::fields;

/// Polling interval for signals.
const POLLING_INTERVAL: Duration = Duration::from_millis(20);
/// Polls between two calls of the progress function.
const POLLS_PER_REPORT: u32 = 5;

/// Progress of the work: the fraction done, and a text.
type LatestProgress = Mutex<Option<(f64, String)>>;

/// Runs in progress in this process, by token.
static GOING_ON: Mutex<Vec<(String, Arc<AtomicBool>)>> = Mutex::new(Vec::new());

/// Settings of a call.
pub(crate) struct Call {
    /// Number of threads; all cores if `None`.
    pub(crate) threads: Option<usize>,
    /// Progress function of a fraction from 0 to 1 and a text.
    pub(crate) progress: Option<Py<PyAny>>,
    /// Name by which [`stop`] finds the call.
    pub(crate) token: Option<String>,
}

/// The call as its work has it.
pub(crate) struct Work<'a> {
    /// Set when the work is to stop.
    pub(crate) interrupt: &'a AtomicBool,
    pending: &'a LatestProgress,
}

impl Work<'_> {
    /// Reports progress.
    pub(crate) fn tell(&self, fraction: f64, text: impl FnOnce() -> String) {
        let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
        // The text is only made if somebody listens.
        if pending.is_none() {
            *pending = Some((fraction, text()));
        }
    }

    /// Whether the work is to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }
}

/// Requests the calls with this token to stop.
pub(crate) fn stop(token: &str) {
    let going_on = GOING_ON.lock().unwrap_or_else(PoisonError::into_inner);
    going_on.iter().filter(|(name, _)| name == token).for_each(|(_, flag)| flag.store(true, Ordering::Relaxed));
}

/// Registration of a call for [`stop`]; ends when dropped.
struct Registered(Arc<AtomicBool>);

impl Registered {
    fn new(token: Option<String>) -> Self {
        let flag = Arc::new(AtomicBool::new(false));
        if let Some(token) = token {
            GOING_ON.lock().unwrap_or_else(PoisonError::into_inner).push((token, Arc::clone(&flag)));
        }
        Self(flag)
    }
}

impl Drop for Registered {
    fn drop(&mut self) {
        let mut going_on = GOING_ON.lock().unwrap_or_else(PoisonError::into_inner);
        going_on.retain(|(_, flag)| !Arc::ptr_eq(flag, &self.0));
    }
}

/// Cores of this machine available to this process.
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Does the work in a pool of threads that ends with it: a fork of this process must not miss threads of a pool.
///
/// # Errors
/// Whatever a signal or the progress function raises, after the work has stopped.
pub(crate) fn call<T: Send>(py: Python<'_>, call: Call, work: impl FnOnce(&Work<'_>) -> T + Send) -> PyResult<T> {
    let Call { threads, progress, token } = call;
    let requested = || std::env::var("RAYON_NUM_THREADS").ok()?.parse().ok().filter(|threads| *threads > 0);
    let threads = threads.or_else(requested).map_or_else(cores, |threads: usize| threads.min(cores()));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(format!("cannot start {threads} threads: {error}")))?;
    let (pending, registered) = (LatestProgress::default(), Registered::new(token));
    let (done, is_done) = mpsc::channel();
    let work_of = Work { interrupt: &registered.0, pending: &pending };
    let (found, raised) = py.detach(|| {
        let is_done = is_done;
        pool.in_place_scope(|scope| {
            let work_of = &work_of;
            scope.spawn(move |_| {
                // The receiver lives as long as this scope.
                let _ = done.send(work(work_of));
            });
            let (mut raised, mut polls) = (None, 0);
            loop {
                match is_done.recv_timeout(POLLING_INTERVAL) {
                    Ok(found) => return (Some(found), raised),
                    // It panicked: the scope propagates that.
                    Err(mpsc::RecvTimeoutError::Disconnected) => return (None, raised),
                    Err(mpsc::RecvTimeoutError::Timeout) => {}
                }
                polls += 1;
                let is_due = polls % POLLS_PER_REPORT == 0;
                if raised.is_none()
                    && let Err(error) = Python::attach(|py| poll(py, progress.as_ref().filter(|_| is_due), &pending))
                {
                    registered.0.store(true, Ordering::Relaxed);
                    raised = Some(error);
                }
            }
        })
    });
    if let Some(error) = raised {
        return Err(error);
    }
    if let Some(progress) = progress {
        progress.call1(py, (1.0, "done"))?;
    }
    found.ok_or_else(|| PyRuntimeError::new_err("the work ended without a result"))
}

/// Lets Python handle signals, and reports progress.
fn poll(py: Python<'_>, progress: Option<&Py<PyAny>>, pending: &LatestProgress) -> PyResult<()> {
    py.check_signals()?;
    if let Some(progress) = progress {
        let latest = pending.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some((fraction, text)) = latest {
            progress.call1(py, (fraction, text))?;
        }
    }
    Ok(())
}

/// Observes a run for a call, and keeps its frames if requested.
pub(crate) struct Observer<'a> {
    work: &'a Work<'a>,
    frames: Option<Vec<Data>>,
}

impl<'a> Observer<'a> {
    /// An observer that keeps the frames or not.
    pub(crate) fn new(work: &'a Work<'a>, keeps_frames: bool) -> Self {
        Self { work, frames: keeps_frames.then(Vec::new) }
    }

    /// The frames so far.
    pub(crate) fn into_frames(self) -> Vec<Data> {
        self.frames.unwrap_or_default()
    }
}

impl Watcher for Observer<'_> {
    fn stepped(&mut self, progress: &Progress) {
        let Progress { clock, time, end, step, .. } = *progress;
        let text = || format!("{} = {time:.3e} of {end:.3e} {}, step {step}", clock.symbol, clock.unit);
        self.work.tell((time / end).clamp(0.0, 1.0), text);
    }

    fn framed(&mut self, solver: &dyn Solver) {
        if let Some(frames) = &mut self.frames {
            let snapshot: Snapshot<'_> = solver.snapshot();
            frames.push(fields::frame(solver.time(), &snapshot, &solver.layers()));
        }
    }
}
