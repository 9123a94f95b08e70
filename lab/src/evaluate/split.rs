//! The sessions that are left out together; and test sessions that were trained on nevertheless, with the same id, or with the same content
//! under another id.

use super::folds::shuffled;
use clap::ValueEnum;
use goodbot::language::Model;
use goodbot_console::Lesson;
use goodbot_lesson::first_words::heard;
use std::collections::{BTreeMap, HashMap};

/// The common property of sessions that stay together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Group {
    /// The person who trained: a session's id up to its first dot
    Worker,
    /// The environment, to the last cell
    Environment,
    /// The environment and the intended task
    Task,
    /// The command, word by word
    Command,
    /// The group that a log of worlds names, such as a speaker or a meaning
    Logged,
}

impl Group {
    /// The common property of one group's sessions.
    fn key(self, lesson: &Lesson) -> String {
        match self {
            Self::Worker => lesson.id.split('.').next().unwrap_or_default().to_owned(),
            Self::Command => {
                // A command that is too long has only its first words here.
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

/// The division of sessions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// The property that keeps sessions together, if any.
    pub group: Option<Group>,
    /// The number of parts; by default, one for each session or group.
    pub parts: Option<usize>,
    /// The most parts, if no number is given.
    pub most: Option<usize>,
}

impl Split {
    /// The sessions part by part.
    ///
    /// # Errors
    /// The reason why they cannot be divided.
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

/// The keys of a session: its id and its content.
struct Keys<'l> {
    id: Option<&'l str>,
    content: String,
}

impl<'l> Keys<'l> {
    fn of(lesson: &'l Lesson) -> Self {
        let header = &lesson.header;
        let meant = lesson.intended.and_then(|task| lesson.readings.get(task)).map(|reading| reading.name.to_string());
        let parts = [lesson.place(), header.command.clone(), lesson.walk.clone(), meant.unwrap_or_default()];
        Self { id: header.id.as_deref(), content: parts.join("\n") }
    }
}

/// For each test lesson, the training lesson that it copies, if any. `rounds` are the positions that are left out of
/// training, and those that are asked. `itself` says that both lists are the same.
pub fn find<'l>(taught: &'l [Lesson], asked: &'l [Lesson], rounds: &[(Vec<usize>, Vec<usize>)], itself: bool) -> Vec<Option<&'l Lesson>> {
    let mut ids: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut contents: HashMap<String, Vec<usize>> = HashMap::new();
    for (position, lesson) in taught.iter().enumerate().filter(|(_, lesson)| lesson.learn) {
        let keys = Keys::of(lesson);
        if let Some(id) = keys.id {
            ids.entry(id).or_default().push(position);
        }
        contents.entry(keys.content).or_default().push(position);
    }
    let mut found = vec![None; asked.len()];
    for (left_out, part) in rounds {
        let left_out: std::collections::HashSet<usize> = left_out.iter().copied().collect();
        for &position in part {
            let Some(lesson) = asked.get(position) else { continue };
            let keys = Keys::of(lesson);
            let alike = keys.id.and_then(|id| ids.get(id)).into_iter().chain(contents.get(&keys.content)).flatten();
            let copy = alike.copied().find(|&other| !(left_out.contains(&other) || itself && other == position));
            if let Some(slot) = found.get_mut(position) {
                *slot = copy.and_then(|copy| taught.get(copy));
            }
        }
    }
    found
}
