//! Possible questions, and the expected information of their answers.

use super::settings::{Asking, CHOICES};
use crate::feedback::BeliefRef;
use crate::feedback::information::{binary_entropy, surprise};
use crate::oomdp::{ClassId, ObjectId};
use crate::probability::{Scaled, total};
use crate::task::{GroundedTask, LiftedTask, TaskSet};

/// The subject of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// "Do you mean this room?", "this block?": an object.
    Object(ObjectId),
    /// "Shall I move or carry?": a kind of task, by the lifted task's position.
    Kind(u8),
    /// "Do you mean this?": a single task, by its position.
    Task(u8),
    /// "Which of these rooms, or none of these?": objects of one class, and their number.
    WhichObject([ObjectId; CHOICES], u8),
    /// "Which of these, or none of these?": single tasks by position, and their number.
    WhichTask([u8; CHOICES], u8),
}

impl Subject {
    /// The number of meanings that it offers to choose from; 0 if the answer is yes or no.
    pub const fn choices(self) -> u8 {
        match self {
            Self::WhichObject(_, count) | Self::WhichTask(_, count) => count,
            Self::Object(_) | Self::Kind(_) | Self::Task(_) => 0,
        }
    }
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Its subject.
    pub subject: Subject,
    /// The tasks for which the answer is yes; in a choice, the tasks of all choices.
    pub yes: TaskSet,
    /// The tasks of each choice.
    pub choices: [TaskSet; CHOICES],
    /// The expected information of the answer, in bits.
    pub information: f32,
    /// The probability that an answer is wrong.
    pub eta: f32,
}

/// The trainer's answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Yes.
    Yes,
    /// No; in a choice, none of these.
    No,
    /// This one, by its position among the choices.
    This(u8),
}

impl Question {
    /// The meaning of an answer: its tasks, whether the intended task is among them, and the number of other answers. `None` if it is no
    /// answer to this question.
    pub fn meaning(&self, answer: Answer) -> Option<(TaskSet, bool, u8)> {
        let count = self.subject.choices();
        match answer {
            Answer::This(chosen) if chosen < count => Some((*self.choices.get(usize::from(chosen))?, true, count)),
            Answer::Yes if count == 0 => Some((self.yes, true, 1)),
            Answer::No => Some((self.yes, false, count.max(1))),
            Answer::Yes | Answer::This(_) => None,
        }
    }
}

/// The inputs for choosing the most informative question.
#[derive(Clone, Copy)]
pub(super) struct Candidates<'a> {
    pub(super) belief: BeliefRef<'a>,
    /// The weight of all tasks together.
    pub(super) whole: Scaled,
    pub(super) tasks: &'a [GroundedTask],
    pub(super) lifted: &'a [LiftedTask],
    /// The tasks of the questions asked already.
    pub(super) asked: &'a [TaskSet],
    pub(super) asking: &'a Asking,
}

impl<'a> Candidates<'a> {
    /// The most informative question that was not asked yet.
    pub(super) fn best(self) -> Option<Question> {
        let mut best = None;
        for (position, task) in self.tasks.iter().enumerate() {
            // Repeating a question is uninformative.
            let before = self.tasks.get(..position).unwrap_or_default();
            if before.iter().all(|other| other.lifted != task.lifted) {
                self.propose(&mut best, Subject::Kind(task.lifted), self.with(|other| other.lifted == task.lifted));
            }
            for (object, _) in self.bound_first(position) {
                self.propose(&mut best, Subject::Object(object), self.binding(object));
            }
            self.propose(&mut best, Subject::Task(position as u8), TaskSet::of(position));
        }
        let mut done: Option<ClassId> = None;
        let classes = self.lifted.iter().flat_map(|lifted| lifted.variables().iter().copied());
        for class in classes {
            if done != Some(class) {
                self.propose_objects(&mut best, class);
                done = Some(class);
            }
        }
        self.propose_tasks(&mut best);
        best
    }

    /// The remaining uncertainty about the task, in bits.
    pub(super) fn uncertainty(self) -> f32 {
        (0..self.tasks.len()).fold(0.0, |sum, task| sum + surprise(self.belief.weight(task).over(self.whole)))
    }

    fn probability(self, set: TaskSet) -> f32 {
        let weight: Scaled = total(set.iter().map(|task| self.belief.weight(task)));
        weight.over(self.whole).clamp(0.0, 1.0)
    }

    fn with(self, same: impl Fn(&GroundedTask) -> bool) -> TaskSet {
        self.tasks.iter().enumerate().filter(|(_, task)| same(task)).map(|(position, _)| position).collect()
    }

    /// The objects that a task binds, with their classes.
    fn bound(self, task: &GroundedTask) -> impl Iterator<Item = (ObjectId, ClassId)> + use<'a> {
        let classes = self.lifted.get(usize::from(task.lifted)).map_or(&[][..], |lifted| lifted.variables());
        task.bindings.into_iter().zip(classes.iter().copied())
    }

    /// The objects that a task binds and no earlier task does, with their classes.
    fn bound_first(self, position: usize) -> impl Iterator<Item = (ObjectId, ClassId)> + use<'a> {
        let before = self.tasks.get(..position).unwrap_or_default();
        let task = self.tasks.get(position);
        let objects = task.into_iter().flat_map(move |task| self.bound(task));
        objects.filter(move |&(object, _)| before.iter().all(|other| !self.binds(other, object)))
    }

    fn binding(self, object: ObjectId) -> TaskSet {
        self.with(|task| self.binds(task, object))
    }

    fn binds(self, task: &GroundedTask, object: ObjectId) -> bool {
        self.bound(task).any(|(bound, _)| bound == object)
    }

    fn is_new(self, yes: TaskSet) -> bool {
        let others = TaskSet::first(self.tasks.len()).without(yes);
        !yes.is_empty() && self.asked.iter().all(|&known| known != yes && known != others)
    }

    /// Proposes a question of yes and no.
    fn propose(self, best: &mut Option<Question>, subject: Subject, yes: TaskSet) {
        let (sure, eta) = (self.probability(yes), self.asking.eta);
        let information = binary_entropy(sure * (1.0 - eta) + (1.0 - sure) * eta) - binary_entropy(eta);
        self.take(best, Question { subject, yes, choices: [TaskSet::EMPTY; CHOICES], information, eta });
    }

    fn take(self, best: &mut Option<Question>, question: Question) {
        if question.information > best.map_or(0.0, |best| best.information) && self.is_new(question.yes) {
            *best = Some(question);
        }
    }

    /// Proposes a choice among disjoint sets of tasks. All wrong answers are equally probable.
    fn propose_choice(self, best: &mut Option<Question>, subject: Subject, choices: [TaskSet; CHOICES]) {
        let count = usize::from(subject.choices());
        let yes = choices.iter().take(count).fold(TaskSet::EMPTY, |all, &choice| all.union(choice));
        let (others, eta) = (count as f32, self.asking.eta);
        let said = |sure: f32| surprise(sure * (1.0 - eta) + (1.0 - sure) * (eta / others));
        let none = self.probability(TaskSet::first(self.tasks.len()).without(yes));
        let answers = choices.iter().take(count).fold(said(none), |sum, &choice| sum + said(self.probability(choice)));
        let information = answers - binary_entropy(eta) - eta * libm::log2f(others);
        self.take(best, Question { subject, yes, choices, information, eta });
    }

    /// Proposes a choice among the most probable objects of a class.
    fn propose_objects(self, best: &mut Option<Question>, class: ClassId) {
        let (mut objects, mut choices, mut listed) = ([ObjectId(0); CHOICES], [TaskSet::EMPTY; CHOICES], TaskSet::EMPTY);
        for position in 0..usize::from(self.asking.choices).min(CHOICES) {
            let of_class = (0..self.tasks.len()).flat_map(|task| self.bound_first(task)).filter(|&(_, bound)| bound == class);
            let mut next: Option<(ObjectId, TaskSet, f32)> = None;
            for (object, _) in of_class {
                let set = self.binding(object);
                // A task with two of the objects would be in two choices.
                let sure = if set.common(listed).is_empty() { self.probability(set) } else { 0.0 };
                if sure > next.map_or(0.0, |(.., most)| most) {
                    next = Some((object, set, sure));
                }
            }
            let (Some((object, set, _)), Some(slot), Some(choice)) = (next, objects.get_mut(position), choices.get_mut(position)) else {
                break;
            };
            (*slot, *choice, listed) = (object, set, listed.union(set));
            if position > 0 {
                self.propose_choice(best, Subject::WhichObject(objects, (position + 1) as u8), choices);
            }
        }
    }

    /// Proposes a choice among the most probable tasks.
    fn propose_tasks(self, best: &mut Option<Question>) {
        let (mut tasks, mut choices, mut listed) = ([0; CHOICES], [TaskSet::EMPTY; CHOICES], TaskSet::EMPTY);
        for position in 0..usize::from(self.asking.choices).min(CHOICES) {
            let mut next: Option<(usize, f32)> = None;
            for task in TaskSet::first(self.tasks.len()).without(listed).iter() {
                let sure = self.probability(TaskSet::of(task));
                if sure > next.map_or(0.0, |(_, most)| most) {
                    next = Some((task, sure));
                }
            }
            let (Some((task, _)), Some(slot), Some(choice)) = (next, tasks.get_mut(position), choices.get_mut(position)) else { break };
            (*slot, *choice, listed) = (task as u8, TaskSet::of(task), listed.with(task));
            if position > 0 {
                self.propose_choice(best, Subject::WhichTask(tasks, (position + 1) as u8), choices);
            }
        }
    }
}
