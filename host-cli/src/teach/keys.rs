//! The meaning of keys, and the command that they write.

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// The part of the screen that gets the keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Focus {
    /// Letters are written into a command.
    #[default]
    Command,
    /// Letters are keys with a meaning.
    Keys,
    /// A page covers the screen.
    Page,
}

/// The intents of the trainer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intent {
    /// Leave the program.
    Leave,
    /// Suspend the program, as ctrl-Z does.
    Suspend,
    /// Redraw everything.
    Redraw,
    /// Write this letter.
    Write(char),
    /// Edit the command that is being written.
    Edit(Edit),
    /// Say the command that was written.
    Say,
    /// Begin to write a command.
    ToCommand,
    /// Stop writing; use keys.
    ToKeys,
    /// "Good bot."
    Good,
    /// "Bad bot."
    Bad,
    /// Nothing; go on.
    Silence,
    /// Yes, to a question.
    Yes,
    /// No, to a question.
    No,
    /// This choice of a question, by number from 1 on.
    Choose(u8),
    /// Wait, or go on.
    Pause,
    /// One step.
    Step,
    /// Record in the log that the likeliest guess is the intended task.
    Meant,
    /// End the session and learn from it.
    Finish,
    /// End the session and do not learn from it.
    Drop,
    /// Take back the last step, or between sessions the last session.
    Undo,
    /// Explain.
    Explain,
    /// Show the words.
    Words,
    /// Change the speed.
    Pace,
    /// Let a simulated trainer judge.
    Auto,
    /// Propose the next lesson.
    NextLesson,
    /// Go to another home.
    AnotherHome,
    /// Put everything back.
    PutBack,
    /// Scroll a page by this many lines.
    Scroll(i16),
}

/// An edit of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edit {
    /// Erase the letter before.
    Back,
    /// Erase the letter here.
    Delete,
    /// Erase the word before.
    Word,
    /// Erase everything.
    All,
    /// Move one letter to the left.
    Left,
    /// Move one letter to the right.
    Right,
    /// Move to the beginning.
    Home,
    /// Move to the end.
    End,
    /// Recall the command before.
    Older,
    /// Recall the command after.
    Newer,
}

/// The meaning of a key. `empty` says that no text is written.
pub fn intent(key: KeyEvent, focus: Focus, empty: bool) -> Option<Intent> {
    if key.kind == KeyEventKind::Release {
        return None;
    }
    if key.modifiers.contains(KeyModifiers::CONTROL) {
        return with_control(key.code, focus, empty);
    }
    match (focus, key.code) {
        (_, KeyCode::F(1)) => Some(Intent::Explain),
        // In the middle of a command, it is a letter: "can you go to the red room?".
        (Focus::Command, KeyCode::Char('?')) if empty => Some(Intent::Explain),
        (Focus::Command, code) => in_command(code),
        (Focus::Keys, code) => as_key(code),
        (Focus::Page, code) => in_page(code),
    }
}

fn with_control(code: KeyCode, focus: Focus, empty: bool) -> Option<Intent> {
    Some(match code {
        KeyCode::Char('c') => Intent::Leave,
        KeyCode::Char('d') if empty || focus != Focus::Command => Intent::Leave,
        KeyCode::Char('z') => Intent::Suspend,
        KeyCode::Char('l') => Intent::Redraw,
        KeyCode::Char('w') => Intent::Edit(Edit::Word),
        KeyCode::Char('u') => Intent::Edit(Edit::All),
        KeyCode::Char('a') => Intent::Edit(Edit::Home),
        KeyCode::Char('e') => Intent::Edit(Edit::End),
        _ => return None,
    })
}

fn in_command(code: KeyCode) -> Option<Intent> {
    Some(match code {
        KeyCode::Char(letter) => Intent::Write(letter),
        KeyCode::Enter => Intent::Say,
        KeyCode::Esc => Intent::ToKeys,
        KeyCode::Tab => Intent::NextLesson,
        KeyCode::Backspace => Intent::Edit(Edit::Back),
        KeyCode::Delete => Intent::Edit(Edit::Delete),
        KeyCode::Left => Intent::Edit(Edit::Left),
        KeyCode::Right => Intent::Edit(Edit::Right),
        KeyCode::Home => Intent::Edit(Edit::Home),
        KeyCode::End => Intent::Edit(Edit::End),
        KeyCode::Up => Intent::Edit(Edit::Older),
        KeyCode::Down => Intent::Edit(Edit::Newer),
        _ => return None,
    })
}

fn as_key(code: KeyCode) -> Option<Intent> {
    let code = if let KeyCode::Char(letter) = code { KeyCode::Char(letter.to_ascii_lowercase()) } else { code };
    Some(match code {
        KeyCode::Char('g') | KeyCode::Right | KeyCode::Up => Intent::Good,
        KeyCode::Char('b') | KeyCode::Left => Intent::Bad,
        KeyCode::Char(' ') | KeyCode::Down => Intent::Silence,
        KeyCode::Char('y') => Intent::Yes,
        KeyCode::Char(digit @ '1'..='3') => Intent::Choose(digit.to_digit(10)? as u8),
        KeyCode::Char('p') => Intent::Pause,
        KeyCode::Char('n') => Intent::No,
        KeyCode::Char('o') => Intent::Step,
        KeyCode::Char('m') => Intent::Meant,
        KeyCode::Char('f') => Intent::Finish,
        KeyCode::Char('d') => Intent::Drop,
        KeyCode::Char('u') => Intent::Undo,
        KeyCode::Char('?') => Intent::Explain,
        KeyCode::Char('w') => Intent::Words,
        KeyCode::Char('s') => Intent::Pace,
        KeyCode::Char('a') => Intent::Auto,
        KeyCode::Char('h') => Intent::AnotherHome,
        KeyCode::Char('r') => Intent::PutBack,
        KeyCode::Char('q') => Intent::Leave,
        KeyCode::Tab => Intent::NextLesson,
        KeyCode::Enter | KeyCode::Esc => Intent::ToCommand,
        _ => return None,
    })
}

fn in_page(code: KeyCode) -> Option<Intent> {
    Some(match code {
        KeyCode::Up => Intent::Scroll(-1),
        KeyCode::Down => Intent::Scroll(1),
        KeyCode::PageUp => Intent::Scroll(-10),
        KeyCode::PageDown => Intent::Scroll(10),
        _ => Intent::ToKeys,
    })
}

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

    fn pressed(code: KeyCode, focus: Focus, empty: bool) -> Option<Intent> {
        intent(KeyEvent::new(code, KeyModifiers::NONE), focus, empty)
    }

    #[test]
    fn a_letter_is_written_into_a_command_and_else_is_a_key() {
        assert_eq!(pressed(KeyCode::Char('g'), Focus::Command, true), Some(Intent::Write('g')));
        assert_eq!(pressed(KeyCode::Char('g'), Focus::Keys, true), Some(Intent::Good));
        assert_eq!(pressed(KeyCode::Right, Focus::Command, true), Some(Intent::Edit(Edit::Right)));
        assert_eq!(pressed(KeyCode::Right, Focus::Keys, true), Some(Intent::Good));
        assert_eq!(pressed(KeyCode::Char('?'), Focus::Command, true), Some(Intent::Explain));
        assert_eq!(pressed(KeyCode::Char('?'), Focus::Command, false), Some(Intent::Write('?')));
        assert_eq!(pressed(KeyCode::F(1), Focus::Command, false), Some(Intent::Explain));
    }

    #[test]
    fn no_is_no_step() {
        assert_eq!(pressed(KeyCode::Char('n'), Focus::Keys, true), Some(Intent::No));
        assert_eq!(pressed(KeyCode::Char('o'), Focus::Keys, true), Some(Intent::Step));
    }

    #[test]
    fn control_c_leaves_from_everywhere() {
        for focus in [Focus::Command, Focus::Keys, Focus::Page] {
            let key = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
            assert_eq!(intent(key, focus, false), Some(Intent::Leave));
        }
    }

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
