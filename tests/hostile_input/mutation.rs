//! Changes of files: bytes, lines, and numbers that are extreme.

/// Numbers from a seed: splitmix64.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    pub fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }
}

/// Numbers and what may stand in their place.
pub const EXTREME: [&str; 34] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "1e-3",
    "1e3",
    "1e6",
    "1e9",
    "1e15",
    "1e18",
    "1e100",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e-9",
    "1e-15",
    "1e-100",
    "1e-300",
    "5e-324",
    "-5e-324",
    "nan",
    "inf",
    "-inf",
    "65536",
    "4294967296",
    "2147483648",
    "9223372036854775807",
    "18446744073709551616",
    "99999999999999999999999999",
    "0.30000000000000004",
    "1e999",
    "[]",
    "\"1 mm\"",
];

const WORDS: [&str; 24] = [
    "\"", "'", "[", "]", "{", "}", "(", ")", "<", ">", "/>", "#", "=", "\n", "\r\n", "\0", "\u{e9}", "\u{feff}", ",",
    ";", "EMPTY", "true", "[[", "mm",
];

/// The file with one to three changes, and what they are.
pub fn changed(bytes: &[u8], random: &mut Random) -> (Vec<u8>, String) {
    let (mut bytes, mut told) = (bytes.to_vec(), Vec::new());
    // Most with one change, so that what comes after the reader is reached.
    let changes = *random.one_of(&[1, 1, 1, 2, 3]);
    for _ in 0..changes {
        told.push(change(&mut bytes, random));
    }
    (bytes, told.join(", "))
}

fn change(bytes: &mut Vec<u8>, random: &mut Random) -> String {
    let at = random.below(bytes.len());
    match random.below(14) {
        0 if !bytes.is_empty() => {
            bytes[at] ^= 1 << random.below(8);
            format!("bit at {at}")
        }
        1 if !bytes.is_empty() => {
            bytes[at] = random.next() as u8;
            format!("byte at {at}")
        }
        2 => {
            bytes.truncate(at);
            format!("cut at {at}")
        }
        3 => {
            let word = random.one_of(&WORDS);
            bytes.splice(at..at, word.bytes());
            format!("{word:?} at {at}")
        }
        4 => {
            let length = *random.one_of(&[100, 10_000, 100_000]);
            bytes.splice(at..at, std::iter::repeat_n(*random.one_of(b"a0[ (-"), length));
            format!("{length} letters at {at}")
        }
        5..=7 => lines(bytes, random),
        _ => number(bytes, random),
    }
}

fn lines(bytes: &mut Vec<u8>, random: &mut Random) -> String {
    let mut all: Vec<Vec<u8>> = bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    if all.is_empty() {
        return "nothing".to_owned();
    }
    let (i, j) = (random.below(all.len()), random.below(all.len()));
    let told = match random.below(3) {
        0 => {
            all.remove(i);
            format!("line {} dropped", i + 1)
        }
        1 => {
            all.insert(j, all[i].clone());
            format!("line {} again at {}", i + 1, j + 1)
        }
        _ => {
            all.swap(i, j);
            format!("lines {} and {} swapped", i + 1, j + 1)
        }
    };
    *bytes = all.concat();
    told
}

/// Replaces a number, or multiplies it.
fn number(bytes: &mut Vec<u8>, random: &mut Random) -> String {
    let places = numbers(bytes);
    if places.is_empty() {
        return "nothing".to_owned();
    }
    let place = random.one_of(&places).clone();
    let old = String::from_utf8_lossy(&bytes[place.clone()]).into_owned();
    let new = if random.below(3) == 0 {
        let factor = *random.one_of(&[-1.0, 0.1, 10.0, 1e-3, 1e3, 1e-6, 1e6, 1.0 + 1e-9]);
        old.parse::<f64>().map_or_else(|_| "7".to_owned(), |old| format!("{:e}", old * factor))
    } else {
        (*random.one_of(&EXTREME)).to_owned()
    };
    bytes.splice(place, new.bytes());
    format!("{old} -> {new}")
}

/// Where numbers stand: digits that begin no part of a word.
pub fn numbers(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut i = 0;
    while i < bytes.len() {
        let begins = bytes[i].is_ascii_digit()
            && (i == 0 || !(bytes[i - 1].is_ascii_alphanumeric() || bytes[i - 1] == b'-'))
            || (bytes[i] == b'-'
                && bytes.get(i + 1).is_some_and(u8::is_ascii_digit)
                && (i == 0 || !bytes[i - 1].is_ascii_alphanumeric()));
        if !begins {
            i += 1;
            continue;
        }
        let start = i;
        i += 1;
        while i < bytes.len()
            && (bytes[i].is_ascii_digit()
                || b".eE_".contains(&bytes[i])
                || (b"+-".contains(&bytes[i]) && b"eE".contains(&bytes[i - 1])))
        {
            i += 1;
        }
        found.push(start..i);
    }
    found
}
