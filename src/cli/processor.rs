//! Whether the processor has the instructions that the program was built with (`.cargo/config.toml`: x86-64-v3).

/// The message if they are missing.
pub const INSUFFICIENT: &str = "this processor lacks instructions (AVX2) that the program was built with; build it without them: \
                                RUSTFLAGS='-C target-cpu=x86-64' cargo build --release";

/// Ends the program with a message if the processor lacks them: the first such instruction would end it without one.
///
/// To be called first. Only functions of the standard library work here, which is built for any processor.
#[inline(never)]
pub fn require() {
    if !is_sufficient() {
        use std::io::Write;

        let mut err = std::io::stderr();
        // Nobody is left to report an error to.
        let _ = [b"error: ".as_slice(), INSUFFICIENT.as_bytes(), b"\n"]
            .into_iter()
            .try_for_each(|part| err.write_all(part));
        std::process::exit(i32::from(super::exit::USAGE));
    }
}

/// Whether the processor has them.
#[inline(never)]
pub fn is_sufficient() -> bool {
    #[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
    return has_v3();
    #[cfg(not(all(target_arch = "x86_64", target_feature = "avx2")))]
    true
}

/// As reported by the processor: the test of the standard library presumes the instructions that the program was built with.
#[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
fn has_v3() -> bool {
    let processor = raw_cpuid::CpuId::new();
    let basic = processor
        .get_feature_info()
        .is_some_and(|f| f.has_avx() && f.has_fma() && f.has_f16c() && f.has_movbe() && f.has_oxsave());
    let extended = processor.get_extended_feature_info().is_some_and(|f| f.has_avx2() && f.has_bmi1() && f.has_bmi2());
    let more = processor.get_extended_processor_and_feature_identifiers().is_some_and(|f| f.has_lzcnt());
    basic && extended && more
}
