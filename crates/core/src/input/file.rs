//! Reading files named by the user: regular files of bounded size. A device or a pipe may never end.

use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// Largest file in bytes: a larger drawing or mask would expand to more than the memory of a machine.
pub const LARGEST: u64 = 1 << 28;

/// Largest text in bytes: about that of a list of a million shapes.
pub const LARGEST_TEXT: u64 = 1 << 26;

/// The bytes of a file.
///
/// # Errors
/// It is not a regular file, is larger than `largest` bytes, or cannot be read.
pub fn read(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for its other end.
    let metadata = std::fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(io::Error::other(format!("it is {}, expected a file", kind(&metadata))));
    }
    if metadata.len() > largest {
        return Err(too_large(metadata.len(), largest));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(largest + 1).read_to_end(&mut bytes)?;
    let length = bytes.len() as u64;
    if length > largest { Err(too_large(length, largest)) } else { Ok(bytes) }
}

/// The text of a file of at most [`LARGEST_TEXT`] bytes, without byte order mark.
///
/// # Errors
/// See [`read`]; and [`io::ErrorKind::InvalidData`] with the line of the first byte that is not valid UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    let text = String::from_utf8(read(path, LARGEST_TEXT)?).map_err(|error| {
        let position = not_text(error.as_bytes()).unwrap_or_default();
        io::Error::new(io::ErrorKind::InvalidData, position)
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Position of the first byte that is not valid UTF-8, as `line 3, byte 17`.
pub fn not_text(bytes: &[u8]) -> Option<String> {
    let valid = std::str::from_utf8(bytes).err()?.valid_up_to();
    let line = bytes[..valid].iter().filter(|byte| **byte == b'\n').count() + 1;
    Some(format!("line {line}, byte {}", valid + 1))
}

fn too_large(length: u64, largest: u64) -> io::Error {
    const MEBIBYTE: u64 = 1 << 20;
    let (length, largest) = (length / MEBIBYTE, largest / MEBIBYTE);
    io::Error::other(format!("it has {length} MiB or more, expected at most {largest} MiB"))
}

fn kind(metadata: &Metadata) -> &'static str {
    if metadata.is_dir() { "a folder" } else { "a device, a pipe or a socket" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_up_to_their_size_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f");
        std::fs::write(&path, "\u{feff}abc").unwrap();
        assert_eq!(read_text(&path).unwrap(), "abc");
        assert_eq!(read(&path, 6).unwrap().len(), 6);
        assert!(read(&path, 5).unwrap_err().to_string().contains("expected at most"));
        assert!(read(folder.path(), 9).unwrap_err().to_string().contains("a folder"));
        #[cfg(unix)]
        assert!(read(Path::new("/dev/zero"), 9).unwrap_err().to_string().contains("a device"));
    }

    #[test]
    fn bytes_that_are_no_text_are_named_with_their_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f");
        std::fs::write(&path, b"a\nb \xff").unwrap();
        assert_eq!(read_text(&path).unwrap_err().to_string(), "line 2, byte 5");
        assert_eq!(not_text(b"abc"), None);
    }
}
