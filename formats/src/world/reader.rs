//! Reads a log of worlds, line by line.

use std::collections::HashMap;
use std::io::BufRead;
use std::sync::Arc;

use super::{CommandRecord, SessionInWorld, WorldFile};
use crate::error::{ANSWER_OUTSIDE_SESSION, END_OUTSIDE_SESSION, FormatError, STEP_BEFORE_SESSION, no_end};
use crate::json::{Object, Source};
use crate::lines::{Line as RawLine, Lines};
use crate::quoted::quoted;
use crate::session::{EndRecord, Record, RecordedAnswer, RecordedSession};

/// An item of a log of worlds.
#[derive(Debug, Clone, PartialEq)]
pub enum Line {
    /// A world. It is valid until another of the same name.
    World(Arc<WorldFile>),
    /// A command in a world on an earlier line.
    Command(CommandRecord),
    /// A session in a world on an earlier line.
    Session(Box<SessionInWorld>),
}

const TYPES: &[&str] = &["world", "command", "session", "step", "answer", "end"];

/// Reads a log of worlds. An iterator: each item is a world, a command, a whole session, or an error. After an error, one may continue:
/// commands and sessions in a world with an error are errors too, and the rest of a broken session is skipped.
pub struct WorldReader<R> {
    lines: Lines<R>,
    worlds: HashMap<String, Arc<WorldFile>>,
    /// A line that came before the end of a session.
    pending: Option<RawLine>,
    /// Whether the last item was an error.
    is_broken: bool,
    began: usize,
}

impl<R: BufRead> WorldReader<R> {
    /// A reader of this log.
    pub fn new(input: R) -> Self {
        Self { lines: Lines::new(input), worlds: HashMap::new(), pending: None, is_broken: false, began: 0 }
    }

    /// The first line of the last item, counted from 1; 0 before the first item.
    pub const fn began(&self) -> usize {
        self.began
    }

    /// The next line that is not blank.
    fn line(&mut self) -> Option<RawLine> {
        loop {
            let line = self.pending.take().or_else(|| self.lines.next())?;
            if line.error.is_some() || !line.text.trim().is_empty() {
                return Some(line);
            }
        }
    }

    /// The item that begins on this line.
    fn read(&mut self, text: &str, number: usize) -> Result<Line, FormatError> {
        let source = Source::new(text, number);
        let fields = source.root()?.object()?;
        let problem = match fields.required("type")?.word(TYPES)? {
            0 => {
                let world = Arc::new(WorldFile::read(&fields)?);
                self.worlds.insert(world.name.clone(), Arc::clone(&world));
                return Ok(Line::World(world));
            }
            1 => return Ok(Line::Command(CommandRecord::read(&fields, number, &*self.world(&fields)?)?)),
            2 => return self.session(&fields, number).map(|session| Line::Session(Box::new(session))),
            3 => STEP_BEFORE_SESSION,
            4 => ANSWER_OUTSIDE_SESSION,
            _ => END_OUTSIDE_SESSION,
        };
        Err(FormatError::new(number, problem))
    }

    /// The world that a command or a session names.
    fn world(&self, fields: &Object<'_>) -> Result<Arc<WorldFile>, FormatError> {
        let node = fields.required("world")?;
        let name = node.text()?;
        self.worlds.get(&name).cloned().ok_or_else(|| {
            node.error(format!("no world {} could be read on a line before this one; put the world's line first", quoted(&name)))
        })
    }

    /// A session, up to its end.
    fn session(&mut self, fields: &Object<'_>, begin: usize) -> Result<SessionInWorld, FormatError> {
        let (world, facts, header) = SessionInWorld::header(fields, self.world(fields)?)?;
        let (mut steps, mut answers) = (Vec::new(), Vec::new());
        loop {
            let Some(line) = self.line() else {
                return Err(FormatError::new(begin, no_end(None)));
            };
            let number = line.number;
            if let Some(error) = line.error {
                return Err(error);
            }
            let source = Source::new(&line.text, number);
            if source.root()?.object()?.required("type")?.word(TYPES)? <= 2 {
                // The item that begins before the end is read next.
                self.pending = Some(line);
                return Err(FormatError::new(begin, no_end(Some(number))));
            }
            match Record::parse(&line.text, number)? {
                Record::Step(step) => {
                    header.check_feedback(&step, number)?;
                    steps.push((number, step));
                }
                Record::Answer(answer) => {
                    header.check_answer(number)?;
                    answers.push(RecordedAnswer { line: number, after: steps.len(), answer });
                }
                Record::End(EndRecord { learn }) => {
                    let session = RecordedSession { header, header_line: begin, steps, answers, learn, end_line: number };
                    return Ok(SessionInWorld { world, facts, session });
                }
                Record::Session(_) => {}
            }
        }
    }
}

impl<R: BufRead> Iterator for WorldReader<R> {
    type Item = Result<Line, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.line()?;
            self.began = line.number;
            let read = line.error.map_or_else(|| self.read(&line.text, line.number), Err);
            let was_broken = std::mem::replace(&mut self.is_broken, read.is_err());
            let begins = || TYPES[..3].iter().any(|kind| line.text.contains(&format!("\"{kind}\"")));
            if !matches!(&read, Err(error) if was_broken && !error.is_fatal && !begins()) {
                return Some(read);
            }
        }
    }
}
