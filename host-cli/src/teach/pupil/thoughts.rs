//! The robot's beliefs and words: the tasks, the support of each word for each task, and the words for each machine token.

use super::Pupil;
use crate::paper::lexicon::Lexicon;
use crate::teach::plain_names::{task_words, token_words};
use goodbot::language::Model;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::GroundedTask;
use goodbot_console::outcome::Failure;
use goodbot_console::training_data::evidence;
use goodbot_lesson::first_words::heard;
use goodbot_lesson::live::LiveError;

/// A task that the command may mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// Its position, which does not change during the session.
    pub position: usize,
    /// The task as in logs: `agentInRoom(agent0,room1)`.
    pub name: String,
    /// The task in everyday words: `go to the green room`.
    pub words: String,
    /// Its present probability.
    pub probability: f32,
}

/// The support of a word of the command: its share for each task. A word without information has even shares.
#[derive(Clone, Debug, PartialEq)]
pub struct WordSupport {
    /// The word as in the command.
    pub word: String,
    /// Whether the robot has learned from this word before.
    pub known: bool,
    /// Its share for each task, by position; the sum is 1.
    pub shares: Vec<f32>,
}

/// A machine token, and the robot's words for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Idea {
    /// The machine token: `roomIsRed`.
    pub token: String,
    /// The token in plain words: `room is red`.
    pub words: String,
    /// The words that the robot expects for it, the most probable first, with their probabilities.
    pub called: Vec<(String, f32)>,
}

impl Pupil {
    /// A task in everyday words.
    pub(super) fn words_of(&self, position: usize) -> Option<String> {
        let agent = &self.lesson.agent;
        let task = agent.tasks().get(position)?;
        Some(task_words(self.lesson.home(), agent.lifted().get(usize::from(task.lifted))?, task))
    }

    /// The tasks that the command may mean, the most probable first; empty without a command.
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

    /// The support of each word for each task: the probability of the word alone under the task, averaged over the task's machine commands.
    pub fn word_support(&self) -> Result<Vec<WordSupport>, Failure> {
        let command = self.lesson.command().ok_or(LiveError::NoSession)?;
        let (agent, home) = (&self.lesson.agent, self.lesson.home());
        let (language, sentence) = (agent.language(), agent.sentence());
        let learned = |word: &Option<Symbol>| word.filter(|word| word.index() < language.tables().words());
        let mut rows = vec![Vec::new(); sentence.len()];
        let start = agent.started_from(home).ok_or(LiveError::NoSession)?;
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
                // The other words keep their places in the sentence, but count as unknown.
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

    /// The words that the robot expects for each machine token, after its last training. Only the beginnings of words may be known: see
    /// [`word_letters`](Self::word_letters).
    pub fn ideas(&self) -> Vec<Idea> {
        let lexicon = Lexicon::of(self.lesson.agent.language());
        let idea = |(token, row): &(String, Vec<f32>)| {
            let called = lexicon.best(row, row.len()).into_iter().map(|(word, share)| (word.to_owned(), share)).collect();
            Idea { token: token.clone(), words: token_words(token), called }
        };
        lexicon.rows.iter().map(idea).collect()
    }

    /// How many letters of a word the robot keeps; 0 for all.
    pub fn word_letters(&self) -> usize {
        self.lesson.agent.options().language.letters_kept()
    }
}
