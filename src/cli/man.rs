//! `meniscus man`: manual pages, generated from the same arguments as the help.

use std::path::Path;

use clap::CommandFactory;
use clap_mangen::Man;

use super::arguments::Arguments;
use super::exit::{DONE, Failure, USAGE};
use super::output::say;
use meniscus_output::atomic;

/// Prints the page of the program, or writes it with those of all commands into a folder.
pub(crate) fn man(out: Option<&Path>) -> Result<u8, Failure> {
    let mut program = Arguments::command();
    program.build();
    let Some(folder) = out else {
        say(page(&program)?.trim_end());
        return Ok(DONE);
    };
    let count = write(folder, &program)?;
    say(format_args!("wrote {count} pages to {0}; try: man {0}/meniscus.1", folder.display()));
    Ok(DONE)
}

/// Writes the pages of a command and its subcommands, and returns their number.
fn write(folder: &Path, command: &clap::Command) -> Result<usize, Failure> {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name());
    let file = folder.join(format!("{name}.1"));
    atomic::write(&file, page(command)?.as_bytes()).map_err(Failure::with(USAGE))?;
    let below = command.get_subcommands().filter(|below| below.get_name() != "help");
    below.map(|below| write(folder, below)).sum::<Result<usize, _>>().map(|count| count + 1)
}

/// The page of a command in roff.
fn page(command: &clap::Command) -> Result<String, Failure> {
    let mut text = Vec::new();
    Man::new(command.clone()).render(&mut text).map_err(Failure::with(USAGE))?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}
