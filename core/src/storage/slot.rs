//! The header of a slot: which model is newer, how long it is, and a check.

use crate::checksum::Running;

/// Bytes of a slot's header, before rounding up to the flash's write size: a mark, the sequence number, the model's length and a CRC-32 of
/// these three.
pub const SLOT_HEADER_BYTES: usize = 16;

const MARK: [u8; 4] = *b"slot";

/// A slot's header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SlotHeader {
    /// The number of models stored before.
    pub sequence: u32,
    /// Bytes of the model.
    pub length: u32,
}

impl SlotHeader {
    pub fn bytes(self) -> [u8; SLOT_HEADER_BYTES] {
        let mut bytes = [0; SLOT_HEADER_BYTES];
        let fields = MARK.into_iter().chain(self.sequence.to_le_bytes()).chain(self.length.to_le_bytes());
        for (slot, byte) in bytes.iter_mut().zip(fields) {
            *slot = byte;
        }
        if let Some((checked, check)) = bytes.split_last_chunk_mut::<4>() {
            let mut sum = Running::new();
            sum.update(checked);
            *check = sum.value().to_le_bytes();
        }
        bytes
    }

    /// Reads a header; `None` if the bytes are not one.
    pub fn read(bytes: &[u8; SLOT_HEADER_BYTES]) -> Option<Self> {
        let [m0, m1, m2, m3, s0, s1, s2, s3, l0, l1, l2, l3, ..] = *bytes;
        let header = Self { sequence: u32::from_le_bytes([s0, s1, s2, s3]), length: u32::from_le_bytes([l0, l1, l2, l3]) };
        ([m0, m1, m2, m3] == MARK && header.bytes() == *bytes).then_some(header)
    }

    /// Whether this one was stored after the other; the sequence number may have wrapped around.
    pub fn is_newer_than(self, other: Self) -> bool {
        let ahead = self.sequence.wrapping_sub(other.sequence);
        ahead != 0 && ahead < 1 << 31
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_with_any_bit_flipped_is_none() {
        let header = SlotHeader { sequence: 7, length: 1_000 };
        assert_eq!(SlotHeader::read(&header.bytes()), Some(header));
        for bit in 0..SLOT_HEADER_BYTES * 8 {
            let mut bytes = header.bytes();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(SlotHeader::read(&bytes), None);
        }
    }

    #[test]
    fn the_newer_one_is_known_when_the_count_runs_over() {
        let at = |sequence| SlotHeader { sequence, length: 0 };
        assert!(at(0).is_newer_than(at(u32::MAX)));
        assert!(!at(u32::MAX).is_newer_than(at(0)));
        assert!(!at(3).is_newer_than(at(3)));
    }
}
