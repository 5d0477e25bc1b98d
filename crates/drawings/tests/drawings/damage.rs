//! Damages of files.

use proptest::prelude::*;

/// A damage: where it begins as a share of the file, what is written there, and how many bytes it replaces.
pub type Damage = (f64, Vec<u8>, usize);

/// Bytes at random, or words that readers may trip over.
pub fn damage() -> impl Strategy<Value = Vec<Damage>> {
    let words: Vec<Vec<u8>> = [
        "1e999",
        "-1",
        "NaN",
        "inf",
        "1000000000",
        "0",
        "1e-320",
        "\n",
        ",",
        "(",
        ")",
        "[[",
        "<g>",
        "/>",
        "\0",
        "\u{e9}",
    ]
    .map(|word| word.as_bytes().to_vec())
    .into();
    let written = prop_oneof![
        2 => proptest::sample::select(words),
        2 => proptest::collection::vec(any::<u8>(), 1..5),
        1 => Just(vec![0xff; 4]),
        1 => Just(vec![0x7f, 0xff, 0xff, 0xff]),
        1 => Just(Vec::new()),
    ];
    // The head of a file, which holds its counts, is hit as often as the rest.
    let place = prop_oneof![0.0..1.0_f64, 0.0..0.02_f64];
    proptest::collection::vec((place, written, prop_oneof![0_usize..6, 0_usize..200]), 1..5)
}

/// A copy with damages.
pub fn damaged(bytes: &[u8], damages: &[Damage]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (place, written, replaced) in damages {
        let from = ((bytes.len() as f64 * place) as usize).min(bytes.len());
        let to = (from + replaced).min(bytes.len());
        bytes.splice(from..to, written.iter().copied());
    }
    bytes
}
