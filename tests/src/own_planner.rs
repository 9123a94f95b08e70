//! A planner with memory of its own.

use goodbot::Capacities;
use goodbot::memory::{AgentHeap, AgentMemory, AgentTables};
use goodbot::oomdp::Domain;
use goodbot::planning::{Plan, PlanTables, Planner, Progress, Ways};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet};

/// A planner with memory of its own.
#[derive(Debug)]
pub struct OwnPlanner {
    memory: AgentHeap,
    planner: Planner,
    tasks: usize,
}

impl OwnPlanner {
    /// A planner for these tasks. Panics if there is no room for them.
    pub fn new<D: Domain>(capacities: &Capacities, domain: &D, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> Self {
        let mut own = Self { memory: AgentHeap::new(capacities), planner: Planner::new(), tasks: tasks.len() };
        own.with_tables(|planner, tables| planner.set_tasks(tables, domain, lifted, tasks)).expect("room for the goals");
        own
    }

    fn with_tables<T>(&mut self, run: impl FnOnce(&mut Planner, &mut PlanTables<'_>) -> T) -> T {
        let AgentTables { session, workspace, .. } = self.memory.lend();
        run(&mut self.planner, &mut PlanTables::new(session.goals, session.plan, workspace))
    }

    /// All its tasks.
    pub fn all(&self) -> TaskSet {
        TaskSet::first(self.tasks)
    }

    /// Begins to plan for these tasks.
    pub fn begin(&mut self, wanted: TaskSet) {
        self.planner.begin(wanted, TaskSet::EMPTY);
    }

    /// Goes on planning.
    pub fn advance<D: Domain>(&mut self, domain: &D, state: &D::State, budget: u32) -> Progress {
        self.with_tables(|planner, tables| planner.advance(tables, domain, state, budget))
    }

    /// Plans at `state` to the end, in calls of this budget.
    pub fn plan_for<D: Domain>(&mut self, domain: &D, state: &D::State, wanted: TaskSet, budget: u32) -> Plan<'_> {
        self.begin(wanted);
        while self.advance(domain, state, budget) == Progress::Working {}
        self.plan()
    }

    /// Plans at `state` for all tasks to the end; `likely` are the likely ones.
    pub fn plan_expecting<D: Domain>(&mut self, domain: &D, state: &D::State, likely: TaskSet) -> Plan<'_> {
        self.begin(self.all());
        self.planner.expect(likely);
        while self.advance(domain, state, u32::MAX) == Progress::Working {}
        self.plan()
    }

    /// Plans at `state` for all tasks to the end, in calls of this budget. `tasks` are its tasks, with the progress of their ways.
    pub fn plan_for_ways<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
        budget: u32,
    ) -> Plan<'_> {
        self.begin(self.all());
        let AgentTables { session, workspace, .. } = self.memory.lend();
        let mut tables = PlanTables::new(session.goals, session.plan, workspace).with_ways(Ways { lifted, tasks });
        while self.planner.advance(&mut tables, domain, state, budget) == Progress::Working {}
        self.plan()
    }

    /// The plan so far.
    pub fn plan(&self) -> Plan<'_> {
        let plan = self.memory.read().session.plan;
        self.planner.plan(plan.optimal, plan.distances)
    }
}
