//! The command that is being written.

use super::keys::Edit;

/// The longest command, in letters.
const MOST_LETTERS: usize = 400;

/// The command that is being written, and the commands before it.
#[derive(Clone, Debug, Default)]
pub struct Prompt {
    letters: Vec<char>,
    cursor: usize,
    said: Vec<String>,
    /// How many commands back the recalled one is; 0 for none.
    back: usize,
}

impl Prompt {
    /// The text.
    pub fn text(&self) -> String {
        self.letters.iter().collect()
    }

    /// The text before the cursor.
    pub fn before(&self) -> String {
        self.letters.iter().take(self.cursor).collect()
    }

    /// Whether the text is empty.
    pub fn is_empty(&self) -> bool {
        self.letters.is_empty()
    }

    /// Replaces the text.
    pub fn set(&mut self, text: &str) {
        self.letters = text.chars().filter(|letter| !letter.is_control()).take(MOST_LETTERS).collect();
        self.cursor = self.letters.len();
        self.back = 0;
    }

    /// Writes a letter.
    pub fn write(&mut self, letter: char) {
        if !letter.is_control() && self.letters.len() < MOST_LETTERS {
            self.letters.insert(self.cursor, letter);
            self.cursor += 1;
        }
    }

    /// Moves the text to the commands before.
    pub fn said(&mut self) {
        let text = self.text();
        if self.said.last() != Some(&text) {
            self.said.push(text);
        }
        self.set("");
    }

    /// Edits the text, or moves the cursor.
    pub fn edit(&mut self, edit: Edit) {
        match edit {
            Edit::Back if self.cursor > 0 => {
                self.cursor -= 1;
                self.letters.remove(self.cursor);
            }
            Edit::Delete if self.cursor < self.letters.len() => drop(self.letters.remove(self.cursor)),
            Edit::Word => {
                let before = self.before();
                let kept = before.trim_end().rfind(' ').map_or(0, |at| before[..=at].chars().count());
                self.letters.drain(kept..self.cursor);
                self.cursor = kept;
            }
            Edit::All => self.set(""),
            Edit::Left => self.cursor = self.cursor.saturating_sub(1),
            Edit::Right => self.cursor = (self.cursor + 1).min(self.letters.len()),
            Edit::Home => self.cursor = 0,
            Edit::End => self.cursor = self.letters.len(),
            Edit::Older => self.recall(self.back + 1),
            Edit::Newer => self.recall(self.back.saturating_sub(1)),
            Edit::Back | Edit::Delete => {}
        }
    }

    fn recall(&mut self, back: usize) {
        if back == 0 {
            self.set("");
        } else if let Some(text) = self.said.len().checked_sub(back).and_then(|at| self.said.get(at)).cloned() {
            self.set(&text);
            self.back = back;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str) -> Prompt {
        let mut prompt = Prompt::default();
        text.chars().for_each(|letter| prompt.write(letter));
        prompt
    }

    #[test]
    fn words_and_letters_are_erased_where_the_cursor_is() {
        let mut prompt = written("go to the réd  ");
        prompt.edit(Edit::Word);
        assert_eq!(prompt.text(), "go to the ");
        prompt.edit(Edit::Home);
        prompt.edit(Edit::Back);
        prompt.edit(Edit::Delete);
        assert_eq!((prompt.text().as_str(), prompt.before().as_str()), ("o to the ", ""));
    }

    #[test]
    fn what_was_said_is_found_again() {
        let mut prompt = written("go");
        prompt.said();
        written("stay").letters.into_iter().for_each(|letter| prompt.write(letter));
        prompt.said();
        prompt.edit(Edit::Older);
        prompt.edit(Edit::Older);
        prompt.edit(Edit::Older);
        assert_eq!(prompt.text(), "go");
        prompt.edit(Edit::Newer);
        assert_eq!(prompt.text(), "stay");
        prompt.edit(Edit::Newer);
        assert!(prompt.is_empty());
    }
}
