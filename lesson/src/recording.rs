//! The log of a live session.

use crate::closed_words::CLOSED_WORDS;
use crate::live::Lesson;
use crate::place::Place;
use crate::walk::{SessionAnswer, Step};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::oomdp::action_name;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{
    AnswerRecord, FeedbackWord, Kind, RecordedAnswer, RecordedSession, SessionHeader, StepRecord, StrategyRecord,
};

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
