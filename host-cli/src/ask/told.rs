//! Commands in worlds without actions. No robot acts there, so none listens either: the words alone give each task its probability, and
//! whether it is a command stays open.

use super::{AskOptions, end, tell_refused, unread_words, why};
use goodbot::Capacities;
use goodbot::language::{LanguageModel, LanguageRef, Synonyms};
use goodbot::memory::AgentHeap;
use goodbot_console::load::words::in_known_words;
use goodbot_console::{Failure, Lesson, Printed, counted, restored, training};
use goodbot_lesson::first_words::{heard, read};
use serde_json::json;
use std::io::Write;

/// The most meanings that are printed.
const TOLD: usize = 10;

/// A command, or a refused command with the reason.
pub type Told = Result<Lesson, (String, String)>;

/// Answers the commands.
///
/// # Errors
/// [`Failure`].
pub fn ask(options: &AskOptions, commands: &[Told]) -> Result<(), Failure> {
    let mut memory = AgentHeap::new(&Capacities::NONE);
    let mut model = restored::language(&options.with, &mut memory, commands.iter().flatten(), false)?;
    let synonyms = options.synonyms.read()?;
    let mut out = Printed::stdout();
    let mut refused = 0_usize;
    for (number, lesson) in commands.iter().enumerate() {
        let lesson = match lesson {
            Ok(lesson) => lesson,
            Err((command, message)) => {
                refused += 1;
                tell_refused(&mut out, options, command, message)?;
                continue;
            }
        };
        let meanings = meanings(&mut model, synonyms, lesson)?;
        let Some((best, _)) = meanings.first() else { continue };
        let told = meanings.iter().take(TOLD);
        let said = &lesson.header.command;
        let unread = read(said).ok().and_then(|read| read.long()).map(|long| long.unread());
        if options.json {
            let tasks: serde_json::Map<_, _> = told.map(|(name, share)| (name.clone(), json!(share))).collect();
            let mut line = json!({
                "type": "answer", "command": said, "task": best, "tasks": tasks, "of": meanings.len(), "verdict": "unsure",
            });
            if let Some(unread) = unread {
                line["unread"] = unread.into();
            }
            writeln!(out, "{line}")?;
            continue;
        }
        if number > 0 {
            writeln!(out)?;
        }
        writeln!(out, "\"{}\"", said.escape_debug())?;
        for (name, share) in told {
            writeln!(out, "  {share:6.3}  {name}")?;
        }
        for line in new_words(model.read(), said) {
            writeln!(out, "{line}")?;
        }
        if unread.is_some() {
            writeln!(out, "{}", unread_words())?;
        }
        writeln!(out, "unsure: {best}, of {}", counted(meanings.len(), "task"))?;
    }
    out.flush()?;
    end(refused, commands.len())
}

/// What is told of the words that no lesson had.
fn new_words(language: LanguageRef<'_>, said: &str) -> Vec<String> {
    let words = heard(language.settings().model, said).unwrap_or_default();
    let taken_for: Vec<Option<String>> = words.iter().map(|word| why::taken_for(language, word)).collect();
    why::new_words(words.iter().zip(&taken_for).map(|(word, taken_for)| (word.as_str(), !language.knows(word), taken_for.as_deref())))
}

/// The tasks that a command may mean, the most probable first, with their probabilities.
fn meanings(model: &mut LanguageModel<&mut AgentHeap>, synonyms: Synonyms<'_>, lesson: &Lesson) -> Result<Vec<(String, f32)>, Failure> {
    let heard = in_known_words(synonyms, model.read(), &lesson.command)?;
    let posterior = training::posterior(model, &Lesson { command: heard, ..lesson.clone() })?;
    let mut meanings: Vec<(String, f32)> =
        lesson.readings.iter().zip(&posterior).map(|(reading, &share)| (reading.name.to_string(), share)).collect();
    meanings.sort_by(|a, b| b.1.total_cmp(&a.1));
    Ok(meanings)
}
