//! How an agent asks, and takes the answer.

use super::looking_ahead::LookingAhead;
use super::question::{Answer, Candidates, Question};
use super::settings::Asking;
use crate::capacity::QUESTIONS_PER_SESSION;
use crate::feedback::{Words, binary_entropy};
use crate::memory::AgentMemory;
use crate::oomdp::{ActionSet, Domain, StateKey, apply};
use crate::planning::Progress;
use crate::session::{Agent, AgentError, Evidence};
use crate::task::TaskSet;
use heapless::Vec;

/// The questions of the session under way.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    /// The task sets of the questions asked.
    sets: Vec<TaskSet, QUESTIONS_PER_SESSION>,
    /// The question that waits for its answer.
    open: Option<Question>,
    looking: Option<LookingAhead>,
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

    /// As [`question`](Self::question), but in parts: each call looks ahead with at most about `budget` node expansions. Call until it is
    /// no longer [`Considered::Working`]; until then the state has no plan.
    ///
    /// # Errors
    /// As [`decide`](Self::decide), and [`AgentError::Setting`] if the settings are out of range.
    pub fn consider<D: Domain>(&mut self, domain: &D, state: &D::State, asking: &Asking, budget: u32) -> Result<Considered, AgentError> {
        asking.check()?;
        self.check_session(domain)?;
        let key = domain.key(state);
        let looking = match self.asked.looking.take().filter(|looking| looking.start == key) {
            Some(looking) => looking,
            None => {
                self.check_planned(domain, state)?;
                match self.begin_looking(key, asking) {
                    Some(looking) => looking,
                    None => return Ok(Considered::Act),
                }
            }
        };
        self.look_on(domain, looking, budget)
    }

    /// The question that would be asked in a state, and a look ahead from there.
    fn begin_looking(&self, key: StateKey, asking: &Asking) -> Option<LookingAhead> {
        let followed = self.most_likely()?;
        if self.asked.sets.is_full() || !asking.kappa.is_finite() || self.belief().probability(followed) >= asking.sure {
            return None;
        }
        let (belief, tasks, lifted, asked) = (self.belief(), self.tasks(), self.lifted(), self.asked.sets.as_slice());
        let candidates = Candidates { belief, whole: belief.whole(), tasks, lifted, asked, asking };
        let question = candidates.best()?;
        // The number of further questions like this one until it is sure.
        let wanted = candidates.uncertainty() - binary_entropy(asking.sure);
        if wanted * asking.kappa > asking.patience * question.information {
            return None;
        }
        Some(LookingAhead {
            question,
            worth: question.information / asking.kappa,
            start: key,
            at: key,
            followed,
            dead: self.dead,
            steps: 0,
            told: 0.0,
            asks: None,
        })
    }

    /// Continues the look ahead, then restores the plan of the state where it began.
    fn look_on<D: Domain>(&mut self, domain: &D, mut looking: LookingAhead, budget: u32) -> Result<Considered, AgentError> {
        let words = Words::expected(self.belief());
        loop {
            // Dead ends stay dead during the look ahead; afterwards they are no longer certain.
            let state = domain.keyed(looking.at);
            if self.planned != Some(looking.at) {
                self.expected = Some(looking.at);
            }
            if self.plan(domain, &state, budget)? == Progress::Working {
                self.asked.looking = Some(looking);
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
