//! Session logs: commands, steps, and their feedback.
//!
//! JSON Lines with any number of sessions, in the order in which they were trained. A session is a line of type `session`, a line of type
//! `step` for each action, and a line of type `end`, which says whether the robot is to learn from it. Blank lines do not count.
//!
//! The session line must have `type`, `version` (1), `kind`, `environment` (an [environment](crate::environment)) and `command`. `kind` is
//! `feedback`, `demonstration` or `labelled`. In a feedback session each step has a `feedback`: `reward`, `punish` or `neutral`. A
//! demonstration has steps without feedback. A labelled session has no steps; its lesson is `intended`. Optional fields:
//!
//! | field | contents |
//! |---|---|
//! | `id` | the session's name |
//! | `intended` | the intended task, as [propositions](crate::task_text), for evaluation only; in a labelled session the lesson |
//! | `before` | the way of the intended task: earlier goals in order, each a list of propositions |
//! | `through` | the way of the intended task: lists of alternatives, each to hold at some time up to the end |
//! | `avoiding` | the way of the intended task: propositions that must not hold before the end |
//! | `actions` | the actions, if they are not the four moves; `noop` is always possible |
//! | `continues` | `true`: the command before is repeated in the same environment |
//! | `prior` | from tasks to prior probabilities, in place of those from the words |
//! | `strategies` | the trainer strategies to consider, in place of the robot's own: `name`, `mu_plus`, `mu_minus`, `epsilon`, `prior`, and optionally three `lags` and four `rests` |
//! | `utterance` | the utterance from this command on, if the robot listened |
//! | `after` | the task of the command before, if this is a later command of an utterance |
//! | `closed_words` | the table of closed words, if it is not the built-in one |
//! | `conversation` | if the robot listened: the conversation's `id`, the `last` task, and objects that words can refer to: `movedLast`, `namedLast`, `wasThereBefore`, `robotWasThereBefore` |
//!
//! A feedback session may have lines of type `answer`, for the trainer's answers to the robot's questions: `tasks` (the tasks of the
//! question), `yes` (whether the intended task is among them), `eta` (the probability that an answer is wrong, less than 0.5), and `others`
//! (how many other answers were possible; 1 by default, as for yes and no). If the trainer corrected the robot without a question, `words`
//! has the words: evidence beside the answer.
//!
//! Times are optional, in milliseconds since the session began: a step may have `at_ms` (the robot acted) and `said_ms` (the trainer gave
//! feedback), an answer `said_ms`. Nothing is learned from them.
//!
//! A session with `continues` has neither `prior` nor `strategies`; one with `utterance` has neither `prior` nor `continues`.
//!
//! ```
//! use goodbot_formats::session::{FeedbackWord, SessionReader};
//!
//! let log = r#"
//! {"type":"session","version":1,"id":"w01-3","kind":"feedback","environment":{"version":1,"objects":[{"class":"agent","name":"agent0","x":4,"y":2}]},"command":"go to the red room","intended":["agentInRoom(agent0,room0)"]}
//! {"type":"step","action":"north","feedback":"reward"}
//! {"type":"end","learn":true}
//! "#;
//! let sessions: Vec<_> = SessionReader::new(log.as_bytes()).collect::<Result<_, _>>()?;
//! assert_eq!(sessions[0].header.command, "go to the red room");
//! assert_eq!(sessions[0].steps[0].1.feedback, Some(FeedbackWord::Reward));
//! assert_eq!(sessions[0].to_lines()?.join("\n"), log.trim());
//! # Ok::<(), goodbot_formats::FormatError>(())
//! ```

mod header;
mod reader;
mod record;

pub use crate::lines::MAX_LINE_BYTES;
pub(crate) use header::write_conversation;
pub use header::{Kind, SessionHeader, StrategyRecord};
pub use reader::SessionReader;
pub(crate) use record::is_one;
pub use record::{AnswerRecord, EndRecord, FeedbackWord, Record, StepRecord};

use crate::error::FormatError;

/// A whole session.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedSession {
    /// The session line.
    pub header: SessionHeader,
    /// The line on which it begins, counted from 1.
    pub header_line: usize,
    /// The steps, each with its line.
    pub steps: Vec<(usize, StepRecord)>,
    /// The trainer's answers to the robot's questions, in their order.
    pub answers: Vec<RecordedAnswer>,
    /// Whether the robot is to learn from it.
    pub learn: bool,
    /// The line on which it ends.
    pub end_line: usize,
}

/// An answer, with its place in the log.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedAnswer {
    /// Its line.
    pub line: usize,
    /// The number of steps before it.
    pub after: usize,
    /// The answer.
    pub answer: AnswerRecord,
}

impl RecordedSession {
    /// The answers after this many steps.
    pub fn answers_after(&self, steps: usize) -> impl Iterator<Item = &RecordedAnswer> {
        self.answers.iter().filter(move |recorded| recorded.after == steps)
    }

    /// The session as lines without line ends. The line numbers in `self` are not used.
    ///
    /// A session that could not be read again is an error of the reader; its line counts from the session line, which is 1.
    pub fn to_lines(&self) -> Result<Vec<String>, FormatError> {
        self.to_lines_with(self.header.to_json_line()?, |step, line| self.header.check(step, line))
    }

    /// The session as lines, beginning with `first`. `check` refuses a step that this session cannot have, given the step's line.
    pub(crate) fn to_lines_with(
        &self,
        first: String,
        check: impl Fn(&StepRecord, usize) -> Result<(), FormatError>,
    ) -> Result<Vec<String>, FormatError> {
        let mut lines = Vec::with_capacity(self.steps.len() + self.answers.len() + 2);
        lines.push(first);
        for index in 0..=self.steps.len() {
            for recorded in self.answers_after(index) {
                self.header.check_answer(lines.len() + 1)?;
                lines.push(recorded.answer.to_json_line()?);
            }
            if let Some((_, step)) = self.steps.get(index) {
                check(step, lines.len() + 1)?;
                lines.push(step.to_json_line()?);
            }
        }
        lines.push(EndRecord { learn: self.learn }.to_json_line()?);
        Ok(lines)
    }
}
