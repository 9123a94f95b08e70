//! The learners that are compared.

use clap::ValueEnum;
use goodbot::capacity::CapacityError;
use goodbot::home::Moves;
use goodbot::language::{LanguageModel, Model, Settings, Synonyms};
use goodbot::memory::AgentHeap;
use goodbot::task::TokenOrder;
use goodbot::{Agent, Options};
use goodbot_console::learner::Learner;
use goodbot_console::load::synonyms::in_known_words;
use goodbot_console::outcome::Failure;
use goodbot_console::training_data::training;
use goodbot_console::training_data::{Lesson, MachineCommand};
use goodbot_lesson::first_words::heard;
use goodbot_lesson::{checked, home};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// The language models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// The best for people's commands: the role model, and a layer above it that learns more from many sessions
    #[default]
    Default,
    /// The role model alone, as on boards, in C and on the page
    Roles,
    /// Model 2, smoothed
    Smoothed,
    /// Model 2 with the paper's settings
    #[value(alias = "ibm2")]
    Paper,
    /// Each machine command has words of its own: naive Bayes, no alignment
    BagOfWords,
}

impl Method {
    /// Its settings: the same as those of a learner of that name in `goodbot learn`.
    pub const fn options(self) -> Options {
        match self {
            Self::Default => Learner::Default.options(),
            Self::Roles => Learner::Roles.options(),
            Self::Smoothed => Options::SMOOTHED,
            Self::Paper | Self::BagOfWords => Learner::Paper.options(),
        }
    }
}

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
    let role_models = [("default", Method::Default.options()), ("roles", Method::Roles.options())];
    role_models.into_iter().chain(model_2.map(|(name, language)| (name, Options { language, ..Options::PAPER }))).collect()
}

/// A trained model.
pub enum Trained<'m> {
    /// Model 2.
    Model2(Box<LanguageModel<&'m mut AgentHeap>>),
    /// The word counts of each machine command.
    Bags(Bags),
    /// A robot with a trained model.
    Robot(Box<Agent<AgentHeap>>),
}

impl<'m> Trained<'m> {
    /// Trains on lessons.
    ///
    /// # Errors
    /// An [`AgentError`](goodbot::AgentError).
    pub fn on<'l>(
        method: Method,
        memory: &'m mut AgentHeap,
        lessons: impl Iterator<Item = &'l Lesson>,
        settings: Settings,
    ) -> Result<Self, goodbot::AgentError> {
        Ok(match method {
            Method::BagOfWords => Self::Bags(Bags::of(lessons, settings.smoothing)?),
            Method::Default | Method::Roles | Method::Smoothed | Method::Paper => {
                Self::Model2(Box::new(training::train(memory, lessons, settings)?))
            }
        })
    }

    /// A lesson with unknown words of its command replaced by known synonyms.
    ///
    /// # Errors
    /// [`Failure::Input`] if the command is too long.
    pub fn in_known_words<'l>(&self, synonyms: Synonyms<'_>, lesson: &'l Lesson) -> Result<Cow<'l, Lesson>, Failure> {
        let language = match self {
            Self::Model2(model) => model.read(),
            Self::Robot(agent) => agent.language(),
            Self::Bags(_) => return Ok(Cow::Borrowed(lesson)),
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
            Self::Model2(model) => Ok(training::posterior(model, lesson)?),
            Self::Bags(bags) => Ok(bags.posterior(lesson)?),
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

/// Naive Bayes: how often each word goes with each machine command.
pub struct Bags {
    counts: BTreeMap<MachineCommand, (f32, BTreeMap<String, f32>)>,
    words: BTreeSet<String>,
    smoothing: f32,
}

impl Bags {
    fn of<'l>(lessons: impl Iterator<Item = &'l Lesson>, smoothing: f32) -> Result<Self, CapacityError> {
        let mut bags = Self { counts: BTreeMap::new(), words: BTreeSet::new(), smoothing };
        for lesson in lessons.filter(|lesson| lesson.learn) {
            let words = heard(Model::Model2, &lesson.command)?;
            bags.words.extend(words.iter().cloned());
            for (command, share) in &lesson.pairs {
                let (whole, counts) = bags.counts.entry(command.clone()).or_default();
                for word in &words {
                    *whole += share;
                    *counts.entry(word.clone()).or_default() += share;
                }
            }
        }
        Ok(bags)
    }

    fn posterior(&self, lesson: &Lesson) -> Result<Vec<f32>, CapacityError> {
        let words = heard(Model::Model2, &lesson.command)?;
        let size = self.words.len() as f32;
        let likelihood = |command: &MachineCommand| {
            let bag = self.counts.get(command);
            let each = |word: &String| {
                let (whole, count) = bag.map_or((0.0, 0.0), |(whole, counts)| (*whole, counts.get(word).copied().unwrap_or(0.0)));
                f64::from((count + self.smoothing) / (whole + self.smoothing * size))
            };
            words.iter().filter(|word| self.words.contains(*word)).map(each).product::<f64>()
        };
        let score = |reading: &goodbot_console::training_data::Reading| {
            let sum: f64 = reading.commands.iter().map(likelihood).sum();
            f64::from(reading.prior) * sum / reading.commands.len().max(1) as f64
        };
        let scores: Vec<f64> = lesson.readings.iter().map(score).collect();
        let whole: f64 = scores.iter().sum();
        Ok(scores.into_iter().map(|score| (score / whole) as f32).collect())
    }
}
