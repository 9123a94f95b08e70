//! The session under way: what was said, what was done, and what was said to that.

use goodbot::feedback::Feedback;
use goodbot::home::HomeState;
use goodbot::planning::Judgement;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{FeedbackWord, Kind, RecordedSession, SessionHeader, StepRecord};
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
    environment: EnvironmentFile,
    done: Vec<Step>,
}

impl Session {
    /// A session in which nothing was done yet.
    pub fn new(id: Option<String>, command: &str, environment: EnvironmentFile, intended: Option<usize>, begun: HomeState) -> Self {
        Self { id, command: command.to_owned(), intended, begun, again: VecDeque::new(), environment, done: Vec::new() }
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
        self.again = steps.into();
    }

    /// The session as a log has it.
    pub fn record(&self, intended: Option<&GroundTaskText>, learn: bool) -> RecordedSession {
        let step = |step: &Step| StepRecord { action: step.action.clone(), feedback: Some(word(step.feedback)) };
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
            strategies: None,
        };
        header.set_meant(intended);
        RecordedSession {
            header,
            header_line: 1,
            steps: self.steps().iter().map(step).zip(2..).map(|(step, line)| (line, step)).collect(),
            answers: vec![],
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
