//! Restores a model file as an agent, or as a language model for questions in worlds.

use crate::messages::{counted, working};
use crate::outcome::Failure;
use crate::starter::Starter;
use crate::training_data::{Lesson, training};
use crate::typed;
use crate::whole_file::read_model;
use goodbot::language::LanguageModel;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::planning::Progress;
use goodbot::snapshot::{Contents, RestoreError};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use std::path::Path;

/// The most entries of a table, whatever a file says.
const MOST_OF_A_FIELD: usize = 1 << 24;

/// From this number of sessions on, learning may take seconds.
const MANY: usize = 500;

/// An agent in a world from a file, with the model of a file. If the model was learned elsewhere, its words alone are taken along, as
/// `goodbot teach` does it.
///
/// # Errors
/// A [`Failure`] that names the file and its fault.
pub fn agent_elsewhere(file: &Path, lifted: &[LiftedTask]) -> Result<Agent<AgentHeap>, Failure> {
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| Failure::of(file, error))?;
    let memory = typed::memory(&room_for(&contents), &contents.options.language, room_for_tasks(&contents));
    let mut agent = Agent::new(memory, lifted, contents.options).map_err(|error| Failure::of(file, error))?;
    restore_or_join(&mut agent, &contents, &bytes).map_err(|error| Failure::of(file, error))?;
    learn_fully(&mut agent);
    Ok(agent)
}

/// Gives an agent the model with these contents. If the model was learned elsewhere, its words are taken along, its belief about the
/// trainer is not, and this is `false`.
///
/// # Errors
/// A [`RestoreError`] if the model does not fit.
pub fn restore_or_join(agent: &mut Agent<impl AgentMemory>, contents: &Contents<'_>, bytes: &[u8]) -> Result<bool, RestoreError> {
    let is_from_here = [0, agent.vocabulary()].contains(&contents.vocabulary);
    if is_from_here {
        agent.restore(bytes)?;
    } else {
        let _ = agent.join(&words(bytes)?)?;
    }
    Ok(is_from_here)
}

/// An agent in homes, with the model of a file and the lessons of a starter.
///
/// # Errors
/// A [`Failure`] that names the file and its fault.
pub fn agent_beside(file: &Path, lifted: &[LiftedTask], starter: &Starter) -> Result<Agent<AgentHeap>, Failure> {
    let mut agent = restored(file, &read_model(file)?, lifted, starter)?;
    let own = agent.language().bitext().sessions();
    let _ = starter.join(&mut agent, own)?;
    learn_fully(&mut agent);
    Ok(agent)
}

/// An agent without tasks with the model of a file, from homes or from any world: it hears no commands, but shows what was learned.
///
/// # Errors
/// The errors of [`agent_beside`].
pub fn model(file: &Path) -> Result<Agent<AgentHeap>, Failure> {
    agent_beside(file, &[], &Starter::default())
}

/// As [`model`], of bytes that came from a file and are not learned yet.
///
/// # Errors
/// The errors of [`agent_beside`].
pub fn agent_of(file: &Path, bytes: &[u8]) -> Result<Agent<AgentHeap>, Failure> {
    restored(file, bytes, &[], &Starter::default())
}

fn restored(file: &Path, bytes: &[u8], lifted: &[LiftedTask], starter: &Starter) -> Result<Agent<AgentHeap>, Failure> {
    let contents = Contents::read(bytes).map_err(|error| Failure::of(file, error))?;
    let tasks = room_for_tasks(&contents) + training::tasks(starter.lessons());
    let memory = typed::memory(&starter.room(room_for(&contents)), &contents.options.language, tasks);
    let mut agent = Agent::new(memory, lifted, Options::DEFAULT).map_err(|error| Failure::of(file, error))?;
    agent.restore(bytes).map_err(|error| Failure::of(file, error))?;
    Ok(agent)
}

/// Learns to the end, with a spinner if that may take seconds.
pub fn learn_fully(agent: &mut Agent<impl AgentMemory>) {
    let sessions = agent.language().bitext().sessions();
    let working = (sessions >= MANY).then(|| working(format!("learning from {}", counted(sessions, "session"))));
    agent.learn_fully();
    if let Some(working) = working {
        working.finish_and_clear();
    }
}

/// The language model of a file, for these questions. `acts` says whether a robot acts in the place of the question. `memory` is replaced by
/// memory of the right size.
///
/// # Errors
/// The errors of [`agent_beside`], and an error if the model was learned by a robot that acts, but none acts in the place of the question.
pub fn language<'m, 'q>(
    file: &Path,
    memory: &'m mut AgentHeap,
    questions: impl IntoIterator<Item = &'q Lesson>,
    acts: bool,
) -> Result<LanguageModel<&'m mut AgentHeap>, Failure> {
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| Failure::of(file, error))?;
    // Words that an acting robot learned in one world are understood in another.
    if contents.vocabulary != 0 && !acts {
        return Err(Failure::of(
            file,
            "was learned in homes, or in a world where a robot acts, and none acts here; name a model of a log of commands",
        ));
    }
    let room = room_for(&contents).plus(training::to_name_tasks(questions));
    *memory = typed::memory(&room, &contents.options.language, room_for_tasks(&contents));
    let mut model = LanguageModel::new(memory, contents.options.language).map_err(|error| Failure::of(file, error))?;
    model.restore(&bytes).map_err(|error| Failure::of(file, error))?;
    while model.lend().train(u32::MAX) == Progress::Working {}
    Ok(model)
}

/// The learned words of a model file, for a robot with other tasks: the kinds of task and the belief about trainers are left out.
///
/// # Errors
/// A [`RestoreError`] if this is no model.
pub fn words(bytes: &[u8]) -> Result<Vec<u8>, RestoreError> {
    let contents = Contents::read(bytes)?;
    let mut memory = typed::memory(&room_for(&contents), &contents.options.language, room_for_tasks(&contents));
    // The memory has room for the whole file, and its settings are valid: this cannot fail.
    let mut model = LanguageModel::new(&mut memory, contents.options.language).map_err(|_| RestoreError::NotAModel)?;
    model.restore(bytes)?;
    model.saved().map_err(|_| RestoreError::NotAModel)
}

/// The number of possible tasks to make room for: those of a model file, and those of a new robot's sessions.
pub fn room_for_tasks(contents: &Contents<'_>) -> usize {
    contents.possible.len().saturating_add(Capacities::STANDARD.pairs)
}

/// Capacities for the tables of a model file, and for more sessions.
pub fn room_for(contents: &Contents<'_>) -> Capacities {
    contents.room(Capacities::STANDARD, MOST_OF_A_FIELD)
}
