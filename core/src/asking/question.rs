//! What can be asked, and what an answer is expected to tell.

use super::settings::Asking;
use crate::feedback::BeliefRef;
use crate::feedback::information::{binary_entropy, surprise};
use crate::oomdp::ObjectId;
use crate::task::{GroundedTask, TaskSet};

/// The most meanings that a question shows to choose from.
pub const CHOICES: usize = 3;

/// What a question is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// "Do you mean this room?", "this block?": an object.
    Object(ObjectId),
    /// "Shall I move or carry?": a kind of task, by the lifted task's position.
    Kind(u8),
    /// "Do you mean this?": a single task, by its position.
    Task(u8),
    /// "Which of these, or none?": so many single tasks, by position.
    Which([u8; CHOICES], u8),
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// What it is about.
    pub subject: Subject,
    /// The tasks for which the answer is yes; those that can be chosen where it asks which.
    pub yes: TaskSet,
    /// What an answer is expected to tell, in bits.
    pub information: f32,
    /// The probability that an answer is wrong.
    pub eta: f32,
}

/// What the trainer answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Yes.
    Yes,
    /// No; where the question was which, none of these.
    No,
    /// This one, by its position among those to choose from.
    This(u8),
}

impl Question {
    /// What the answer says: the tasks that it is about, whether it speaks for them, and how many other answers there were. Nothing where
    /// it is no answer to this question.
    pub fn meaning(&self, answer: Answer) -> Option<(TaskSet, bool, u8)> {
        match (self.subject, answer) {
            (Subject::Which(_, count), Answer::No) => Some((self.yes, false, count)),
            (Subject::Which(tasks, count), Answer::This(chosen)) if chosen < count => {
                Some((TaskSet::of(usize::from(*tasks.get(usize::from(chosen))?)), true, count))
            }
            (Subject::Which(..), _) | (_, Answer::This(_)) => None,
            (_, answer) => Some((self.yes, answer == Answer::Yes, 1)),
        }
    }
}

/// The question that tells most, of those that were not asked yet.
pub(super) fn best(
    belief: BeliefRef<'_>,
    tasks: &[GroundedTask],
    variables: impl Fn(u8) -> usize,
    asked: &[TaskSet],
    asking: &Asking,
) -> Option<Question> {
    let all = TaskSet::first(tasks.len());
    let whole = belief.whole();
    let probability = |task: usize| belief.weight(task).over(whole);
    let new = |yes: TaskSet| !yes.is_empty() && yes != all && asked.iter().all(|&known| known != yes && known != all.without(yes));
    let mut best: Option<Question> = None;
    let mut propose = |subject: Subject, yes: TaskSet, information: f32| {
        if information > best.map_or(0.0, |best| best.information) && new(yes) {
            best = Some(Question { subject, yes, information, eta: asking.eta });
        }
    };
    let told = |yes: TaskSet| {
        let sure = yes.iter().fold(0.0, |sum, task| sum + probability(task));
        binary_entropy(sure * (1.0 - asking.eta) + (1.0 - sure) * asking.eta) - binary_entropy(asking.eta)
    };
    for (position, task) in tasks.iter().enumerate() {
        let of = |same: &dyn Fn(&GroundedTask) -> bool| {
            tasks.iter().enumerate().filter(|(_, other)| same(other)).fold(TaskSet::EMPTY, |set, (at, _)| set.with(at))
        };
        let kind = of(&|other| other.lifted == task.lifted);
        propose(Subject::Kind(task.lifted), kind, told(kind));
        for &object in task.bindings.iter().take(variables(task.lifted)) {
            let set = of(&|other| other.bindings.iter().take(variables(other.lifted)).any(|&bound| bound == object));
            propose(Subject::Object(object), set, told(set));
        }
        propose(Subject::Task(position as u8), TaskSet::of(position), told(TaskSet::of(position)));
    }
    let (mut chosen, mut listed) = ([0; CHOICES], TaskSet::EMPTY);
    for position in 0..usize::from(asking.choices).min(CHOICES) {
        let likeliest = all.without(listed).iter().fold(None, |best: Option<usize>, task| match best {
            Some(best) if probability(task) <= probability(best) => Some(best),
            _ => Some(task),
        });
        let (Some(task), Some(slot)) = (likeliest, chosen.get_mut(position)) else { break };
        *slot = task as u8;
        listed = listed.with(task);
        if position > 0 {
            let others = position.saturating_add(1) as f32;
            // Each wrong answer is as probable as any other.
            let said = |sure: f32| surprise(sure * (1.0 - asking.eta) + (1.0 - sure) * (asking.eta / others));
            let none = all.without(listed).iter().fold(0.0, |sum, task| sum + probability(task));
            let answers = listed.iter().fold(said(none), |sum, task| sum + said(probability(task)));
            let information = answers - binary_entropy(asking.eta) - asking.eta * libm::log2f(others);
            propose(Subject::Which(chosen, position.saturating_add(1) as u8), listed, information);
        }
    }
    best
}
