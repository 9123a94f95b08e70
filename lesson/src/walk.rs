//! The course of a session: a command in a home or another world, steps with their feedback, and answers.

use crate::closed_words::CLOSED_WORDS;
use crate::listening::Conversing;
use goodbot::feedback::{Feedback, Strategy, StrategyError};
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, Domain, action_named, apply};
use goodbot::task::{GroundedTask, TaskSet};
use goodbot_formats::session::{Kind, StrategyRecord};

/// One step of a session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<S = HomeState> {
    /// Its line in the log.
    pub line: usize,
    /// The state before it.
    pub before: S,
    /// The action.
    pub action: Action,
    /// The feedback; silence in a demonstration.
    pub feedback: Feedback,
    /// Whether it is an action that changed nothing, other than the rest.
    pub bump: bool,
}

impl<S: Copy + PartialEq> Step<S> {
    /// A step from a state, and the state after it; `None` if there is no such action, or it is impossible in that state.
    pub fn from<D: Domain<State = S>>(domain: &D, before: S, action: &str, feedback: Feedback, line: usize) -> Option<(Self, S)> {
        let action = action_named(domain, action)?;
        let next = apply(domain, &before, action)?;
        Some((Self { line, feedback, ..Self::new(before, action, next) }, next))
    }

    /// A live step without feedback.
    pub fn new(before: S, action: Action, after: S) -> Self {
        Self { line: 0, before, action, feedback: Feedback::Neutral, bump: action != Action::NOOP && after == before }
    }

    /// The state after it.
    pub fn after<D: Domain<State = S>>(&self, domain: &D) -> S {
        apply(domain, &self.before, self.action).unwrap_or(self.before)
    }
}

/// An answer in a session.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionAnswer {
    /// Its line in the log.
    pub line: usize,
    /// How many steps come before it.
    pub after: usize,
    /// The tasks of the question.
    pub tasks: TaskSet,
    /// Whether the intended task is among them.
    pub yes: bool,
    /// The probability that it is wrong.
    pub eta: f32,
    /// How many other answers were possible.
    pub others: u8,
    /// The words of a correction: evidence beside the answer.
    pub words: Option<String>,
}

impl SessionAnswer {
    /// A "yes" to no tasks, wrong with the probability `eta`, for the caller to fill in.
    pub const fn of(eta: f32) -> Self {
        Self { line: 0, after: 0, tasks: TaskSet::EMPTY, yes: true, eta, others: 1, words: None }
    }
}

/// The utterance that began a session.
#[derive(Clone, Debug, PartialEq)]
pub struct Listening {
    /// The utterance, from the session's command on.
    pub utterance: String,
    /// The kind of the task before, by its position, if the utterance has earlier commands.
    pub after: Option<u8>,
    /// The conversation before the utterance.
    pub conversation: Conversing,
}

/// A trainer strategy that a session names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The strategy.
    pub strategy: Strategy,
    /// Its probability as a share of the most probable strategy's: single precision then never makes all of them 0.
    pub share: f32,
    /// Its recorded probability.
    pub recorded: f32,
}

impl Expected {
    /// A recorded strategy; `most` is the probability of the most probable one.
    ///
    /// # Errors
    /// A [`StrategyError`] for a number out of range.
    pub fn new(record: &StrategyRecord, most: f64) -> Result<Self, StrategyError> {
        let strategy = Strategy::new(record.mu_plus as f32, record.mu_minus as f32, record.epsilon as f32)?;
        let strategy = strategy.with_lags(record.lags.map_or(Strategy::NO_LAG, |lags| lags.map(|lag| lag as f32)))?;
        let strategy = match record.rests {
            Some(rests) => strategy.with_rests(rests.map(|number| number as f32))?,
            None => strategy,
        };
        Ok(Self { strategy, share: (record.prior / most) as f32, recorded: record.prior as f32 })
    }
}

/// A session from its command to its end.
#[derive(Debug)]
pub struct Walk<D: Domain> {
    /// The command.
    pub command: String,
    /// The utterance that the command is part of, if the robot listened.
    pub listening: Option<Listening>,
    /// The closed words.
    pub closed: goodbot::talk::ClosedWords<'static>,
    /// The kind of session: feedback, demonstration or label.
    pub kind: Kind,
    /// Whether it repeats the command before, and keeps its belief.
    pub continues: bool,
    /// The line of its header.
    pub header_line: usize,
    /// The line of its end.
    pub end_line: usize,
    /// The home, or the robot of another world.
    pub home: D,
    /// The state at the beginning.
    pub start: D::State,
    /// The recorded prior of the tasks that it names; others have 0.
    pub prior: Option<Vec<(GroundedTask, f32)>>,
    /// The recorded strategies.
    pub strategies: Option<Vec<Expected>>,
    /// The steps.
    pub steps: Vec<Step<D::State>>,
    /// The answers, in the order of the steps that they follow.
    pub answers: Vec<SessionAnswer>,
}

impl<D: Domain> Walk<D> {
    /// A session at its very beginning, without a command.
    pub const fn new(home: D, start: D::State, kind: Kind) -> Self {
        Self {
            command: String::new(),
            listening: None,
            closed: CLOSED_WORDS,
            kind,
            continues: false,
            header_line: 0,
            end_line: 0,
            home,
            start,
            prior: None,
            strategies: None,
            steps: Vec::new(),
            answers: Vec::new(),
        }
    }

    /// The state at the end.
    pub fn end(&self) -> D::State {
        self.steps.last().map_or(self.start, |last| last.after(&self.home))
    }
}
