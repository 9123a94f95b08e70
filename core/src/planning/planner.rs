//! Which way of planning serves a state.
//!
//! | the state space | the plan |
//! |---|---|
//! | fits the search's memory | one search, exact |
//! | too large, with blocks that can be taken to stand still | the [relaxation](super::relaxed) |
//! | too large even so, with regions | [region by region](Domain::regions), approximate |
//! | too large otherwise | a search that hashes states, until the memory is full |

use super::Progress;
use super::goals::GoalTable;
use super::regions::Regions;
use super::relaxed::Relaxation;
use super::search::{PlanMemory, Search};
use crate::oomdp::Domain;
use crate::task::TaskSet;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Way {
    #[default]
    Known,
    Search,
    Relaxed,
    Regions,
}

/// Plans for one state after another, for the tasks of one session.
#[derive(Debug)]
pub struct Planner<'m> {
    search: Search<'m>,
    relaxation: Relaxation,
    regions: Regions,
    way: Way,
    all: TaskSet,
}

impl<'m> Planner<'m> {
    /// A planner that knows nothing yet.
    pub fn new(plan: PlanMemory<'m>, workspace: &'m mut [u64]) -> Self {
        Self {
            search: Search::new(plan, workspace),
            relaxation: Relaxation::default(),
            regions: Regions::default(),
            way: Way::Known,
            all: TaskSet::EMPTY,
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

    /// Forgets what it knows: the tasks or the domain are others now.
    pub fn forget(&mut self, tasks: usize) {
        self.relaxation.forget();
        (self.way, self.all) = (Way::Known, TaskSet::first(tasks));
    }

    /// Begins at `state`, for the tasks in `wanted`; those in `dead` are known to be dead ends.
    pub fn begin<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, wanted: TaskSet, dead: TaskSet) {
        if Relaxation::applies(domain) && !self.search.fits(domain, goals, self.all) {
            self.way = Way::Relaxed;
            self.search.stand(domain, goals, state, wanted, dead);
            self.relaxation.begin(&mut self.search, domain, goals, state);
        } else {
            self.way = Way::Search;
            self.search.begin(domain, goals, state, wanted, dead);
        }
    }

    /// Goes on, with no more than about `budget` looks. `state` is the one that it began with.
    pub fn advance<D: Domain + ?Sized>(&mut self, domain: &D, goals: &GoalTable<'_>, state: &D::State, budget: u32) -> Progress {
        let progress = match self.way {
            Way::Known => Progress::Done,
            Way::Search => self.search.advance(domain, goals, budget),
            Way::Relaxed => match self.relaxation.advance(&mut self.search, domain, goals, state, budget) {
                Progress::Done if domain.regions() > 0 && !self.search.unknown().is_empty() => {
                    self.way = Way::Regions;
                    self.regions.begin(&mut self.search, domain, goals, state);
                    Progress::Working
                }
                progress => progress,
            },
            Way::Regions => self.regions.advance(&mut self.search, domain, goals, state, budget),
        };
        if progress == Progress::Done {
            self.way = Way::Known;
        }
        progress
    }

    /// Whether it has come to its end.
    pub fn is_done(&self) -> bool {
        self.way == Way::Known
    }

    /// What it found.
    pub fn search(&self) -> &Search<'m> {
        &self.search
    }
}
