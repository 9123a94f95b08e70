//! One backward sweep that serves every task in every state.
//!
//! The forward [`Search`](super::Search) knows its own state only. The sweep carries sets of tasks backward from the goals, one level of
//! cost at a time, all tasks of a state in one word: afterwards the optimal sets of every state that can be reached are at hand, and
//! nothing is searched again when the robot has moved.
//!
//! What is kept for a state is, for each action, the tasks for which that action is optimal. The distance modulo three would be less and
//! is enough where every move can be taken back; a block that was pushed cannot be pulled back everywhere, an action may then lead two or
//! five further away, and modulo three this cannot be told from one nearer.
//!
//! A level looks only at states from which some action leads to a state of an earlier level:
//! [`Domain::ways_in`] finds them. Where a domain does not say, each level looks at all states.

use super::Progress;
use super::goals::GoalTable;
use super::lanes::{LaneWidth, has, insert, take_from};
use crate::oomdp::domain::MOST_COST;
use crate::oomdp::{Action, ActionSet, Domain};
use crate::task::TaskSet;

/// Where the sweep stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Phase {
    /// Nothing begun, or it does not fit.
    #[default]
    Idle,
    /// Finding the states that can be reached.
    Flood {
        anew: bool,
    },
    /// Marking the goals.
    Goals,
    /// Finding the states that may be of this level.
    Mark {
        cost: u32,
    },
    /// Looking at them.
    Settle,
    Done,
}

/// How the memory is laid out: planes of one lane a state, then bit sets of one bit a state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Layout {
    states: usize,
    width: LaneWidth,
    plane: usize,
    set: usize,
    actions: usize,
    /// Levels that are needed at the same time: as many as the dearest action costs, and one.
    ring: usize,
}

impl Layout {
    fn new<D: Domain + ?Sized>(domain: &D, tasks: usize) -> Option<Self> {
        let states = usize::try_from(domain.state_count()).ok()?;
        let width = LaneWidth::for_tasks(tasks);
        let dearest = domain.actions().iter().map(|kind| kind.cost).max().unwrap_or(1).clamp(1, MOST_COST);
        let actions = domain.actions().len().min(Action::MOST);
        let ring = usize::from(dearest).saturating_add(1);
        Some(Self { states, width, plane: width.words(states), set: states.div_ceil(64), actions, ring })
    }

    fn words(&self) -> Option<usize> {
        let planes = self.actions.checked_add(self.ring)?.checked_add(1)?;
        self.plane.checked_mul(planes)?.checked_add(self.set.checked_mul(self.ring.checked_add(2)?)?)
    }

    /// The lanes of an action, of what was reached, and of one level, in this order.
    const fn plane_at(&self, plane: usize) -> (usize, usize) {
        (plane.wrapping_mul(self.plane), self.plane)
    }

    /// The bits of the states of one level, of all that can be reached, and of those to look at, in this order.
    const fn set_at(&self, set: usize) -> (usize, usize) {
        let planes = self.actions.wrapping_add(self.ring).wrapping_add(1);
        (planes.wrapping_mul(self.plane).wrapping_add(set.wrapping_mul(self.set)), self.set)
    }

    const fn level_slot(&self, level: u32) -> usize {
        if self.ring == 0 { 0 } else { level as usize % self.ring }
    }
}

/// A sweep, under way or done.
#[derive(Debug)]
pub struct Sweep<'m> {
    words: &'m mut [u64],
    layout: Layout,
    phase: Phase,
    wanted: TaskSet,
    level: u32,
    cursor: usize,
    /// The last level that has any state.
    latest: u32,
    settled: u64,
}

impl<'m> Sweep<'m> {
    /// A sweep that has not begun.
    pub fn new(words: &'m mut [u64]) -> Self {
        let layout = Layout::default();
        Self { words, layout, phase: Phase::Idle, wanted: TaskSet::EMPTY, level: 0, cursor: 0, latest: 0, settled: 0 }
    }

    /// The u64s that a sweep of this domain with so many tasks takes; `None` where that is beyond counting.
    pub fn words_needed<D: Domain + ?Sized>(domain: &D, tasks: usize) -> Option<usize> {
        Layout::new(domain, tasks)?.words()
    }

    /// Whether a sweep with so many tasks has room.
    pub fn fits<D: Domain + ?Sized>(&self, domain: &D, tasks: usize) -> bool {
        !self.words.is_empty() && Self::words_needed(domain, tasks).is_some_and(|words| words <= self.words.len())
    }

    /// Forgets what was swept.
    pub fn forget(&mut self) {
        self.phase = Phase::Idle;
    }

    /// Begins with the states that can be reached from `state`. Gives whether there is room; nothing is begun where there is none.
    #[inline(never)]
    pub fn begin<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, wanted: TaskSet) -> bool {
        let tasks = (u64::BITS.saturating_sub(wanted.0.leading_zeros())) as usize;
        self.phase = Phase::Idle;
        let Some(layout) = Layout::new(domain, tasks).filter(|_| self.fits(domain, tasks)) else { return false };
        self.layout = layout;
        self.words.iter_mut().take(layout.words().unwrap_or(usize::MAX)).for_each(|word| *word = 0);
        (self.wanted, self.level, self.cursor, self.latest, self.settled) = (wanted, 0, 0, 0, 0);
        let Some(at) = usize::try_from(domain.number(state)).ok().filter(|&at| at < layout.states) else { return false };
        insert(self.set_mut(layout.ring), at);
        insert(self.set_mut(layout.ring.wrapping_add(1)), at);
        self.phase = Phase::Flood { anew: false };
        true
    }

    fn set(&self, set: usize) -> &[u64] {
        let (start, len) = self.layout.set_at(set);
        self.words.get(start..start.wrapping_add(len)).unwrap_or(&[])
    }

    fn set_mut(&mut self, set: usize) -> &mut [u64] {
        let (start, len) = self.layout.set_at(set);
        self.words.get_mut(start..start.wrapping_add(len)).unwrap_or(&mut [])
    }

    #[inline]
    fn lane(&self, plane: usize, state: usize) -> TaskSet {
        let (start, len) = self.layout.plane_at(plane);
        self.layout.width.get(self.words.get(start..start.wrapping_add(len)).unwrap_or(&[]), state)
    }

    #[inline]
    fn plane_mut(&mut self, plane: usize) -> &mut [u64] {
        let (start, len) = self.layout.plane_at(plane);
        self.words.get_mut(start..start.wrapping_add(len)).unwrap_or(&mut [])
    }

    const fn reached_plane(&self) -> usize {
        self.layout.actions
    }

    const fn level_plane(&self, level: u32) -> usize {
        self.layout.actions.wrapping_add(1).wrapping_add(self.layout.level_slot(level))
    }

    const fn known_set(&self) -> usize {
        self.layout.ring
    }

    const fn open_set(&self) -> usize {
        self.layout.ring.wrapping_add(1)
    }

    /// Goes on, looking at no more than about `budget` states (at least one).
    #[inline(never)]
    pub fn advance<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, budget: u32) -> Progress {
        let mut left = budget.max(1);
        loop {
            if left == 0 {
                return Progress::Working;
            }
            match self.phase {
                Phase::Idle | Phase::Done => return Progress::Done,
                Phase::Flood { anew } => self.flood(domain, anew, &mut left),
                Phase::Goals => self.mark_goals(domain, goals, &mut left),
                Phase::Mark { cost } => self.mark(domain, cost, &mut left),
                Phase::Settle => self.settle(domain, &mut left),
            }
        }
    }

    fn flood<D: Domain + ?Sized>(&mut self, domain: &D, mut anew: bool, left: &mut u32) {
        let (known, open) = (self.known_set(), self.open_set());
        let mut cursor = self.cursor;
        while *left > 0 {
            let Some(at) = take_from(self.set_mut(open), &mut cursor) else {
                // States opened behind the cursor are left for another pass.
                self.phase = if anew { Phase::Flood { anew: false } } else { Phase::Goals };
                self.cursor = 0;
                return;
            };
            *left = left.wrapping_sub(1);
            let state = domain.numbered(at as u64);
            for action in (0..self.layout.actions).map(|position| Action(position as u8)) {
                let Some(next) = domain.number_after(&state, at as u64, action) else { continue };
                let Ok(next) = usize::try_from(next) else { continue };
                if insert(self.set_mut(known), next) {
                    insert(self.set_mut(open), next);
                    anew |= next / 64 < cursor;
                }
            }
        }
        self.cursor = cursor;
        self.phase = Phase::Flood { anew };
    }

    fn mark_goals<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, left: &mut u32) {
        let (level, reached, width) = (self.level_plane(0), self.reached_plane(), self.layout.width);
        let slot = self.layout.level_slot(0);
        while *left > 0 {
            let Some(bits) = self.set(self.known_set()).get(self.cursor).copied() else {
                (self.level, self.cursor, self.phase) = (1, 0, Phase::Mark { cost: 0 });
                return;
            };
            let mut rest = bits;
            while rest != 0 {
                let at = self.cursor.wrapping_mul(64).wrapping_add(rest.trailing_zeros() as usize);
                rest &= rest.wrapping_sub(1);
                *left = left.saturating_sub(1);
                let met = goals.satisfied(domain, &domain.numbered(at as u64)).common(self.wanted);
                if !met.is_empty() {
                    width.add(self.plane_mut(level), at, met);
                    width.add(self.plane_mut(reached), at, met);
                    insert(self.set_mut(slot), at);
                }
            }
            self.cursor = self.cursor.wrapping_add(1);
        }
    }

    /// Cost 0 stands for the level itself: its memory is that of a level no longer needed, and is emptied first.
    fn mark<D: Domain + ?Sized>(&mut self, domain: &D, cost: u32, left: &mut u32) {
        let dearest = self.layout.ring.wrapping_sub(1) as u32;
        if cost > dearest {
            (self.cursor, self.phase) = (0, Phase::Settle);
            return;
        }
        let next = Phase::Mark { cost: cost.wrapping_add(1) };
        let used = cost == 0 || domain.actions().iter().any(|kind| u32::from(kind.cost.clamp(1, MOST_COST)) == cost);
        let Some(earlier) = self.level.checked_sub(cost).filter(|_| used) else {
            (self.cursor, self.phase) = (0, next);
            return;
        };
        let slot = self.layout.level_slot(earlier);
        let ways = domain.ways_in();
        while *left > 0 {
            let Some(bits) = self.set(slot).get(self.cursor).copied() else {
                (self.cursor, self.phase) = (0, next);
                return;
            };
            if cost == 0 && bits != 0 {
                self.empty_word(slot, bits);
            } else if ways == 0 && bits != 0 {
                self.open_all();
                (self.cursor, self.phase) = (0, next);
                return;
            } else {
                let mut rest = bits;
                while rest != 0 {
                    let at = self.cursor.wrapping_mul(64).wrapping_add(rest.trailing_zeros() as usize);
                    rest &= rest.wrapping_sub(1);
                    *left = left.saturating_sub(1);
                    self.open_ways_in(domain, ways, at);
                }
            }
            self.cursor = self.cursor.wrapping_add(1);
        }
    }

    #[inline]
    fn open_ways_in<D: Domain + ?Sized>(&mut self, domain: &D, ways: usize, at: usize) {
        let state = domain.numbered(at as u64);
        for way in 0..ways {
            let Some(before) = domain.way_in(&state, way) else { continue };
            let Ok(before) = usize::try_from(domain.number(&before)) else { continue };
            if has(self.set(self.known_set()), before) {
                insert(self.set_mut(self.open_set()), before);
            }
        }
    }

    fn empty_word(&mut self, slot: usize, bits: u64) {
        let (plane, width, cursor) = (self.level_plane(self.level), self.layout.width, self.cursor);
        let mut rest = bits;
        while rest != 0 {
            let at = cursor.wrapping_mul(64).wrapping_add(rest.trailing_zeros() as usize);
            rest &= rest.wrapping_sub(1);
            width.clear(self.plane_mut(plane), at);
        }
        if let Some(word) = self.set_mut(slot).get_mut(cursor) {
            *word = 0;
        }
    }

    fn open_all(&mut self) {
        let (start, len) = self.layout.set_at(self.known_set());
        let to = self.layout.set_at(self.open_set()).0;
        for offset in 0..len {
            let known = self.words.get(start.wrapping_add(offset)).copied().unwrap_or(0);
            if let Some(open) = self.words.get_mut(to.wrapping_add(offset)) {
                *open = known;
            }
        }
    }

    fn settle<D: Domain + ?Sized>(&mut self, domain: &D, left: &mut u32) {
        let (open, width, reached) = (self.open_set(), self.layout.width, self.reached_plane());
        let (plane, slot) = (self.level_plane(self.level), self.layout.level_slot(self.level));
        let mut cursor = self.cursor;
        while *left > 0 {
            let Some(at) = take_from(self.set_mut(open), &mut cursor) else {
                let quiet = self.level.saturating_sub(self.latest) as usize >= self.layout.ring;
                (self.level, self.cursor) = (self.level.saturating_add(1), 0);
                self.phase = if quiet { Phase::Done } else { Phase::Mark { cost: 0 } };
                return;
            };
            *left = left.wrapping_sub(1);
            let missing = self.wanted.without(self.lane(reached, at));
            if missing.is_empty() {
                continue;
            }
            self.settled = self.settled.wrapping_add(1);
            let state = domain.numbered(at as u64);
            let mut gained = TaskSet::EMPTY;
            for position in 0..self.layout.actions {
                let cost = domain.actions().get(position).map_or(1, |kind| u32::from(kind.cost.clamp(1, MOST_COST)));
                let Some(earlier) = self.level.checked_sub(cost) else { continue };
                let Some(next) = domain.number_after(&state, at as u64, Action(position as u8)) else { continue };
                let Ok(next) = usize::try_from(next) else { continue };
                let nearer = self.lane(self.level_plane(earlier), next).common(missing);
                if !nearer.is_empty() {
                    width.add(self.plane_mut(position), at, nearer);
                    gained = gained.union(nearer);
                }
            }
            if !gained.is_empty() {
                width.add(self.plane_mut(reached), at, gained);
                width.add(self.plane_mut(plane), at, gained);
                insert(self.set_mut(slot), at);
                self.latest = self.level;
            }
        }
        self.cursor = cursor;
    }

    /// Whether it has come to its end, and knows this state.
    pub fn knows<D: Domain + ?Sized>(&self, domain: &D, state: &D::State) -> bool {
        self.phase == Phase::Done && usize::try_from(domain.number(state)).is_ok_and(|at| has(self.set(self.known_set()), at))
    }

    /// Whether it is under way.
    pub fn is_working(&self) -> bool {
        !matches!(self.phase, Phase::Idle | Phase::Done)
    }

    /// The tasks whose goal can be reached from a state that is known, those included that hold there.
    pub fn reachable<D: Domain + ?Sized>(&self, domain: &D, state: &D::State) -> TaskSet {
        usize::try_from(domain.number(state)).map_or(TaskSet::EMPTY, |at| self.lane(self.reached_plane(), at))
    }

    /// The actions that begin a shortest way to a task's goal, from a state that is known: none where the task holds or is a dead end.
    pub fn toward<D: Domain + ?Sized>(&self, domain: &D, state: &D::State, task: usize) -> ActionSet {
        let Ok(at) = usize::try_from(domain.number(state)) else { return ActionSet::EMPTY };
        (0..self.layout.actions)
            .filter(|&position| self.lane(position, at).contains(task))
            .fold(ActionSet::EMPTY, |set, position| set.with(Action(position as u8)))
    }

    /// The cost of a shortest way to a task's goal, from a state that is known, by walking there: the distances are not kept.
    pub fn distance<D: Domain + ?Sized>(&self, domain: &D, state: &D::State, task: usize) -> Option<u32> {
        if !self.reachable(domain, state).contains(task) {
            return None;
        }
        let (mut state, mut distance) = (*state, 0_u32);
        // Each action lowers the distance, and none is more than the last level.
        for _ in 0..=self.level {
            let Some(action) = self.toward(domain, &state, task).iter().next() else { return Some(distance) };
            let cost = domain.actions().get(usize::from(action.0)).map_or(1, |kind| u32::from(kind.cost.clamp(1, MOST_COST)));
            distance = distance.saturating_add(cost);
            state = domain.step(&state, action)?;
        }
        None
    }

    /// How often a state was looked at, once for each level at which one of its actions might be the first of a shortest way.
    pub fn settled(&self) -> u64 {
        self.settled
    }
}
