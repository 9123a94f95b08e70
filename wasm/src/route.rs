//! Where a task would lead the robot, for the ghost on the floor plan.

use crate::world::SCOUT;
use goodbot::capacity::CapacityError;
use goodbot::home::{Home, HomeState};
use goodbot::memory::{AgentHeap, AgentMemory, AgentTables, HomeMemory};
use goodbot::oomdp::{Domain, apply};
use goodbot::planning::{OptimalSet, PlanTables, Planner, Progress, Ways};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, Way};

/// The most node expansions of a look ahead.
const MOST_EXPANSIONS: u32 = 200_000;
/// The most steps of its route.
const MOST_STEPS: usize = 300;

/// A second planner in its own memory: looking ahead must not disturb the plan that feedback is judged by.
#[derive(Debug)]
pub struct Scout {
    memory: AgentHeap,
    planner: Planner,
}

impl Default for Scout {
    /// A scout who has not looked yet.
    fn default() -> Self {
        Self { memory: AgentHeap::new(&SCOUT), planner: Planner::new() }
    }
}

impl Scout {
    fn tables(memory: &mut AgentHeap) -> PlanTables<'_> {
        let AgentTables { session, workspace, .. } = memory.lend();
        PlanTables::new(session.goals, session.plan, workspace)
    }

    /// Takes the tasks of a session.
    ///
    /// # Errors
    /// A [`CapacityError`] where they are too many.
    pub fn set_tasks<M: HomeMemory>(&mut self, home: &Home<M>, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> Result<(), CapacityError> {
        self.planner.set_tasks(&mut Self::tables(&mut self.memory), home, lifted, tasks)
    }
}

/// A look ahead under way: the states on the way to a task's goal, following the first optimal action each time.
#[derive(Debug)]
pub struct Lookahead {
    states: Vec<HomeState>,
    task: usize,
    /// The task at its position, with the progress of its way; the entries before it are only fillers.
    tasks: Vec<GroundedTask>,
    left: u32,
    searching: bool,
    arrived: bool,
}

impl Lookahead {
    /// A look from a state to where a task is done. The task has this position and progress in the session.
    pub fn new(state: HomeState, task: usize, goal: GroundedTask) -> Self {
        let tasks = vec![goal; task + 1];
        Self { states: vec![state], task, tasks, left: MOST_EXPANSIONS, searching: false, arrived: false }
    }

    /// Goes on, with at most about `budget` expansions. A look that is done may lead nowhere.
    pub fn advance<M: HomeMemory>(&mut self, scout: &mut Scout, home: &Home<M>, lifted: &[LiftedTask], budget: u32) -> Progress {
        let mut budget = budget.max(1);
        let Scout { memory, planner } = scout;
        while budget > 0 && !self.arrived {
            let Some(here) = self.states.last().copied() else { return Progress::Done };
            if let Some(task) = self.tasks.last_mut()
                && let Some(lifted) = lifted.get(usize::from(task.lifted)).filter(|_| !self.searching)
            {
                task.way = Way::of(task, lifted).advance(task.way, |part| home.holds(part, &here));
            }
            let mut tables = Scout::tables(memory).with_ways(Ways { lifted, tasks: &self.tasks });
            let mut before = 0;
            if self.searching {
                before = planner.plan(tables.plan.optimal, tables.plan.distances).expansions();
            } else {
                planner.begin(TaskSet::of(self.task), TaskSet::EMPTY);
                self.searching = true;
            }
            let progress = planner.advance(&mut tables, home, &here, budget.min(self.left));
            let plan = planner.plan(tables.plan.optimal, tables.plan.distances);
            // A search that expands no state counts as one, so that this ends.
            let spent = plan.expansions().saturating_sub(before).max(1);
            (budget, self.left) = (budget.saturating_sub(spent), self.left.saturating_sub(spent));
            let next = match progress {
                Progress::Working if self.left == 0 => None,
                Progress::Working => return Progress::Working,
                Progress::Done if plan.optimal(self.task) == OptimalSet::Goal => {
                    self.arrived = true;
                    return Progress::Done;
                }
                Progress::Done => {
                    let onward = plan.optimal(self.task).onward();
                    onward.and_then(|actions| actions.iter().next()).and_then(|action| apply(home, &here, action))
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
