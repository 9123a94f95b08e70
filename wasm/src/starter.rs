//! The robot's starter: everyday sentences beside its own sessions. They are in its memory only: its saved model has its own sessions.

use crate::replay::with_names;
use crate::world::{MIND, ROOMS, World, build};
use goodbot::home::Moves;
use goodbot::language::LanguageModel;
use goodbot::memory::AgentHeap;
use goodbot::session::Finished;
use goodbot::snapshot::Places;
use goodbot::symbols::SymbolsRef;
use goodbot::task::{GroundedTask, LiftedTask, ground, is_marker};
use goodbot::{Agent, Capacities, Options};
use goodbot_lesson::name::description;
use goodbot_lesson::starter::{beside, sentences};
use wasm_bindgen::prelude::*;

/// A language, or none, and the places of its sentences.
#[derive(Debug, Default)]
pub(crate) struct Starter {
    language: String,
    pub(crate) places: Places,
}

impl Starter {
    /// Adds the sentences beside a mind's own sessions, and begins training. Where the mind has no room for them, it does without.
    pub(crate) fn join(&mut self, mind: &mut Agent<AgentHeap>) {
        if self.language.is_empty() {
            return;
        }
        let own = mind.language().bitext().sessions();
        let joined = model(&self.language, mind.lifted(), own).and_then(|file| mind.join(&file).ok());
        self.places = Places::last(mind, joined.unwrap_or(0));
    }

    /// Leaves fewer sentences after the mind has learned from a session of its own, and begins training.
    pub(crate) fn fade(&mut self, mind: &mut Agent<AgentHeap>, finished: &Finished) {
        if self.places.find_after(finished) {
            self.places.leave(mind);
            self.join(mind);
        } else {
            *self = Self::default();
        }
    }
}

/// The sentences to learn from beside this many own sessions, as the bytes of a model file.
fn model(language: &str, lifted: &[LiftedTask], own: usize) -> Option<Vec<u8>> {
    let memory = AgentHeap::new(&Capacities { states: 64, hashed_states: 0, ..MIND });
    let mut model = LanguageModel::new(memory, Options::DEFAULT.language).ok()?;
    for sentence in beside(&sentences(language, lifted), own) {
        let (home, start) = build(&sentence.home, Moves::Push, &ROOMS).ok()?;
        let mut tasks = vec![GroundedTask::UNUSED; MIND.tasks];
        let count = ground(&home, lifted, &start, &mut tasks).ok()?;
        let named = with_names(&home, lifted, &tasks[..count]);
        let (task, _) = named.iter().find(|(_, name)| name == sentence.intended)?;
        let words = model.lend().hear(&sentence.command).ok()?;
        let symbol =
            |tokens: SymbolsRef<'_>, token| if is_marker(token) { Ok(token) } else { model.lend().tokens_mut().intern(tokens.text(token)) };
        let command = description(&home, lifted, task, &start, symbol).ok()?;
        model.lend().add_session(&words, std::iter::once((&command[..], 1.0))).ok()?;
    }
    model.saved().ok()
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// The language of the robot's starter; empty without one.
    pub fn starter(&self) -> String {
        self.starter.language.clone()
    }

    /// Gives the robot the starter of a language, or takes it away if the language is empty or has none, and begins to train: call
    /// [`learn`](Self::learn) until it is done. A session under way ends unlearned.
    #[wasm_bindgen(js_name = setStarter)]
    pub fn set_starter(&mut self, language: &str) {
        if language == self.starter.language {
            return;
        }
        self.forget();
        let Self { starter, lesson, .. } = self;
        starter.places.leave(&mut lesson.agent);
        language.clone_into(&mut starter.language);
        starter.join(&mut lesson.agent);
    }
}
