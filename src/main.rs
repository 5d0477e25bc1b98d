//! The `meniscus` program; a thin wrapper of the library.

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Keeps the large arrays of a step: returning them to the system and allocating them anew costs a seventh of it (docs/numerics/overview.md).
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    meniscus::cli::processor::require();
    meniscus::cli::main()
}
