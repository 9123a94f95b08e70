//! Plans for homes whose joint state space is out of reach.
//!
//! The blocks that do not matter to a task are taken to stand still: tasks that speak of the same blocks are planned together, by one
//! search in the small space of the agent and those blocks. Where a task's goal cannot be reached so, a block may be in the way: each
//! other block in turn is then let move too, and the first with which the goal can be reached is taken. Tasks left over are searched for in
//! the whole space, as far as the memory for hashed states goes, once a session. [`Search::relaxed`] says which tasks' optimal sets come
//! from blocks that stand still: such a set can miss a shorter way on which another block is pushed, and a dead end that another block
//! would make.

use super::Progress;
use super::goals::GoalTable;
use super::search::Search;
use super::standing::{Moving, Standing};
use crate::oomdp::Domain;
use crate::task::TaskSet;

/// A plan made in parts, one for each group of tasks that speak of the same blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Relaxation {
    /// The tasks not looked at yet in this pass.
    waiting: TaskSet,
    /// The tasks without a plan after this pass.
    left: TaskSet,
    /// The tasks of the part under way.
    group: TaskSet,
    moving: Moving,
    /// 0: the tasks' own blocks alone; then each variable, one more than its position, let move too; then the whole space.
    pass: usize,
    /// The tasks that the whole space was searched for in vain.
    tried: TaskSet,
}

impl Relaxation {
    /// Whether a domain can be planned for in this way.
    pub(super) fn applies<D: Domain + ?Sized>(domain: &D) -> bool {
        (0..domain.variables().min(32)).any(|variable| domain.stands_still(variable))
    }

    /// Begins for the tasks that `search` has not resolved at its state.
    #[inline(never)]
    pub(super) fn begin<D: Domain + ?Sized>(&mut self, search: &mut Search<'_>, domain: &D, goals: &GoalTable<'_>, state: &D::State) {
        *self = Self { waiting: search.unknown(), tried: self.tried, ..Self::default() };
        self.next_part(search, domain, goals, state);
    }

    /// Forgets the session's tasks.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }

    /// Goes on, with about `budget` looks.
    #[inline(never)]
    pub(super) fn advance<D: Domain + ?Sized>(
        &mut self,
        search: &mut Search<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        budget: u32,
    ) -> Progress {
        let before = search.looks();
        while !self.group.is_empty() {
            let left = budget.saturating_sub(search.looks().wrapping_sub(before)).max(1);
            let whole = self.is_whole(domain);
            let progress = if whole {
                search.advance(domain, goals, left)
            } else {
                search.advance(&Standing { domain, moving: self.moving, now: state }, goals, left)
            };
            if progress == Progress::Working {
                return Progress::Working;
            }
            let missed = search.end_part(self.group, whole);
            self.left = self.left.union(missed);
            if whole {
                self.tried = self.tried.union(missed);
            }
            self.next_part(search, domain, goals, state);
        }
        search.leave_unknown(self.left);
        Progress::Done
    }

    fn is_whole<D: Domain + ?Sized>(&self, domain: &D) -> bool {
        self.pass > domain.variables()
    }

    /// Takes the next group of tasks; an empty one where all is done.
    fn next_part<D: Domain + ?Sized>(&mut self, search: &mut Search<'_>, domain: &D, goals: &GoalTable<'_>, state: &D::State) {
        self.group = TaskSet::EMPTY;
        loop {
            let Some(first) = self.waiting.iter().next() else {
                if self.left.is_empty() || self.is_whole(domain) {
                    return;
                }
                self.pass = self.pass.saturating_add(1);
                (self.waiting, self.left) = (self.left, TaskSet::EMPTY);
                continue;
            };
            if self.is_whole(domain) {
                self.group = self.waiting.without(self.tried);
                self.left = self.left.union(self.waiting.common(self.tried));
                self.waiting = TaskSet::EMPTY;
                if self.group.is_empty() || !search.can_hash() {
                    self.left = self.left.union(self.group);
                    self.group = TaskSet::EMPTY;
                    return;
                }
                search.begin_part(domain, goals, state, self.group);
                return;
            }
            let own = goals.variables_of(domain, first).map(|read| Moving(Moving::own(domain).0 | read));
            let group = self.waiting.iter().filter(|&task| {
                let variables = goals.variables_of(domain, task);
                variables.map(|read| Moving(Moving::own(domain).0 | read)) == own
            });
            let group = group.fold(TaskSet::EMPTY, |set, task| set.union(TaskSet::of(task)));
            self.waiting = self.waiting.without(group);
            let moving = own.and_then(|own| match self.pass.checked_sub(1) {
                None => Some(own),
                Some(extra) => (!own.contains(extra)).then(|| own.with(extra)),
            });
            let Some(moving) = moving else {
                self.left = self.left.union(group);
                continue;
            };
            (self.group, self.moving) = (group, moving);
            search.begin_part(&Standing { domain, moving, now: state }, goals, state, group);
            return;
        }
    }
}
