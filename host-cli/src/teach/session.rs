//! The session under way: what was said, what was done, and what was said to that.

use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::HomeState;
use goodbot::planning::Judgement;
use goodbot::task::TaskSet;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{
    AnswerRecord, FeedbackWord, Kind, RecordedAnswer, RecordedSession, SessionHeader, StepRecord, StrategyRecord,
};
use goodbot_formats::task_text::GroundTaskText;
use std::collections::VecDeque;

/// A step that was judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The action's name.
    pub action: String,
    /// What the trainer said to it.
    pub feedback: Feedback,
    /// For each task, by position, whether the action was right.
    pub judgements: Vec<Judgement>,
}

/// An answer to a question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answered {
    /// How many judged steps stand before it.
    pub after: usize,
    /// The tasks that it is about.
    pub tasks: TaskSet,
    /// Whether what is meant is among them.
    pub yes: bool,
    /// The probability that an answer is wrong.
    pub eta: f32,
    /// How many other answers there were.
    pub others: u8,
}

/// What came of a word to a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judged {
    /// The belief has changed.
    Counted,
    /// The same had been said already.
    AsBefore,
    /// It is impossible whatever the task is, and was ignored.
    Impossible,
    /// It says nothing, because no task's plan is known exactly there.
    SaysNothing,
}

/// A session under way.
#[derive(Clone, Debug)]
pub struct Session {
    /// Its name in the log.
    pub id: Option<String>,
    /// What was said.
    pub command: String,
    /// The position of the task that the trainer means, where that is known.
    pub intended: Option<usize>,
    /// Where everything was when it was said.
    pub begun: HomeState,
    /// The steps that are still to be walked again.
    pub again: VecDeque<Step>,
    /// What was answered.
    pub answers: Vec<Answered>,
    /// How many of the answers the robot has taken in, since the session is walked.
    pub taken: usize,
    /// What was believed of the trainer when it began.
    pub strategies: Vec<(Strategy, f32)>,
    environment: EnvironmentFile,
    done: Vec<Step>,
}

impl Session {
    /// A session in which nothing was done yet.
    pub fn new(id: Option<String>, command: &str, environment: EnvironmentFile, intended: Option<usize>, begun: HomeState) -> Self {
        Self {
            id,
            command: command.to_owned(),
            intended,
            begun,
            again: VecDeque::new(),
            answers: Vec::new(),
            taken: 0,
            strategies: Vec::new(),
            environment,
            done: Vec::new(),
        }
    }

    /// The steps that were judged.
    pub fn done(&self) -> &[Step] {
        &self.done
    }

    /// All steps, those included that are still to be walked again.
    pub fn steps(&self) -> Vec<Step> {
        self.done.iter().chain(&self.again).cloned().collect()
    }

    /// Adds a step.
    pub fn judged(&mut self, step: Step) {
        self.done.push(step);
    }

    /// The last word to the last step counts.
    pub fn judged_anew(&mut self, feedback: Feedback) {
        if let Some(last) = self.done.last_mut() {
            last.feedback = feedback;
        }
    }

    /// Begins anew with these steps, which are to be walked again.
    pub fn walk_again(&mut self, steps: Vec<Step>) {
        self.done.clear();
        self.answers.retain(|answer| answer.after <= steps.len());
        self.taken = 0;
        self.again = steps.into();
    }

    /// The session as a log has it. `name` gives the name of a task by its position.
    pub fn record(
        &self,
        intended: Option<&GroundTaskText>,
        learn: bool,
        name: impl Fn(usize) -> Option<GroundTaskText>,
    ) -> RecordedSession {
        let answer = |given: &Answered| {
            let tasks = given.tasks.iter().filter_map(&name).collect();
            let answer = AnswerRecord { tasks, yes: given.yes, eta: given.eta.into(), others: given.others, said_ms: None };
            RecordedAnswer { line: 1, after: given.after, answer }
        };
        let strategy = |(number, (strategy, prior)): (usize, &(Strategy, f32))| StrategyRecord {
            name: format!("strategy {}", number + 1),
            mu_plus: strategy.mu_plus().into(),
            mu_minus: strategy.mu_minus().into(),
            epsilon: strategy.epsilon().into(),
            prior: (*prior).into(),
            lags: Some(strategy.lags().map(f64::from)).filter(|lags| *lags != Strategy::NO_LAG.map(f64::from)),
            rests: (!strategy.rests_as_it_moves()).then(|| strategy.rests().map(f64::from)),
        };
        let own = match self.strategies.as_slice() {
            [] => true,
            [(only, _)] => *only == Strategy::BALANCED,
            _ => false,
        };
        let step = |step: &Step| StepRecord::new(step.action.clone(), Some(word(step.feedback)));
        let mut header = SessionHeader {
            id: self.id.clone(),
            kind: Kind::Feedback,
            environment: self.environment.clone(),
            command: self.command.clone(),
            intended: None,
            before: None,
            through: None,
            avoiding: None,
            actions: None,
            continues: false,
            prior: None,
            strategies: (!own).then(|| self.strategies.iter().enumerate().map(strategy).collect()),
        };
        header.set_meant(intended);
        RecordedSession {
            header,
            header_line: 1,
            steps: self.steps().iter().map(step).zip(2..).map(|(step, line)| (line, step)).collect(),
            answers: self.answers.iter().map(answer).collect(),
            learn,
            end_line: self.done.len() + self.again.len() + 2,
        }
    }
}

const fn word(feedback: Feedback) -> FeedbackWord {
    match feedback {
        Feedback::Reward => FeedbackWord::Reward,
        Feedback::Punish => FeedbackWord::Punish,
        Feedback::Neutral => FeedbackWord::Neutral,
    }
}
