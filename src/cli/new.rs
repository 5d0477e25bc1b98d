//! `meniscus new`: a commented starter case.

use super::arguments::NewArguments;
use super::exit::{DONE, Failure, USAGE};
use super::output::say;
use super::source;
use crate::io::atomic;

/// Writes the starter case to a file that does not exist yet.
pub fn new(arguments: &NewArguments) -> Result<u8, Failure> {
    let file = &arguments.file;
    if file.exists() {
        return Err(Failure::new(USAGE, &format_args!("{} exists; name another file", file.display())));
    }
    let text = source::starter_case();
    atomic::write(file, text.as_bytes()).map_err(|error| Failure::new(USAGE, &error))?;
    say(format_args!("wrote {0}; try: meniscus check {0}, then: meniscus run {0}", file.display()));
    Ok(DONE)
}
