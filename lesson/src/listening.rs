//! When a robot that is taught expects new words, and how it hears a recorded utterance.

use crate::walk::Listening;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Domain;
use goodbot::talk::{ClosedWords, Listened};
use goodbot::{Agent, AgentError};
use std::collections::BTreeMap;

/// The share of new words in commands from which on a trainer's words are tried, even if the robot takes them for nothing that it can do.
const MANY_NEW: f32 = 0.1;

/// Whether the next command may well have words that no lesson had, by the words that the lessons have once (the Good-Turing estimate).
/// What the robot takes for nothing is then more probably a command in new words. To try it costs a punishment, and teaches them.
pub fn expects_new_words(agent: &Agent<impl AgentMemory>) -> bool {
    let bitext = agent.language().bitext();
    let mut times: BTreeMap<usize, u32> = BTreeMap::new();
    (0..bitext.sessions() as u16)
        .flat_map(|session| bitext.sentence(session))
        .for_each(|word| *times.entry(word.index()).or_default() += 1);
    let (once, all) = (times.values().filter(|&&times| times == 1).count(), times.values().sum::<u32>());
    (once as f32 + 2.0) / (all as f32 + 2.0) >= MANY_NEW
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
