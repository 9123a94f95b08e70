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
mod record;

pub use crate::lines::MAX_LINE_BYTES;
pub use header::{Kind, SessionHeader, StrategyRecord};
pub(crate) use record::is_one;
pub use record::{AnswerRecord, EndRecord, FeedbackWord, Record, StepRecord};

use crate::environment::EnvironmentFile;
use crate::error::{ANSWER_OUTSIDE_SESSION, END_OUTSIDE_SESSION, FormatError, STEP_BEFORE_SESSION, no_end};
use crate::lines::Lines;
use std::io::BufRead;

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

/// The most lines that are skipped to find the next session line. A file with more other lines is no log.
const MOST_PASSED_OVER: usize = 100_000;

/// Reads sessions. An iterator: each item is a whole session, or its error.
///
/// After an error, one may stop or continue. The next item is then the next session of the log; the rest of the broken session is skipped.
/// Each broken session is one error. A session that continues one with an error is itself an error.
///
/// ```
/// use goodbot_formats::session::SessionReader;
///
/// let session = r#"{"type":"session","version":1,"kind":"demonstration","environment":{"version":1,"objects":[]},"command":"go"}"#;
/// let log = [session, r#"{"type":"step"}"#, r#"{"type":"end","learn":true}"#,
///            session, r#"{"type":"end","learn":true}"#].join("\n");
/// let mut reader = SessionReader::new(log.as_bytes());
/// assert_eq!(
///     reader.next().unwrap().unwrap_err().with_file("log.jsonl").to_string(),
///     r#"log.jsonl:2: field "action": is missing; add it"#
/// );
/// assert_eq!(reader.next().unwrap().unwrap().header_line, 4);
/// assert!(reader.next().is_none());
/// ```
pub struct SessionReader<R> {
    lines: Lines<R>,
    /// The next session's header, which came before the end of the last session.
    pending: Option<Result<(usize, Box<SessionHeader>), FormatError>>,
    last: Last,
}

/// The item before.
enum Last {
    /// Nothing.
    Start,
    /// A session, with its command and environment.
    Session(String, EnvironmentFile),
    /// A session that could not be read.
    Broken,
}

/// The reason why a line is no record.
struct Failure {
    error: FormatError,
    /// Whether the line may be the beginning of a session.
    session: bool,
}

impl<R: BufRead> SessionReader<R> {
    /// A reader of this log.
    pub fn new(input: R) -> Self {
        SessionReader { lines: Lines::new(input), pending: None, last: Last::Start }
    }

    /// The record on the next line that is not blank.
    fn record(&mut self) -> Option<Result<(usize, Record), Failure>> {
        loop {
            let line = self.lines.next()?;
            if line.error.is_none() && line.text.trim().is_empty() {
                continue;
            }
            let record = match line.error {
                Some(error) => Err(error),
                None => Record::parse(&line.text, line.number),
            };
            return Some(match record {
                Ok(record) => Ok((line.number, record)),
                Err(error) => Err(Failure { error, session: line.text.contains("\"session\"") }),
            });
        }
    }

    /// The next session line. The rest of a broken session is skipped.
    fn header(&mut self) -> Option<Result<(usize, Box<SessionHeader>), FormatError>> {
        if let Some(pending) = self.pending.take() {
            return Some(pending);
        }
        for _ in 0..MOST_PASSED_OVER {
            let broken = matches!(self.last, Last::Broken);
            let stray = |line, problem| Some(Err(FormatError::new(line, problem)));
            match self.record()? {
                Ok((line, Record::Session(header))) => return Some(Ok((line, header))),
                Err(failure) if failure.session || !broken || failure.error.is_fatal => {
                    return Some(Err(failure.error));
                }
                _ if broken => {}
                Ok((line, Record::Step(_))) => {
                    return match self.last {
                        Last::Start => stray(line, STEP_BEFORE_SESSION),
                        _ => stray(line, "a step comes after the end of its session; move it before the end line, or begin a session"),
                    };
                }
                Ok((line, Record::Answer(_))) => return stray(line, ANSWER_OUTSIDE_SESSION),
                Ok((line, Record::End(_))) => return stray(line, END_OUTSIDE_SESSION),
                Err(failure) => return Some(Err(failure.error)),
            }
        }
        Some(Err(self.lines.give_up(format!("no session begins in {MOST_PASSED_OVER} lines; check that this is a session log"))))
    }

    /// Checks that a session with `continues` has the session before's command and environment.
    fn check_continues(&self, line: usize, header: &SessionHeader) -> Result<(), FormatError> {
        let problem = match &self.last {
            _ if !header.continues => return Ok(()),
            Last::Broken => "the session before could not be read, so nothing can be continued; mend that one first",
            Last::Session(command, environment) if *command != header.command || *environment != header.environment => {
                "the session before has another command or environment; remove \"continues\""
            }
            _ => return Ok(()),
        };
        Err(FormatError::new(line, problem).with_field("continues"))
    }

    fn session(&mut self) -> Option<Result<RecordedSession, FormatError>> {
        let (header_line, header) = match self.header()? {
            Ok(header) => header,
            Err(error) => return Some(Err(error)),
        };
        Some(self.rest(header_line, *header))
    }

    /// The lines after a session line, up to the end.
    fn rest(&mut self, begin: usize, header: SessionHeader) -> Result<RecordedSession, FormatError> {
        self.check_continues(begin, &header)?;
        let (mut steps, mut answers) = (Vec::new(), Vec::new());
        loop {
            let next = match self.record() {
                None => {
                    return Err(FormatError::new(begin, no_end(None)));
                }
                Some(Ok((line, Record::Step(step)))) => {
                    header.check(&step, line)?;
                    steps.push((line, step));
                    continue;
                }
                Some(Ok((line, Record::Answer(answer)))) => {
                    header.check_answer(line)?;
                    answers.push(RecordedAnswer { line, after: steps.len(), answer });
                    continue;
                }
                Some(Ok((end_line, Record::End(EndRecord { learn })))) => {
                    return Ok(RecordedSession { header, header_line: begin, steps, answers, learn, end_line });
                }
                Some(Ok((line, Record::Session(next)))) => Ok((line, next)),
                Some(Err(failure)) if failure.session => Err(failure.error),
                Some(Err(failure)) => return Err(failure.error),
            };
            // Two sessions are affected: this one is the error now, the next one follows.
            let next_session = Some(next.as_ref().map_or_else(|e| e.line, |(line, _)| *line));
            self.pending = Some(next);
            return Err(FormatError::new(begin, no_end(next_session)));
        }
    }
}

impl<R: BufRead> Iterator for SessionReader<R> {
    type Item = Result<RecordedSession, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        let result = self.session()?;
        self.last = match &result {
            Ok(session) => {
                let header = &session.header;
                Last::Session(header.command.clone(), header.environment.clone())
            }
            Err(_) => Last::Broken,
        };
        Some(result)
    }
}
