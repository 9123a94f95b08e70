//! A log of worlds, line by line.

use std::collections::HashMap;
use std::io::BufRead;
use std::sync::Arc;

use super::{CommandRecord, WorldFile};
use crate::error::{FormatError, Problem};
use crate::json::Source;
use crate::lines::Lines;

/// A line of a log of worlds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Line {
    /// A world.
    World(Arc<WorldFile>),
    /// A command in a world before it.
    Command(CommandRecord),
}

/// Reads a log of worlds. An iterator: each item is a line that is not blank, or what is wrong with it. After an error one may go on: the
/// commands in a world that could not be read are errors too.
pub struct WorldReader<R> {
    lines: Lines<R>,
    worlds: HashMap<String, Arc<WorldFile>>,
}

impl<R: BufRead> WorldReader<R> {
    /// A reader of this log.
    pub fn new(input: R) -> Self {
        Self { lines: Lines::new(input), worlds: HashMap::new() }
    }

    fn read(&mut self, text: &str, number: usize) -> Result<Line, FormatError> {
        let source = Source::new(text, number);
        let fields = source.root()?.object()?;
        if fields.required("type")?.word(&["world", "command"])? == 0 {
            let world = Arc::new(WorldFile::read(&fields)?);
            if self.worlds.insert(world.name.clone(), Arc::clone(&world)).is_some() {
                let name = world.name.clone();
                return Err(fields.error("name", Problem::DuplicateName { name }));
            }
            return Ok(Line::World(world));
        }
        let node = fields.required("world")?;
        let name = node.text()?;
        match self.worlds.get(&name) {
            None => Err(node.error(Problem::NoSuchWorld { name })),
            Some(world) => Ok(Line::Command(CommandRecord::read(&fields, number, world)?)),
        }
    }
}

impl<R: BufRead> Iterator for WorldReader<R> {
    type Item = Result<Line, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.lines.next()?;
            if let Some(error) = line.error {
                return Some(Err(error));
            }
            if !line.text.trim().is_empty() {
                return Some(self.read(&line.text, line.number));
            }
        }
    }
}
