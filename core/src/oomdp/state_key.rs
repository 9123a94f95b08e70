//! An identifier for the states of any domain, without the domain's own type.

/// Words of a key.
const WORDS: usize = if cfg!(feature = "alloc") { 4 } else { 1 };

/// A state, as an agent keeps it between calls: its number if the domain's states are numbered, else its packed contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StateKey([u64; WORDS]);

impl StateKey {
    /// The bits of a key.
    pub(crate) const BITS: usize = WORDS * u64::BITS as usize;

    /// The key of a state with this number.
    pub const fn of(number: u64) -> Self {
        let mut words = [0; WORDS];
        let [first, ..] = &mut words;
        *first = number;
        Self(words)
    }

    /// The number of a numbered state.
    pub const fn number(self) -> u64 {
        let [first, ..] = self.0;
        first
    }

    /// Packs numbers below 2 to the power of `bits`, as many as fit.
    #[cfg(feature = "alloc")]
    pub(crate) fn packed(numbers: impl Iterator<Item = u16>, bits: usize) -> Self {
        let mut words = [0; WORDS];
        for (position, number) in numbers.enumerate() {
            for bit in (0..bits).filter(|bit| number >> bit & 1 == 1) {
                let at = position.wrapping_mul(bits).wrapping_add(bit);
                if let Some(word) = words.get_mut(at / 64) {
                    *word |= 1 << (at % 64);
                }
            }
        }
        Self(words)
    }

    /// The packed number at a position.
    #[cfg(feature = "alloc")]
    pub(crate) fn unpacked(self, position: usize, bits: usize) -> u16 {
        (0..bits).fold(0, |number, bit| {
            let at = position.wrapping_mul(bits).wrapping_add(bit);
            number | (self.0.get(at / 64).map_or(0, |word| word >> (at % 64) & 1) as u16) << bit
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_numbers_come_back() {
        for bits in 1..=10 {
            let count = StateKey::BITS / bits;
            let number = |position: usize| (position as u16).wrapping_mul(0x9e37) & ((1 << bits) - 1);
            let key = StateKey::packed((0..count).map(number), bits);
            assert!((0..count).all(|position| key.unpacked(position, bits) == number(position)), "{bits} bits");
        }
    }
}
