//! The `meniscus` program; all of it is in the library.

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Retains the large arrays of a step: returning them to the system and fetching them again costs a seventh of it (docs/numerics/overview.md).
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    meniscus::cli::processor::require();
    meniscus::cli::main()
}
