//! The 64-bit FNV-1a hash: detects changes of bytes by accident, not by intent.
//!
//! Source: Fowler, Noll, Vo, "The FNV non-cryptographic hash algorithm", IETF draft. The same on every machine and version.

use meniscus_core::math;

/// The FNV-1a hash of `bytes`.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    math::fnv1a(math::FNV1A_BASIS, bytes.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_of_known_strings_is_that_of_the_draft() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
