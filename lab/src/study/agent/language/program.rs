//! A language model of one's own: a program that reads lines of JSON.
//!
//! `begin` starts a new model. `hear` has words, and the facts of each task; the program answers with a log likelihood for each task.
//! `learn` has the same, and the belief at the end of the lesson. `begin` and `learn` have no answer. Each thread has one process for all
//! its runs.

use super::{Speak, wordless};
use crate::study::agent::pick;
use crate::study::fault::StudyError;
use crate::study::place::Place;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// The most bytes of an answer that are read, and the most letters of a wrong one that are shown.
const LONGEST: u64 = 1 << 20;
const SHOWN: usize = 200;

/// A language whose words another program learns.
#[derive(Debug)]
pub struct Program(&'static str);

/// A running program.
struct Running {
    command: &'static str,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    child: Child,
}

thread_local! {
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

impl Running {
    fn start(command: &'static str) -> Result<Self, StudyError> {
        let mut typed = command.split_whitespace();
        let started = Command::new(typed.next().unwrap_or_default()).args(typed).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started.map_err(|error| StudyError(format!("the program {command:?} cannot be started ({error})")))?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(StudyError(format!("the program {command:?} has no input or output")));
        };
        Ok(Self { command, requests, answers: BufReader::new(answers), child })
    }

    fn send(&mut self, request: &Value) -> Result<(), StudyError> {
        // In one piece: the pipe has no buffer on this side.
        let sent = self.requests.write_all(format!("{request}\n").as_bytes());
        sent.map_err(|_| StudyError(format!("the program {:?} has ended; its own messages say why", self.command)))
    }

    /// The answer to `hear`: a number for each task.
    fn answer(&mut self, tasks: usize) -> Result<Vec<f32>, StudyError> {
        let mut line = String::new();
        let read = self.answers.by_ref().take(LONGEST).read_line(&mut line);
        if !matches!(read, Ok(1..)) {
            return Err(StudyError(format!("the program {:?} gave no answer; its own messages say why", self.command)));
        }
        let numbers = serde_json::from_str::<Vec<f32>>(&line).ok().filter(|numbers| numbers.len() == tasks);
        let numbers = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()));
        let shown: String = line.trim().chars().take(SHOWN).collect();
        let wrong = || format!("the program {:?} answered {shown:?}, which is no list of {tasks} finite numbers", self.command);
        numbers.ok_or_else(|| StudyError(wrong()))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It may wait for requests still.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Program {
    /// A new model of the program that is started by this command.
    ///
    /// # Errors
    /// [`StudyError`] if the program cannot be started, or has ended.
    pub fn new(command: &'static str) -> Result<Self, StudyError> {
        let program = Self(command);
        program.with(|running| running.send(&json!({"type": "begin"})))?;
        Ok(program)
    }

    fn with<T>(&self, act: impl FnOnce(&mut Running) -> Result<T, StudyError>) -> Result<T, StudyError> {
        RUNNING.with_borrow_mut(|kept| {
            let running = match kept.take().filter(|running| running.command == self.0) {
                Some(running) => running,
                None => Running::start(self.0)?,
            };
            act(kept.insert(running))
        })
    }
}

impl Speak for Program {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        let request = json!({"type": "hear", "words": place.words, "tasks": place.facts});
        let likely = self.with(|running| {
            running.send(&request)?;
            running.answer(place.facts.len())
        })?;
        let logs = wordless(place).into_iter().map(|share| libm::logf(share.max(f32::MIN_POSITIVE)));
        Ok(pick::softmax(&logs.zip(likely).map(|(log, likely)| log + likely).collect::<Vec<_>>()))
    }

    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError> {
        let request = json!({"type": "learn", "words": place.words, "tasks": place.facts, "beliefs": posterior});
        self.with(|running| running.send(&request))
    }
}
