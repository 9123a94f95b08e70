//! The training data of one session.

use goodbot_formats::session::{Kind, SessionHeader};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::Fault;
use goodbot_lesson::first_words::FirstWords;
use std::collections::BTreeMap;
use std::sync::Arc;

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
