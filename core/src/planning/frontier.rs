//! Which states of a search are open, at which distance, and which are done: bit sets over the states.
//!
//! There is one set for each distance that is open at the same time, in a ring, and one for the states that are done. The words of all
//! sets for the same 32 states lie side by side: one state's marks are in one cache line. Above them, one bit for each word says whether
//! it was touched, so that neither finding the next state nor clearing up takes time for states that a search never came near.

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
        for group in 0..self.groups {
            let summary = self.groups.wrapping_add(group / 32).wrapping_mul(sets);
            let touched = self.memory.get(summary..summary.wrapping_add(sets)).unwrap_or(&[]).iter().fold(0, |all, bits| all | bits);
            if group % 32 == 0 && touched == 0 {
                continue;
            }
            if touched >> (group % 32) & 1 == 1 {
                let start = group.wrapping_mul(sets);
                self.memory.get_mut(start..start.wrapping_add(sets)).unwrap_or(&mut []).fill(0);
            }
        }
        let summaries = self.groups.wrapping_mul(sets);
        let end = summaries.wrapping_add(self.groups.div_ceil(32).wrapping_mul(sets));
        self.memory.get_mut(summaries..end).unwrap_or(&mut []).fill(0);
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
    fn has(&self, set: usize, slot: usize) -> bool {
        self.memory.get(self.word(set, slot)).is_some_and(|word| word >> (slot % 32) & 1 == 1)
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

    /// Whether a state is done.
    #[inline]
    pub(super) fn is_done(&self, slot: usize) -> bool {
        self.has(self.ring, slot)
    }

    /// Marks a state as done.
    #[inline]
    pub(super) fn finish(&mut self, slot: usize) {
        self.put(self.ring, slot);
    }

    /// How far beyond the distance under way a state is open.
    #[inline]
    pub(super) fn open_at(&self, slot: usize) -> Option<usize> {
        (0..self.ring).find(|&cost| self.has(self.set_at(cost), slot))
    }

    /// Opens a state so far beyond the distance under way.
    #[inline]
    pub(super) fn open(&mut self, slot: usize, cost: usize) {
        self.put(self.set_at(cost), slot);
    }

    /// Takes a state out that is open so far beyond the distance under way.
    #[inline]
    pub(super) fn close(&mut self, slot: usize, cost: usize) {
        let word = self.word(self.set_at(cost), slot);
        if let Some(bits) = self.memory.get_mut(word) {
            *bits &= !(1 << (slot % 32));
        }
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
            frontier.open(states - 1, 1);
            frontier.open(1_025, 1);
            frontier.open(40, 1);
            frontier.close(40, 1);
            assert_eq!(frontier.open_at(1_025), Some(1));
            frontier.next_level();
            assert_eq!(core::iter::from_fn(|| frontier.take()).collect::<std::vec::Vec<_>>(), [1_025, states - 1]);
            assert!(frontier.is_done(1_025) && !frontier.is_done(40));
            // Left open when the next search begins.
            frontier.open(77, 1);
        }
    }

    #[test]
    fn the_room_is_all_that_fits() {
        let mut memory = [0; 7];
        // Two groups of 32 states take six words and their summary three.
        assert_eq!(Frontier::new(&mut memory).room(2), 32);
        assert_eq!(Frontier::new(&mut []).room(2), 0);
    }
}
