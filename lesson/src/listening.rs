//! When a robot listens, and how it hears a recorded utterance.

use crate::walk::Listening;
use goodbot::language::Model;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Domain;
use goodbot::talk::{ClosedWords, Listened};
use goodbot::{Agent, AgentError};

/// With fewer lessons, every utterance is a command: the robot has heard too few sentences to tell commands from other talk.
pub const FEW_LESSONS: usize = 20;

/// Whether a robot can tell commands from other talk.
pub fn tells_talk(agent: &Agent<impl AgentMemory>) -> bool {
    agent.language().bitext().sessions() >= FEW_LESSONS && agent.options().language.model == Model::Roles
}

/// Begins a session with a recorded utterance.
///
/// # Errors
/// The errors of [`Agent::listen`] and [`Agent::listen_after`].
pub fn listen<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    home: &D,
    start: &D::State,
    listening: &Listening,
    closed: ClosedWords<'_>,
) -> Result<Listened, AgentError> {
    agent.resume(listening.conversation.facts);
    let listened = match listening.after {
        None => agent.listen(home, start, &listening.utterance, closed)?,
        kind => agent.listen_after(home, start, &listening.utterance, closed, kind)?,
    };
    agent.leave_out_done(home, &listened)?;
    Ok(listened)
}
