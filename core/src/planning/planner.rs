//! Which way of planning serves a state.
//!
//! | the state space | the plan |
//! |---|---|
//! | fits the search's arrays | a forward search; once a session's searches have cost as much as a sweep would, one sweep, then look-ups |
//! | too large, with blocks that can be taken to stand still | the [relaxation](super::relaxed) |
//! | too large otherwise | a forward search that hashes states, until the memory is full |
//!
//! The first two kinds of plan are exact and equal. A session is so never more than about twice as dear as with the better of the two
//! alone, however long it is.

use super::Progress;
use super::goals::GoalTable;
use super::relaxed::Relaxation;
use super::search::{PlanMemory, Search};
use super::sweep::Sweep;
use crate::oomdp::Domain;
use crate::task::TaskSet;

/// How many expansions of forward searches cost as much as a sweep, for each state there is (measured: `docs/performance.md`).
const SWEEP_WORTH: u64 = 24;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Way {
    #[default]
    Known,
    Search,
    Sweep,
    Relaxed,
}

/// Plans for one state after another, for the tasks of one session.
#[derive(Debug)]
pub struct Planner<'m> {
    search: Search<'m>,
    sweep: Sweep<'m>,
    relaxation: Relaxation,
    way: Way,
    spent: u64,
    all: TaskSet,
    wanted: TaskSet,
    dead: TaskSet,
}

impl<'m> Planner<'m> {
    /// A planner that knows nothing yet. `sweep` may be empty.
    pub fn new(plan: PlanMemory<'m>, workspace: &'m mut [u64], sweep: &'m mut [u64]) -> Self {
        Self {
            search: Search::new(plan, workspace),
            sweep: Sweep::new(sweep),
            relaxation: Relaxation::default(),
            way: Way::Known,
            spent: 0,
            all: TaskSet::EMPTY,
            wanted: TaskSet::EMPTY,
            dead: TaskSet::EMPTY,
        }
    }

    /// Ends what is under way and gives the workspace away, until [`take_workspace`](Self::take_workspace).
    pub(crate) fn lend_workspace(&mut self) -> &'m mut [u64] {
        self.way = Way::Known;
        self.search.lend_workspace()
    }

    /// Takes the workspace for the search.
    pub(crate) fn take_workspace(&mut self, workspace: &'m mut [u64]) {
        self.search.take_workspace(workspace);
    }

    /// Forgets what it knows of the graph: the tasks or the domain are others now.
    pub fn forget(&mut self, tasks: usize) {
        self.sweep.forget();
        self.relaxation.forget();
        (self.way, self.spent, self.all) = (Way::Known, 0, TaskSet::first(tasks));
    }

    /// Begins at `state`, for the tasks in `wanted`; those in `dead` are known to be dead ends.
    pub fn begin<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, wanted: TaskSet, dead: TaskSet) {
        (self.wanted, self.dead) = (wanted, dead);
        if self.search.adopt(domain, goals, state, self.all, &self.sweep) {
            self.way = Way::Known;
            return;
        }
        let states = domain.state_count();
        if self.search.fits(domain, goals, self.all) {
            if self.sweep.is_working() {
                self.way = Way::Sweep;
            } else if self.spent > states.saturating_mul(SWEEP_WORTH) && self.sweep.begin(domain, state, self.all) {
                self.way = Way::Sweep;
                self.spent = 0;
            } else {
                self.way = Way::Search;
            }
        } else {
            self.way = if Relaxation::applies(domain) { Way::Relaxed } else { Way::Search };
        }
        match self.way {
            Way::Search => self.search.begin(domain, goals, state, wanted, dead),
            Way::Relaxed => {
                self.search.stand(domain, goals, state, wanted, dead);
                self.relaxation.begin(&mut self.search, domain, goals, state);
            }
            Way::Known | Way::Sweep => {}
        }
    }

    /// Goes on, looking at no more than about `budget` states. `state` is the one that it began with.
    pub fn advance<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, budget: u32) -> Progress {
        match self.way {
            Way::Known => return Progress::Done,
            Way::Search => {
                if self.search.advance(domain, goals, budget) == Progress::Working {
                    return Progress::Working;
                }
                self.spent = self.spent.saturating_add(u64::from(self.search.looks()));
            }
            Way::Relaxed => {
                if self.relaxation.advance(&mut self.search, domain, goals, state, budget) == Progress::Working {
                    return Progress::Working;
                }
            }
            Way::Sweep => {
                if self.sweep.advance(domain, goals, budget) == Progress::Working {
                    return Progress::Working;
                }
                if !self.search.adopt(domain, goals, state, self.all, &self.sweep) {
                    // The robot was put where it could not have gone.
                    self.sweep.forget();
                    self.way = Way::Search;
                    self.search.begin(domain, goals, state, self.wanted, self.dead);
                    return Progress::Working;
                }
            }
        }
        self.way = Way::Known;
        Progress::Done
    }

    /// Whether it has come to its end.
    pub fn is_done(&self) -> bool {
        self.way == Way::Known
    }

    /// What it found.
    pub fn search(&self) -> &Search<'m> {
        &self.search
    }

    /// The sweep.
    pub fn sweep(&self) -> &Sweep<'m> {
        &self.sweep
    }
}
