//! Ctrl-C and termination signals: the first one requests the run to stop after its step, the second one ends the program at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::exit::INTERRUPTED;
use super::output::tell;

/// The flag that these signals set, one per process. If no handler can be installed, the signals end the program as usual.
pub(crate) fn flag() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    Arc::clone(FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        if let Err(error) = install(Arc::clone(&flag)) {
            tell(format_args!("note: Ctrl-C will not save the state: {error}"));
        }
        flag
    }))
}

/// A signal arrived. Only a second one ends the program: the flag may already be set for another reason, such as a parent that got the same signal.
fn asked_to_stop(flag: &AtomicBool, how: &str) {
    static ONE_CAME: AtomicBool = AtomicBool::new(false);
    flag.store(true, Ordering::Relaxed);
    if ONE_CAME.swap(true, Ordering::Relaxed) {
        std::process::exit(i32::from(INTERRUPTED));
    }
    tell(format_args!("\ninterrupted{how}: finishing the step and saving the state (once more: stop at once)"));
}

#[cfg(unix)]
fn install(flag: Arc<AtomicBool>) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let mut signals = vec![SIGINT, SIGTERM];
    // A program started with `nohup` is meant to continue.
    if !is_ignored(SIGHUP) {
        signals.push(SIGHUP);
    }
    let mut signals = signal_hook::iterator::Signals::new(signals)?;
    std::thread::Builder::new().name("signals".into()).spawn(move || {
        for signal in signals.forever() {
            let how = match signal {
                SIGTERM => " by SIGTERM",
                SIGHUP => " by SIGHUP",
                _ => "",
            };
            asked_to_stop(&flag, how);
        }
    })?;
    Ok(())
}

/// Whether this process was started with a signal ignored, if the system reports it.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask & (1 << (signal - 1)) != 0)
}

#[cfg(not(unix))]
fn install(flag: Arc<AtomicBool>) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(move || asked_to_stop(&flag, ""))
}
