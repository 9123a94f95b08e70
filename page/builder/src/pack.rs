//! Packs bytes as text for a script element: deflate, which browsers expand by themselves, in signs that a host's gzip packs well.

use anyhow::Result;
use zopfli::{Format, Options, compress};

/// So many blocks, each with codes of its own, are enough for all parts.
const MOST_BLOCKS: u16 = 100;
/// The signs: those of ASCII but for spaces and `<`, with which an element could end. Of 93 signs, 35 stand for six bits and 58 for seven. A host's gzip writes
/// them in just as many, and finds fewer of them repeated than of base64's, because a repetition by chance takes it more bits than it saves.
const SIX: u32 = 35;

/// The bytes packed, for `page/src/begin.js`.
pub fn packed(bytes: &[u8]) -> Result<String> {
    let mut packed = Vec::new();
    compress(Options { maximum_block_splits: MOST_BLOCKS, ..Options::default() }, Format::Deflate, bytes, &mut packed)?;
    Ok(signs(&packed))
}

fn signs(bytes: &[u8]) -> String {
    let mut bits = bytes.iter().flat_map(|byte| (0..8).rev().map(move |bit| u32::from(byte >> bit & 1)));
    let mut text = String::new();
    while let Some(first) = bits.next() {
        // Zeros fill up the last sign.
        let mut more = |number: u32, count: u32| (0..count).fold(number, |number, _| number * 2 + bits.next().unwrap_or(0));
        let six = more(first, 5);
        let place = if six < SIX { six } else { more(six, 1) - SIX };
        text.extend((b'!'..=b'~').map(char::from).filter(|sign| *sign != '<').nth(place as usize));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_below_thirty_five_are_signs_of_six_bits_and_others_of_seven() {
        assert_eq!(signs(&[0b00000010, 0b00101000, 0b11111110]), "!DFw");
        assert_eq!(signs(&[0b01101101, 0b11000000]), "=>!");
    }
}
