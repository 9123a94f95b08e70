//! Possible questions, and the expected information of their answers.

use super::settings::{Asking, CHOICES};
use crate::feedback::BeliefRef;
use crate::feedback::information::{binary_entropy, surprise};
use crate::oomdp::{ClassId, ObjectId};
use crate::probability::{Scaled, total};
use crate::task::{GroundedTask, LiftedTask, TaskSet};
use heapless::Vec;

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

/// The next step of a search for the most informative question. None takes long, so that a control loop waits for one at most.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// Questions of yes and no about this task, and about what no earlier task has.
    Task(u8),
    /// A choice among objects of one class.
    Objects(OfObjects),
    /// A choice among tasks, which has these already.
    Tasks(Vec<u8, CHOICES, u8>),
    /// The best question is found.
    Best,
}

/// A choice among the most probable objects of a class, under way.
#[derive(Clone, Debug)]
pub(super) struct OfObjects {
    /// The variable that has the class, by its position among those of all kinds of tasks.
    variable: u8,
    /// The objects that it has already.
    listed: Vec<ObjectId, CHOICES, u8>,
    /// The next task to look at, and the most probable object of those before, with its probability.
    task: u8,
    next: Option<(ObjectId, f32)>,
}

impl OfObjects {
    const fn of(variable: u8) -> Self {
        Self { variable, listed: Vec::new(), task: 0, next: None }
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
    /// Does one step of the search for the most informative question that was not asked yet. Returns the next step, `None` after the last.
    pub(super) fn propose_on(self, best: &mut Option<Question>, step: Step) -> Option<Step> {
        match step {
            Step::Task(position) if usize::from(position) < self.tasks.len() => {
                self.propose_about(best, usize::from(position));
                Some(Step::Task(position.saturating_add(1)))
            }
            Step::Task(_) => Some(Step::Objects(OfObjects::of(0))),
            Step::Objects(choice) => match self.class(choice.variable) {
                Some(class) => Some(Step::Objects(self.choose_on(best, class, choice))),
                None => Some(Step::Tasks(Vec::new())),
            },
            Step::Tasks(listed) => Some(self.choose_task(best, listed)),
            Step::Best => None,
        }
    }

    /// Proposes questions of yes and no about a task, its kind and its objects. Repeating a question is uninformative.
    fn propose_about(self, best: &mut Option<Question>, position: usize) {
        let Some(task) = self.tasks.get(position) else { return };
        let before = self.tasks.get(..position).unwrap_or_default();
        if before.iter().all(|other| other.lifted != task.lifted) {
            self.propose(best, Subject::Kind(task.lifted), self.with(|other| other.lifted == task.lifted));
        }
        for (object, _) in self.bound_first(position) {
            self.propose(best, Subject::Object(object), self.binding(object));
        }
        self.propose(best, Subject::Task(position as u8), TaskSet::of(position));
    }

    /// The class of a variable, by its position among those of all kinds of tasks.
    fn class(self, variable: u8) -> Option<ClassId> {
        self.lifted.iter().flat_map(|lifted| lifted.variables().iter().copied()).nth(usize::from(variable))
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

    /// Does one step of proposing a choice among the most probable objects of a class: looks at one task, or takes the object that is found.
    fn choose_on(self, best: &mut Option<Question>, class: ClassId, mut choice: OfObjects) -> OfObjects {
        let following = OfObjects::of(choice.variable.saturating_add(1));
        let is_done = choice.variable.checked_sub(1).is_some_and(|before| self.class(before) == Some(class));
        if is_done || choice.listed.len() >= usize::from(self.asking.choices).min(CHOICES) {
            return following;
        }
        let mut choices = [TaskSet::EMPTY; CHOICES];
        choices.iter_mut().zip(&choice.listed).for_each(|(set, &object)| *set = self.binding(object));
        if usize::from(choice.task) < self.tasks.len() {
            let listed = choices.into_iter().fold(TaskSet::EMPTY, TaskSet::union);
            for (object, _) in self.bound_first(usize::from(choice.task)).filter(|&(_, bound)| bound == class) {
                let set = self.binding(object);
                // A task with two of the objects would be in two choices.
                let sure = if set.common(listed).is_empty() { self.probability(set) } else { 0.0 };
                if sure > choice.next.map_or(0.0, |(_, most)| most) {
                    choice.next = Some((object, sure));
                }
            }
            choice.task = choice.task.saturating_add(1);
            return choice;
        }
        let Some((object, _)) = choice.next.take() else { return following };
        choice.task = 0;
        if let Some(set) = choices.get_mut(choice.listed.len()) {
            *set = self.binding(object);
        }
        let _ = choice.listed.push(object);
        if choice.listed.len() > 1 {
            let mut objects = [ObjectId(0); CHOICES];
            objects.iter_mut().zip(&choice.listed).for_each(|(slot, &object)| *slot = object);
            self.propose_choice(best, Subject::WhichObject(objects, choice.listed.len() as u8), choices);
        }
        choice
    }

    /// Adds the most probable of the other tasks to a choice, and proposes it.
    fn choose_task(self, best: &mut Option<Question>, mut listed: Vec<u8, CHOICES, u8>) -> Step {
        let (mut next, mut most) = (None, 0.0);
        for task in 0..self.tasks.len() as u8 {
            let sure = if listed.contains(&task) { 0.0 } else { self.probability(TaskSet::of(usize::from(task))) };
            if sure > most {
                (next, most) = (Some(task), sure);
            }
        }
        let has_room = listed.len() < usize::from(self.asking.choices).min(CHOICES);
        let Some(task) = next.filter(|_| has_room) else { return Step::Best };
        let _ = listed.push(task);
        if listed.len() > 1 {
            let (mut tasks, mut choices) = ([0; CHOICES], [TaskSet::EMPTY; CHOICES]);
            for ((slot, choice), &task) in tasks.iter_mut().zip(&mut choices).zip(&listed) {
                (*slot, *choice) = (task, TaskSet::of(usize::from(task)));
            }
            self.propose_choice(best, Subject::WhichTask(tasks, listed.len() as u8), choices);
        }
        Step::Tasks(listed)
    }
}
