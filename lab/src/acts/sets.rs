//! Sets of sentences with their meanings.

use goodbot_console::outcome::Failure;
use std::path::{Path, PathBuf};

/// A set of sentences, said to one robot in one home.
#[derive(Clone, Debug)]
pub struct Set {
    /// Who wrote them.
    pub author: String,
    /// Their language.
    pub language: String,
    /// The robot's model.
    pub model: PathBuf,
    /// The home.
    pub home: PathBuf,
    /// The file of the sentences.
    pub file: PathBuf,
    /// The sentences.
    pub sentences: Vec<Sentence>,
}

/// A sentence with its meaning.
#[derive(Clone, Debug)]
pub struct Sentence {
    /// Its kind, such as `polite`.
    pub kind: String,
    /// Its words.
    pub words: String,
    /// What was said and followed before.
    pub before: Option<String>,
    /// The meanings, each of which is right; none if nothing is to be done now.
    pub meanings: Vec<Meaning>,
}

/// Tasks, as in files.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// The tasks.
    pub tasks: Vec<String>,
    /// Whether their order counts.
    pub is_ordered: bool,
}

impl Set {
    /// Whether a robot reads the sentences of both in the same way.
    pub fn reads_as(&self, other: &Self) -> bool {
        self.language == other.language && [&self.model, &self.home, &self.file] == [&other.model, &other.home, &other.file]
    }
}

impl Meaning {
    /// What is left to do if these tasks are so already.
    pub fn left(&self, so: &[String]) -> Self {
        Self { tasks: self.tasks.iter().filter(|task| !so.contains(task)).cloned().collect(), ..*self }
    }
}

/// Reads a list of sets.
///
/// # Errors
/// The file and line at fault.
pub fn read(list: &Path) -> Result<Vec<Set>, Failure> {
    let folder = list.parent().unwrap_or(Path::new("."));
    let mut sets = Vec::new();
    for (at, columns) in rows(list, 5)? {
        let [author, language, model, home, sentences] = columns.as_slice() else { continue };
        let file = folder.join(sentences);
        let mut of_file = Vec::new();
        for (_, columns) in rows(&file, 3)? {
            let [kind, words, meaning] = columns.as_slice() else { continue };
            let (before, words) =
                words.split_once(" ||| ").map_or((None, words.as_str()), |(before, words)| (Some(before.trim().to_owned()), words));
            of_file.push(Sentence { kind: kind.clone(), words: words.trim().to_owned(), before, meanings: meanings(meaning) });
        }
        if of_file.is_empty() {
            return Err(Failure::Input(format!("{}:{at}: {} has no sentences", list.display(), file.display())));
        }
        let [author, language] = [author, language].map(String::clone);
        sets.push(Set { author, language, model: folder.join(model), home: folder.join(home), file, sentences: of_file });
    }
    Ok(sets)
}

/// The columns of each line, with its number.
fn rows(file: &Path, count: usize) -> Result<Vec<(usize, Vec<String>)>, Failure> {
    let text = std::fs::read_to_string(file).map_err(|error| Failure::Input(format!("{}: {error}", file.display())))?;
    let mut rows = Vec::new();
    for (at, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#')) {
        let columns: Vec<String> = line.split('\t').map(str::to_owned).collect();
        if columns.len() != count {
            let message =
                format!("{}:{}: has {} columns, and {count} are needed; part them by tabs", file.display(), at + 1, columns.len());
            return Err(Failure::Input(message));
        }
        rows.push((at + 1, columns));
    }
    Ok(rows)
}

fn meanings(text: &str) -> Vec<Meaning> {
    let meaning = |text: &str| {
        let is_ordered = !text.contains(" and ");
        let tasks = text.split(if is_ordered { " then " } else { " and " }).map(|task| task.trim().to_owned()).collect();
        Meaning { tasks, is_ordered }
    };
    if text.trim() == "none" { vec![] } else { text.split(" or ").map(meaning).collect() }
}
