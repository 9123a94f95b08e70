//! The place of a lesson, a home or another world, its record in a log, and the log of a live session.

use crate::closed_words::CLOSED_WORDS;
use crate::home;
use crate::live::Lesson;
use crate::walk::{SessionAnswer, Step};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::Home;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, Either, PushGrid, action_name};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{
    AnswerRecord, FeedbackWord, Kind, RecordedAnswer, RecordedSession, SessionHeader, StepRecord, StrategyRecord,
};
use std::fmt;

/// The place of a lesson.
pub trait Place: Domain<State: fmt::Debug> + fmt::Debug {
    /// The place at the time of a command, as a log records it.
    type Record: Clone + fmt::Debug;

    /// A session as a log has it.
    type Recorded;

    /// The record of the place in a state.
    fn record(&self, state: &Self::State) -> Self::Record;

    /// A session that began in `record`. `session` has everything else; its environment is empty.
    fn recorded(&self, record: &Self::Record, session: RecordedSession) -> Self::Recorded;
}

/// The number of actions of a robot that only moves.
const MOVES: usize = 4;

/// The names of a home's actions, if a log must name them: if the robot does more than move.
pub(crate) fn named_actions<M: HomeMemory>(home: &Home<M>) -> Option<impl Iterator<Item = &str>> {
    let actions = home.actions();
    (actions.len() > MOVES).then(|| actions.iter().map(|kind| kind.name))
}

impl<M: HomeMemory + fmt::Debug> Place for Home<M> {
    type Record = EnvironmentFile;
    type Recorded = RecordedSession;

    fn record(&self, state: &Self::State) -> EnvironmentFile {
        home::environment(self, state)
    }

    fn recorded(&self, record: &EnvironmentFile, mut session: RecordedSession) -> RecordedSession {
        session.header.environment = record.clone();
        session.header.actions = named_actions(self).map(|names| names.map(str::to_owned).collect());
        session
    }
}

impl<H: Place + PushGrid, W: Place> Place for Either<H, W> {
    type Record = Either<H::Record, W::Record>;
    type Recorded = Either<H::Recorded, W::Recorded>;

    fn record(&self, state: &Self::State) -> Self::Record {
        match (self, state) {
            (Self::Floor(home), Either::Floor(state)) => Either::Floor(home.record(state)),
            (Self::Other(world), Either::Other(state)) => Either::Other(world.record(state)),
            _ => unreachable!("a lesson has one place, and its states"),
        }
    }

    fn recorded(&self, record: &Self::Record, session: RecordedSession) -> Self::Recorded {
        match (self, record) {
            (Self::Floor(home), Either::Floor(record)) => Either::Floor(home.recorded(record, session)),
            (Self::Other(world), Either::Other(record)) => Either::Other(world.recorded(record, session)),
            _ => unreachable!("a lesson has one place, and its records"),
        }
    }
}

impl<D: Place> Lesson<D> {
    /// The session under way as a log has it: utterance, steps, feedback and answers. `learn` says whether it is learned from. `None` if no
    /// session is under way.
    pub fn recorded(&self, learn: bool) -> Option<D::Recorded> {
        let (walk, session) = self.session()?;
        let home = self.home();
        let step = |step: &Step<D::State>| StepRecord::new(action_name(home, step.action).to_owned(), Some(word(step.feedback)));
        let answer = |given: &SessionAnswer| {
            let tasks = given.tasks.iter().filter_map(|task| self.name_of(task)).collect();
            let words = given.words.clone();
            let eta = given.eta.into();
            let answer = AnswerRecord { tasks, yes: given.yes, eta, others: given.others, words, said_ms: None };
            RecordedAnswer { line: 1, after: given.after, answer }
        };
        // "Again" has no words for its task.
        let learn = learn && !self.agent.sentence().is_empty();
        let steps = &walk.steps;
        let recorded = RecordedSession {
            header: SessionHeader {
                utterance: walk.listening.as_ref().map(|listening| listening.utterance.clone()),
                after: session.after.as_ref().and_then(|task| self.name_of_task(task)),
                conversation: walk.listening.as_ref().and_then(|listening| listening.conversation.recorded(home, self.agent.lifted())),
                closed_words: Some(walk.closed).filter(|closed| *closed != CLOSED_WORDS).map(|closed| closed.to_string()),
                strategies: session.named_strategies().map(|all| all.iter().enumerate().map(strategy).collect()),
                ..SessionHeader::new(Kind::Feedback, EnvironmentFile::new(vec![]), walk.command.clone())
            },
            header_line: 1,
            steps: steps.iter().map(step).zip(2..).map(|(step, line)| (line, step)).collect(),
            answers: walk.answers.iter().map(answer).collect(),
            learn,
            end_line: steps.len() + 2,
        };
        Some(home.recorded(&session.environment, recorded))
    }

    /// The record of the place as it is now.
    pub fn environment(&self) -> D::Record {
        self.home().record(self.state())
    }
}

fn strategy((number, (strategy, prior)): (usize, &(Strategy, f32))) -> StrategyRecord {
    StrategyRecord {
        name: format!("strategy {}", number + 1),
        mu_plus: strategy.mu_plus().into(),
        mu_minus: strategy.mu_minus().into(),
        epsilon: strategy.epsilon().into(),
        prior: (*prior).into(),
        lags: Some(strategy.lags().map(f64::from)).filter(|lags| *lags != Strategy::NO_LAG.map(f64::from)),
        rests: (!strategy.rests_as_it_moves()).then(|| strategy.rests().map(f64::from)),
    }
}

/// The word of a log for this feedback.
pub const fn word(feedback: Feedback) -> FeedbackWord {
    match feedback {
        Feedback::Reward => FeedbackWord::Reward,
        Feedback::Punish => FeedbackWord::Punish,
        Feedback::Neutral => FeedbackWord::Neutral,
    }
}
