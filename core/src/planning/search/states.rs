//! The search that looks at states one by one.
//!
//! The frontier is a ring of bit sets, one for each distance that is open at the same time, and each state's first actions take one byte
//! (two where the domain has more than eight actions): with costs of 1 that is 11 bits a state. A domain whose state numbers run higher
//! than the memory is searched through a hash table of state numbers; where that fills up, the tasks that have no goal nearer than the
//! first state that found no room are *unknown*.

use super::findings::Findings;
use crate::oomdp::domain::MOST_COST;
use crate::oomdp::{Action, ActionSet, Domain};
use crate::planning::GoalTable;
use crate::planning::frontier::{Frontier, Way};

const EMPTY: u64 = u64::MAX;

/// Where a search state by state stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct States {
    frontier: Frontier,
    /// States that fit.
    slots: usize,
    hashing: bool,
    /// How many states are open.
    ahead: usize,
    /// The distance of the first state that found no room.
    horizon: u32,
}

impl States {
    /// How many states fit where they are not hashed.
    pub(super) fn room<D: Domain + ?Sized>(domain: &D, marks: usize) -> usize {
        Frontier::room(marks, ring(domain), bytes(domain))
    }

    /// Lays out the memory, which holds nothing but zeroes, and opens what `state` leads to.
    pub(super) fn begin<D: Domain + ?Sized>(
        domain: &D,
        state: &D::State,
        marks: &mut [u64],
        hashed: &mut [u64],
        found: &Findings<'_>,
    ) -> Self {
        let room = Self::room(domain, marks.len());
        let count = domain.state_count();
        let hashing = count > room as u64;
        let slots = if hashing { room.min(hashed.len()) } else { usize::try_from(count).unwrap_or(room) };
        if hashing {
            hashed.iter_mut().take(slots).for_each(|number| *number = EMPTY);
        }
        let frontier = Frontier::new(slots, ring(domain), bytes(domain));
        let mut states = Self { frontier, slots, hashing, ahead: 0, horizon: u32::MAX };
        match states.slot(hashed, domain.number(state)) {
            Some(slot) => {
                states.frontier.finish(marks, slot);
                for action in found.applicable.iter().filter(|&action| action != Action::NOOP) {
                    states.follow(marks, hashed, domain, (state, domain.number(state)), action, ActionSet::of(action), found.level);
                }
            }
            // Not even the state itself finds room: nothing can be said.
            None => states.horizon = 0,
        }
        states
    }

    /// Leaves nothing but zeroes.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        self.frontier.clear(marks);
    }

    /// Whether every state found room.
    pub(super) fn is_complete(&self) -> bool {
        self.horizon == u32::MAX
    }

    /// Goes on to the next distance. Gives whether there is one: from the first state that found no room on, a goal may be missing, and so
    /// may a way to one.
    pub(super) fn next_level(&mut self, level: u32) -> bool {
        self.frontier.next_level();
        self.ahead > 0 && level < self.horizon
    }

    fn slot(&self, hashed: &mut [u64], number: u64) -> Option<usize> {
        if !self.hashing {
            return usize::try_from(number).ok().filter(|&slot| slot < self.slots);
        }
        // Multiplicative hashing, linear probing; a probe that runs long means that the table is as good as full.
        let spread = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut slot = ((spread >> 32).wrapping_mul(self.slots as u64) >> 32) as usize;
        for _ in 0..64 {
            let entry = hashed.get_mut(..self.slots)?.get_mut(slot)?;
            if *entry == EMPTY {
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
        }
        None
    }

    #[inline]
    #[expect(clippy::too_many_arguments, reason = "what is borrowed apart")]
    fn follow<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        hashed: &mut [u64],
        domain: &D,
        (state, number): (&D::State, u64),
        action: Action,
        first: ActionSet,
        level: u32,
    ) {
        let Some(next) = domain.number_after(state, number, action).filter(|&next| next != number) else { return };
        let cost = domain.actions().get(usize::from(action.0)).map_or(1, |kind| kind.cost.clamp(1, MOST_COST));
        let Some(slot) = self.slot(hashed, next) else {
            self.horizon = self.horizon.min(level.saturating_add(u32::from(cost)));
            return;
        };
        match self.frontier.meet(marks, slot, usize::from(cost)) {
            Way::NoShorter => {}
            Way::AsShort => {
                let both = self.frontier.first_actions(marks, slot).union(first);
                self.frontier.set_first_actions(marks, slot, both);
            }
            way => {
                self.ahead = self.ahead.saturating_add(usize::from(way == Way::New));
                self.frontier.set_first_actions(marks, slot, first);
            }
        }
    }

    /// Looks at one state of the distance under way; gives `None` where none is left.
    #[inline]
    pub(super) fn look<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        hashed: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
    ) -> Option<u32> {
        let slot = self.frontier.take(marks)?;
        self.ahead = self.ahead.saturating_sub(1);
        let number = if self.hashing { hashed.get(slot).copied().unwrap_or(0) } else { slot as u64 };
        let state = domain.numbered(number);
        let first = self.frontier.first_actions(marks, slot);
        for task in goals.satisfied(domain, &state).common(found.unresolved).iter() {
            found.meet(task, first);
        }
        for position in 0..domain.actions().len().min(Action::MOST) {
            self.follow(marks, hashed, domain, (&state, number), Action(position as u8), first, found.level);
        }
        Some(1)
    }
}

/// Distances that are open at the same time: as many as the dearest action costs, and one.
fn ring<D: Domain + ?Sized>(domain: &D) -> usize {
    let dearest = domain.actions().iter().map(|kind| kind.cost).max().unwrap_or(1).clamp(1, MOST_COST);
    usize::from(dearest).saturating_add(1)
}

/// Bytes of a state's first actions.
fn bytes<D: Domain + ?Sized>(domain: &D) -> usize {
    if domain.actions().len() > 8 { 2 } else { 1 }
}
