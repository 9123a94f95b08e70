//! One uniform-cost search from the current state that serves every task.
//!
//! Each state that is reached carries the set of first actions with which some shortest way to it begins. The first goal state that the
//! search meets for a task gives the task's distance, and the first actions of all its goal states at that distance are its optimal set:
//! every action a with cost(s,a) + dist(step(s,a)) = dist(s). The search ends when each task has met a goal or nothing is left.
//!
//! The frontier is a ring of bit sets, one for each distance that is open at the same time, and each state's first actions take one byte
//! (two where the domain has more than eight actions): with costs of 1 that is 11 bits a state. A domain whose state numbers run higher
//! than the memory is searched through a hash table of state numbers; where that fills up, the tasks that have no goal nearer than the
//! first state that found no room are *unknown*.

mod results;

use super::Progress;
use super::frontier::{Frontier, Way};
use super::goals::GoalTable;
pub use super::optimal_set::OptimalSet;
use crate::oomdp::domain::MOST_COST;
use crate::oomdp::{Action, ActionSet, Domain, apply};
use crate::task::TaskSet;

/// Memory for a [`Search`].
#[derive(Debug)]
pub struct PlanMemory<'m> {
    /// First actions: one byte a state, two where the domain has more than eight actions.
    pub first_actions: &'m mut [u8],
    /// Bit sets over the states, as many as the dearest action costs, and two: see
    /// [`Capacities::frontier_words`](crate::Capacities::frontier_words).
    pub frontier: &'m mut [u32],
    /// State numbers, where states are hashed; may be empty.
    pub hashed: &'m mut [u64],
    /// The optimal set of each task.
    pub optimal: &'m mut [ActionSet],
    /// The distance of each task.
    pub distances: &'m mut [u32],
}

const EMPTY: u64 = u64::MAX;

/// A search, under way or done.
#[derive(Debug)]
pub struct Search<'m> {
    first_actions: &'m mut [u8],
    frontier: Frontier<'m>,
    hashed: &'m mut [u64],
    optimal: &'m mut [ActionSet],
    distances: &'m mut [u32],
    /// States that fit.
    slots: usize,
    /// Second byte of a state's first actions, as an offset; 0 where one byte is enough.
    second_byte: usize,
    hashing: bool,
    level: u32,
    /// Whether any state is left at a distance beyond this level.
    ahead: usize,
    /// The distance of the first state that found no room.
    horizon: u32,
    wanted: TaskSet,
    unresolved: TaskSet,
    found_now: TaskSet,
    goal_here: TaskSet,
    dead: TaskSet,
    applicable: ActionSet,
    /// Tasks planned with blocks taken to stand still.
    relaxed: TaskSet,
    /// Whether this search is one of several for the same state.
    in_part: bool,
    running: bool,
    expanded: u32,
}

impl<'m> Search<'m> {
    /// A search that has not begun.
    pub fn new(memory: PlanMemory<'m>) -> Self {
        Self {
            first_actions: memory.first_actions,
            frontier: Frontier::new(memory.frontier),
            hashed: memory.hashed,
            optimal: memory.optimal,
            distances: memory.distances,
            slots: 0,
            second_byte: 0,
            hashing: false,
            level: 0,
            ahead: 0,
            horizon: u32::MAX,
            wanted: TaskSet::EMPTY,
            unresolved: TaskSet::EMPTY,
            found_now: TaskSet::EMPTY,
            goal_here: TaskSet::EMPTY,
            dead: TaskSet::EMPTY,
            applicable: ActionSet::EMPTY,
            relaxed: TaskSet::EMPTY,
            in_part: false,
            running: false,
            expanded: 0,
        }
    }

    /// Begins at `state`, for the tasks in `wanted`. Those in `dead` are known to be dead ends: once no goal can be reached, none can be
    /// reached from any later state.
    pub fn begin<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, wanted: TaskSet, dead: TaskSet) {
        self.stand(domain, goals, state, wanted, dead);
        self.in_part = false;
        self.start(domain, state);
    }

    /// Begins a search for some of the tasks that are not resolved yet, in a domain of its own; the other tasks' results stay.
    pub(super) fn begin_part<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, tasks: TaskSet) {
        (self.level, self.ahead, self.horizon) = (0, 0, u32::MAX);
        (self.unresolved, self.found_now) = (tasks, TaskSet::EMPTY);
        self.in_part = true;
        self.start(domain, state);
    }

    /// Ends a part. Gives the tasks for which it found nothing; the others' sets count as relaxed, but for those of the `whole` space.
    pub(super) fn end_part(&mut self, tasks: TaskSet, whole: bool) -> TaskSet {
        if whole && self.horizon == u32::MAX {
            self.dead = self.dead.union(self.unresolved);
            self.unresolved = TaskSet::EMPTY;
        }
        if !whole {
            self.relaxed = self.relaxed.union(tasks.without(self.unresolved));
        }
        self.unresolved
    }

    pub(super) fn leave_unknown(&mut self, tasks: TaskSet) {
        self.unresolved = tasks;
    }

    pub(super) fn can_hash(&self) -> bool {
        !self.hashed.is_empty()
    }

    /// How many states fit where they are not hashed.
    pub fn room<D: Domain + ?Sized>(&self, domain: &D) -> usize {
        (self.first_actions.len() / bytes(domain)).min(self.frontier.room(ring(domain)))
    }

    fn start<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) {
        let room = self.room(domain);
        let count = domain.state_count();
        self.hashing = count > room as u64;
        self.slots = if self.hashing { room.min(self.hashed.len()) } else { usize::try_from(count).unwrap_or(room) };
        self.second_byte = if bytes(domain) == 2 { self.slots } else { 0 };
        self.frontier.lay_out(self.slots, ring(domain));
        if self.hashing {
            self.hashed.iter_mut().take(self.slots).for_each(|number| *number = EMPTY);
        }
        self.running = !self.unresolved.is_empty();
        if self.running {
            self.open_first(domain, state);
        }
    }

    /// What can be said of `state` without any search; the rest of `wanted` is unresolved.
    pub(super) fn stand<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        wanted: TaskSet,
        dead: TaskSet,
    ) {
        self.expanded = 0;
        self.optimal.iter_mut().for_each(|set| *set = ActionSet::EMPTY);
        self.distances.iter_mut().for_each(|distance| *distance = u32::MAX);
        (self.level, self.ahead, self.horizon) = (0, 0, u32::MAX);
        (self.found_now, self.relaxed) = (TaskSet::EMPTY, TaskSet::EMPTY);
        self.goal_here = goals.satisfied(domain, state).common(wanted);
        self.dead = dead.common(wanted).without(self.goal_here);
        self.wanted = wanted;
        self.unresolved = wanted.without(self.goal_here).without(self.dead);
        self.applicable = ActionSet::NOOP;
        for action in (0..domain.actions().len().min(Action::MOST)).map(|position| Action(position as u8)) {
            if domain.step(state, action).is_some() {
                self.applicable = self.applicable.with(action);
            }
        }
    }

    fn open_first<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) {
        match self.slot(domain.number(state)) {
            Some(slot) => {
                self.frontier.finish(slot);
                for action in self.applicable.iter().filter(|&action| action != Action::NOOP) {
                    self.follow(domain, state, domain.number(state), action, ActionSet::of(action));
                }
            }
            // Not even the state itself finds room: nothing can be said.
            None => self.horizon = 0,
        }
    }

    fn slot(&mut self, number: u64) -> Option<usize> {
        if !self.hashing {
            return usize::try_from(number).ok().filter(|&slot| slot < self.slots);
        }
        // Multiplicative hashing, linear probing; a probe that runs long means that the table is as good as full.
        let spread = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut slot = ((spread >> 32).wrapping_mul(self.slots as u64) >> 32) as usize;
        for _ in 0..64 {
            let entry = self.hashed.get_mut(..self.slots)?.get_mut(slot)?;
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

    fn first_actions(&self, slot: usize) -> ActionSet {
        let byte = |at: usize| self.first_actions.get(at).copied().unwrap_or(0);
        let high = if self.second_byte > 0 { byte(slot.wrapping_add(self.second_byte)) } else { 0 };
        ActionSet(u16::from_le_bytes([byte(slot), high]))
    }

    fn set_first_actions(&mut self, slot: usize, actions: ActionSet) {
        let [low, high] = actions.0.to_le_bytes();
        if let Some(byte) = self.first_actions.get_mut(slot) {
            *byte = low;
        }
        if self.second_byte > 0
            && let Some(byte) = self.first_actions.get_mut(slot.wrapping_add(self.second_byte))
        {
            *byte = high;
        }
    }

    #[inline]
    fn follow<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, number: u64, action: Action, first: ActionSet) {
        let Some(next) = domain.number_after(state, number, action).filter(|&next| next != number) else { return };
        let cost = domain.actions().get(usize::from(action.0)).map_or(1, |kind| kind.cost.clamp(1, MOST_COST));
        let distance = self.level.saturating_add(u32::from(cost));
        let Some(slot) = self.slot(next) else {
            self.horizon = self.horizon.min(distance);
            return;
        };
        match self.frontier.meet(slot, usize::from(cost)) {
            Way::NoShorter => {}
            Way::AsShort => {
                let both = self.first_actions(slot).union(first);
                self.set_first_actions(slot, both);
            }
            way => {
                self.ahead = self.ahead.saturating_add(usize::from(way == Way::New));
                self.set_first_actions(slot, first);
            }
        }
    }

    /// Goes on, expanding at most `budget` states (at least one).
    pub fn advance<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, budget: u32) -> Progress {
        let mut left = budget.max(1);
        while self.running {
            if left == 0 {
                return Progress::Working;
            }
            match self.frontier.take() {
                Some(slot) => {
                    left = left.saturating_sub(1);
                    self.expand(domain, goals, slot);
                }
                None => self.finish_level(),
            }
        }
        Progress::Done
    }

    #[inline]
    fn expand<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, slot: usize) {
        self.ahead = self.ahead.saturating_sub(1);
        self.expanded = self.expanded.saturating_add(1);
        let number = if self.hashing { self.hashed.get(slot).copied().unwrap_or(0) } else { slot as u64 };
        let state = domain.numbered(number);
        let first = self.first_actions(slot);
        let met = goals.satisfied(domain, &state).common(self.unresolved);
        if !met.is_empty() {
            self.found_now = self.found_now.union(met);
            for task in met.iter() {
                if let Some(set) = self.optimal.get_mut(task) {
                    *set = set.union(first);
                }
                if let Some(distance) = self.distances.get_mut(task) {
                    *distance = self.level;
                }
            }
        }
        for position in 0..domain.actions().len().min(Action::MOST) {
            self.follow(domain, &state, number, Action(position as u8), first);
        }
    }

    fn finish_level(&mut self) {
        self.unresolved = self.unresolved.without(self.found_now);
        self.found_now = TaskSet::EMPTY;
        self.frontier.next_level();
        self.level = self.level.saturating_add(1);
        // From the first state that found no room on, a goal may be missing, and so may a way to one.
        self.running = !self.unresolved.is_empty() && self.ahead > 0 && self.level < self.horizon;
        if !self.running && self.horizon == u32::MAX && !self.in_part {
            self.dead = self.dead.union(self.unresolved);
            self.unresolved = TaskSet::EMPTY;
        }
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

/// The state after a walk: `None` where an action of it cannot be done.
pub fn walk<D: Domain + ?Sized>(domain: &D, start: &D::State, actions: impl IntoIterator<Item = Action>) -> Option<D::State> {
    actions.into_iter().try_fold(*start, |state, action| apply(domain, &state, action))
}
