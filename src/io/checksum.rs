//! The FNV-1a hash of 64 bits: tells whether bytes changed, by accident, not by intent.
//!
//! Source: Fowler, Noll, Vo, "The FNV non-cryptographic hash algorithm", IETF draft. The same on every machine and version.

/// Start value of the hash.
const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
/// Factor of the hash.
const PRIME: u64 = 0x0100_0000_01b3;

/// The FNV-1a hash of `bytes`.
#[must_use]
pub fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(OFFSET_BASIS, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
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
