//! Reads the sessions of a log, one in memory at a time.

use std::io::BufRead;

use super::header::SessionHeader;
use super::record::Record;
use super::{EndRecord, RecordedAnswer, RecordedSession};
use crate::environment::EnvironmentFile;
use crate::error::{ANSWER_OUTSIDE_SESSION, END_OUTSIDE_SESSION, FormatError, STEP_BEFORE_SESSION, no_end};
use crate::lines::Lines;

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
/// let mut reader = SessionReader::new(log.as_bytes()).with_file("log.jsonl");
/// assert_eq!(
///     reader.next().unwrap().unwrap_err().to_string(),
///     r#"log.jsonl:2: field "action": is missing; add it"#
/// );
/// assert_eq!(reader.next().unwrap().unwrap().header_line, 4);
/// assert!(reader.next().is_none());
/// ```
pub struct SessionReader<R> {
    lines: Lines<R>,
    file: Option<String>,
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
        SessionReader { lines: Lines::new(input), file: None, pending: None, last: Last::Start }
    }

    /// The same reader, with the file's name in its errors.
    pub fn with_file(mut self, file: impl Into<String>) -> Self {
        self.file = Some(file.into());
        self
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
        let mut result = self.session()?;
        self.last = match &result {
            Ok(session) => {
                let header = &session.header;
                Last::Session(header.command.clone(), header.environment.clone())
            }
            Err(_) => Last::Broken,
        };
        if let (Err(error), Some(file)) = (&mut result, &self.file) {
            error.file = Some(file.clone());
        }
        Some(result)
    }
}
