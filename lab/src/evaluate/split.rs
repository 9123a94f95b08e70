//! Which sessions are left out together, and asked when a model was trained on the rest.

use super::folds::shuffled;
use clap::ValueEnum;
use goodbot::language::Model;
use goodbot_console::training_data::Lesson;
use goodbot_lesson::first_words::heard;
use std::collections::BTreeMap;

/// What keeps sessions together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Group {
    /// The person who trained: a session's id up to its first dot
    Worker,
    /// The environment, to the last cell
    Environment,
    /// The environment and what was meant there
    Task,
    /// The command, word by word
    Command,
    /// What a log of worlds says must stay together: a speaker, a meaning
    Logged,
}

impl Group {
    /// What sessions of one group have in common.
    fn key(self, lesson: &Lesson) -> String {
        match self {
            Self::Worker => lesson.id.split('.').next().unwrap_or_default().to_owned(),
            Self::Command => {
                // Of a command that is too long its first words alone are here.
                heard(Model::Model2, &lesson.command).unwrap_or_default().join(" ")
            }
            Self::Logged => lesson.group.clone().unwrap_or_else(|| lesson.id.clone()),
            Self::Environment => lesson.place(),
            Self::Task => {
                let meant = lesson.intended.and_then(|task| lesson.readings.get(task)).map(|reading| reading.name.to_string());
                format!("{} {}", lesson.place(), meant.unwrap_or_default())
            }
        }
    }
}

/// How sessions are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// What keeps them together, if anything does.
    pub group: Option<Group>,
    /// How many parts; one for each session or group where nothing is said.
    pub parts: Option<usize>,
    /// The most parts where no number is given.
    pub most: Option<usize>,
}

impl Split {
    /// The sessions part by part.
    ///
    /// # Errors
    /// Why they cannot be divided like this.
    pub fn parts(self, lessons: &[Lesson], seed: u64) -> Result<Vec<Vec<usize>>, String> {
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (position, lesson) in lessons.iter().enumerate() {
            groups.entry(self.group.map_or_else(|| format!("{position:09}"), |group| group.key(lesson))).or_default().push(position);
        }
        let mut groups: Vec<Vec<usize>> = groups.into_values().collect();
        groups.sort();
        let what = match self.group {
            None => "session",
            Some(Group::Worker) => "worker",
            Some(Group::Command) => "command",
            Some(Group::Environment) => "environment",
            Some(Group::Task) => "environment and task",
            Some(Group::Logged) => "group",
        };
        if groups.len() < 2 {
            return Err(format!("there is one {what} alone, and nothing else to train on; name files that have more"));
        }
        let Some(count) = self.parts.or(self.most.filter(|&most| most < groups.len())) else { return Ok(groups) };
        if count > groups.len() {
            let most = groups.len();
            return Err(format!("--k-fold {count} is more parts than there are: {what} by {what} there are {most}; give 2 to {most}"));
        }
        let mut parts = vec![Vec::new(); count];
        for (position, group) in shuffled(groups.len(), seed).into_iter().enumerate() {
            if let (Some(part), Some(group)) = (parts.get_mut(position % count), groups.get(group)) {
                part.extend(group);
            }
        }
        Ok(parts)
    }
}
