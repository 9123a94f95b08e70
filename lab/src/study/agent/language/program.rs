//! A language model of one's own: a program that reads lines of JSON.
//!
//! `begin` starts a new model. `hear` has words, and the facts of each task; the program answers with a log likelihood for each task.
//! `learn` has the same, and the belief at the end of the lesson. `begin` and `learn` have no answer. Each thread has one process for all
//! its runs.

use super::{PROGRAM, Speak, wordless};
use crate::study::agent;
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot_console::counted;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;
use std::{fmt, thread};

/// The most bytes of an answer that are read, and the most letters of a wrong one that are shown.
const LONGEST: u64 = 1 << 20;
const SHOWN: usize = 200;

/// The settings of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The command that starts it.
    pub command: &'static str,
    /// The most seconds for an answer.
    pub seconds: u32,
}

impl Settings {
    /// The settings of this command. It is kept until the end, because agents are copied into every run.
    pub fn new(command: &str, seconds: u32) -> Self {
        Self { command: command.to_owned().leak(), seconds }
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{PROGRAM}{}", self.command)
    }
}

/// A language whose words another program learns.
#[derive(Debug)]
pub struct Program(Settings);

/// A running program. A thread of its own writes and reads, so that a program that does neither cannot stop the study.
struct Running {
    settings: Settings,
    /// The requests, and whether each has an answer.
    requests: Sender<(String, bool)>,
    answers: Receiver<String>,
    child: Child,
}

thread_local! {
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

impl Running {
    fn start(settings: Settings) -> Result<Self, StudyError> {
        let command = settings.command;
        let mut typed = command.split_whitespace();
        let started = Command::new(typed.next().unwrap_or_default()).args(typed).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started.map_err(|error| StudyError(format!("the program {command:?} cannot be started ({error})")))?;
        let (Some(mut input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(StudyError(format!("the program {command:?} has no input or output")));
        };
        let ((requests, asked), (answered, answers)) = (channel::<(String, bool)>(), channel());
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            for (request, asks) in asked {
                // In one piece: the pipe has no buffer on this side.
                let mut fails = input.write_all(request.as_bytes()).is_err();
                if asks && !fails {
                    let mut line = String::new();
                    let read = output.by_ref().take(LONGEST).read_line(&mut line);
                    fails = !matches!(read, Ok(1..)) || answered.send(line).is_err();
                }
                if fails {
                    break;
                }
            }
        });
        Ok(Self { settings, requests, answers, child })
    }

    fn send(&self, request: &Value, asks: bool) {
        // If the thread has ended, the next answer is missing.
        let _ = self.requests.send((format!("{request}\n"), asks));
    }

    /// The answer to `hear`: a number for each task.
    fn answer(&self, tasks: usize) -> Result<Vec<f32>, StudyError> {
        let Settings { command, seconds } = self.settings;
        let line = self.answers.recv_timeout(Duration::from_secs(seconds.into())).map_err(|missing| {
            StudyError(match missing {
                RecvTimeoutError::Disconnected => format!("the program {command:?} gave no answer; its own messages say why"),
                RecvTimeoutError::Timeout => format!(
                    "the program {command:?} gave no answer in {}; let it answer each hear by a line and flush it, or raise --program-seconds",
                    counted(seconds as usize, "second")
                ),
            })
        })?;
        let numbers = serde_json::from_str::<Vec<f32>>(&line).ok().filter(|numbers| numbers.len() == tasks);
        let numbers = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()));
        let shown: String = line.trim().chars().take(SHOWN).collect();
        let wrong = || format!("the program {command:?} answered {shown:?}, which is no list of {tasks} finite numbers");
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
    /// A new model of the program with these settings.
    ///
    /// # Errors
    /// [`StudyError`] if the program cannot be started.
    pub fn new(settings: Settings) -> Result<Self, StudyError> {
        let program = Self(settings);
        program.with(|running| {
            running.send(&json!({"type": "begin"}), false);
            Ok(())
        })?;
        Ok(program)
    }

    fn with<T>(&self, act: impl FnOnce(&Running) -> Result<T, StudyError>) -> Result<T, StudyError> {
        RUNNING.with_borrow_mut(|kept| {
            let running = match kept.take().filter(|running| running.settings == self.0) {
                Some(running) => running,
                None => Running::start(self.0)?,
            };
            let result = act(&running)?;
            // After a fault the program is stopped.
            *kept = Some(running);
            Ok(result)
        })
    }
}

impl Speak for Program {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        let request = json!({"type": "hear", "words": place.words, "tasks": place.facts});
        let likely = self.with(|running| {
            running.send(&request, true);
            running.answer(place.facts.len())
        })?;
        let logs = wordless(place).into_iter().map(|share| libm::logf(share.max(f32::MIN_POSITIVE)));
        Ok(agent::softmax(&logs.zip(likely).map(|(log, likely)| log + likely).collect::<Vec<_>>()))
    }

    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError> {
        let request = json!({"type": "learn", "words": place.words, "tasks": place.facts, "beliefs": posterior});
        self.with(|running| {
            running.send(&request, false);
            Ok(())
        })
    }
}
