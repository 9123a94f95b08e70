//! The open states of a search by their distance, the closed states, and the first actions that lead to each.
//!
//! There is one bit set for each distance that is open at the same time, in a ring, and one for the closed states. The words of all sets
//! for the same 64 states are adjacent, followed by the states' first actions, one byte each, or one more for each eight actions
//! beyond the first eight. In addition, a summary has one bit for each word of the sets: whether it was touched. So neither finding the next state nor
//! clearing takes time for states that a search never came near.

use crate::oomdp::ActionSet;

/// A comparison of a path to a state with the known paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrival {
    /// The first path.
    First,
    /// Shorter than the known paths.
    Shorter,
    /// Another shortest path.
    Equal,
    /// Longer than a known path.
    Longer,
}

/// The layout of one search's marks in its memory, and its position there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frontier {
    /// Groups of 64 states.
    groups: usize,
    /// The number of distances open at the same time; the set after the last holds the closed states.
    ring: usize,
    /// The number of bytes for a state's first actions.
    bytes: usize,
    /// The set of the current distance.
    head: usize,
    /// The summary word being scanned.
    cursor: usize,
}

impl Frontier {
    /// A frontier without open states. `ring` distances are open at the same time, and first actions take `bytes` bytes.
    pub(super) const fn new(states: usize, ring: usize, bytes: usize) -> Self {
        Self { groups: states.div_ceil(64), ring, bytes, head: 0, cursor: 0 }
    }

    pub(super) const fn words(&self) -> usize {
        let summaries = self.groups.div_ceil(64).saturating_mul(self.sets());
        self.groups.saturating_mul(self.stride()).saturating_add(summaries)
    }

    /// The number of states that fit into `words` words, with `beside` extra words per 64 states.
    pub(super) fn room(words: usize, ring: usize, bytes: usize, beside: usize) -> usize {
        let needed = |groups: usize| Self { groups, ..Self::new(0, ring, bytes) }.words().saturating_add(groups.saturating_mul(beside));
        let fits = |groups: usize| needed(groups) <= words;
        let mut groups = words / Self::new(0, ring, bytes).stride().saturating_add(beside);
        while groups > 0 && !fits(groups) {
            // The excess is the summaries, less than a sixtieth of all.
            groups = groups.saturating_sub(1 + groups / 4_096);
        }
        groups.saturating_mul(64)
    }

    /// Continues to fill the marks with zeros, with about `left` words at most. Returns whether it is done.
    pub(super) fn clear_on(&self, marks: &mut [u64], left: &mut usize) -> bool {
        let (sets, stride) = (self.sets(), self.stride());
        for cursor in 0..self.groups.div_ceil(64) {
            if *left == 0 {
                return false;
            }
            let at = self.summary(cursor, 0);
            let summaries = marks.get_mut(at..at.wrapping_add(sets)).unwrap_or(&mut []);
            let mut touched = summaries.iter().fold(0, |all, bits| all | bits);
            summaries.fill(0);
            while touched != 0 {
                let group = cursor.wrapping_mul(64).wrapping_add(touched.trailing_zeros() as usize);
                touched &= touched.wrapping_sub(1);
                *left = left.saturating_sub(stride);
                let start = group.wrapping_mul(stride);
                marks.get_mut(start..start.wrapping_add(stride)).unwrap_or(&mut []).fill(0);
            }
        }
        true
    }

    #[inline]
    const fn sets(&self) -> usize {
        self.ring.wrapping_add(1)
    }

    /// The number of words of a group.
    #[inline]
    const fn stride(&self) -> usize {
        self.sets().wrapping_add(self.bytes.wrapping_mul(8))
    }

    #[inline]
    const fn summary(&self, cursor: usize, set: usize) -> usize {
        self.groups.wrapping_mul(self.stride()).wrapping_add(cursor.wrapping_mul(self.sets())).wrapping_add(set)
    }

    /// The bit set of the states `cost` beyond the current distance; with `cost` equal to `ring` it is the current set itself.
    #[inline]
    const fn set_at(&self, cost: usize) -> usize {
        let set = self.head.wrapping_add(cost);
        if set >= self.ring { set.wrapping_sub(self.ring) } else { set }
    }

    #[inline]
    fn put(&self, marks: &mut [u64], set: usize, slot: usize) {
        let word = (slot / 64).wrapping_mul(self.stride()).wrapping_add(set);
        let Some(bits) = marks.get_mut(word) else { return };
        let untouched = *bits == 0;
        *bits |= 1 << (slot % 64);
        if untouched && let Some(summary) = marks.get_mut(self.summary(slot / 4_096, set)) {
            *summary |= 1 << (slot / 64 % 64);
        }
    }

    /// Closes a state.
    #[inline]
    pub(super) fn finish(&self, marks: &mut [u64], slot: usize) {
        self.put(marks, self.ring, slot);
    }

    /// The states that were ever reached, of the 64 around this one.
    #[inline]
    pub(super) fn reached(&self, marks: &[u64], slot: usize) -> u64 {
        let start = (slot / 64).wrapping_mul(self.stride());
        let group = marks.get(start..start.wrapping_add(self.sets())).unwrap_or(&[]);
        group.iter().fold(0, |all, word| all | word)
    }

    /// Reaches a state `cost` beyond the current distance, and opens it there unless a shorter path is known.
    #[inline]
    pub(super) fn meet(&self, marks: &mut [u64], slot: usize, cost: usize) -> Arrival {
        let (sets, ring, set, bit) = (self.sets(), self.ring, self.set_at(cost), 1_u64 << (slot % 64));
        let start = (slot / 64).wrapping_mul(self.stride());
        let Some(group) = marks.get_mut(start..start.wrapping_add(sets)) else { return Arrival::Longer };
        let way = if group.iter().fold(0, |all, word| all | word) & bit == 0 {
            Arrival::First
        } else if group.last().is_some_and(|done| done & bit != 0) {
            return Arrival::Longer;
        } else if group.get(set).is_some_and(|word| word & bit != 0) {
            return Arrival::Equal;
        } else {
            let mut found = false;
            for farther in cost..ring {
                if let Some(word) = group.get_mut(self.set_at(farther)) {
                    found |= *word & bit != 0;
                    *word &= !bit;
                }
            }
            if !found {
                return Arrival::Longer;
            }
            Arrival::Shorter
        };
        self.put(marks, set, slot);
        way
    }

    /// Takes the next state of the current distance, and closes it.
    #[inline]
    pub(super) fn take(&mut self, marks: &mut [u64]) -> Option<usize> {
        loop {
            if self.cursor.wrapping_mul(64) >= self.groups {
                return None;
            }
            let summary_at = self.summary(self.cursor, self.head);
            let summary = *marks.get(summary_at)?;
            if summary == 0 {
                self.cursor = self.cursor.wrapping_add(1);
                continue;
            }
            let group = self.cursor.wrapping_mul(64).wrapping_add(summary.trailing_zeros() as usize);
            let word = marks.get_mut(group.wrapping_mul(self.stride()).wrapping_add(self.head))?;
            let bits = *word;
            *word = bits & bits.wrapping_sub(1);
            if *word == 0
                && let Some(bits) = marks.get_mut(summary_at)
            {
                *bits = summary & summary.wrapping_sub(1);
            }
            if bits != 0 {
                let slot = group.wrapping_mul(64).wrapping_add(bits.trailing_zeros() as usize);
                self.finish(marks, slot);
                return Some(slot);
            }
        }
    }

    /// Moves to the next distance.
    pub(super) fn next_level(&mut self) {
        self.head = self.set_at(1);
        self.cursor = 0;
    }

    /// The word with byte `byte` of a state's first actions, and its shift there.
    #[inline]
    const fn first_actions_at(&self, slot: usize, byte: usize) -> (usize, u32) {
        let start = (slot / 64).wrapping_mul(self.stride()).wrapping_add(self.sets());
        (start.wrapping_add(byte.wrapping_mul(8)).wrapping_add(slot / 8 % 8), (slot % 8).wrapping_mul(8) as u32)
    }

    /// The first actions that lead to a state.
    #[inline]
    pub(super) fn first_actions(&self, marks: &[u64], slot: usize) -> ActionSet {
        let byte = |byte: usize| {
            let (word, shift) = self.first_actions_at(slot, byte);
            (marks.get(word).copied().unwrap_or(0) >> shift) as u8
        };
        ActionSet::of_bytes(self.bytes, byte)
    }

    /// Sets the first actions that lead to a state.
    #[inline]
    pub(super) fn set_first_actions(&self, marks: &mut [u64], slot: usize, actions: ActionSet) {
        for (byte, value) in actions.bytes().take(self.bytes).enumerate() {
            let (word, shift) = self.first_actions_at(slot, byte);
            if let Some(word) = marks.get_mut(word) {
                *word = *word & !(0xff << shift) | u64::from(value) << shift;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_come_by_distance_and_what_was_marked_can_be_cleared() {
        let mut marks = std::vec![0; 6_000];
        for (states, ring) in [(31_000, 2), (20_000, 3), (31_000, 2)] {
            assert!(Frontier::room(marks.len(), ring, 1, 0) >= states);
            let mut frontier = Frontier::new(states, ring, 1);
            assert_eq!(frontier.take(&mut marks), None);
            assert_eq!(
                [states - 1, 1_025, 1_025].map(|slot| frontier.meet(&mut marks, slot, 1)),
                [Arrival::First, Arrival::First, Arrival::Equal]
            );
            frontier.next_level();
            assert_eq!(core::iter::from_fn(|| frontier.take(&mut marks)).collect::<std::vec::Vec<_>>(), [1_025, states - 1]);
            assert_eq!(frontier.meet(&mut marks, 1_025, 1), Arrival::Longer);
            // Left open for the next search.
            assert_eq!(frontier.meet(&mut marks, 77, 1), Arrival::First);
            while !frontier.clear_on(&mut marks, &mut 100) {}
            assert!(marks.iter().all(|&word| word == 0));
        }
    }

    #[test]
    fn a_shorter_way_that_is_found_later_is_taken() {
        let mut marks = [0; 100];
        let mut frontier = Frontier::new(100, 6, 1);
        assert_eq!(
            [5, 3, 3, 4].map(|cost| frontier.meet(&mut marks, 50, cost)),
            [Arrival::First, Arrival::Shorter, Arrival::Equal, Arrival::Longer]
        );
        let levels: std::vec::Vec<_> = (0..6)
            .map(|_| {
                frontier.next_level();
                frontier.take(&mut marks)
            })
            .collect();
        assert_eq!(levels, [None, None, Some(50), None, None, None]);
    }

    #[test]
    fn the_first_actions_of_states_side_by_side_are_kept_apart() {
        for bytes in 1..=ActionSet::MOST / 8 {
            let mut marks = std::vec![0; 3 * (3 + 8 * bytes) + 3];
            let frontier = Frontier::new(130, 2, bytes);
            let all = ActionSet::of_bytes(bytes, |_| 0xff);
            let of = |slot: usize| ActionSet::of_bytes(bytes, |byte| (slot * 3 + byte * 5) as u8);
            for slot in 0..130 {
                frontier.set_first_actions(&mut marks, slot, all);
                frontier.set_first_actions(&mut marks, slot, of(slot));
            }
            assert!((0..130).all(|slot| frontier.first_actions(&marks, slot) == of(slot)));
        }
    }

    #[test]
    fn the_room_is_all_that_fits() {
        // A group of 64 states takes three words and eight of first actions, and each 64 groups take three words more.
        assert_eq!([13, 14, 24, 25, 36].map(|words| Frontier::room(words, 2, 1, 0)), [0, 64, 64, 128, 192]);
        assert_eq!(Frontier::room(64 * 11 + 3, 2, 1, 0), 4_096);
        assert_eq!(Frontier::room(65 * 11 + 3, 2, 1, 0), 4_096);
        assert_eq!(Frontier::room(65 * 11 + 6, 2, 1, 0), 4_160);
    }
}
