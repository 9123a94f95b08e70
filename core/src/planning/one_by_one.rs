//! The exact search that expands states one by one. It serves every domain.
//!
//! Each reached state has the set of first actions of its shortest paths. The first goal state that the search meets for a task gives the
//! task's distance, and the first actions of all its goal states at that distance are its optimal set: every action a with cost(s,a) +
//! dist(step(s,a)) = dist(s).
//!
//! With costs of 1 and at most 8 actions this takes 11 bits per state. If the states do not fit, the search keeps the states that it meets
//! in a hash table of state numbers. Once that is full, a task stays *unknown* unless it has a goal nearer than the first state without
//! room.

mod frontier;

use self::frontier::{Arrival, Frontier};
use super::goals::Goals;
use super::plan::Results;
use crate::capacity::{Capacities, Capacity, CapacityError};
use crate::oomdp::domain::MOST_COST;
use crate::oomdp::{Action, ActionSet, Domain, SearchKind, cost, own_actions};

/// The progress of a search that expands states one by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct StateSearch {
    frontier: Frontier,
    /// The number of states that fit.
    slots: usize,
    hashing: bool,
    /// The number of words at the end of the marks that serve as hash table, if there is no other memory for one.
    own_table: usize,
    /// The number of open states.
    ahead: usize,
    /// The distance of the first state without room.
    horizon: u32,
    /// A state whose number is not below the domain's `state_count`, although all counted states have room.
    stray: Option<Stray>,
}

/// A reached state that the domain did not count.
#[derive(Clone, Copy, Debug)]
pub struct Stray {
    /// Its number.
    pub number: u64,
    /// The number of the previous state, and the action between them.
    pub from: (u64, Action),
}

impl StateSearch {
    /// The number of states that fit without hashing.
    pub(super) fn room<D: Domain>(domain: &D, marks: usize) -> usize {
        Frontier::room(marks, ring(domain), bytes(domain), 0)
    }

    /// Whether all states fit.
    pub(super) fn fits<D: Domain>(domain: &D, marks: usize) -> bool {
        domain.state_count() <= Self::room(domain, marks) as u64
    }

    /// Lays out the marks, which hold zeros, and opens the successors of `state`.
    #[inline(never)]
    pub(super) fn begin<D: Domain>(domain: &D, state: &D::State, marks: &mut [u64], hashed: &mut [u64], applicable: ActionSet) -> Self {
        let hashing = !Self::fits(domain, marks.len());
        let (slots, own_table) = if !hashing {
            (usize::try_from(domain.state_count()).unwrap_or(0), 0)
        } else if hashed.is_empty() {
            let slots = Frontier::room(marks.len(), ring(domain), bytes(domain), 64);
            (slots, slots)
        } else {
            (Self::room(domain, marks.len()).min(hashed.len()), 0)
        };
        let frontier = Frontier::new(slots, ring(domain), bytes(domain));
        let mut search = Self { frontier, slots, hashing, own_table, ahead: 0, horizon: u32::MAX, stray: None };
        let (marks, table) = search.split(marks, hashed);
        match search.slot(marks, table, domain.number(state)) {
            Some(slot) => {
                search.frontier.finish(marks, slot);
                for action in applicable.iter().filter(|&action| action != Action::NOOP) {
                    search.follow(marks, table, domain, state, action, ActionSet::of(action), 0);
                }
            }
            // Not even this state has room, so there is no result.
            None => search.horizon = 0,
        }
        search
    }

    /// The marks without the hash table, and the hash table.
    #[inline]
    fn split<'t>(&self, marks: &'t mut [u64], hashed: &'t mut [u64]) -> (&'t mut [u64], &'t mut [u64]) {
        let at = marks.len().saturating_sub(self.own_table);
        let (marks, own) = marks.split_at_mut_checked(at).unwrap_or_default();
        (marks, if own.is_empty() { hashed } else { own })
    }

    /// Continues to fill the marks with zeros, with about `left` words at most. Returns whether it is done.
    pub(super) fn clear_on(&mut self, marks: &mut [u64], left: &mut usize) -> bool {
        let (marks, table) = self.split(marks, &mut []);
        if !self.frontier.clear_on(marks, left) {
            return false;
        }
        let part = table.len().min(*left);
        table.get_mut(..part).unwrap_or(&mut []).fill(0);
        // The rest is at the end.
        self.own_table = self.own_table.saturating_sub(part);
        *left = left.saturating_sub(part);
        self.own_table == 0
    }

    /// Whether every state had room.
    pub(super) fn is_complete(&self) -> bool {
        self.horizon == u32::MAX
    }

    /// A reached state that the domain did not count, if the search met one.
    pub(super) const fn stray(&self) -> Option<Stray> {
        self.stray
    }

    /// The work of an expansion, in expansions: to look for states in a hash table takes longer.
    pub(super) const fn work(&self) -> u32 {
        if self.hashing { 2 } else { 1 }
    }

    /// Moves to the next distance. Returns whether there is one: from the first state without room on, a goal or a path to one may be
    /// missing.
    pub(super) fn next_level(&mut self, level: u32) -> bool {
        self.frontier.next_level();
        self.ahead > 0 && level < self.horizon
    }

    /// The slot of a state; `None` if there is no room for it. The caller then puts the state into the frontier. Entries of the hash table
    /// count only for states in the frontier, so the table need not be cleared before a search.
    #[inline]
    fn slot(&self, marks: &[u64], table: &mut [u64], number: u64) -> Option<usize> {
        if !self.hashing {
            return usize::try_from(number).ok().filter(|&slot| slot < self.slots);
        }
        // Multiplicative hashing with linear probing; after a long probe the table counts as full.
        let spread = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut slot = ((spread >> 32).wrapping_mul(self.slots as u64) >> 32) as usize;
        let table = table.get_mut(..self.slots)?;
        let mut reached = self.frontier.reached(marks, slot);
        for _ in 0..64 {
            let entry = table.get_mut(slot)?;
            if reached >> (slot % 64) & 1 == 0 {
                *entry = number;
                return Some(slot);
            }
            if *entry == number {
                return Some(slot);
            }
            slot = slot.wrapping_add(1);
            if slot >= self.slots {
                slot = 0;
            }
            if slot.is_multiple_of(64) {
                reached = self.frontier.reached(marks, slot);
            }
        }
        None
    }

    #[inline]
    #[expect(clippy::too_many_arguments, reason = "what is borrowed apart")]
    fn follow<D: Domain>(
        &mut self,
        marks: &mut [u64],
        table: &mut [u64],
        domain: &D,
        state: &D::State,
        action: Action,
        first: ActionSet,
        level: u32,
    ) {
        let cost = cost(domain, action);
        // The search ends at the horizon, and in a full table a state is looked for the longest.
        if self.hashing && level.saturating_add(u32::from(cost)) >= self.horizon {
            return;
        }
        let Some(next) = domain.step(state, action).filter(|next| next != state) else { return };
        let number = domain.number(&next);
        let Some(slot) = self.slot(marks, table, number) else {
            self.horizon = self.horizon.min(level.saturating_add(u32::from(cost)));
            self.stray = (!self.hashing).then(|| Stray { number, from: (domain.number(state), action) });
            return;
        };
        match self.frontier.meet(marks, slot, usize::from(cost)) {
            Arrival::Longer => {}
            Arrival::Equal => {
                let both = self.frontier.first_actions(marks, slot).union(first);
                self.frontier.set_first_actions(marks, slot, both);
            }
            arrival => {
                self.ahead = self.ahead.saturating_add(usize::from(arrival == Arrival::First));
                self.frontier.set_first_actions(marks, slot, first);
            }
        }
    }

    /// Expands one state of the current distance. Returns the number of expansions, or `None` if no state is left.
    #[inline]
    pub(super) fn expand<D: Domain>(
        &mut self,
        marks: &mut [u64],
        hashed: &mut [u64],
        results: &mut Results<'_>,
        domain: &D,
        goals: &Goals<'_>,
    ) -> Option<u32> {
        let (marks, table) = self.split(marks, hashed);
        let slot = self.frontier.take(marks)?;
        self.ahead = self.ahead.saturating_sub(1);
        let number = if self.hashing { table.get(slot).copied().unwrap_or(0) } else { slot as u64 };
        let state = domain.numbered(number);
        let first = self.frontier.first_actions(marks, slot);
        for task in goals.satisfied(domain, &state, results.found.sought).iter() {
            results.meet(task, first);
        }
        for action in own_actions(domain) {
            self.follow(marks, table, domain, &state, action, first, results.found.level);
        }
        Some(1)
    }
}

/// The number of distances open at the same time: the highest cost of an action, plus one.
fn ring<D: Domain>(domain: &D) -> usize {
    let highest = domain.actions().iter().map(|kind| kind.cost).max().unwrap_or(1).clamp(1, MOST_COST);
    usize::from(highest).saturating_add(1)
}

/// The number of bytes for a state's first actions: a bit for each action.
fn bytes<D: Domain>(domain: &D) -> usize {
    let actions = domain.actions().len();
    // A controller has at most two bytes.
    if ActionSet::MOST > 16 && actions > 16 {
        actions.min(Action::MOST).div_ceil(8)
    } else if actions > 8 {
        2
    } else {
        1
    }
}

/// The least [`Capacities::states`](crate::Capacities::states) with room for every state of a domain, so that plans are exact. It is the
/// number of states if there are at most 8 actions of cost 1, and more otherwise. `None` if the states cannot be counted.
#[doc(hidden)]
pub fn states_needed<D: Domain>(domain: &D) -> Option<usize> {
    let count = usize::try_from(domain.state_count()).ok().filter(|&count| count < usize::MAX / 1_024)?;
    let words = Frontier::new(count, ring(domain), bytes(domain)).words();
    let usual = Frontier::new(count, 2, 1).words();
    // Whole groups: a smaller number would need as many words.
    Some(if usual == words { count } else { Capacities::states_of(words) })
}

/// Refuses a domain whose states do not fit, unless it has a hash table or can be planned for approximately.
pub(super) fn check<D: Domain>(domain: &D, marks: usize, hashed: usize) -> Result<(), CapacityError> {
    if hashed > 0 || D::Search::grid(domain).is_some() || StateSearch::fits(domain, marks) {
        return Ok(());
    }
    match states_needed(domain) {
        Some(needed) => Err(CapacityError::new(Capacity::States, Frontier::room(marks, 2, 1, 0), needed)),
        // No table has room for uncounted states, so they need hashing.
        None => Err(CapacityError::full(Capacity::HashedStates, hashed)),
    }
}
