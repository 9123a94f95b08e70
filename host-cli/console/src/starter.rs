//! The option for a [starter](goodbot_lesson::starter), and its sentences as lessons.

use crate::outcome::Failure;
use crate::training_data::evidence::Witness;
use crate::training_data::{Lesson, training};
use crate::typed::name_of;
use crate::whole_file::options_of_model;
use clap::{Args, ValueEnum};
use goodbot::capacity::Capacity;
use goodbot::language::Model;
use goodbot::memory::AgentHeap;
use goodbot::snapshot::SAVED;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_formats::session::{Kind, RecordedSession, SessionHeader};
use goodbot_formats::task_text::{GroundTaskText, TaskTextError};
use goodbot_lesson::starter::{Sentence, beside, sentences};
use std::path::Path;

/// The languages of the starters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// German
    De,
    /// English
    En,
    /// Spanish
    Es,
    /// French
    Fr,
    /// Chinese
    Zh,
}

/// The option for the starter.
#[derive(Clone, Copy, Debug, Args)]
pub struct StarterOptions {
    /// Begin with everyday sentences in a language; they count less with each session of your own
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    starter: Option<Language>,
}

impl StarterOptions {
    /// Whether a starter is asked for.
    pub const fn is_given(&self) -> bool {
        self.starter.is_some()
    }

    /// The starter to add to a model file.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), and an error if the file is no model.
    pub fn of_model(&self, file: &Path, lifted: &[LiftedTask]) -> Result<Starter, Failure> {
        if self.is_given() { self.read(lifted, options_of_model(file)?) } else { Ok(Starter::default()) }
    }

    /// The starter; without the option, it has no lessons.
    ///
    /// # Errors
    /// [`Failure::Input`] for the paper's settings, and for tasks that make a sentence unreadable.
    pub fn read(&self, lifted: &[LiftedTask], options: Options) -> Result<Starter, Failure> {
        match self.starter {
            None => Ok(Starter::default()),
            Some(_) if options.language.model != Model::Roles => {
                Err(Failure::Input("--starter is not for the paper's settings; leave out --learner or --starter".to_owned()))
            }
            Some(language) => Starter::new(language, lifted, options),
        }
    }
}

/// Lessons beside the user's own: the more own lessons, the fewer of these.
#[derive(Clone, Debug, Default)]
pub struct Starter {
    lessons: Vec<Lesson>,
}

/// A sentence as a labelled session.
fn labelled(Sentence { command, home, intended }: Sentence) -> Result<RecordedSession, TaskTextError> {
    let mut header = SessionHeader::new(Kind::Labelled, home, command);
    header.set_meant(Some(&intended.parse::<GroundTaskText>()?));
    Ok(RecordedSession { header, header_line: 1, steps: vec![], answers: vec![], learn: true, end_line: 2 })
}

impl Starter {
    /// The starter in a language, for a robot with these kinds of task. Sentences of other kinds are left out.
    ///
    /// # Errors
    /// [`Failure::Input`] for tasks that make a sentence unreadable.
    pub fn new(language: Language, lifted: &[LiftedTask], options: Options) -> Result<Self, Failure> {
        let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("the starter: {error}"));
        let mut witness = Witness::new(lifted, options, None).map_err(|error| fault(&error))?;
        let lesson = |sentence| Ok(witness.lesson("starter", &labelled(sentence).map_err(|error| fault(&error))?)?);
        let lessons = sentences(&name_of(language), lifted).into_iter().map(lesson).collect::<Result<_, Failure>>()?;
        Ok(Self { lessons })
    }

    /// All its lessons.
    pub fn lessons(&self) -> &[Lesson] {
        &self.lessons
    }

    /// The lessons to learn from beside this many own ones, taken evenly from all.
    pub fn beside(&self, own: usize) -> impl Iterator<Item = &Lesson> {
        beside(&self.lessons, own)
    }

    /// These capacities, plus room for all its lessons.
    pub fn room(&self, own: Capacities) -> Capacities {
        if self.lessons.is_empty() {
            return own;
        }
        let (needed, mut both) = (training::capacities(&self.lessons, Capacities::NONE), own);
        for capacity in SAVED {
            both.set(capacity, own.get(capacity).saturating_add(needed.get(capacity)));
        }
        both.translations = both.translations.max((both.tokens + 1).saturating_mul(both.words));
        both.set(Capacity::Alignments, both.alignments.max(needed.alignments));
        both
    }

    /// Adds the lessons beside this many own ones to an agent's training data, and begins training. Returns how many were added; lessons
    /// that the agent has already are not.
    ///
    /// # Errors
    /// [`Failure::Input`] if the agent has no room, or has another language model.
    pub fn join(&self, agent: &mut Agent<AgentHeap>, own: usize) -> Result<usize, Failure> {
        if self.lessons.is_empty() {
            return Ok(0);
        }
        let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("the starter: {error}"));
        let settings = agent.options().language;
        let mut memory = training::memory(&self.lessons, &settings);
        let data = training::data(&mut memory, self.beside(own), settings).map_err(|error| fault(&error))?;
        let file = data.saved().map_err(|error| fault(&error))?;
        agent.join(&file).map_err(|error| fault(&error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::paper_tasks;

    #[test]
    fn each_sentence_is_a_lesson_with_one_meaning() {
        for language in Language::value_variants() {
            let starter = Starter::new(*language, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
            assert!(!starter.lessons().is_empty() && starter.lessons().iter().all(|lesson| lesson.learn && lesson.pairs.len() == 1));
        }
        assert_eq!(Starter::default().beside(0).count(), 0);
    }
}
