//! Which word of a command speaks for which task.
//!
//! For each word and task, the role model's probability of the word after those before it, under the task alone. Each word's row is then made
//! to sum to 1, so that a word that tells nothing is spread evenly.

use goodbot::Agent;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::Home;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::symbols::{Symbol, Symbols};
use goodbot::task::Tokens;
use goodbot::task::description::{Scene, describe};
use goodbot::task::is_marker;

use crate::view::Support;

/// How much each word of the command under way speaks for each task.
///
/// # Errors
/// A [`CapacityError`] where a task's machine commands are too many or too long.
pub fn support(agent: &Agent<impl AgentMemory>, home: &Home<impl HomeMemory>) -> Result<Support, CapacityError> {
    let (language, sentence) = (agent.language(), agent.sentence());
    let length = sentence.len();
    // Interning machine tokens must leave the model's own as they are.
    let (mut bytes, mut ends, mut count) = (vec![0; 4_096], vec![0; 256], 0);
    let mut own = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Tokens, Capacity::TokenBytes);
    let mut rows = vec![Vec::new(); length];
    let mut description = Tokens::new();
    for task in 0..agent.tasks().len() {
        description.clear();
        if let Some((task, start)) = agent.tasks().get(task).zip(agent.started_from(home)) {
            describe(home, agent.lifted(), task, &mut Scene::new(start), &mut own, &mut description)?;
        }
        // All values that the model does not know are alike.
        for token in description.iter_mut().filter(|token| !is_marker(**token)) {
            *token = language.tokens().find(own.read().text(*token)).unwrap_or(Symbol::new(i16::MAX as u16));
        }
        for row in &mut rows {
            row.push(0.0);
        }
        language.word_by_word(sentence, &description, |position, probability| {
            if let Some(slot) = rows.get_mut(position).and_then(|row| row.last_mut()) {
                *slot = probability;
            }
        });
    }
    Ok(spread(agent, rows))
}

/// The support, with each row scaled to sum to 1.
fn spread(agent: &Agent<impl AgentMemory>, mut rows: Vec<Vec<f32>>) -> Support {
    let (language, sentence) = (agent.language(), agent.sentence());
    let even = 1.0 / agent.tasks().len().max(1) as f32;
    for row in &mut rows {
        let whole: f32 = row.iter().sum();
        for share in row.iter_mut() {
            *share = if whole > 0.0 { *share / whole } else { even };
        }
    }
    let words = sentence.iter().map(|word| word.map_or_else(String::new, |word| language.words().text(word).to_owned())).collect();
    let known = sentence.iter().map(|word| word.is_some_and(|word| word.index() < language.tables().words())).collect();
    Support { words, known, tasks: rows }
}
