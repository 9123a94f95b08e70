//! The checksum of model files, slots in flash and vocabularies: CRC-32, as in Ethernet, zip and PNG. Beside it, a hash for tables of words.

/// Bytes of the CRC-32.
pub const CHECK_BYTES: usize = 4;

/// The FNV-1a hash of these values, one step for each.
#[cfg(any(feature = "layer", feature = "talk"))]
pub(crate) fn fnv(values: impl Iterator<Item = u32>) -> u32 {
    values.fold(0x811c_9dc5, |hash, value| (hash ^ value).wrapping_mul(0x0100_0193))
}

/// The check of each half byte. A table for whole bytes takes 1 KB of a controller's flash, and without any the vocabulary's check takes a
/// small controller more than a quarter of a tick.
#[allow(clippy::indexing_slicing, reason = "it is computed when the library is compiled")]
const TABLE: [u32; 16] = {
    let mut table = [0; 16];
    let mut at = 0;
    while at < table.len() {
        let (mut entry, mut bits) = (at as u32, 0);
        while bits < 4 {
            entry = (entry >> 1) ^ if entry & 1 == 1 { 0xedb8_8320 } else { 0 };
            bits += 1;
        }
        table[at] = entry;
        at += 1;
    }
    table
};

/// A checksum under way, kept between calls.
#[derive(Clone, Debug)]
pub(crate) struct Running(u32);

impl Running {
    /// The checksum of no bytes.
    pub(crate) const fn new() -> Self {
        Self(u32::MAX)
    }

    pub(crate) fn update(&mut self, bytes: &[u8]) {
        let half = |check: u32| TABLE.get((check & 15) as usize).copied().unwrap_or(0) ^ (check >> 4);
        self.0 = bytes.iter().fold(self.0, |check, &byte| half(half(check ^ u32::from(byte))));
    }

    /// The checksum of all bytes so far.
    pub(crate) const fn value(&self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_is_that_of_zip_in_one_part_or_in_several() {
        let (mut at_once, mut in_parts) = (Running::new(), Running::new());
        at_once.update(b"123456789");
        in_parts.update(b"1234");
        in_parts.update(b"");
        in_parts.update(b"56789");
        assert_eq!([at_once.value(), in_parts.value()], [0xcbf4_3926; 2]);
    }
}
