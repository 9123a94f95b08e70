//! How an agent asks, and takes the answer.

use super::looking_ahead::{Looking, LookingAhead};
use super::question::{Answer, Candidates, Question, Step};
use super::settings::Asking;
use crate::capacity::QUESTIONS_PER_SESSION;
use crate::feedback::{Words, binary_entropy};
use crate::memory::AgentMemory;
use crate::oomdp::{ActionSet, Domain, StateKey, apply};
use crate::planning::Progress;
use crate::session::{Agent, AgentError, Evidence};
use crate::task::TaskSet;
use heapless::Vec;

/// A step takes about as long as so many node expansions.
const OF_A_STEP: u32 = 8;

/// The questions of the session under way.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    /// The task sets of the questions asked.
    sets: Vec<TaskSet, QUESTIONS_PER_SESSION>,
    /// The question that waits for its answer.
    open: Option<Question>,
    looking: Option<Looking>,
}

impl Asked {
    /// No question yet.
    pub(crate) const NOTHING: Self = Self { sets: Vec::new(), open: None, looking: None };

    /// Drops the open question and the look ahead.
    pub(crate) fn close(&mut self) {
        (self.open, self.looking) = (None, None);
    }
}

/// The result of considering a question, in parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Considered {
    /// Not decided yet: call again.
    Working,
    /// Acting is as informative, or the robot is sure, or all questions were asked.
    Act,
    /// Ask this.
    Ask(Question),
}

impl<M: AgentMemory> Agent<M> {
    /// Returns the question to ask, or `None`, in a state that must have been planned; the plan is unchanged afterwards. The question
    /// counts as asked: it is not returned again in this session. A session has at most [`QUESTIONS_PER_SESSION`].
    ///
    /// # Errors
    /// As [`consider`](Self::consider).
    pub fn question<D: Domain>(&mut self, domain: &D, state: &D::State, asking: &Asking) -> Result<Option<Question>, AgentError> {
        loop {
            match self.consider(domain, state, asking, u32::MAX)? {
                Considered::Working => {}
                Considered::Act => return Ok(None),
                Considered::Ask(question) => return Ok(Some(question)),
            }
        }
    }

    /// As [`question`](Self::question), but in parts: each call looks for the best question, and then ahead, with at most about `budget` node
    /// expansions. Call until it is no longer [`Considered::Working`]; until then the state has no plan.
    ///
    /// # Errors
    /// As [`decide`](Self::decide), and [`AgentError::Setting`] if the settings are out of range.
    pub fn consider<D: Domain>(&mut self, domain: &D, state: &D::State, asking: &Asking, budget: u32) -> Result<Considered, AgentError> {
        asking.check()?;
        self.check_session(domain)?;
        let (key, mut left) = (domain.key(state), budget.max(1));
        let mut looking = match self.asked.looking.take().filter(|looking| looking.start() == key) {
            Some(looking) => looking,
            None => {
                self.check_planned(domain, state)?;
                if !self.may_ask(asking) {
                    return Ok(Considered::Act);
                }
                Looking::Proposing(key, None, Step::Task(0))
            }
        };
        while let Looking::Proposing(_, best, step) = looking {
            if left == 0 {
                self.asked.looking = Some(Looking::Proposing(key, best, step));
                return Ok(Considered::Working);
            }
            left = left.saturating_sub(OF_A_STEP);
            looking = match self.propose_on(key, asking, best, step) {
                Some(looking) => looking,
                None => return Ok(Considered::Act),
            };
        }
        match looking {
            Looking::Ahead(ahead) => self.look_on(domain, ahead, left),
            Looking::Proposing(..) => Ok(Considered::Working),
        }
    }

    /// Whether a question is worth looking for.
    fn may_ask(&self, asking: &Asking) -> bool {
        let is_unsure = |followed| self.belief().probability(followed) < asking.sure;
        !self.asked.sets.is_full() && asking.kappa.is_finite() && self.most_likely().is_some_and(is_unsure)
    }

    /// Does a step of looking for the best question. After the last it returns a look ahead from this state, if the question is worth one.
    #[inline(never)]
    fn propose_on(&self, start: StateKey, asking: &Asking, mut best: Option<Question>, step: Step) -> Option<Looking> {
        let (belief, tasks, lifted, asked) = (self.belief(), self.tasks(), self.lifted(), self.asked.sets.as_slice());
        let candidates = Candidates { belief, whole: belief.whole(), tasks, lifted, asked, asking };
        if let Some(next) = candidates.propose_on(&mut best, step) {
            return Some(Looking::Proposing(start, best, next));
        }
        let question = best?;
        // The number of further questions like this one until it is sure.
        let wanted = candidates.uncertainty() - binary_entropy(asking.sure);
        if wanted * asking.kappa > asking.patience * question.information {
            return None;
        }
        let (worth, followed) = (question.information / asking.kappa, self.most_likely()?);
        let ahead = LookingAhead { question, worth, start, at: start, followed, dead: self.dead, steps: 0, told: 0.0, asks: None };
        Some(Looking::Ahead(ahead))
    }

    /// Continues the look ahead, then restores the plan of the state where it began.
    fn look_on<D: Domain>(&mut self, domain: &D, mut looking: LookingAhead, mut left: u32) -> Result<Considered, AgentError> {
        let words = Words::expected(self.belief());
        loop {
            // Dead ends stay dead during the look ahead; afterwards they are no longer certain.
            let state = domain.keyed(looking.at);
            if self.planned != Some(looking.at) {
                self.expected = Some(looking.at);
            }
            let was_planned = self.check_planned(domain, &state).is_ok();
            let is_working = left == 0 || self.plan(domain, &state, left)? == Progress::Working;
            // What follows a plan takes as long as a part of one.
            left = if was_planned { left } else { left.saturating_sub(OF_A_STEP) };
            if is_working || left == 0 {
                self.asked.looking = Some(Looking::Ahead(looking));
                return Ok(Considered::Working);
            }
            if let Some(asks) = looking.asks {
                return Ok(self.asks(&looking, asks));
            }
            let action = self.onward(looking.followed, Some(&words).filter(|_| self.options.telling), &mut |_| 0);
            let right = self.right(ActionSet::of(action)).next().unwrap_or(0.0);
            looking.add(words.information(right));
            let next = apply(domain, &state, action).map_or(looking.at, |next| domain.key(&next));
            if looking.asks.is_some() {
                if looking.at != looking.start {
                    self.dead = looking.dead;
                }
                looking.at = looking.start;
            } else {
                looking.at = next;
            }
            left = left.saturating_sub(OF_A_STEP);
        }
    }

    fn asks(&mut self, looking: &LookingAhead, asks: bool) -> Considered {
        if !asks || self.asked.sets.push(looking.question.yes).is_err() {
            return Considered::Act;
        }
        self.asked.open = Some(looking.question);
        Considered::Ask(looking.question)
    }

    /// Withdraws the last question: it waits for no answer, and is not asked again in this session.
    pub const fn withdraw_question(&mut self) {
        self.asked.open = None;
    }

    /// The question that waits for its answer.
    pub fn open_question(&self) -> Option<&Question> {
        self.asked.open.as_ref()
    }

    /// Updates the belief by the trainer's answer to the last question. It may also stay unanswered.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::NotAsked`] if no question waits for its answer, and [`AgentError::NoAnswer`] if it is no
    /// answer to this question, which then stays open.
    pub fn answer(&mut self, answer: Answer) -> Result<Evidence, AgentError> {
        self.check_under_way()?;
        let question = self.asked.open.ok_or(AgentError::NotAsked)?;
        let (tasks, yes, others) = question.meaning(answer).ok_or(AgentError::NoAnswer)?;
        self.asked.open = None;
        self.answered(tasks, yes, question.eta, others)
    }

    /// Updates the belief by an answer given in full, such as a recorded one: whether the intended task is among `tasks`, the probability
    /// `eta` of a wrong answer, and the number of other answers, which are equally probable (1 for yes and no).
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::NoAnswer`] if there is no such task or no other answer, and [`AgentError::Setting`] if `eta`
    /// is out of range.
    pub fn answered(&mut self, tasks: TaskSet, yes: bool, eta: f32, others: u8) -> Result<Evidence, AgentError> {
        self.check_under_way()?;
        Asking { eta, ..Asking::DEFAULT }.check()?;
        if others == 0 || tasks.is_empty() || !tasks.without(TaskSet::first(self.tasks().len())).is_empty() {
            return Err(AgentError::NoAnswer);
        }
        let wrong = eta / f32::from(others);
        let possible = self.belief_mut().observe_unrelated(|task| if tasks.contains(task) == yes { 1.0 - eta } else { wrong });
        Ok(if possible { Evidence::Used } else { Evidence::Impossible })
    }
}
