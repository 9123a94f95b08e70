//! The learned words of an agent: for each machine token, the probability of each English word.

use goodbot::language::LanguageRef;

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
