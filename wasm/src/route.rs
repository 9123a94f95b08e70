//! Where a task would lead the robot, for the ghost on the floor plan.

use goodbot::home::{Home, HomeState};
use goodbot::oomdp::apply;
use goodbot::planning::{GoalTable, OptimalSet, Progress, Search};
use goodbot::task::TaskSet;

use crate::cells::{Lookout, SCOUT, Scout, memory};

/// How many looks of the search a look ahead may take before it is given up.
const MOST_LOOKS: u32 = 200_000;
/// How many steps it may go.
const MOST_STEPS: usize = 300;

/// A scout who has not looked yet.
pub fn scout() -> Scout {
    Scout::new(memory(&SCOUT), |memory| {
        let agent = memory.borrow_mut().split().agent;
        let search = Search::new(agent.session.plan, agent.language.tables.counts);
        Lookout { goals: GoalTable::new(agent.session.goals), search }
    })
}

/// A look ahead under way: the states on the way to a task's goal, following the first optimal action each time.
#[derive(Debug)]
pub struct Lookahead {
    states: Vec<HomeState>,
    task: usize,
    left: u32,
    searching: bool,
    arrived: bool,
}

impl Lookahead {
    /// A look from a state to where a task is done.
    pub fn new(state: HomeState, task: usize) -> Self {
        Self { states: vec![state], task, left: MOST_LOOKS, searching: false, arrived: false }
    }

    /// Goes on, with at most about `budget` looks. A look that is done may lead nowhere.
    pub fn advance(&mut self, lookout: &mut Lookout<'_>, home: &Home<'_>, budget: u32) -> Progress {
        let mut budget = budget.max(1);
        while budget > 0 && !self.arrived {
            let Some(here) = self.states.last().copied() else { return Progress::Done };
            if !self.searching {
                lookout.search.begin(home, &lookout.goals, &here, TaskSet::of(self.task), TaskSet::EMPTY);
                self.searching = true;
            }
            let before = lookout.search.looks();
            let progress = lookout.search.advance(home, &lookout.goals, budget.min(self.left));
            // A search that needs no state at all still counts, so that this ends.
            let spent = lookout.search.looks().saturating_sub(before).max(1);
            (budget, self.left) = (budget.saturating_sub(spent), self.left.saturating_sub(spent));
            let next = match progress {
                Progress::Working if self.left == 0 => None,
                Progress::Working => return Progress::Working,
                Progress::Done => match lookout.search.optimal(self.task) {
                    OptimalSet::Goal => {
                        self.arrived = true;
                        return Progress::Done;
                    }
                    OptimalSet::Toward(actions) => actions.iter().next().and_then(|action| apply(home, &here, action)),
                    OptimalSet::DeadEnd(_) | OptimalSet::Unknown => None,
                },
            };
            let Some(next) = next.filter(|_| self.left > 0 && self.states.len() < MOST_STEPS) else { return Progress::Done };
            self.states.push(next);
            self.searching = false;
        }
        Progress::Working
    }

    /// The states from the first to the goal; `None` where the task leads nowhere, or finding out took too long.
    pub fn states(self) -> Option<Vec<HomeState>> {
        self.arrived.then_some(self.states)
    }
}
