//! Grounded tasks: a lifted task with its variables bound to objects.

use super::lifted::LiftedProposition;
use super::way::{Part, Way, WayState};
use super::{LiftedTask, TaskSet};
use crate::capacity::{Capacity, CapacityError, VARIABLES_PER_TASK};
use crate::oomdp::{Domain, GroundProposition, ObjectId, Objects, World};

/// A lifted task with its variables bound to objects, and its prior Pr(l|s) Pr(t|s,l).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundedTask {
    /// The lifted task, by its position among the agent's.
    pub lifted: u8,
    /// The object of each variable.
    pub bindings: [ObjectId; VARIABLES_PER_TASK],
    /// The progress of its way, if it has one; or that it is negated.
    pub way: WayState,
    /// Its prior probability, before any command.
    pub prior: f32,
}

impl GroundedTask {
    /// The value of unused memory.
    pub const UNUSED: Self = Self { lifted: 0, bindings: [ObjectId(0); VARIABLES_PER_TASK], way: WayState::START, prior: 0.0 };

    /// Whether the goal is that it does not hold: `!agentInRoom(agent0,room1)`.
    pub const fn is_negated(&self) -> bool {
        self.way.is_negated()
    }

    /// Its opposite: the goal is any state where it does not hold. `None` for a task of several propositions, or with a way. `lifted` is the
    /// task that it grounds.
    #[cfg(feature = "talk")]
    #[must_use]
    pub fn negated(&self, lifted: &LiftedTask) -> Option<Self> {
        let is_single = lifted.propositions().len() == 1 && !lifted.has_way();
        is_single.then_some(Self { way: WayState::NEGATED, ..*self })
    }

    /// Whether its goal is reached, regardless of its way. `holds` evaluates propositions in the state; `lifted` is its lifted task.
    pub fn is_reached(&self, lifted: &LiftedTask, holds: impl Fn(&GroundProposition) -> bool) -> bool {
        self.propositions(lifted).all(|part| holds(&part)) != self.is_negated()
    }

    /// The conjunction, with the objects in it; with a way, that of the goal. `lifted` is the task that it grounds.
    pub fn propositions(&self, lifted: &LiftedTask) -> impl Iterator<Item = GroundProposition> {
        let task = *self;
        lifted.propositions().iter().map(move |&part| task.grounded(part))
    }

    /// The goal's propositions, then those of its way, with the objects in them. `lifted` is the task that it grounds.
    pub fn parts<'l>(&self, lifted: &'l LiftedTask) -> impl Iterator<Item = (Part, GroundProposition)> + Clone + use<'l> {
        let task = *self;
        lifted.parts().map(move |(part, proposition)| (part, task.grounded(proposition)))
    }

    /// Whether this task and another of the same lifted task have the same propositions in another order: `done(a) & done(b)`, and
    /// `done(b) & done(a)`.
    fn is_same(&self, other: &Self, lifted: &LiftedTask) -> bool {
        // Different objects are bound, so both have as many different propositions.
        self.parts(lifted).all(|part| other.parts(lifted).any(|own| own == part))
    }

    /// A number that is the same for the same objects in another order, and for few others.
    fn mix(&self) -> u32 {
        // Not a loop: it is computed for each pair of tasks.
        let [ObjectId(a), ObjectId(b), ObjectId(c), ObjectId(d), ObjectId(e), ObjectId(f)] = self.bindings;
        let [a, b, c, d, e, f] = [u32::from(a), u32::from(b), u32::from(c), u32::from(d), u32::from(e), u32::from(f)];
        let sum = a.wrapping_add(b).wrapping_add(c).wrapping_add(d).wrapping_add(e).wrapping_add(f);
        sum << 8 | (a ^ b ^ c ^ d ^ e ^ f)
    }

    /// A proposition of the lifted task, with the objects in it.
    pub fn grounded(&self, part: LiftedProposition) -> GroundProposition {
        let object = |variable: u8| self.bindings.get(usize::from(variable)).copied().unwrap_or(ObjectId(0));
        GroundProposition { proposition: part.proposition, arguments: part.variables.map(object) }
    }
}

/// Grounds every lifted task that the environment permits: one task for each binding of its variables to different objects, except those
/// that hold already or that the domain does not [admit](Domain::admits), those whose way adds no constraint in this start state, and those with the same propositions as one before: interchangeable
/// variables give a task once. Pr(l|s) is uniform over the permissible lifted tasks and
/// Pr(t|s,l) over the remaining groundings, renormalised (paper, section 3). Returns the number of tasks.
///
/// # Errors
/// A [`CapacityError`] if `tasks` is too small.
pub fn ground<D: Domain>(domain: &D, lifted: &[LiftedTask], state: &D::State, tasks: &mut [GroundedTask]) -> Result<usize, CapacityError> {
    ground_some(domain, lifted, state, tasks, false)
}

/// As [`ground`]; also the tasks that hold already, if `held` is set. A function of its own, so that it is compiled once.
#[inline(never)]
fn ground_some<D: Domain>(
    domain: &D,
    lifted: &[LiftedTask],
    state: &D::State,
    tasks: &mut [GroundedTask],
    held: bool,
) -> Result<usize, CapacityError> {
    ground_unless(domain.world().objects, lifted, tasks, |task, lifted| {
        if !is_admitted(domain, task, lifted) {
            return true;
        }
        let holds = |part: &GroundProposition| domain.holds(part, state);
        if lifted.has_way() { Way::of(task, lifted).is_idle(holds) } else { !held && task.propositions(lifted).all(|part| holds(&part)) }
    })
}

/// Whether a task has only propositions that it may be about.
#[cfg(feature = "alloc")]
fn is_admitted<D: Domain>(domain: &D, task: &GroundedTask, lifted: &LiftedTask) -> bool {
    task.parts(lifted).all(|(_, part)| domain.admits(&part))
}

#[cfg(not(feature = "alloc"))]
const fn is_admitted<D: Domain>(_domain: &D, _task: &GroundedTask, _lifted: &LiftedTask) -> bool {
    true
}

/// As [`ground`], but with tasks that hold already, which get the share `done` of the prior of each kind. They are left out if there is no
/// room for them, or if `done` is 0.
///
/// # Errors
/// As [`ground`].
pub fn ground_with_done<D: Domain>(
    domain: &D,
    lifted: &[LiftedTask],
    state: &D::State,
    tasks: &mut [GroundedTask],
    done: f32,
) -> Result<usize, CapacityError> {
    if done == 0.0 {
        return ground(domain, lifted, state, tasks);
    }
    let Ok(count) = ground_some(domain, lifted, state, tasks, true) else { return ground(domain, lifted, state, tasks) };
    let tasks = tasks.get_mut(..count).unwrap_or(&mut []);
    share_with_done(lifted, tasks, done, |part| domain.holds(part, state));
    Ok(count)
}

/// A share of this much or more is that of words which are mostly about what holds.
const MOSTLY_DONE: f32 = 0.5;

/// Gives the tasks of each kind that hold already the share `done` of the kind's prior, if there are others too. A command is seldom about
/// what holds, so it makes no task that holds more than half as probable as one that is to do: among a hundred floors, a robot without
/// words would otherwise stay where it is.
pub(crate) fn share_with_done(lifted: &[LiftedTask], tasks: &mut [GroundedTask], done: f32, holds: impl Fn(&GroundProposition) -> bool) {
    for (position, kind) in lifted.iter().enumerate().filter(|(_, kind)| !kind.has_way()) {
        let (mut sums, mut counts) = ([0.0_f32; 2], [0.0_f32; 2]);
        let of_kind = |task: &&mut GroundedTask| usize::from(task.lifted) == position;
        let part = |task: &GroundedTask| usize::from(task.propositions(kind).all(|part| holds(&part)));
        for task in tasks.iter_mut().filter(of_kind) {
            sums.iter_mut().zip(&mut counts).skip(part(task)).take(1).for_each(|(sum, count)| {
                *sum += task.prior;
                *count += 1.0;
            });
        }
        let [open, held] = sums;
        if open == 0.0 || held == 0.0 {
            continue;
        }
        let [to_do, held_tasks] = counts;
        let done = if done < MOSTLY_DONE { done.min(held_tasks / (to_do + to_do + held_tasks)) } else { done };
        for task in tasks.iter_mut().filter(of_kind) {
            let share = if part(task) == 1 { done / held } else { (1.0 - done) / open };
            task.prior *= share * (open + held);
        }
    }
}

/// The factor of a task's prior for each part that only asks an object to stay where it is.
const STAYING: f32 = 0.1;

/// Whether an object is of a class with attributes.
pub(crate) fn is_thing(world: &World<'_>, object: ObjectId) -> bool {
    let carries = |class| world.schema.attributes.iter().any(|attribute| attribute.carriers.iter().any(|it| it.class == class));
    world.objects.get(object).is_some_and(|object| carries(object.class))
}

/// Makes tasks of [`ground`] less probable if they ask an object to stay where it is: a factor of a tenth for each such part. The sum over
/// each lifted task stays. A command asks for a change; nobody needs to say that unmoved objects stay. This holds for objects with
/// attributes, by which words tell them apart. The robot has none: it moves in any task, and coming back is worth a word.
pub(crate) fn expect_change<D: Domain>(domain: &D, lifted: &[LiftedTask], state: &D::State, tasks: &mut [GroundedTask]) {
    let world = domain.world();
    let stays =
        |part: &GroundProposition| part.arguments.first().is_some_and(|&object| is_thing(&world, object)) && domain.holds(part, state);
    let mut rest = tasks;
    while let Some(first) = rest.first().map(|task| task.lifted) {
        let count = rest.iter().take_while(|task| task.lifted == first).count();
        let Some((group, others)) = rest.split_at_mut_checked(count) else { return };
        rest = others;
        let Some(lifted) = lifted.get(usize::from(first)) else { continue };
        if lifted.propositions().len() < 2 {
            continue;
        }
        let before: f32 = group.iter().map(|task| task.prior).sum();
        for task in &mut *group {
            let staying = task.propositions(lifted).filter(stays).count();
            task.prior = (0..staying).fold(task.prior, |prior, _| prior * STAYING);
        }
        let after: f32 = group.iter().map(|task| task.prior).sum();
        group.iter_mut().for_each(|task| task.prior *= before / after);
    }
}

/// Grounds every lifted task, except those for which `holds` is true.
pub(crate) fn ground_unless(
    objects: Objects<'_>,
    lifted: &[LiftedTask],
    tasks: &mut [GroundedTask],
    holds: impl Fn(&GroundedTask, &LiftedTask) -> bool,
) -> Result<usize, CapacityError> {
    let limit = tasks.len().min(TaskSet::MOST);
    let (mut count, mut groups) = (0_usize, 0_usize);
    for (position, task) in lifted.iter().enumerate() {
        let first = count;
        let mut bindings = Some([ObjectId(0); VARIABLES_PER_TASK]).filter(|_| !task.variables.is_empty());
        if let Some(start) = bindings {
            bindings = next_binding(objects, task, start, true);
        }
        // If each propositional function occurs once, different objects are different tasks.
        let several = task.propositions().len() > 1;
        let repeats = several
            && task.parts().enumerate().any(|(position, (kind, one))| {
                task.parts().take(position).any(|(other_kind, other)| other_kind == kind && other.proposition == one.proposition)
            });
        while let Some(bound) = bindings {
            let grounded = GroundedTask { lifted: position as u8, bindings: bound, ..GroundedTask::UNUSED };
            let earlier = tasks.get(first..count).unwrap_or(&[]);
            let is_twin = || {
                let mix = if repeats { grounded.mix() } else { 0 };
                repeats && earlier.iter().any(|other| other.mix() == mix && other.is_same(&grounded, task))
                    || task.has_way() && Way::of(&grounded, task).is_twin()
            };
            if !(holds(&grounded, task) || is_twin()) {
                if let Some(slot) = tasks.get_mut(count).filter(|_| count < limit) {
                    *slot = grounded;
                }
                count += 1;
                // Memory never has room for more, so their exact number does not matter.
                if count > TaskSet::MOST {
                    return Err(CapacityError::new(Capacity::Tasks, limit, count));
                }
            }
            bindings = next_binding(objects, task, bound, false);
        }
        let group = tasks.get_mut(first..count).unwrap_or(&mut []);
        let share = 1.0 / group.len().max(1) as f32;
        groups += usize::from(!group.is_empty());
        for grounded in group {
            grounded.prior = share;
        }
    }
    Capacity::Tasks.fits(count, limit)?;
    let share = 1.0 / groups.max(1) as f32;
    for grounded in tasks.iter_mut().take(count) {
        grounded.prior *= share;
    }
    Ok(count)
}

/// The next assignment of different objects of the right classes, in the order of the objects, the last variable counting fastest.
fn next_binding(
    objects: Objects<'_>,
    task: &LiftedTask,
    mut bound: [ObjectId; VARIABLES_PER_TASK],
    first: bool,
) -> Option<[ObjectId; VARIABLES_PER_TASK]> {
    let variables = task.variables.as_slice();
    // The variable to set next, and the first object to try for it.
    let mut variable = if first { 0 } else { variables.len().checked_sub(1)? };
    let mut from = if first { 0 } else { bound.get(variable)?.index() + 1 };
    loop {
        let class = *variables.get(variable)?;
        let taken = bound.get(..variable)?;
        let found = objects.iter().skip(from).find(|(id, object)| object.class == class && !taken.contains(id)).map(|(id, _)| id);
        match found {
            Some(id) => {
                *bound.get_mut(variable)? = id;
                variable += 1;
                from = 0;
                if variable == variables.len() {
                    return Some(bound);
                }
            }
            None => {
                variable = variable.checked_sub(1)?;
                from = bound.get(variable)?.index() + 1;
            }
        }
    }
}
