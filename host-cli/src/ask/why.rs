//! Word by word: what speaks for a task.
//!
//! All that is said of single words comes from [`words`]: another language model needs another function here and nothing else.

use crate::lessons::{evidence, training};
use goodbot::language::tokenizer::for_each_word;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Domain;
use goodbot::symbols::Symbol;
use goodbot::{Agent, AgentError};

/// How a word was explained.
#[derive(Clone, Debug)]
pub struct Word {
    /// The word as it was said.
    pub word: String,
    /// The machine token that explains it best, `NULL` for none.
    pub token: String,
    /// How much of the word's probability that token has.
    pub share: f32,
    /// The word's probability given the task; nothing for a word never heard.
    pub probability: Option<f32>,
}

/// The words of the command that the agent heard last, each with the machine token that explains it best in the task's most likely machine
/// command.
///
/// # Errors
/// An [`AgentError`] where the task has no room.
pub fn words<D: Domain>(agent: &Agent<impl AgentMemory>, domain: &D, command: &str, task: usize) -> Result<Vec<Word>, AgentError> {
    let Some(grounded) = agent.tasks().get(task) else { return Ok(vec![]) };
    let Some(lifted) = agent.lifted().get(usize::from(grounded.lifted)) else { return Ok(vec![]) };
    let language = agent.language();
    let find = |command: &Vec<String>| -> Option<Vec<Symbol>> { command.iter().map(|token| language.tokens().find(token)).collect() };
    let commands: Vec<Vec<Symbol>> = evidence::commands(domain, lifted, grounded, agent.options())?.iter().filter_map(find).collect();
    let sentence = agent.sentence();
    let likelier = |best: Option<Vec<Symbol>>, command: Vec<Symbol>| match best {
        Some(best) if !language.likelihood(sentence, &command).exceeds(language.likelihood(sentence, &best)) => Some(best),
        _ => Some(command),
    };
    let Some(best) = commands.into_iter().fold(None, likelier) else { return Ok(vec![]) };
    let said = said(command);
    let word = |(position, it): (usize, training::Explained)| Word {
        word: said.get(position).cloned().unwrap_or(it.word),
        token: if it.probability.is_some() { it.token } else { "never heard".to_owned() },
        share: it.share,
        probability: it.probability,
    };
    Ok(training::explained(language, sentence, &best).into_iter().enumerate().map(word).collect())
}

/// The words of a command, whole.
pub fn said(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    // What is too long was refused when it was heard.
    let _ = for_each_word(command, |word| {
        words.push(word.to_owned());
        Ok(())
    });
    words
}
