//! Ctrl-C: the first one asks the run to stop after its step, the second one ends the program at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::exit::INTERRUPTED;
use super::output::tell;

/// The flag that Ctrl-C sets, the same one for all that a process does. Where no handler can be installed, Ctrl-C ends the program as it
/// always does.
pub fn flag() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    Arc::clone(FLAG.get_or_init(set_by_interrupt))
}

fn set_by_interrupt() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&flag);
    let handler = move || {
        if set.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(INTERRUPTED));
        }
        tell("\ninterrupted: finishing the step and saving the state (again Ctrl-C: stop at once)");
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        tell(format_args!("note: Ctrl-C will not save the state: {error}"));
    }
    flag
}
