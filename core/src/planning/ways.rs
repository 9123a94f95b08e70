//! Tasks with a path constraint, called a way: the product of the world and the way's progress.
//!
//! The product has a copy of the world, a layer, for each state of the way. A step changes the layer if it meets a clause or an earlier
//! goal. No step leaves a state with something to avoid; such a state can only be the end. Tasks with the same way and different goals
//! share a search. A task with a finished way is a task without one.

use crate::oomdp::{Action, ActionKind, Domain, GroundProposition, OneByOne, World};
use crate::task::{GroundedTask, LiftedTask, TaskSet, Way, WayState};

/// The planned tasks, with the progress of their ways.
#[derive(Clone, Copy, Debug, Default)]
#[doc(hidden)]
pub struct Ways<'t> {
    /// The lifted tasks.
    pub lifted: &'t [LiftedTask],
    /// The tasks that ground them, in planning order.
    pub tasks: &'t [GroundedTask],
}

impl<'t> Ways<'t> {
    /// The way of a task, if it has one.
    pub(super) fn of(&self, task: usize) -> Option<Way<'t>> {
        let task = self.tasks.get(task)?;
        let lifted = self.lifted.get(usize::from(task.lifted))?;
        lifted.has_way().then(|| Way::of(task, lifted))
    }

    /// The progress of a task's way.
    fn state(&self, task: usize) -> WayState {
        self.tasks.get(task).map_or(WayState::START, |task| task.way)
    }

    /// The tasks with a way for which this is true.
    fn those(&self, tasks: TaskSet, is: impl Fn(&Way<'t>, WayState) -> bool) -> TaskSet {
        if self.lifted.iter().any(LiftedTask::has_way) {
            tasks.iter().filter(|&task| self.of(task).is_some_and(|way| is(&way, self.state(task)))).collect()
        } else {
            TaskSet::EMPTY
        }
    }

    /// The tasks with a way.
    pub(super) fn all(&self) -> TaskSet {
        self.those(TaskSet::first(self.tasks.len()), |_, _| true)
    }

    /// The tasks with an unfinished way.
    pub(super) fn open(&self, tasks: TaskSet) -> TaskSet {
        self.those(tasks, |way, state| !way.is_finished(state))
    }

    /// The tasks that have become impossible: the robot has met something to avoid.
    pub(super) fn broken(&self, tasks: TaskSet) -> TaskSet {
        self.those(tasks, |_, state| state.is_broken())
    }

    /// The tasks that share the way of one of them.
    pub(super) fn group(&self, first: usize, tasks: TaskSet) -> TaskSet {
        let Some(own) = self.of(first) else { return TaskSet::EMPTY };
        self.those(tasks, |way, _| way.is_shared_with(&own))
    }

    /// The world with the layers of a task's way, and the present state of the way.
    pub(super) fn product<'d, D: Domain>(&self, domain: &'d D, task: usize) -> Option<(Product<'d, 't, D>, WayState)> {
        self.of(task).map(|way| (Product { domain, layers: u64::from(way.layers()), way }, self.state(task)))
    }
}

/// The product of a world and the way of a task.
pub(super) struct Product<'d, 't, D> {
    domain: &'d D,
    way: Way<'t>,
    layers: u64,
}

impl<'t, D> Product<'_, 't, D> {
    /// The way.
    pub(super) const fn way(&self) -> &Way<'t> {
        &self.way
    }
}

impl<D: Domain> Domain for Product<'_, '_, D> {
    type State = (D::State, WayState);
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.domain.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.domain.actions()
    }

    fn step(&self, (state, way): &Self::State, action: Action) -> Option<Self::State> {
        if self.way.is_violated(|part| self.domain.holds(part, state)) {
            return None;
        }
        let next = self.domain.step(state, action)?;
        Some((next, self.way.pass(*way, |part| self.domain.holds(part, &next))))
    }

    /// A goal holds only in the last layer.
    fn holds(&self, proposition: &GroundProposition, (state, way): &Self::State) -> bool {
        self.way.leads_to_goal(*way) && self.domain.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.domain.state_count().saturating_mul(self.layers)
    }

    fn number(&self, (state, way): &Self::State) -> u64 {
        self.domain.number(state).wrapping_mul(self.layers).wrapping_add(u64::from(self.way.layer(*way)))
    }

    fn numbered(&self, number: u64) -> Self::State {
        let (state, layer) = (number.checked_div(self.layers).unwrap_or(0), number.checked_rem(self.layers).unwrap_or(0));
        (self.domain.numbered(state), self.way.of_layer(layer as u8))
    }
}
