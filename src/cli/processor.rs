//! Whether the processor has the instructions that the program was built with (`.cargo/config.toml`).

use super::exit::{Failure, USAGE};

/// # Errors
/// A failure that tells how to build for the processor, where it lacks them: the first one would end the program without a word.
pub fn check() -> Result<(), Failure> {
    if cfg!(target_feature = "avx2") && !has_avx2() {
        let what = "this processor lacks AVX2 instructions, with which the program was built; build it without them: \
                    RUSTFLAGS='-C target-cpu=x86-64' cargo build --release";
        return Err(Failure::new(USAGE, &what));
    }
    Ok(())
}

/// What the processor itself tells: the standard library's test takes what the program was built with for granted.
#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    raw_cpuid::CpuId::new().get_extended_feature_info().is_some_and(|features| features.has_avx2())
}

#[cfg(not(target_arch = "x86_64"))]
fn has_avx2() -> bool {
    false
}
