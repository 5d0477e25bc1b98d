//! The 64-bit FNV-1a hash: detects changes of bytes by accident, not by intent.
//!
//! Source: Fowler, Noll, Vo, "The FNV non-cryptographic hash algorithm", IETF draft. The same on every machine and version.

use std::io::{self, Write};

use meniscus_core::math;

/// The FNV-1a hash of `bytes`.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    math::fnv1a(math::FNV1A_BASIS, bytes.iter().copied())
}

/// A target that counts and sums up what is written to it.
pub(crate) struct Summed<W> {
    to: W,
    /// Number of bytes so far.
    pub(crate) bytes: usize,
    /// Their [`fnv1a`].
    pub(crate) checksum: u64,
}

impl<W: Write> Summed<W> {
    /// A target to which nothing is written so far.
    pub(crate) fn new(to: W) -> Self {
        Self { to, bytes: 0, checksum: math::FNV1A_BASIS }
    }
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.bytes += written;
        self.checksum = math::fnv1a(self.checksum, bytes[..written].iter().copied());
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_in_parts_has_the_hash_of_the_whole() {
        let (mut to, whole) = (Vec::new(), b"foobar");
        let mut summed = Summed::new(&mut to);
        summed.write_all(b"foo").and_then(|()| summed.write_all(b"bar")).unwrap();
        assert_eq!((summed.bytes, summed.checksum), (whole.len(), fnv1a(whole)));
        assert_eq!(to, whole);
    }

    #[test]
    fn the_hash_of_known_strings_is_that_of_the_draft() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
