//! What the robot thinks: the tasks, which word speaks for which, and what it calls things.

use super::{Pupil, no_session};
use crate::teach::plain_names::{task_words, token_words};
use goodbot::language::Model;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::GroundedTask;
use goodbot_console::outcome::Failure;
use goodbot_console::training_data::evidence;
use goodbot_lesson::first_words::heard;

/// A task that the command may mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// Its position, which stays for the session.
    pub position: usize,
    /// As logs write it: `agentInRoom(agent0,room1)`.
    pub name: String,
    /// As a person says it: `go to the green room`.
    pub words: String,
    /// How probable it is now.
    pub probability: f32,
}

/// What a word of the command said: for each task, its share of the word. A word that tells nothing is spread evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct WordSupport {
    /// The word as it was said.
    pub word: String,
    /// Whether it was learned from before.
    pub known: bool,
    /// For each task, by position, its share; together 1.
    pub shares: Vec<f32>,
}

/// What the robot calls one idea.
#[derive(Clone, Debug, PartialEq)]
pub struct Idea {
    /// The machine token: `roomIsRed`.
    pub token: String,
    /// In plain words: `room is red`.
    pub words: String,
    /// The words that it expects for it, the likeliest first, with their probabilities.
    pub called: Vec<(String, f32)>,
}

impl Pupil {
    /// A task as a person says it.
    pub(super) fn words_of(&self, position: usize) -> Option<String> {
        let agent = &self.lesson.agent;
        let task = agent.tasks().get(position)?;
        Some(task_words(self.lesson.home(), agent.lifted().get(usize::from(task.lifted))?, task))
    }

    /// The tasks that the command may mean, the likeliest first. None where no command was heard.
    pub fn meanings(&self) -> Vec<Meaning> {
        let agent = &self.lesson.agent;
        let tasks = if self.lesson.is_under_way() { agent.tasks() } else { &[] };
        let named = |(position, task): (usize, &GroundedTask)| {
            let lifted = agent.lifted().get(usize::from(task.lifted))?;
            let name = self.lesson.name_of(position)?.to_string();
            Some(Meaning {
                position,
                name,
                words: task_words(self.lesson.home(), lifted, task),
                probability: agent.belief().probability(position),
            })
        };
        let mut meanings: Vec<Meaning> = tasks.iter().enumerate().filter_map(named).collect();
        meanings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        meanings
    }

    /// Which word of the command speaks for which task: for each word and task, how probable the word alone is under the task, the mean
    /// over the task's machine commands.
    pub fn word_support(&self) -> Result<Vec<WordSupport>, Failure> {
        let command = self.lesson.command().ok_or_else(no_session)?;
        let (agent, home) = (&self.lesson.agent, self.lesson.home());
        let (language, sentence) = (agent.language(), agent.sentence());
        let learned = |word: &Option<Symbol>| word.filter(|word| word.index() < language.tables().words());
        let mut rows = vec![Vec::new(); sentence.len()];
        let Some(start) = agent.started_from(home) else { return Err(no_session()) };
        for task in agent.tasks() {
            let commands = evidence::commands(home, agent.lifted(), task, &start, agent.options())?;
            if agent.options().language.model == Model::Roles {
                let description = commands.first().map(|command| evidence::description_symbols(language, command)).unwrap_or_default();
                rows.iter_mut().for_each(|row| row.push(Scaled::ZERO));
                language.word_by_word(sentence, &description, |position, probability| {
                    if let Some(slot) = rows.get_mut(position).and_then(|row| row.last_mut()) {
                        *slot = Scaled::new(probability);
                    }
                });
                continue;
            }
            let find = |command: &Vec<String>| command.iter().map(|token| language.tokens().find(token)).collect::<Option<Vec<_>>>();
            let commands: Vec<Vec<Symbol>> = commands.iter().filter_map(find).collect();
            for (at, row) in rows.iter_mut().enumerate() {
                // A word that is left out keeps its place in the sentence and says nothing.
                let alone: Vec<Option<Symbol>> =
                    sentence.iter().enumerate().map(|(other, word)| if other == at { *word } else { None }).collect();
                let sum = commands.iter().fold(Scaled::ZERO, |sum, command| sum.plus(language.likelihood(&alone, command)));
                row.push(sum.scaled_by(1.0 / commands.len().max(1) as f32));
            }
        }
        let said = heard(agent.options().language.model, command)?;
        let support = |((word, row), heard): ((String, Vec<Scaled>), &Option<Symbol>)| {
            let whole = total(row.iter().copied());
            let even = 1.0 / row.len().max(1) as f32;
            let shares = row.iter().map(|&part| if whole.is_zero() { even } else { part.over(whole) }).collect();
            WordSupport { word, known: learned(heard).is_some(), shares }
        };
        Ok(said.into_iter().zip(rows).zip(sentence.iter()).map(support).collect())
    }

    /// What the robot calls things, as it was last learned: for each idea the words that it expects. Only beginnings of words may be known:
    /// see [`word_letters`](Self::word_letters).
    pub fn ideas(&self) -> Vec<Idea> {
        let language = self.lesson.agent.language();
        let tables = language.tables();
        let idea = |(token, text): (Symbol, &str)| {
            let words = language.words().iter().take(tables.words());
            let mut called: Vec<(String, f32)> =
                words.map(|(word, text)| (text.to_owned(), tables.translation(word, Some(token)))).collect();
            called.sort_by(|a, b| b.1.total_cmp(&a.1));
            Idea { token: text.to_owned(), words: token_words(text), called }
        };
        language.tokens().iter().take(tables.tokens()).map(idea).collect()
    }

    /// How many letters of a word the robot keeps; all of them where it is 0.
    pub fn word_letters(&self) -> usize {
        self.lesson.agent.options().language.letters_kept()
    }
}
