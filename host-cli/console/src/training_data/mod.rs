//! Recorded sessions as training data: each session's command, with its evidence for each task.
//!
//! - [`evidence`]: one session, replayed by an agent without words;
//! - [`training`]: a language model trained on many at once;
//! - [`worlds`]: commands and sessions in worlds from files.
//!
//! The order of the sessions does not matter: the posterior over a session's tasks comes from its prior without words, Pr(l|s) Pr(t|s,l),
//! and from feedback, demonstration or label.

pub mod evidence;
pub mod training;
pub mod worlds;

use super::load::input;
use super::load::input::InputFile;
use super::messages::{bar, counted, counting, say, summed};
use super::outcome::Failure;
use super::typed::{Believes, Limit};
use crate::load::input::Content;
use evidence::Witness;
use goodbot::Options;
use goodbot::task::LiftedTask;
use goodbot_formats::session::{Kind, RecordedSession, SessionHeader, SessionReader};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::Fault;
use goodbot_lesson::first_words::{FirstWords, told};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The most faulty sessions to skip: a file with more is no log.
pub const MOST_FAULTS: usize = 1_000;
/// The most sessions that a model can be trained on.
const MOST_SESSIONS: usize = u16::MAX as usize;

/// The result of reading logs.
#[derive(Debug, Default)]
pub struct Lessons {
    /// The lessons.
    pub lessons: Vec<Lesson>,
    /// How many faulty sessions were skipped.
    pub skipped: usize,
    /// How many labelled sessions were left out because their task has a way.
    pub with_way: usize,
    /// How many commands in worlds were left out because no task has their meaning.
    pub no_task: usize,
    /// How many commands are read by their first words only.
    pub long: usize,
}

/// The options for reading logs.
#[derive(Clone, Debug, Default)]
pub struct LogOptions {
    /// The expected trainers, in place of the sessions' own.
    pub believes: Option<Believes>,
    /// Whether faulty sessions are skipped.
    pub keep_going: bool,
    /// The most sessions to read from all files together.
    pub limit: Limit,
}

/// Reads the sessions of all files and replays them.
pub fn read(files: &[InputFile], lifted: &[LiftedTask], options: Options, log_options: &LogOptions) -> Result<Lessons, Failure> {
    let keep_going = log_options.keep_going;
    let mut sessions: Vec<(String, RecordedSession)> = Vec::new();
    let (mut skipped, mut with_way, mut no_task) = (0, 0, 0);
    let (mut lessons, mut homes, mut remarks) = (Vec::new(), None, Vec::new());
    let ways = lifted.iter().any(LiftedTask::has_way);
    let mut left = log_options.limit.count();
    let progress = counting("reading sessions");
    for file in files {
        let opened = input::log(file)?;
        let name = input::name(file);
        let is_of_homes = Content::of(opened.buffer()) != Content::Worlds;
        if *homes.get_or_insert(is_of_homes) != is_of_homes {
            let message = "does not mix with the log before it: one has homes, the other has worlds; learn from each by itself";
            return Err(Fault::new(name, message).into());
        }
        if !is_of_homes {
            worlds::read(name, opened, options, log_options.believes.as_ref(), &mut left, |lesson| {
                progress.inc(1);
                match lesson {
                    Ok(Some(_)) if lessons.len() >= MOST_SESSIONS => return Err(too_many(name)),
                    Ok(Some(lesson)) => {
                        remarks.extend_from_slice(&lesson.remarks);
                        lessons.push(lesson);
                    }
                    Ok(None) => no_task += 1,
                    Err(fault) => progress.suspend(|| refuse(&[fault], keep_going, &mut skipped))?,
                }
                Ok(())
            })?;
            continue;
        }
        for session in SessionReader::new(opened).take(left) {
            progress.inc(1);
            left -= 1;
            match session {
                Ok(session) if session.header.has_way() && !ways => with_way += 1,
                Ok(_) if sessions.len() >= MOST_SESSIONS => return Err(too_many(name)),
                Ok(session) => sessions.push((name.to_owned(), session)),
                Err(error) => progress.suspend(|| refuse(&[Fault::from_format(name, error)], keep_going, &mut skipped))?,
            }
        }
    }
    progress.finish_and_clear();
    let progress = bar(sessions.len(), "walking through sessions");
    let walked: Vec<Result<Lesson, Vec<Fault>>> = sessions
        .par_iter()
        .map_init(
            || Witness::new(lifted, options, log_options.believes.clone()),
            |witness, (file, session)| {
                let lesson = match witness {
                    Ok(witness) => witness.lesson(file, session),
                    Err(error) => Err(vec![Fault::new(file, error)]),
                };
                progress.inc(1);
                lesson
            },
        )
        .collect();
    progress.finish_and_clear();
    for lesson in walked {
        match lesson {
            Ok(lesson) => {
                remarks.extend_from_slice(&lesson.remarks);
                lessons.push(lesson);
            }
            Err(faults) => refuse(&faults, keep_going, &mut skipped)?,
        }
    }
    summed(&remarks).iter().for_each(|remark| say!("{remark}"));
    let long: Vec<&Fault> = lessons.iter().filter_map(|lesson| lesson.long.as_ref()).collect();
    tell_long(&long);
    let long = long.len();
    if skipped > 0 {
        say!("{} with faults skipped", counted(skipped, "session"));
    }
    if with_way > 0 {
        say!("{} with a way (through, avoiding) left out: consider ways with --routes", counted(with_way, "session"));
    }
    if no_task > 0 {
        say!("{} left out: their task is of no kind of their world, or holds already", counted(no_task, "command"));
    }
    if lessons.is_empty() && !files.is_empty() {
        return Err(Failure::Input("there is no session to learn from; name a file that has one".to_owned()));
    }
    Ok(Lessons { lessons, skipped, with_way, no_task, long })
}

/// Reports commands that are read by their first words only, with the lines of the first five.
pub fn tell_long(long: &[&Fault]) {
    const MOST: usize = 5;
    if long.is_empty() {
        return;
    }
    let place = |fault: &&Fault| fault.line.map_or_else(|| fault.file.clone(), |line| format!("{}:{line}", fault.file));
    let places: Vec<String> = long.iter().take(MOST).map(place).collect();
    let more = long.len().checked_sub(MOST).filter(|&more| more > 0).map_or_else(String::new, |more| format!(" and {more} more"));
    say!("{}: {}{more}", told(long.len()), places.join(", "));
}

fn too_many(name: &str) -> Failure {
    Failure::Input(format!("{name}: has more than {MOST_SESSIONS} sessions; --limit {MOST_SESSIONS} reads the first ones"))
}

fn refuse(faults: &[Fault], keep_going: bool, skipped: &mut usize) -> Result<(), Failure> {
    if !keep_going {
        return Err(faults.to_vec().into());
    }
    input::tell(faults);
    *skipped += 1;
    if *skipped > MOST_FAULTS {
        let message = format!("more than {MOST_FAULTS} sessions are at fault; check with goodbot check that this is a session log");
        return Err(Failure::Input(message));
    }
    Ok(())
}

/// A machine command: its tokens.
pub type MachineCommand = Vec<String>;

/// A task that a command may mean.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The task.
    pub name: GroundTaskText,
    /// Its kind, with the attributes of its objects: `blockInRoom bag red`.
    pub label: String,
    /// Its probability before any word.
    pub prior: f32,
    /// Its machine commands, equally probable.
    pub commands: Vec<MachineCommand>,
}

/// The training data of one session.
#[derive(Clone, Debug, Default)]
pub struct Lesson {
    /// The session's name.
    pub id: String,
    /// The command.
    pub command: String,
    /// The session's header. In a world from a file, its environment is empty.
    pub header: SessionHeader,
    /// The world's name and its facts, if the place is no home.
    pub world: Option<String>,
    /// Whether a robot can act in the place: in homes, and in worlds with actions.
    pub acts: bool,
    /// The group to keep on one side of a split between training and test data, if the log names one.
    pub group: Option<String>,
    /// The position of the intended task, if the record names it.
    pub intended: Option<usize>,
    /// Whether the steps told the intended task, in place of the record.
    pub is_told_by_steps: bool,
    /// The possible tasks. Lessons in the same state of the same world share them.
    pub readings: Arc<[Reading]>,
    /// The tokens of a world's [numbers](goodbot_lesson::world::numbers), with their digits.
    pub numbers: Arc<BTreeMap<String, String>>,
    /// The probability of each task without words: from the steps, or from the label.
    pub beliefs: Vec<f32>,
    /// The machine commands of the possible tasks, with their probabilities.
    pub pairs: Vec<(MachineCommand, f32)>,
    /// The actions and their feedback, as a text.
    pub walk: String,
    /// Whether the language model is to learn from it.
    pub learn: bool,
    /// Remarks that are no faults.
    pub remarks: Vec<Fault>,
    /// The command's length, if only its first words are read.
    pub long: Option<Fault>,
}

impl Lesson {
    /// A command in a world without a robot. Its meaning is still unknown, and it is not learned from.
    pub(super) fn told(id: String, world: String, command: &FirstWords<'_>, header: SessionHeader, readings: Arc<[Reading]>) -> Self {
        Self {
            id,
            command: command.words.to_owned(),
            header,
            world: Some(world),
            beliefs: readings.iter().map(|reading| reading.prior).collect(),
            readings,
            ..Self::default()
        }
    }

    /// Takes the task that the steps, without words, make more probable than `clear` for the intended one, if the record does not name it.
    pub fn told_by_steps(mut self, clear: f32) -> Self {
        let told = self.beliefs.iter().position(|&belief| belief > clear);
        if self.intended.is_none() && told.is_some() {
            (self.intended, self.is_told_by_steps) = (told, true);
        }
        self
    }

    /// Whether the evidence without words makes the intended task more probable than any other. `None` if the intended task is unknown or
    /// was labelled, or
    /// told by this evidence.
    pub fn evidence_is_right(&self) -> Option<bool> {
        let is_apart = self.header.kind != Kind::Labelled && !self.is_told_by_steps;
        let meant = self.beliefs.get(self.intended.filter(|_| is_apart)?)?;
        Some(self.beliefs.iter().filter(|belief| *belief >= meant).count() == 1)
    }

    /// The place as a text: equal for equal homes, and for the same state of the same world.
    pub fn place(&self) -> String {
        self.world.clone().unwrap_or_else(|| self.header.environment.to_json_line())
    }
}

/// The machine commands of a labelled task: all equally probable, and equal ones merged.
pub(super) fn told_pairs(reading: &Reading) -> Vec<(MachineCommand, f32)> {
    let share = 1.0 / reading.commands.len().max(1) as f32;
    let mut pairs: Vec<(MachineCommand, f32)> = Vec::new();
    for command in &reading.commands {
        match pairs.iter_mut().find(|(known, _)| known == command) {
            Some((_, whole)) => *whole += share,
            None => pairs.push((command.clone(), share)),
        }
    }
    pairs
}

/// A state of a world, as a text.
pub(super) fn place(world: &WorldFile, facts: &[GroundAtomText]) -> String {
    let mut facts: Vec<String> = facts.iter().map(ToString::to_string).collect();
    facts.sort();
    format!("{} {}", world.name, facts.join(" "))
}
