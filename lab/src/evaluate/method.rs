//! Trained models, and the control: a learner that sees the scene and the intended task, but no word.
//!
//! If each task has a starting room of its own, such a learner understands every command. Only accuracy above this learner's shows that
//! words were understood.

use goodbot::home::Moves;
use goodbot::language::{LanguageModel, Settings, Synonyms};
use goodbot::memory::AgentHeap;
use goodbot::task::TokenOrder;
use goodbot::{Agent, Options};
use goodbot_console::load::words::in_known_words;
use goodbot_console::{Failure, Learner, Lesson, training};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_lesson::{checked, home};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The default and the paper's settings, and variants that differ in one choice.
pub fn ablations() -> Vec<(&'static str, Options)> {
    let default = Settings::SMOOTHED;
    let model_2 = [
        ("Model 2, smoothed", default),
        ("  no alignment prior", Settings { alignment_prior: 0.0, ..default }),
        ("  whole words", Settings { word_letters: 0, ..default }),
        ("  smoothing 0.1", Settings { smoothing: 0.1, ..default }),
        ("  10 rounds", Settings { rounds: 10, ..default }),
        ("  facts by attribute", Settings { order: TokenOrder::Attributes, ..default }),
        ("paper", Settings::PAPER),
        ("  and alignment prior 4", Settings { alignment_prior: 4.0, ..Settings::PAPER }),
        ("  and four letters", Settings { word_letters: 4, ..Settings::PAPER }),
        ("  and facts by proposition", Settings { order: TokenOrder::Propositions, ..Settings::PAPER }),
    ];
    let role_models = [("default", Learner::Default.options()), ("roles", Learner::Roles.options())];
    role_models.into_iter().chain(model_2.map(|(name, language)| (name, Options { language, ..Options::PAPER }))).collect()
}

/// A trained model.
pub enum Trained<'m> {
    /// A language model.
    Model(Box<LanguageModel<&'m mut AgentHeap>>),
    /// A robot with a trained model.
    Robot(Box<Agent<AgentHeap>>),
}

impl<'m> Trained<'m> {
    /// Trains on lessons.
    ///
    /// # Errors
    /// An [`AgentError`](goodbot::AgentError).
    pub fn on<'l>(
        memory: &'m mut AgentHeap,
        lessons: impl Iterator<Item = &'l Lesson>,
        settings: Settings,
    ) -> Result<Self, goodbot::AgentError> {
        Ok(Self::Model(Box::new(training::train(memory, lessons, settings)?)))
    }

    /// A lesson with unknown words of its command replaced by known synonyms.
    ///
    /// # Errors
    /// [`Failure::Input`] if the command is too long.
    pub fn in_known_words<'l>(&self, synonyms: Synonyms<'_>, lesson: &'l Lesson) -> Result<Cow<'l, Lesson>, Failure> {
        let language = match self {
            Self::Model(model) => model.read(),
            Self::Robot(agent) => agent.language(),
        };
        let command = in_known_words(synonyms, language, &lesson.command)?;
        Ok(if command == lesson.command { Cow::Borrowed(lesson) } else { Cow::Owned(Lesson { command, ..lesson.clone() }) })
    }

    /// The posterior over a lesson's tasks.
    ///
    /// # Errors
    /// [`Failure::Input`] if the command does not fit.
    pub fn posterior(&mut self, lesson: &Lesson) -> Result<Vec<f32>, Failure> {
        match self {
            Self::Model(model) => Ok(training::posterior(model, lesson)?),
            Self::Robot(agent) => {
                let header = &lesson.header;
                let moves = checked::moves(header.action_names()).unwrap_or(Moves::Push);
                let mut memory = home::memory();
                let (home, start) = home::build(&header.environment, moves, &mut memory)
                    .map_err(|flaw| Failure::Input(format!("{}: {}", lesson.id, flaw.message(&header.environment))))?;
                agent.hear(&home, &start, &lesson.command)?;
                let posterior = (0..agent.tasks().len()).map(|task| agent.belief().probability(task)).collect();
                agent.forget();
                Ok(posterior)
            }
        }
    }
}

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
