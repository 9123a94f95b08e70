//! Session logs: commands, what was done, and how it was judged.
//!
//! JSON Lines, any number of sessions one after the other, in the order in which they were
//! trained. A session is a line of type `session`, a line of type `step` for each action, and a
//! line of type `end`, which says whether the robot is to learn from it. Blank lines do not count.
//!
//! On the session line, `type`, `version` (1), `kind`, `environment` (an
//! [environment](crate::environment)) and `command` must be there. `kind` is `feedback`, where each
//! step has a `feedback` of `reward`, `punish` or `neutral`, `demonstration`, where none has, or `labelled`, where there is no step and
//! `intended` is the lesson.
//! May be absent:
//!
//! | field | what |
//! |---|---|
//! | `id` | the session's name |
//! | `intended` | what the trainer meant, as [propositions](crate::task_text), for evaluation only; in a labelled session the lesson |
//! | `before` | the way of what was meant: earlier goals, one after the other, each a list of propositions |
//! | `through` | the way of what was meant: what is to hold at some time before the end or at it, each a list of alternatives |
//! | `avoiding` | the way of what was meant: what must not hold before the end |
//! | `actions` | the domain's actions, where they are not the four moves; `noop` always is one |
//! | `continues` | `true`: the command before, once more, in the same environment |
//! | `prior` | from tasks to probabilities, instead of what the words would give |
//! | `strategies` | the trainer strategies to consider, instead of the robot's own |
//! | `utterance` | where the robot listened: what was said, from this command on |
//! | `after` | where this is not the first command of what was said: the task of the command before |
//! | `closed_words` | the table of closed words, where it is another than the one that is built in |
//! | `conversation` | where the robot listened: the conversation's `id`, and what was said and done in it before, as texts by name |
//!
//! In a session of feedback, a line of type `answer` is where the trainer answered a question of the robot's: `tasks` (the tasks that the
//! answer is about), `yes` (whether what is meant is among them), `eta` (the probability that an answer is wrong, less than 0.5), and
//! `others` (how many other answers there were; 1, as for yes and no, where it is absent). Where the trainer corrected the robot unasked,
//! `words` are what was said: evidence beside the answer.
//!
//! When things were done, in milliseconds since the session began, a step may say by `at_ms` (the robot acted) and `said_ms` (the trainer said the
//! word), and an answer by `said_ms`. Nothing is learned from these.
//!
//! A session that `continues` has neither `prior` nor `strategies`; one with an `utterance` has no `prior`, and does not continue.
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
pub use header::{SessionHeader, StrategyRecord};
pub use reader::SessionReader;
pub(crate) use reader::is_fatal;
pub use record::{AnswerRecord, EndRecord, FeedbackWord, Kind, Record, StepRecord};

use crate::error::FormatError;

/// A whole session.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedSession {
    /// What the session is about.
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

/// An answer, and its place.
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

    /// The session as lines without line ends. The line numbers in `self` play no part.
    ///
    /// What could not be read again is not written: the error is the reader's, and its line counts
    /// from the session line, which is 1.
    pub fn to_lines(&self) -> Result<Vec<String>, FormatError> {
        self.to_lines_with(self.header.to_json_line()?, |step, line| self.header.check(step, line))
    }

    /// The session as lines, `first` being the first. `check` tells whether a step can be one of this session's, given its line.
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
