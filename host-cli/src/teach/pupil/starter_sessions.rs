//! A robot with a starter: it has the starter's sentences beside its own sessions. The more own sessions, the fewer sentences.
//!
//! The sentences are in the agent's memory only. Its saved model has its own sessions, as without a starter.

use goodbot::memory::AgentHeap;
use goodbot::session::Finished;
use goodbot::snapshot::Places;
use goodbot::{Agent, Capacities};
use goodbot_console::outcome::Failure;
use goodbot_console::starter::Starter;
use goodbot_console::training_data::training;

/// The sentences, and their places in the agent's training data.
#[derive(Debug, Default)]
pub struct StarterSessions {
    starter: Starter,
    places: Places,
    /// The agent without them, as the bytes of a model file.
    own: Vec<u8>,
}

impl StarterSessions {
    /// A starter that is in no agent yet.
    pub fn new(starter: Starter) -> Self {
        Self { starter, ..Self::default() }
    }

    fn is_on(&self) -> bool {
        !self.starter.lessons().is_empty()
    }

    /// Capacities for the agent's own data and the sentences.
    pub fn room(&self, own: Capacities) -> Capacities {
        self.starter.room(own)
    }

    /// The total number of possible tasks of the sentences.
    pub fn tasks(&self) -> usize {
        training::tasks(self.starter.lessons())
    }

    /// The number of sentences in the agent's training data.
    pub fn count(&self) -> usize {
        self.places.count()
    }

    /// The agent without the sentences, as the bytes of a model file; `None` without a starter.
    pub fn own(&self) -> Option<&[u8]> {
        self.is_on().then_some(&self.own)
    }

    /// Adds the sentences to an agent that has only its own sessions.
    pub fn join(&mut self, mind: &mut Agent<AgentHeap>) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        let own = mind.language().bitext().sessions();
        self.own = mind.saved()?;
        let joined = self.starter.join(mind, own)?;
        self.places = Places::last(mind, joined);
        Ok(())
    }

    /// Removes sentences after the agent has learned from a session of its own. Older sessions may have given way.
    pub fn fade(&mut self, mind: &mut Agent<AgentHeap>, finished: &Finished) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        if !self.places.find_after(finished) {
            *self = Self::default();
            return Ok(());
        }
        self.places.leave(mind);
        self.join(mind)
    }
}
