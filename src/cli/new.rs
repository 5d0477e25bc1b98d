//! `meniscus new`: a commented starter case, or a shape file of generated grains.

use std::path::PathBuf;

use super::arguments::NewArguments;
use super::exit::{DONE, Failure, USAGE};
use super::output::say;
use super::{new_pack, source};
use meniscus_output::atomic;

/// Writes the starter case, or the generated grains, to a file that does not exist yet.
pub(crate) fn new(arguments: &NewArguments) -> Result<u8, Failure> {
    let default = if arguments.pack.pack.is_some() { "pack.toml" } else { "case.toml" };
    let file = arguments.file.clone().unwrap_or_else(|| PathBuf::from(default));
    if file.exists() {
        return Err(Failure::new(USAGE, format_args!("{} exists; name another file", file.display())));
    }
    if let Some(kind) = arguments.pack.pack {
        return new_pack::new_pack(kind, arguments, &file);
    }
    let text = source::starter_case(arguments.depth)?;
    atomic::write(&file, text.as_bytes()).map_err(Failure::with(USAGE))?;
    say(format_args!("wrote {0}; try: meniscus check {0}, then: meniscus run {0}", file.display()));
    Ok(DONE)
}
