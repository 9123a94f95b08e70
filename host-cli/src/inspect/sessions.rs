//! The sessions of a model: it keeps their commands, oldest first.

use crate::teach::full_words::FullWords;
use goodbot::Agent;
use goodbot::memory::AgentMemory;

/// The command of each session.
pub fn commands(agent: &Agent<impl AgentMemory>) -> Vec<String> {
    let language = agent.language();
    let full = FullWords::new(language.settings().letters_kept());
    let text = |session: usize| {
        let words = language.bitext().sentence(session as u16).iter();
        words.map(|&word| full.of(language.words().text(word))).collect::<Vec<_>>().join(" ")
    };
    (0..language.bitext().sessions()).map(text).collect()
}
