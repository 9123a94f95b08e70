//! What happens in a session: a command in a home or another world, steps, what was said to them, and answers.

use crate::conversing::Conversing;
use goodbot::feedback::{Feedback, Strategy, StrategyError};
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, Domain, action_named, apply};
use goodbot::task::{GroundedTask, TaskSet};
use goodbot_formats::session::{Kind, StrategyRecord};

/// One step of a session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<S = HomeState> {
    /// Its line.
    pub line: usize,
    /// Where everything was before it.
    pub before: S,
    /// What was done.
    pub action: Action,
    /// What the trainer said; silence in a demonstration.
    pub feedback: Feedback,
    /// Whether it was a move that moved nothing.
    pub bump: bool,
}

impl<S: Copy + PartialEq> Step<S> {
    /// A step from a state, with where everything is after it; `None` where there is no such action, or it cannot be done there.
    pub fn from<D: Domain<State = S>>(domain: &D, before: S, action: &str, feedback: Feedback, line: usize) -> Option<(Self, S)> {
        let action = action_named(domain, action)?;
        let next = apply(domain, &before, action)?;
        Some((Self { line, feedback, ..Self::new(before, action, next) }, next))
    }

    /// A live step, to which nothing was said yet.
    pub fn new(before: S, action: Action, after: S) -> Self {
        Self { line: 0, before, action, feedback: Feedback::Neutral, bump: action != Action::NOOP && after == before }
    }

    /// Where everything is after it.
    pub fn after<D: Domain<State = S>>(&self, domain: &D) -> S {
        apply(domain, &self.before, self.action).unwrap_or(self.before)
    }
}

/// An answer of a session.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionAnswer {
    /// Its line.
    pub line: usize,
    /// How many steps come before it.
    pub after: usize,
    /// The tasks that it is about.
    pub tasks: TaskSet,
    /// Whether what is meant is among them.
    pub yes: bool,
    /// The probability that it is wrong.
    pub eta: f32,
    /// How many other answers there were.
    pub others: u8,
    /// What was said, where it was a correction: evidence beside the answer.
    pub words: Option<String>,
}

impl SessionAnswer {
    /// An answer of yes to nothing yet, which is wrong with this probability.
    pub const fn of(eta: f32) -> Self {
        Self { line: 0, after: 0, tasks: TaskSet::EMPTY, yes: true, eta, others: 1, words: None }
    }
}

/// How a session began where the robot listened.
#[derive(Clone, Debug, PartialEq)]
pub struct Listening {
    /// What was said, from the session's command on.
    pub utterance: String,
    /// Where other commands were before this one: the lifted task of the last of them, by its position.
    pub after: Option<u8>,
    /// What was said and done before.
    pub conversation: Conversing,
}

/// A trainer strategy that a session names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The strategy.
    pub strategy: Strategy,
    /// How probable it is, as a share of the most probable one: single precision then never makes all of them 0.
    pub share: f32,
    /// How probable it is, as it is recorded.
    pub recorded: f32,
}

impl Expected {
    /// A recorded strategy; `most` is how probable the most probable one is.
    ///
    /// # Errors
    /// What is no probability.
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
    /// What was said.
    pub command: String,
    /// Where the robot listened: the utterance that the command is of.
    pub listening: Option<Listening>,
    /// The words that speak about commands.
    pub closed: goodbot::talk::ClosedWords<'static>,
    /// How it teaches.
    pub kind: Kind,
    /// Whether it is the command before, once more.
    pub continues: bool,
    /// The line of its header.
    pub header_line: usize,
    /// The line of its end.
    pub end_line: usize,
    /// The home, or the robot of another world.
    pub home: D,
    /// Where everything is at the beginning.
    pub start: D::State,
    /// The recorded prior of the tasks that it names; it is 0 for others.
    pub prior: Option<Vec<(GroundedTask, f32)>>,
    /// The recorded strategies.
    pub strategies: Option<Vec<Expected>>,
    /// The steps.
    pub steps: Vec<Step<D::State>>,
    /// The answers, in the order of the steps that they follow.
    pub answers: Vec<SessionAnswer>,
}

impl<D: Domain> Walk<D> {
    /// A session in which nothing has happened yet, not even a command.
    pub const fn new(home: D, start: D::State, kind: Kind) -> Self {
        Self {
            command: String::new(),
            listening: None,
            closed: crate::listening::CLOSED_WORDS,
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

    /// Where everything is at the end.
    pub fn end(&self) -> D::State {
        self.steps.last().map_or(self.start, |last| last.after(&self.home))
    }
}
