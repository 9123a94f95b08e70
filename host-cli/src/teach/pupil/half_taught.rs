//! A robot that is half taught from the start: a starter's sentences beside its own sessions, the fewer the more those are.
//!
//! The sentences are in the robot's mind alone. What is saved of it are its own sessions, as without a starter.

use goodbot::memory::AgentHeap;
use goodbot::session::Finished;
use goodbot::{Agent, Capacities};
use goodbot_console::outcome::Failure;
use goodbot_console::starter::Starter;
use goodbot_console::training_data::training;
use std::ops::Range;

/// The sentences, and where they are in a mind.
#[derive(Debug, Default)]
pub struct HalfTaught {
    starter: Starter,
    /// Their positions among the sessions of the mind.
    places: Range<usize>,
    /// The mind without them, as the bytes of a model file.
    own: Vec<u8>,
}

impl HalfTaught {
    /// A starter, which is in no mind yet.
    pub fn new(starter: Starter) -> Self {
        Self { starter, ..Self::default() }
    }

    fn is_on(&self) -> bool {
        !self.starter.lessons().is_empty()
    }

    /// Room for these capacities and the sentences together.
    pub fn room(&self, own: Capacities) -> Capacities {
        self.starter.room(own)
    }

    /// How many possible tasks the sentences have together.
    pub fn tasks(&self) -> usize {
        training::tasks(self.starter.lessons())
    }

    /// How many sentences are in the mind.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The mind without the sentences, as the bytes of a model file; `None` where there is no starter.
    pub fn own(&self) -> Option<&[u8]> {
        self.is_on().then_some(&self.own)
    }

    /// Takes the sentences into a mind that has its own sessions alone.
    pub fn join(&mut self, mind: &mut Agent<AgentHeap>) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        let own = mind.language().bitext().sessions();
        self.own = mind.saved()?;
        let joined = self.starter.join(mind, own)?;
        self.places = own..own + joined;
        Ok(())
    }

    /// The mind has learned from a session of its own, and others may have given way: it keeps fewer sentences.
    pub fn fade(&mut self, mind: &mut Agent<AgentHeap>, finished: &Finished) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        let gone = finished.gave_way.positions();
        if gone.len() < finished.gave_way.count() {
            // It is not known where the sentences are now. Those that are left stay, as sessions like all others.
            *self = Self::default();
            return Ok(());
        }
        let now = |place: usize| place - gone.iter().filter(|&&gone| usize::from(gone) < place).count();
        for place in (now(self.places.start)..now(self.places.end)).rev() {
            mind.unlearn(place as u16);
        }
        self.join(mind)
    }
}
