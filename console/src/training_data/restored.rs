//! A model file as an agent that can be asked, or as a language model where it was learned in worlds from files.

use crate::learner;
use crate::messages::{counted, working};
use crate::outcome::Failure;
use crate::starter::Starter;
use crate::training_data::training;
use crate::whole_file::read_model;
use goodbot::language::LanguageModel;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::planning::Progress;
use goodbot::snapshot::{Contents, RestoreError, SAVED};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use std::path::Path;

/// The most that any table may hold, whatever a file says.
const MOST_OF_A_FIELD: usize = 1 << 24;

/// From this many sessions on, learning may take seconds.
const MANY: usize = 500;

/// An agent that knows what a model file knows.
///
/// # Errors
/// A [`Failure`] that names the file and what is wrong with it.
pub fn agent(file: &Path, lifted: &[LiftedTask]) -> Result<Agent<AgentHeap>, Failure> {
    agent_beside(file, lifted, &Starter::default())
}

/// The same, which also knows what a starter says. An empty starter says nothing.
///
/// # Errors
/// As [`agent`].
pub fn agent_beside(file: &Path, lifted: &[LiftedTask], starter: &Starter) -> Result<Agent<AgentHeap>, Failure> {
    let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", file.display()));
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| fault(&error))?;
    let tasks = room_for_tasks(&contents) + training::tasks(starter.lessons());
    let memory = learner::memory(&starter.room(room_for(&contents)), &contents.options.language, tasks);
    let mut agent = Agent::new(memory, lifted, Options::DEFAULT).map_err(|error| fault(&error))?;
    agent.restore(&bytes).map_err(|error| fault(&error))?;
    let own = agent.language().bitext().sessions();
    let _ = starter.join(&mut agent, own)?;
    learn_fully(&mut agent);
    Ok(agent)
}

/// Learns to the end, and tells that it goes on where that takes a while.
pub fn learn_fully(agent: &mut Agent<impl AgentMemory>) {
    let sessions = agent.language().bitext().sessions();
    let working = (sessions >= MANY).then(|| working(format!("learning from {}", counted(sessions, "session"))));
    agent.learn_fully();
    if let Some(working) = working {
        working.finish_and_clear();
    }
}

/// How a model file's robot understands and learns.
///
/// # Errors
/// As [`agent`].
pub fn options(file: &Path) -> Result<Options, Failure> {
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| Failure::Input(format!("{}: {error}", file.display())))?;
    Ok(contents.options)
}

/// The language model of a file. `acts` says whether a robot acts where it is asked. Its memory is made in place of `memory`.
///
/// # Errors
/// As [`agent`], and where the file was learned by a robot that acts, and no robot acts where it is asked.
pub fn language<'m>(file: &Path, memory: &'m mut AgentHeap, acts: bool) -> Result<LanguageModel<&'m mut AgentHeap>, Failure> {
    let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", file.display()));
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| fault(&error))?;
    // What a robot that acts has learned in one world is understood in another.
    if contents.vocabulary != 0 && !acts {
        return Err(fault(
            &"was learned in homes, or in a world where a robot acts, and none acts here; name a model of a log of commands",
        ));
    }
    *memory = learner::memory(&room_for(&contents), &contents.options.language, room_for_tasks(&contents));
    let mut model = LanguageModel::new(memory, contents.options.language).map_err(|error| fault(&error))?;
    model.restore(&bytes).map_err(|error| fault(&error))?;
    while model.train(u32::MAX) == Progress::Working {}
    Ok(model)
}

/// The words of a model file, for a robot of other tasks: all but the tasks that they were learned for, and what is believed of trainers.
///
/// # Errors
/// Where this is no model.
pub fn words(bytes: &[u8]) -> Result<Vec<u8>, RestoreError> {
    let contents = Contents::read(bytes)?;
    let mut memory = learner::memory(&room_for(&contents), &contents.options.language, room_for_tasks(&contents));
    // Here is room for all that the file holds, and its settings were found sound.
    let mut model = LanguageModel::new(&mut memory, contents.options.language).map_err(|_| RestoreError::NotAModel)?;
    model.restore(bytes)?;
    model.saved().map_err(|_| RestoreError::NotAModel)
}

/// For how many possible tasks there is to be room: for those of a model file, and for those of as many sessions as a new robot keeps.
pub fn room_for_tasks(contents: &Contents<'_>) -> usize {
    contents.possible.len().saturating_add(Capacities::STANDARD.pairs)
}

/// Room for what a model file holds, and for more.
pub fn room_for(contents: &Contents<'_>) -> Capacities {
    let mut most = Capacities::STANDARD;
    for capacity in SAVED {
        most.set(capacity, MOST_OF_A_FIELD);
    }
    Capacities::STANDARD.at_least(contents.sizes.at_most(most))
}
