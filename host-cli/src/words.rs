//! Words: those of a model and of its sessions, in full, and tasks, objects and machine tokens in everyday words.

pub use goodbot_lesson::name::{in_plain_words, looks};

use crate::teach::site::Site;
use goodbot::Agent;
use goodbot::language::{LanguageRef, for_each_word, word_form};
use goodbot::memory::AgentMemory;
use goodbot::oomdp::ObjectId;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot_lesson::name::{in_words, in_words_of_file, object_in_words};
use std::collections::BTreeMap;

/// The full forms of the words that were said.
#[derive(Debug, Default)]
pub struct FullWords {
    letters: usize,
    full: BTreeMap<String, String>,
}

impl FullWords {
    /// No words yet, for a robot that keeps this many letters of a word; 0 for all.
    pub fn new(letters: usize) -> Self {
        Self { letters, full: BTreeMap::new() }
    }

    /// Adds the words of a command. The first full word for each beginning stays.
    pub fn hear(&mut self, command: &str) {
        let (letters, full) = (self.letters, &mut self.full);
        // The robot does not know a word that is too long for it.
        let _ = for_each_word(command, |word| {
            full.entry(word_form(word, letters).to_owned()).or_insert_with(|| word.to_owned());
            Ok(())
        });
    }

    /// The full form of a word; if only its beginning is known, the beginning with dots.
    pub fn of(&self, kept: &str) -> String {
        let cut = self.letters > 0 && kept.chars().count() >= self.letters;
        self.full.get(kept).cloned().unwrap_or_else(|| if cut { format!("{kept}…") } else { kept.to_owned() })
    }
}

/// A task in everyday words: `take the yellow bag to the blue room`; in a world from a file, `lamp on: red kitchen lamp`.
pub fn task_words(site: &Site, lifted: &LiftedTask, task: &GroundedTask) -> String {
    match site {
        Site::Floor(home) => in_words(home, lifted, task),
        Site::Other(robot) => in_words_of_file(robot, lifted, task),
    }
}

/// An object in everyday words.
pub fn object_words(site: &Site, id: ObjectId) -> String {
    match site {
        Site::Floor(home) => object_in_words(home, id),
        Site::Other(robot) => looks(robot, id),
    }
}

/// A machine token in plain words: `roomIsGreen` is `room is green`. A kind of task is worded as a request.
pub fn token_words(token: &str) -> String {
    match token {
        "agentInRoom" => "go to a room".to_owned(),
        "blockInRoom" => "take to a room".to_owned(),
        _ => in_plain_words(token),
    }
}

/// An action in the past tense: `went north`.
pub fn action_words(action: &str) -> String {
    match action {
        "noop" => "stayed where it is".to_owned(),
        "north" | "south" | "east" | "west" => format!("went {action}"),
        other => format!("did \"{other}\""),
    }
}

/// A probability in percent. It is 0 % or 100 % only if it is exactly that.
pub fn percent(probability: f32) -> String {
    match probability * 100.0 {
        none if none <= 0.0 => "0 %".to_owned(),
        little if little < 1.0 => "<1 %".to_owned(),
        all if all >= 100.0 => "100 %".to_owned(),
        nearly if nearly > 99.0 => ">99 %".to_owned(),
        other => format!("{other:.0} %"),
    }
}

/// Translation probabilities, with their names.
#[derive(Clone, Debug)]
pub struct Lexicon {
    /// The English words.
    pub words: Vec<String>,
    /// The machine tokens, each with its row of probabilities, one for each word.
    pub rows: Vec<(String, Vec<f32>)>,
}

impl Lexicon {
    /// The translation table of a language model.
    pub fn of(language: LanguageRef<'_>) -> Self {
        let tables = language.tables();
        let words = || language.words().iter().take(tables.words());
        let row = |token| words().map(|(word, _)| tables.translation(word, Some(token))).collect();
        Self {
            words: words().map(|(_, text)| text.to_owned()).collect(),
            rows: language.tokens().iter().take(tables.tokens()).map(|(token, text)| (text.to_owned(), row(token))).collect(),
        }
    }

    /// The same, with each cut word written in full as in these commands: `chair` for `chai`. If the agent merges several words, they are
    /// written side by side.
    pub fn written_out<'c>(mut self, commands: impl Iterator<Item = &'c str> + Clone, letters: usize) -> Self {
        if letters > 0 {
            for word in &mut self.words {
                let whole = |other: &&str| other.chars().take(letters).eq(word.chars());
                let mut known: Vec<&str> = commands.clone().flat_map(str::split_whitespace).filter(whole).collect();
                known.sort_unstable();
                known.dedup();
                if !known.is_empty() {
                    *word = known.join("/");
                }
            }
        }
        self
    }

    /// t(word | token); 0 if either is unknown.
    pub fn translation(&self, token: &str, word: &str) -> f32 {
        let column = self.words.iter().position(|known| known == word);
        let row = self.rows.iter().find(|(known, _)| known == token);
        row.zip(column).map_or(0.0, |((_, row), column)| row[column])
    }

    /// The most probable words of a row, best first.
    pub fn best(&self, row: &[f32], count: usize) -> Vec<(&str, f32)> {
        let mut words: Vec<(&str, f32)> = self.words.iter().map(String::as_str).zip(row.iter().copied()).collect();
        words.sort_by(|a, b| b.1.total_cmp(&a.1));
        words.truncate(count);
        words
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{Moves, paper_tasks};
    use goodbot::task::ground;
    use goodbot_lesson::home as homes;

    #[test]
    fn words_are_shown_as_they_were_said() {
        let mut words = FullWords::new(4);
        words.hear("Go to the yellow room");
        assert_eq!([words.of("yell"), words.of("go"), words.of("chai")], ["yellow", "go", "chai…"]);
    }

    #[test]
    fn a_probability_is_certain_only_where_it_is() {
        let shown = [0.0, 0.004, 0.5, 0.994, 0.999, 1.0].map(percent);
        assert_eq!(shown, ["0 %", "<1 %", "50 %", ">99 %", ">99 %", "100 %"]);
    }

    #[test]
    fn what_shall_not_be_is_told_as_that() {
        let rooms = homes::parse("home", "#########\n#rrr#ggg#\n#r@r+ggg#\n#rrr#ggg#\n#########\n").unwrap();
        let (home, start) = homes::build(&rooms, Moves::Push, homes::memory()).unwrap();
        let (kinds, mut tasks) = (paper_tasks().unwrap(), [GroundedTask::UNUSED; 4]);
        ground(&home, &kinds, &start, &mut tasks).unwrap();
        let (site, go) = (Site::Floor(home), tasks[0]);
        let told = [go, go.negated(&kinds[0]).unwrap()].map(|task| task_words(&site, &kinds[0], &task));
        assert_eq!(told, ["go to the green room", "stay out of the green room"]);
    }

    #[test]
    fn tokens_are_read_as_words() {
        assert_eq!(token_words("roomIsGreen"), "room is green");
        assert_eq!(token_words("block"), "block");
        assert_eq!(token_words("blockInRoom"), "take to a room");
    }
}
