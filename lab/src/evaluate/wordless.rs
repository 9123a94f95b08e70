//! The control: a learner that sees the scene and the intended task, but no word.
//!
//! If each task has a starting room of its own, such a learner understands every command. Only accuracy above this learner's shows that
//! words were understood.

use goodbot_console::training_data::Lesson;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use std::collections::BTreeMap;

/// How often each kind of task was intended: in total, and for each scene.
#[derive(Debug, Default)]
pub struct Wordless {
    everywhere: Counts,
    scenes: BTreeMap<String, Counts>,
}

#[derive(Debug, Default)]
struct Counts {
    whole: f64,
    labels: BTreeMap<String, f64>,
}

impl Counts {
    fn add(&mut self, label: &str, weight: f64) {
        self.whole += weight;
        *self.labels.entry(label.to_owned()).or_default() += weight;
    }

    /// The share of a label, smoothed towards `before` with the weight of one session.
    fn share(&self, label: &str, before: f64) -> f64 {
        (self.labels.get(label).copied().unwrap_or(0.0) + before) / (self.whole + 1.0)
    }
}

impl Wordless {
    /// The counts of these lessons.
    pub fn of<'l>(lessons: impl Iterator<Item = &'l Lesson>) -> Self {
        let mut learner = Self::default();
        for lesson in lessons.filter(|lesson| lesson.learn) {
            let scene = learner.scenes.entry(scene(lesson)).or_default();
            for (reading, &belief) in lesson.readings.iter().zip(&lesson.beliefs).filter(|&(_, &belief)| belief > 0.0) {
                scene.add(&reading.label, f64::from(belief));
                learner.everywhere.add(&reading.label, f64::from(belief));
            }
        }
        learner
    }

    /// The probability of each task of a lesson, without its words.
    pub fn posterior(&self, lesson: &Lesson) -> Vec<f32> {
        let here = self.scenes.get(&scene(lesson));
        let mut alike: BTreeMap<&str, f64> = BTreeMap::new();
        for reading in &*lesson.readings {
            *alike.entry(&reading.label).or_default() += f64::from(reading.prior);
        }
        let even = 1.0 / alike.len().max(1) as f64;
        let score = |label: &str| {
            let everywhere = self.everywhere.share(label, even);
            here.map_or(everywhere, |here| here.share(label, everywhere))
        };
        // Tasks with the same label share the label's score.
        let part = |reading: &goodbot_console::training_data::Reading| {
            f64::from(reading.prior) / alike.get(reading.label.as_str()).copied().unwrap_or(1.0)
        };
        let scores: Vec<f64> = lesson.readings.iter().map(|reading| score(&reading.label) * part(reading)).collect();
        let whole: f64 = scores.iter().sum();
        scores.into_iter().map(|score| (score / whole) as f32).collect()
    }
}

/// The rooms of the agent and the blocks, by their looks; in a world from a file, the world and its facts.
fn scene(lesson: &Lesson) -> String {
    lesson.world.clone().unwrap_or_else(|| scene_of_home(&lesson.header.environment))
}

fn scene_of_home(environment: &EnvironmentFile) -> String {
    let room_of = |at: (i32, i32)| {
        environment.objects.iter().find_map(|object| match object {
            ObjectRecord::Room { left, bottom, right, top, color, .. }
                if (left + 1..*right).contains(&at.0) && (bottom + 1..*top).contains(&at.1) =>
            {
                Some(color.as_str())
            }
            _ => None,
        })
    };
    let mut things: Vec<String> = environment
        .objects
        .iter()
        .filter_map(|object| match object {
            ObjectRecord::Agent { x, y, .. } => Some(format!("agent in {}", room_of((*x, *y)).unwrap_or("no room"))),
            ObjectRecord::Block { x, y, color, shape, .. } => {
                Some(format!("{color} {shape} in {}", room_of((*x, *y)).unwrap_or("no room")))
            }
            ObjectRecord::Room { .. } | ObjectRecord::Door { .. } => None,
        })
        .collect();
    things.sort();
    things.join(", ")
}
