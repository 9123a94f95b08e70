//! Where a task would lead the robot, for the ghost on the floor plan.

use goodbot::HeapMemory;
use goodbot::capacity::CapacityError;
use goodbot::home::{Home, HomeState};
use goodbot::oomdp::apply;
use goodbot::planning::{OptimalSet, Plan, PlanTables, Planner, Progress};
use goodbot::session::AgentMemory;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet};

use crate::cells::SCOUT;

/// How many expansions of the search a look ahead may take before it is given up.
const MOST_EXPANSIONS: u32 = 200_000;
/// How many steps it may go.
const MOST_STEPS: usize = 300;

/// A second planner, so that looking ahead leaves the robot's own plan alone.
#[derive(Debug)]
pub struct Scout {
    memory: Box<HeapMemory>,
    planner: Planner,
}

impl Default for Scout {
    /// A scout of no tasks.
    fn default() -> Self {
        Self { memory: Box::new(HeapMemory::new(&SCOUT)), planner: Planner::new() }
    }
}

impl Scout {
    fn with_tables<T>(&mut self, run: impl FnOnce(&mut Planner, &mut PlanTables<'_>) -> T) -> T {
        let AgentMemory { language, mut session } = self.memory.split().agent;
        run(&mut self.planner, &mut PlanTables::new(&mut session.goals, &mut session.plan, language.tables.counts))
    }

    fn plan(&mut self) -> Plan<'_> {
        let plan = self.memory.split().agent.session.plan;
        self.planner.plan(plan.optimal, plan.distances)
    }

    /// Takes the tasks that may be looked ahead for.
    pub fn set_tasks(
        &mut self,
        home: &Home<'_>,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
        state: &HomeState,
    ) -> Result<(), CapacityError> {
        self.with_tables(|planner, tables| planner.set_tasks(tables, home, lifted, tasks, state))
    }
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
        Self { states: vec![state], task, left: MOST_EXPANSIONS, searching: false, arrived: false }
    }

    /// Goes on, with at most about `budget` expansions. A look that is done may lead nowhere.
    pub fn advance(&mut self, scout: &mut Scout, home: &Home<'_>, budget: u32) -> Progress {
        let mut budget = budget.max(1);
        while budget > 0 && !self.arrived {
            let Some(here) = self.states.last().copied() else { return Progress::Done };
            if !self.searching {
                scout.with_tables(|planner, tables| planner.begin(tables, home, &here, TaskSet::of(self.task), TaskSet::EMPTY));
                self.searching = true;
            }
            let before = scout.plan().expansions();
            let most = budget.min(self.left);
            let progress = scout.with_tables(|planner, tables| planner.advance(tables, home, &here, most));
            // A search that needs no state at all still counts, so that this ends.
            let spent = scout.plan().expansions().saturating_sub(before).max(1);
            (budget, self.left) = (budget.saturating_sub(spent), self.left.saturating_sub(spent));
            let next = match progress {
                Progress::Working if self.left == 0 => None,
                Progress::Working => return Progress::Working,
                Progress::Done => {
                    let plan = scout.plan().optimal(self.task);
                    if plan == OptimalSet::Goal {
                        self.arrived = true;
                        return Progress::Done;
                    }
                    plan.onward().and_then(|actions| actions.iter().next()).and_then(|action| apply(home, &here, action))
                }
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
