//! A model file as an agent that can be asked.

use crate::learner;
use crate::outcome::Failure;
use crate::whole_file::read_model;
use goodbot::memory::AgentHeap;
use goodbot::snapshot::{Contents, SAVED};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use std::path::Path;

/// The most that any table may hold, whatever a file says.
const MOST_OF_A_FIELD: usize = 1 << 24;

/// An agent that knows what a model file knows.
///
/// # Errors
/// A [`Failure`] that names the file and what is wrong with it.
pub fn agent(file: &Path, lifted: &[LiftedTask]) -> Result<Agent<AgentHeap>, Failure> {
    let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", file.display()));
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| fault(&error))?;
    let memory = learner::memory(&room_for(&contents), &contents.options.language, contents.possible.len());
    let mut agent = Agent::new(memory, lifted, Options::DEFAULT).map_err(|error| fault(&error))?;
    agent.restore(&bytes).map_err(|error| fault(&error))?;
    agent.learn_fully();
    Ok(agent)
}

/// Room for what a model file holds, and for more.
pub fn room_for(contents: &Contents<'_>) -> Capacities {
    let mut most = Capacities::STANDARD;
    for capacity in SAVED {
        most.set(capacity, MOST_OF_A_FIELD);
    }
    Capacities::STANDARD.at_least(contents.sizes.at_most(most))
}
