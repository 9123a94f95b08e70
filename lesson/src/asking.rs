//! When the robot asks in a live session: seldom, and nothing twice.
//!
//! Beyond [`goodbot::asking`], these rules hold:
//! - The robot asks nothing if a task has a belief of 0.5.
//! - It asks and offers nothing twice in a session, even after a step back.
//! - It asks half as readily after each session with expected answers only, down to an eighth, until an answer surprises it.
//! - It asks nothing while a question waits for its answer.
//! - If it listened, and two tasks that differ in one object fit nearly as well, it asks at once which is meant: two chairs, for example.

use crate::live::{Lesson, LiveError};
use crate::place::Place;
use goodbot::asking::{Answer, Asking, Question};
use goodbot::task::TaskSet;

/// The robot asks nothing if a task has this belief. Chosen with four robots of twenty lessons: 0.8 brings a question before a third of the
/// commands, and understands 2 in 100 more.
const SURE: f32 = 0.5;
/// Each session with expected answers makes the robot ask less, up to this many sessions.
const MOST_TRUST: u8 = 3;
/// An answer is a surprise if its probability is below this share of a uniform guess.
const LEAST_EXPECTED: f32 = 0.9;
/// The cost of a question between two tied tasks, in steps.
const COST_OF_A_TIE: f32 = 0.5;
/// Two tasks tie if the less probable one has this share of the other's belief, and both together have this belief.
const TIE: f32 = 0.6;

/// The questions of a session, and whether the answers were as expected.
#[derive(Clone, Debug, Default)]
pub(crate) struct Asked {
    /// The tasks of each question and of each of its choices.
    sets: Vec<TaskSet>,
    answered: bool,
    surprised: bool,
}

impl Asked {
    /// No question was asked.
    pub const NOTHING: Self = Self { sets: Vec::new(), answered: false, surprised: false };

    /// Records an answer with its probability, and how many other answers there were. It is a surprise if it is less probable than a
    /// uniform guess would make it.
    pub fn hear(&mut self, probability: f32, others: u8) {
        self.answered = true;
        self.surprised |= probability * (f32::from(others) + 1.0) < LEAST_EXPECTED;
    }

    /// How many sessions in a row had expected answers, after this one; at most [`MOST_TRUST`].
    pub fn trust(&self, before: u8) -> u8 {
        match (self.answered, self.surprised) {
            (false, _) => before,
            (true, false) => before.saturating_add(1).min(MOST_TRUST),
            (true, true) => 0,
        }
    }

    fn has(&self, question: &Question) -> bool {
        sets(question).any(|set| self.sets.contains(&set))
    }
}

/// The tasks of a question, and those of each of its choices.
fn sets(question: &Question) -> impl Iterator<Item = TaskSet> {
    let count = usize::from(question.subject.choices());
    std::iter::once(question.yes).chain(question.choices.into_iter().take(count)).filter(|set| !set.is_empty())
}

impl<D: Place> Lesson<D> {
    /// The question to ask here, if it teaches the robot more than its next steps do. The plan must be done.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::question`](goodbot::Agent::question).
    pub fn ask(&mut self, asking: &Asking) -> Result<Option<Question>, LiveError> {
        // A trainer who does not answer gets no second question.
        if self.agent.open_question().is_some() {
            return Ok(None);
        }
        let mut asking =
            Asking { sure: asking.sure.min(SURE), kappa: asking.kappa * f32::from(1_u8 << self.trust.min(MOST_TRUST)), ..*asking };
        if asking.kappa.is_finite() && self.has_tie() {
            asking.kappa = asking.kappa.min(COST_OF_A_TIE);
        }
        loop {
            let (agent, home, state) = self.parts();
            let question = agent.question(home, state, &asking)?;
            let asked = self.asked_mut()?;
            match question {
                None => return Ok(None),
                // The agent proposes nothing twice, so this ends.
                Some(question) if asked.has(&question) => self.agent.withdraw_question(),
                Some(question) => {
                    asked.sets.extend(sets(&question));
                    return Ok(Some(question));
                }
            }
        }
    }

    /// Records the probability of an answer before it changes the belief.
    pub(crate) fn expect_answer(&mut self, answer: Answer) {
        let Some((tasks, yes, others)) = self.agent.open_question().and_then(|question| question.meaning(answer)) else { return };
        let among: f32 = tasks.iter().map(|task| self.agent.belief().probability(task)).sum();
        if let Ok(asked) = self.asked_mut() {
            asked.hear(if yes { among } else { 1.0 - among }, others);
        }
    }

    /// Ends a session: whether its answers were expected counts for the next one.
    pub(crate) fn end_asking(&mut self) {
        let trust = self.trust;
        self.trust = self.asked_mut().map_or(trust, |asked| asked.trust(trust));
    }

    /// Whether two tasks that differ in one object fit the command nearly as well.
    fn has_tie(&self) -> bool {
        if self.session().is_none_or(|(walk, _)| walk.listening.is_none()) {
            return false;
        }
        let mut likeliest: Vec<(usize, f32)> =
            (0..self.agent.tasks().len()).map(|task| (task, self.agent.belief().probability(task))).collect();
        likeliest.sort_by(|a, b| b.1.total_cmp(&a.1));
        let [(first, most), (second, next), ..] = likeliest[..] else { return false };
        let [first, second] = [first, second].map(|task| self.agent.tasks()[task]);
        let different = first.bindings.iter().zip(&second.bindings).filter(|(a, b)| a != b).count();
        first.lifted == second.lifted && different == 1 && next >= TIE * most && most + next >= TIE
    }
}
