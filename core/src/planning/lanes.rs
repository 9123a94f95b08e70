//! Many small task sets in one array of words.
//!
//! A [`TaskSet`](crate::task::TaskSet) has 64 bits, but a session with nine tasks needs nine. The sweep keeps one lane of 8, 16, 32 or 64
//! bits a state, as many lanes to a word as fit.

use crate::task::TaskSet;

/// How wide the lanes are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct LaneWidth {
    /// Lanes in a word, as a power of two: 0 to 3.
    power: u32,
}

impl LaneWidth {
    /// The narrowest lanes that hold sets of so many tasks.
    pub(super) const fn for_tasks(tasks: usize) -> Self {
        Self {
            power: match tasks {
                0..=8 => 3,
                9..=16 => 2,
                17..=32 => 1,
                _ => 0,
            },
        }
    }

    /// Words for so many lanes.
    pub(super) const fn words(self, lanes: usize) -> usize {
        lanes.div_ceil(1 << self.power)
    }

    #[inline]
    const fn place(self, lane: usize) -> (usize, u32, u64) {
        let bits = 64_u32 >> self.power;
        let within = (lane & ((1 << self.power) - 1)) as u32;
        (lane >> self.power, within.wrapping_mul(bits), u64::MAX >> 64_u32.wrapping_sub(bits))
    }

    /// The set of one lane.
    #[inline]
    pub(super) fn get(self, words: &[u64], lane: usize) -> TaskSet {
        let (word, shift, mask) = self.place(lane);
        TaskSet(words.get(word).copied().unwrap_or(0) >> shift & mask)
    }

    /// Adds tasks to the set of one lane.
    #[inline]
    pub(super) fn add(self, words: &mut [u64], lane: usize, set: TaskSet) {
        let (word, shift, mask) = self.place(lane);
        if let Some(word) = words.get_mut(word) {
            *word |= (set.0 & mask) << shift;
        }
    }

    /// Empties the set of one lane.
    #[inline]
    pub(super) fn clear(self, words: &mut [u64], lane: usize) {
        let (word, shift, mask) = self.place(lane);
        if let Some(word) = words.get_mut(word) {
            *word &= !(mask << shift);
        }
    }
}

/// Whether a bit set has this bit.
#[inline]
pub(super) fn has(bits: &[u64], at: usize) -> bool {
    bits.get(at / 64).is_some_and(|word| word >> (at % 64) & 1 == 1)
}

/// Adds a bit to a bit set. Gives whether it was new.
#[inline]
pub(super) fn insert(bits: &mut [u64], at: usize) -> bool {
    let Some(word) = bits.get_mut(at / 64) else { return false };
    let new = *word >> (at % 64) & 1 == 0;
    *word |= 1 << (at % 64);
    new
}

/// Takes the first bit from a word on, and gives its position; `cursor` is then its word.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_of_every_width_keep_their_sets_apart() {
        for tasks in [1, 8, 9, 16, 17, 32, 33, 64] {
            let width = LaneWidth::for_tasks(tasks);
            let all = TaskSet::first(tasks);
            let mut words = [0; 16];
            assert!(width.words(10) <= words.len());
            width.add(&mut words, 3, all);
            width.add(&mut words, 5, TaskSet::of(tasks - 1));
            assert_eq!([2, 3, 4, 5, 6].map(|lane| width.get(&words, lane).0), [0, all.0, 0, 1 << (tasks - 1), 0], "{tasks} tasks");
            width.clear(&mut words, 3);
            assert_eq!([3, 5].map(|lane| width.get(&words, lane).0), [0, 1 << (tasks - 1)], "{tasks} tasks");
        }
    }

    #[test]
    fn bits_come_back_in_order() {
        let mut bits = [0; 3];
        assert!([130, 5, 64].iter().all(|&at| insert(&mut bits, at)));
        assert!(!insert(&mut bits, 64));
        let mut cursor = 0;
        let taken: std::vec::Vec<usize> = core::iter::from_fn(|| take_from(&mut bits, &mut cursor)).collect();
        assert_eq!(taken, [5, 64, 130]);
    }
}
