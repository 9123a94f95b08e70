//! Bit sets, and arrays of 16-bit entries, in borrowed words.

/// Adds a bit to a bit set. Returns whether it was new.
#[inline]
pub(super) fn insert(bits: &mut [u64], at: usize) -> bool {
    let Some(word) = bits.get_mut(at / 64) else { return false };
    let new = *word >> (at % 64) & 1 == 0;
    *word |= 1 << (at % 64);
    new
}

/// Takes the first bit from the word `cursor` on, and returns its position; `cursor` is then its word.
#[inline]
pub(super) fn take_from(bits: &mut [u64], cursor: &mut usize) -> Option<usize> {
    loop {
        let word = bits.get_mut(*cursor)?;
        if *word != 0 {
            let bit = word.trailing_zeros() as usize;
            *word &= word.wrapping_sub(1);
            return Some(cursor.wrapping_mul(64).wrapping_add(bit));
        }
        *cursor = cursor.wrapping_add(1);
    }
}

/// The number of words for this many 16-bit entries.
#[cfg(feature = "bounds")]
pub(super) const fn entry_words(entries: usize) -> usize {
    entries.div_ceil(4)
}

/// An entry of an array of 16-bit entries.
#[cfg(feature = "bounds")]
#[inline]
pub(super) fn entry(words: &[u64], at: usize) -> u16 {
    bytemuck::try_cast_slice(words).ok().and_then(|entries: &[u16]| entries.get(at)).copied().unwrap_or(0)
}

/// Sets an entry of an array of 16-bit entries.
#[cfg(feature = "bounds")]
#[inline]
pub(super) fn set_entry(words: &mut [u64], at: usize, value: u16) {
    let entries: &mut [u16] = bytemuck::try_cast_slice_mut(words).unwrap_or(&mut []);
    if let Some(entry) = entries.get_mut(at) {
        *entry = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_come_back_in_order() {
        let mut bits = [0; 3];
        assert!([130, 5, 64].iter().all(|&at| insert(&mut bits, at)));
        assert!(!insert(&mut bits, 64));
        let mut cursor = 0;
        let taken: std::vec::Vec<usize> = core::iter::from_fn(|| take_from(&mut bits, &mut cursor)).collect();
        assert_eq!(taken, [5, 64, 130]);
    }

    #[cfg(feature = "bounds")]
    #[test]
    fn entries_side_by_side_are_kept_apart() {
        let mut words = [0; 3];
        (0..12).for_each(|at| set_entry(&mut words, at, u16::MAX));
        (0..12).for_each(|at| set_entry(&mut words, at, at as u16 * 5_000));
        assert!((0..12).all(|at| entry(&words, at) == at as u16 * 5_000));
    }
}
