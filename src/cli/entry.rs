//! From the arguments to a command and its exit code.

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use super::arguments::{Arguments, Command};
use super::exit::{BUG, DONE, Failure, USAGE};
use super::output::{print_error, say};
use super::threads::pool;
use super::{check, compare, couple, geometry, list, man, movie, network, new, output, run, study, threads};

/// Reads the command line and executes it.
pub fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        let location =
            panic.location().map_or(String::new(), |location| format!(" ({}:{})", location.file(), location.line()));
        let payload = panic.payload();
        let what =
            payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        let what = what.unwrap_or("no message");
        print_error(format_args!(
            "bug in meniscus: {what}{location}. Please report this line together with the case file."
        ));
        std::process::exit(i32::from(BUG));
    }));
    let code = match Arguments::try_parse() {
        Ok(arguments) => {
            threads::bound_environment();
            if arguments.quiet {
                output::be_quiet();
            }
            dispatch(arguments.command).unwrap_or_else(|failure| {
                print_error(failure.message.trim_end());
                failure.code
            })
        }
        // Help and version also arrive here.
        Err(error) => {
            let printed = error.print();
            if !error.use_stderr() {
                output::printed(printed.and_then(|()| std::io::stdout().flush()));
            }
            if error.use_stderr() { USAGE } else { DONE }
        }
    };
    ExitCode::from(all_printed(code))
}

/// The exit code, unless results that should have been printed are lost.
fn all_printed(code: u8) -> u8 {
    let Some(error) = output::not_printed() else { return code };
    let what = format!("cannot print the results: {error}; write them somewhere else");
    print_error(Failure::new(USAGE, &what).message);
    if code == DONE { USAGE } else { code }
}

fn dispatch(command: Option<Command>) -> Result<u8, Failure> {
    match command {
        None => run::run(&run::RunArguments::default()),
        Some(Command::Run(arguments)) => run::run(&arguments),
        Some(Command::Check(arguments)) => pool(arguments.threads)?.install(|| check::check(&arguments)),
        Some(Command::Geometry(arguments)) => pool(arguments.threads)?.install(|| geometry::geometry(&arguments)),
        Some(Command::New(arguments)) => new::new(&arguments),
        Some(Command::List) => {
            list::list();
            Ok(DONE)
        }
        Some(Command::Schema { study }) => {
            let schema = if study { crate::study::schema() } else { meniscus_case::schema() };
            say(format!("{schema:#}").trim_end());
            Ok(DONE)
        }
        Some(Command::Completions { shell }) => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "meniscus", &mut script);
            say(String::from_utf8_lossy(&script).trim_end());
            Ok(DONE)
        }
        Some(Command::Man { out }) => man::man(out.as_deref()),
        Some(Command::Movie(arguments)) => movie::movie(&arguments),
        Some(Command::Network(arguments)) => network::network(&arguments),
        Some(Command::Compare(arguments)) => compare::compare(&arguments),
        Some(Command::Couple(arguments)) => couple::couple(&arguments),
        Some(Command::Study(command)) => study::study(&command),
    }
}
