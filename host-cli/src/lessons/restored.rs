//! A model file as an agent that can be asked.

use crate::outcome::Failure;
use crate::whole_file::read_whole;
use goodbot::snapshot::Contents;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use std::path::Path;

/// An agent that knows what a model file knows.
///
/// # Errors
/// A [`Failure`] that names the file and what is wrong with it.
pub fn agent(file: &Path, lifted: &[LiftedTask]) -> Result<Agent<'static>, Failure> {
    let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", file.display()));
    let bytes = read_whole(file)?;
    let contents = Contents::read(&bytes).map_err(|error| fault(&error))?;
    let capacities = room_for(&contents);
    // One for the whole run of the program.
    let memory = Box::leak(Box::new(HeapMemory::new(&capacities)));
    let mut agent = Agent::new(memory.split().agent, lifted, Options::DEFAULT).map_err(|error| fault(&error))?;
    agent.restore(&bytes).map_err(|error| fault(&error))?;
    agent.learn_fully();
    Ok(agent)
}

/// Memory for a robot that has learned what a model file holds, and room for more.
pub fn room_for(contents: &Contents<'_>) -> Capacities {
    let (sizes, least) = (&contents.sizes, Capacities::STANDARD);
    let most = |least: usize, size: u32| least.max((size as usize).min(1 << 24));
    Capacities {
        words: most(least.words, sizes.words),
        word_bytes: most(least.word_bytes, sizes.word_bytes),
        tokens: most(least.tokens, sizes.tokens),
        token_bytes: most(least.token_bytes, sizes.token_bytes),
        commands: most(least.commands, sizes.commands),
        command_tokens: most(least.command_tokens, sizes.command_tokens),
        sessions: most(least.sessions, sizes.sessions),
        sentence_words: most(least.sentence_words, sizes.sentence_words),
        pairs: most(least.pairs, sizes.pairs),
        translations: most(least.translations, sizes.translations),
        alignments: most(least.alignments, sizes.alignments),
        length_pairs: most(least.length_pairs, sizes.length_pairs),
        ..least
    }
}
