//! One uniform-cost search from the current state that serves every task.
//!
//! Each state that is reached carries the set of first actions with which some shortest way to it begins. The first goal state that the
//! search meets for a task gives the task's distance, and the first actions of all its goal states at that distance are its optimal set:
//! every action a with cost(s,a) + dist(step(s,a)) = dist(s). The search ends when each task has met a goal or nothing is left.
//!
//! Where the robot goes about in a grid, the search looks at whole `rows` of states at once, elsewhere at `states` one by one.

mod alone;
mod findings;
mod results;
mod rows;
mod states;

use self::findings::Findings;
use self::rows::Rows;
use self::states::States;
use super::Progress;
use super::goals::GoalTable;
pub use super::optimal_set::OptimalSet;
use crate::oomdp::{Action, ActionSet, Domain, apply};
use crate::task::TaskSet;

/// Memory for a [`Search`].
#[derive(Debug)]
pub struct PlanMemory<'m> {
    /// How many words of the workspace are for first actions and the frontier: see
    /// [`Capacities::search_words`](crate::Capacities::search_words).
    pub words: usize,
    /// State numbers, where states are hashed; may be empty.
    pub hashed: &'m mut [u64],
    /// The optimal set of each task.
    pub optimal: &'m mut [ActionSet],
    /// The distance of each task.
    pub distances: &'m mut [u32],
}

/// First actions and the frontier: the first words of the workspace.
#[derive(Debug)]
struct Marks<'m> {
    workspace: &'m mut [u64],
    words: usize,
}

impl<'m> Marks<'m> {
    /// Takes the workspace; nothing is marked.
    fn take(&mut self, workspace: &'m mut [u64]) {
        self.workspace = workspace;
        self.words().fill(0);
    }

    fn room(&self) -> usize {
        self.workspace.len().min(self.words)
    }

    #[inline]
    fn words(&mut self) -> &mut [u64] {
        let room = self.room();
        self.workspace.get_mut(..room).unwrap_or(&mut [])
    }
}

/// How the states are looked at.
#[derive(Clone, Copy, Debug)]
enum Way {
    Rows(Rows),
    States(States),
}

/// A search, under way or done.
#[derive(Debug)]
pub struct Search<'m> {
    marks: Marks<'m>,
    hashed: &'m mut [u64],
    found: Findings<'m>,
    /// How, once it has begun; what it marked is cleared when another begins.
    way: Option<Way>,
    /// Whether this search is one of several for the same state.
    in_part: bool,
    running: bool,
}

impl<'m> Search<'m> {
    /// A search that has not begun, with its marks in the workspace that it has in turn with training.
    pub fn new(memory: PlanMemory<'m>, workspace: &'m mut [u64]) -> Self {
        let PlanMemory { words, hashed, optimal, distances } = memory;
        let mut marks = Marks { workspace: &mut [], words };
        marks.take(workspace);
        Self { marks, hashed, found: Findings::new(optimal, distances), way: None, in_part: false, running: false }
    }

    /// Ends the search and gives the workspace away, until [`take_workspace`](Self::take_workspace).
    pub(super) fn lend_workspace(&mut self) -> &'m mut [u64] {
        (self.way, self.running) = (None, false);
        core::mem::take(&mut self.marks.workspace)
    }

    /// Takes the workspace for its marks.
    pub(super) fn take_workspace(&mut self, workspace: &'m mut [u64]) {
        self.marks.take(workspace);
    }

    /// Begins at `state`, for the tasks in `wanted`. Those in `dead` are known to be dead ends: once no goal can be reached, none can be
    /// reached from any later state.
    pub fn begin<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, wanted: TaskSet, dead: TaskSet) {
        self.stand(domain, goals, state, wanted, dead);
        self.in_part = false;
        self.start(domain, goals, state);
    }

    /// What can be said of `state` without a search; the rest of `wanted` is unresolved.
    pub(super) fn stand<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        wanted: TaskSet,
        dead: TaskSet,
    ) {
        self.found.stand(domain, goals, state, wanted, dead);
        self.running = false;
        self.clear();
        let possible = alone::possible(domain, goals, state, self.found.unresolved, self.marks.words());
        self.found.dead = self.found.dead.union(self.found.unresolved.without(possible));
        self.found.unresolved = possible;
    }

    /// Begins a search for some of the tasks that are not resolved yet, in a domain of its own; the other tasks' results stay.
    pub(super) fn begin_part<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, tasks: TaskSet) {
        (self.found.level, self.found.unresolved, self.found.found_now) = (0, tasks, TaskSet::EMPTY);
        self.in_part = true;
        self.start(domain, goals, state);
    }

    /// Ends a part. Gives the tasks for which it found nothing; the others' sets count as relaxed, but for those of the `whole` space.
    pub(super) fn end_part(&mut self, tasks: TaskSet, whole: bool) -> TaskSet {
        if whole && self.is_complete() {
            self.found.dead = self.found.dead.union(self.found.unresolved);
            self.found.unresolved = TaskSet::EMPTY;
        }
        if !whole {
            self.found.relaxed = self.found.relaxed.union(tasks.without(self.found.unresolved));
        }
        self.found.unresolved
    }

    pub(super) fn leave_unknown(&mut self, tasks: TaskSet) {
        self.found.unresolved = tasks;
    }

    /// The words of the marks, all zero, for a plan's own use before a part begins. They are to be zero again then.
    pub(super) fn scratch(&mut self) -> &mut [u64] {
        self.clear();
        self.marks.words()
    }

    pub(super) fn can_hash(&self) -> bool {
        !self.hashed.is_empty()
    }

    /// Whether all states fit the memory, so that a search for these tasks finds out everything.
    pub fn fits<D: Domain + ?Sized>(&self, domain: &D, goals: &GoalTable<'_>, tasks: TaskSet) -> bool {
        domain.state_count() <= States::room(domain, self.marks.room()) as u64
            || Rows::new(domain, goals, tasks, self.marks.room()).is_some()
    }

    fn start<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State) {
        self.clear();
        self.running = !self.found.unresolved.is_empty();
        if self.running {
            self.way = Some(match Rows::new(domain, goals, self.found.unresolved, self.marks.room()) {
                Some(mut rows) => {
                    rows.begin(domain, goals, state, self.marks.words(), &self.found);
                    Way::Rows(rows)
                }
                None => Way::States(States::begin(domain, state, self.marks.words(), self.hashed, &self.found)),
            });
        }
    }

    /// Leaves nothing but zeroes.
    fn clear(&mut self) {
        match self.way.take() {
            Some(Way::Rows(rows)) => rows.clear(self.marks.words()),
            Some(Way::States(states)) => states.clear(self.marks.words()),
            None => {}
        }
    }

    /// Whether no state was left out for want of room.
    fn is_complete(&self) -> bool {
        !matches!(&self.way, Some(Way::States(states)) if !states.is_complete())
    }

    /// Goes on, with at most about `budget` looks (at least one): see [`looks`](Self::looks).
    pub fn advance<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, budget: u32) -> Progress {
        let mut left = budget.max(1);
        while self.running {
            if left == 0 {
                return Progress::Working;
            }
            let looks = match &mut self.way {
                // Where there never is a grid, the compiler leaves rows out.
                Some(Way::Rows(rows)) if domain.grid().is_some() => rows.look(self.marks.words(), &mut self.found, domain, goals),
                Some(Way::States(states)) => states.look(self.marks.words(), self.hashed, &mut self.found, domain, goals),
                _ => None,
            };
            match looks {
                Some(looks) => {
                    left = left.saturating_sub(looks);
                    self.found.looks = self.found.looks.saturating_add(looks);
                }
                None => self.finish_level(),
            }
        }
        Progress::Done
    }

    fn finish_level(&mut self) {
        self.found.finish_level();
        let ahead = match &mut self.way {
            Some(Way::Rows(rows)) => rows.next_level(),
            Some(Way::States(states)) => states.next_level(self.found.level),
            None => false,
        };
        self.running = ahead && !self.found.unresolved.is_empty();
        if !self.running && self.is_complete() && !self.in_part {
            self.found.dead = self.found.dead.union(self.found.unresolved);
            self.found.unresolved = TaskSet::EMPTY;
        }
    }
}

/// The state after a walk: `None` where an action of it cannot be done.
pub fn walk<D: Domain + ?Sized>(domain: &D, start: &D::State, actions: impl IntoIterator<Item = Action>) -> Option<D::State> {
    actions.into_iter().try_fold(*start, |state, action| apply(domain, &state, action))
}
