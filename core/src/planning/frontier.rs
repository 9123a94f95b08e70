//! Which states of a search are open, at which distance, and which are done: bit sets over the states.
//!
//! There is one set for each distance that is open at the same time, in a ring, and one for the states that are done. The words of all
//! sets for the same 32 states lie side by side: one state's marks are in one cache line. Above them, one bit for each word says whether
//! it was touched, so that neither finding the next state nor clearing up takes time for states that a search never came near.

/// How a way to a state compares with the ways known before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// The first.
    New,
    /// Shorter than those before.
    Shorter,
    /// One more of the shortest.
    AsShort,
    /// No shorter than one that is known.
    NoShorter,
}

/// The bit sets of one search.
#[derive(Debug)]
pub(super) struct Frontier<'m> {
    memory: &'m mut [u32],
    /// Groups of 32 states.
    groups: usize,
    /// Distances open at the same time; the set after the last holds the states that are done.
    ring: usize,
    /// The set of the distance under way.
    head: usize,
    /// The group of 32 groups that is looked through.
    cursor: usize,
}

impl<'m> Frontier<'m> {
    /// No state is open.
    pub(super) fn new(memory: &'m mut [u32]) -> Self {
        memory.fill(0);
        Self { memory, groups: 0, ring: 0, head: 0, cursor: 0 }
    }

    /// How many states there is room for, with so many distances open at the same time.
    pub(super) fn room(&self, ring: usize) -> usize {
        let sets = ring.saturating_add(1);
        let fits = |groups: usize| groups.saturating_add(groups.div_ceil(32)).saturating_mul(sets) <= self.memory.len();
        let mut groups = (self.memory.len() / sets).saturating_mul(32) / 33;
        while fits(groups.saturating_add(1)) {
            groups = groups.saturating_add(1);
        }
        if fits(groups) { groups.saturating_mul(32) } else { groups.saturating_sub(1).saturating_mul(32) }
    }

    /// Begins anew, for so many states. The caller has made sure that there is room.
    pub(super) fn lay_out(&mut self, states: usize, ring: usize) {
        let sets = self.sets();
        for cursor in 0..self.groups.div_ceil(32) {
            let at = self.groups.wrapping_add(cursor).wrapping_mul(sets);
            let summaries = self.memory.get_mut(at..at.wrapping_add(sets)).unwrap_or(&mut []);
            let mut touched = summaries.iter().fold(0, |all, bits| all | bits);
            summaries.fill(0);
            while touched != 0 {
                let group = cursor.wrapping_mul(32).wrapping_add(touched.trailing_zeros() as usize);
                touched &= touched.wrapping_sub(1);
                let start = group.wrapping_mul(sets);
                self.memory.get_mut(start..start.wrapping_add(sets)).unwrap_or(&mut []).fill(0);
            }
        }
        (self.groups, self.ring, self.head, self.cursor) = (states.div_ceil(32), ring, 0, 0);
    }

    #[inline]
    const fn sets(&self) -> usize {
        self.ring.wrapping_add(1)
    }

    /// The bit set of the states that are `cost` beyond the distance under way; the cost of the whole ring is the distance itself.
    #[inline]
    const fn set_at(&self, cost: usize) -> usize {
        let set = self.head.wrapping_add(cost);
        if set >= self.ring { set.wrapping_sub(self.ring) } else { set }
    }

    #[inline]
    const fn word(&self, set: usize, slot: usize) -> usize {
        (slot / 32).wrapping_mul(self.sets()).wrapping_add(set)
    }

    #[inline]
    fn put(&mut self, set: usize, slot: usize) {
        let (word, sets) = (self.word(set, slot), self.sets());
        let Some(bits) = self.memory.get_mut(word) else { return };
        let untouched = *bits == 0;
        *bits |= 1 << (slot % 32);
        if untouched {
            let summary = self.groups.wrapping_add(slot / 1024).wrapping_mul(sets).wrapping_add(set);
            if let Some(summary) = self.memory.get_mut(summary) {
                *summary |= 1 << (slot / 32 % 32);
            }
        }
    }

    /// Marks a state as done.
    #[inline]
    pub(super) fn finish(&mut self, slot: usize) {
        self.put(self.ring, slot);
    }

    /// Meets a state on a way that is `cost` beyond the distance under way, and opens it there if no other way to it is as near.
    #[inline]
    pub(super) fn meet(&mut self, slot: usize, cost: usize) -> Way {
        let (sets, ring, set, bit) = (self.sets(), self.ring, self.set_at(cost), 1_u32 << (slot % 32));
        let start = (slot / 32).wrapping_mul(sets);
        let Some(group) = self.memory.get_mut(start..start.wrapping_add(sets)) else { return Way::NoShorter };
        let way = if group.iter().fold(0, |all, word| all | word) & bit == 0 {
            Way::New
        } else if group.last().is_some_and(|done| done & bit != 0) {
            return Way::NoShorter;
        } else if group.get(set).is_some_and(|word| word & bit != 0) {
            return Way::AsShort;
        } else {
            let head = self.head;
            let farther = (cost..ring).map(|cost| {
                if head.wrapping_add(cost) >= ring { head.wrapping_add(cost).wrapping_sub(ring) } else { head.wrapping_add(cost) }
            });
            let mut found = false;
            for set in farther {
                if let Some(word) = group.get_mut(set) {
                    found |= *word & bit != 0;
                    *word &= !bit;
                }
            }
            if !found {
                return Way::NoShorter;
            }
            Way::Shorter
        };
        self.put(set, slot);
        way
    }

    /// Takes the next state of the distance under way, which is then done.
    #[inline]
    pub(super) fn take(&mut self) -> Option<usize> {
        let sets = self.sets();
        loop {
            if self.cursor.wrapping_mul(32) >= self.groups {
                return None;
            }
            let summary_at = self.groups.wrapping_add(self.cursor).wrapping_mul(sets).wrapping_add(self.head);
            let summary = self.memory.get_mut(summary_at)?;
            if *summary == 0 {
                self.cursor = self.cursor.wrapping_add(1);
                continue;
            }
            let group = self.cursor.wrapping_mul(32).wrapping_add(summary.trailing_zeros() as usize);
            let rest = summary.wrapping_sub(1) & *summary;
            let word = self.memory.get_mut(group.wrapping_mul(sets).wrapping_add(self.head))?;
            let bits = *word;
            *word = bits & bits.wrapping_sub(1);
            if *word == 0
                && let Some(summary) = self.memory.get_mut(summary_at)
            {
                *summary = rest;
            }
            if bits != 0 {
                let slot = group.wrapping_mul(32).wrapping_add(bits.trailing_zeros() as usize);
                self.finish(slot);
                return Some(slot);
            }
        }
    }

    /// Goes on to the next distance.
    pub(super) fn next_level(&mut self) {
        self.head = self.set_at(1);
        self.cursor = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_come_by_distance_and_a_new_search_finds_nothing_left_over() {
        let mut memory = std::vec![u32::MAX; 4_000];
        let mut frontier = Frontier::new(&mut memory);
        for (states, ring) in [(31_000, 2), (20_000, 3), (31_000, 2)] {
            assert!(frontier.room(ring) >= states);
            frontier.lay_out(states, ring);
            assert_eq!(frontier.take(), None);
            assert_eq!([states - 1, 1_025, 1_025].map(|slot| frontier.meet(slot, 1)), [Way::New, Way::New, Way::AsShort]);
            frontier.next_level();
            assert_eq!(core::iter::from_fn(|| frontier.take()).collect::<std::vec::Vec<_>>(), [1_025, states - 1]);
            assert_eq!(frontier.meet(1_025, 1), Way::NoShorter);
            // Left open when the next search begins.
            assert_eq!(frontier.meet(77, 1), Way::New);
        }
    }

    #[test]
    fn a_shorter_way_that_is_found_later_is_taken() {
        let mut memory = [0; 100];
        let mut frontier = Frontier::new(&mut memory);
        frontier.lay_out(100, 6);
        assert_eq!([5, 3, 3, 4].map(|cost| frontier.meet(50, cost)), [Way::New, Way::Shorter, Way::AsShort, Way::NoShorter]);
        let levels: std::vec::Vec<_> = (0..6)
            .map(|_| {
                frontier.next_level();
                frontier.take()
            })
            .collect();
        assert_eq!(levels, [None, None, Some(50), None, None, None]);
    }

    #[test]
    fn the_room_is_all_that_fits() {
        let mut memory = [0; 7];
        // Two groups of 32 states take six words and their summary three.
        assert_eq!(Frontier::new(&mut memory).room(2), 32);
        assert_eq!(Frontier::new(&mut []).room(2), 0);
    }
}
