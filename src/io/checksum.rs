//! The 64-bit FNV-1a hash: detects changes of bytes by accident, not by intent.
//!
//! Source: Fowler, Noll, Vo, "The FNV non-cryptographic hash algorithm", IETF draft. The same on every machine and version.

use serde::{Deserialize, Serialize};

use crate::math;

/// The hash of a stream of bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fnv1a(u64);

impl Default for Fnv1a {
    fn default() -> Self {
        Self(math::FNV1A_BASIS)
    }
}

impl Fnv1a {
    /// Adds the next bytes.
    pub(crate) fn pass(&mut self, bytes: &[u8]) {
        self.0 = math::fnv1a(self.0, bytes.iter().copied());
    }
}

/// The FNV-1a hash of `bytes`.
pub(crate) fn fnv1a(bytes: &[u8]) -> u64 {
    let mut hash = Fnv1a::default();
    hash.pass(bytes);
    hash.0
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
