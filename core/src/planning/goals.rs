//! Which tasks a state satisfies.
//!
//! A task is a conjunction of ground propositions, and most propositions read one variable of the state: where the agent is, where one
//! block is. So for each value of each variable the table keeps the tasks that this value does not rule out, one bit a task, and the
//! tasks that a state satisfies are the intersection over its variables: as many look-ups as variables, however many tasks.

use crate::capacity::{Capacity, CapacityError};
use crate::oomdp::{Domain, GroundProposition, ObjectId, PropositionId};
use crate::task::{GroundedTask, LiftedTask, TaskSet};

/// A ground proposition and the tasks that it is a part of.
#[derive(Clone, Copy, Debug)]
pub struct GoalPart {
    proposition: GroundProposition,
    tasks: TaskSet,
    tabled: bool,
}

impl GoalPart {
    /// What unused memory holds.
    pub const UNUSED: Self = Self {
        proposition: GroundProposition { proposition: PropositionId(0), arguments: [ObjectId(0); crate::capacity::ARGUMENTS] },
        tasks: TaskSet::EMPTY,
        tabled: false,
    };
}

/// Memory for a [`GoalTable`].
#[derive(Debug)]
pub struct GoalMemory<'m> {
    /// One entry a distinct ground proposition.
    pub parts: &'m mut [GoalPart],
    /// One entry a value of a state variable; where there are too few, propositions are asked one by one.
    pub entries: &'m mut [TaskSet],
}

/// Which tasks ask what of a state.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Asked {
    /// Where the robot is: the first variable.
    pub(super) of_place: TaskSet,
    /// Any other variable.
    pub(super) of_all_else: TaskSet,
    /// More than one variable at once.
    pub(super) of_several: TaskSet,
}

/// Finds the tasks that a state satisfies.
#[derive(Debug)]
pub struct GoalTable<'m> {
    memory: GoalMemory<'m>,
    parts: usize,
    variables: usize,
    asked: Asked,
    all: TaskSet,
    untabled: bool,
}

impl<'m> GoalTable<'m> {
    /// A table of no tasks.
    pub fn new(memory: GoalMemory<'m>) -> Self {
        Self { memory, parts: 0, variables: 0, asked: Asked::default(), all: TaskSet::EMPTY, untabled: false }
    }

    /// Fills the table for `tasks`. `state` is any state of the domain.
    ///
    /// # Errors
    /// A [`CapacityError`] where the tasks have more distinct ground propositions than there is room for; the table then has no tasks.
    pub fn fill<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
        state: &D::State,
    ) -> Result<(), CapacityError> {
        (self.parts, self.variables, self.all, self.untabled) = (0, 0, TaskSet::EMPTY, false);
        self.asked = Asked::default();
        for (position, task) in tasks.iter().enumerate() {
            let Some(lifted) = lifted.get(usize::from(task.lifted)) else { continue };
            for proposition in task.propositions(lifted) {
                self.add(proposition, position)?;
            }
        }
        let fits = (0..domain.variables()).try_fold(0_usize, |sum, variable| sum.checked_add(domain.values(variable)));
        if fits.is_some_and(|entries| entries <= self.memory.entries.len()) {
            self.tabulate(domain, state);
        }
        for part in self.memory.parts.iter().take(self.parts) {
            let asked = match domain.reads(&part.proposition) {
                Some(0) => &mut self.asked.of_place,
                Some(_) => &mut self.asked.of_all_else,
                None => &mut self.asked.of_several,
            };
            *asked = asked.union(part.tasks);
        }
        self.untabled = self.memory.parts.iter().take(self.parts).any(|part| !part.tabled);
        self.all = TaskSet::first(tasks.len());
        Ok(())
    }

    fn add(&mut self, proposition: GroundProposition, task: usize) -> Result<(), CapacityError> {
        let limit = self.memory.parts.len();
        let known = self.memory.parts.iter_mut().take(self.parts).find(|part| part.proposition == proposition);
        if let Some(part) = known {
            part.tasks = part.tasks.union(TaskSet::of(task));
            return Ok(());
        }
        let Some(slot) = self.memory.parts.get_mut(self.parts) else {
            self.parts = 0;
            return Err(CapacityError::full(Capacity::GroundPropositions, limit));
        };
        *slot = GoalPart { proposition, tasks: TaskSet::of(task), tabled: false };
        self.parts = self.parts.saturating_add(1);
        Ok(())
    }

    fn tabulate<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) {
        self.variables = domain.variables();
        let mut entries = self.memory.entries.iter_mut();
        for variable in 0..self.variables {
            for value in 0..domain.values(variable) {
                let changed = domain.with_value(state, variable, value);
                let Some(entry) = entries.next() else { return };
                *entry = TaskSet(u64::MAX);
                for part in self.memory.parts.iter_mut().take(self.parts) {
                    if domain.reads(&part.proposition) == Some(variable) {
                        part.tabled = true;
                        if !domain.holds(&part.proposition, &changed) {
                            *entry = entry.without(part.tasks);
                        }
                    }
                }
            }
        }
    }

    /// A table of tasks that hold where the domain says so, whatever proposition it is asked.
    pub(super) fn of_domain(memory: GoalMemory<'m>, tasks: TaskSet) -> Self {
        if let Some(part) = memory.parts.first_mut() {
            *part = GoalPart { tasks, ..GoalPart::UNUSED };
        }
        Self { parts: 1, all: tasks, untabled: true, ..Self::new(memory) }
    }

    pub(super) fn asked(&self) -> Asked {
        self.asked
    }

    /// The variables that a task's propositions read, one bit each; `None` where one of them reads more than one.
    pub fn variables_of<D: Domain + ?Sized>(&self, domain: &D, task: usize) -> Option<u32> {
        let mut parts = self.memory.parts.iter().take(self.parts).filter(|part| part.tasks.contains(task));
        parts.try_fold(0, |read, part| Some(read | 1_u32.checked_shl(domain.reads(&part.proposition)? as u32)?))
    }

    /// The tasks that the value of one variable in `state` does not rule out. What is asked of more than one variable at once is left out.
    #[inline]
    pub fn not_ruled_out<D: Domain + ?Sized>(&self, domain: &D, state: &D::State, variable: usize) -> TaskSet {
        if variable < self.variables {
            let offset = (0..variable).fold(domain.value(state, variable), |sum, earlier| sum.wrapping_add(domain.values(earlier)));
            return self.memory.entries.get(offset).copied().unwrap_or(TaskSet::EMPTY).common(self.all);
        }
        let mut left = self.all;
        for part in self.memory.parts.iter().take(self.parts) {
            let asked = !left.common(part.tasks).is_empty() && domain.reads(&part.proposition) == Some(variable);
            if asked && !domain.holds(&part.proposition, state) {
                left = left.without(part.tasks);
            }
        }
        left
    }

    /// The tasks that hold in `state`.
    #[inline]
    pub fn satisfied<D: Domain + ?Sized>(&self, domain: &D, state: &D::State) -> TaskSet {
        let (mut satisfied, mut offset) = (self.all, 0_usize);
        for variable in 0..self.variables {
            let at = offset.wrapping_add(domain.value(state, variable));
            satisfied = satisfied.common(self.memory.entries.get(at).copied().unwrap_or(TaskSet::EMPTY));
            offset = offset.wrapping_add(domain.values(variable));
        }
        if self.untabled {
            for part in self.memory.parts.iter().take(self.parts) {
                if !part.tabled && !satisfied.common(part.tasks).is_empty() && !domain.holds(&part.proposition, state) {
                    satisfied = satisfied.without(part.tasks);
                }
            }
        }
        satisfied
    }
}
