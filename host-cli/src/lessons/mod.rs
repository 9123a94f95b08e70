//! Recorded sessions as training data: what was said, and what each session shows of the task that was meant.
//!
//! - [`evidence`]: one session, walked by an agent that knows no word;
//! - [`training`]: a language model trained on many at once;
//! - [`restored`]: an agent from a model file.
//!
//! The order of the sessions plays no part: the posterior over a session's tasks comes from its prior without any word, Pr(l|s) Pr(t|s,l),
//! and what the trainer said or showed.

pub mod evidence;
pub mod restored;
pub mod training;

use crate::load::{Fault, input};
use crate::outcome::Failure;
use evidence::Witness;
use goodbot::Options;
use goodbot::task::LiftedTask;
use goodbot_formats::session::{RecordedSession, SessionHeader, SessionReader};
use goodbot_formats::task_text::GroundTaskText;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

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
    /// The actions of one of its shortest plans; empty where no one asked for plans.
    pub plan: MachineCommand,
}

/// What one session has to teach.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The session's name.
    pub id: String,
    /// What was said.
    pub command: String,
    /// Where it was said, and the rest of its record.
    pub header: SessionHeader,
    /// The task that was meant, by position, where the record says so.
    pub intended: Option<usize>,
    /// The tasks.
    pub readings: Vec<Reading>,
    /// What the command may have meant, and how probable that is.
    pub pairs: Vec<(MachineCommand, f32)>,
    /// What the trainer did, in order; empty for feedback.
    pub shown: Vec<String>,
    /// Whether it is to be learned from.
    pub learn: bool,
    /// What is worth knowing, and no fault.
    pub remarks: Vec<Fault>,
}

/// Reads the sessions of all files and walks through them. Gives the lessons and how many sessions were passed over.
pub fn read(
    files: &[String],
    lifted: &[LiftedTask],
    options: Options,
    plans: bool,
    keep_going: bool,
) -> Result<(Vec<Lesson>, usize), Failure> {
    let mut sessions: Vec<(String, RecordedSession)> = Vec::new();
    let mut skipped = 0;
    for file in files {
        let opened = input::open(file).map_err(|fault| Failure::Input(fault.to_string()))?;
        let name = input::name(file);
        for session in SessionReader::new(opened) {
            match session {
                Ok(session) => sessions.push((name.to_owned(), session)),
                Err(error) => refuse(&[Fault::from_format(name, error)], keep_going, &mut skipped)?,
            }
        }
    }
    let progress = bar(sessions.len(), "walking through sessions");
    let walked: Vec<Result<Lesson, Vec<Fault>>> = sessions
        .par_iter()
        .map_init(
            || Witness::new(lifted, options, plans),
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
    let mut lessons = Vec::new();
    for lesson in walked {
        match lesson {
            Ok(lesson) => {
                lesson.remarks.iter().for_each(|remark| eprintln!("{remark}"));
                lessons.push(lesson);
            }
            Err(faults) => refuse(&faults, keep_going, &mut skipped)?,
        }
    }
    if skipped > 0 {
        eprintln!("{skipped} sessions at fault were passed over");
    }
    if lessons.is_empty() {
        return Err(Failure::Input("there is no session to learn from; name a file that has one".to_owned()));
    }
    Ok((lessons, skipped))
}

fn refuse(faults: &[Fault], keep_going: bool, skipped: &mut usize) -> Result<(), Failure> {
    let text: Vec<String> = faults.iter().map(ToString::to_string).collect();
    if !keep_going {
        return Err(Failure::Input(text.join("\n")));
    }
    eprintln!("{}", text.join("\n"));
    *skipped += 1;
    Ok(())
}

/// A progress bar on standard error.
pub fn bar(length: usize, what: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {bar:30} {pos}/{len} {elapsed}").unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length as u64).with_style(style).with_message(what)
}
