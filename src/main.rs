//! The `meniscus` program; all of it is in the library.

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Keeps the large arrays of a step: returned to the system and fetched again they cost a seventh of it (docs/numerics/overview.md).
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    meniscus::cli::processor::require();
    meniscus::cli::main()
}
