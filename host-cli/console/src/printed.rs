//! The one way of text to standard output and standard error.
//!
//! Names, words and ids come from files of strangers. A terminal obeys control characters, and shows text in another order after bidirectional
//! ones, so [`Printed`] shows both as escapes, such as `\u001b`. That is also how JSON writes them, so that lines of JSON keep their meaning. A
//! new command cannot forget it: clippy refuses the standard library's own handles everywhere else.

use std::borrow::Cow;
use std::io::{self, BufWriter, IsTerminal, Write};

/// A writer of text for people and programs. Each piece that is written must end with a whole character, as all formatted text does; bytes that
/// are no UTF-8 become U+FFFD.
pub struct Printed {
    out: BufWriter<Box<dyn Write>>,
}

impl Printed {
    /// To standard output.
    #[expect(clippy::disallowed_methods, reason = "this is where text is escaped")]
    pub fn stdout() -> Self {
        Self { out: BufWriter::new(Box::new(io::stdout())) }
    }

    /// To standard error.
    #[expect(clippy::disallowed_methods, reason = "this is where text is escaped")]
    pub fn stderr() -> Self {
        Self { out: BufWriter::new(Box::new(io::stderr())) }
    }

    /// Writes text in one of the terminal's colours, such as 31 for red.
    ///
    /// # Errors
    /// The error of the output.
    pub fn paint(&mut self, color: u8, text: &str) -> io::Result<()> {
        write!(self.out, "\u{1b}[{color}m{}\u{1b}[0m", printable(text))
    }
}

impl Write for Printed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write_all(printable(&String::from_utf8_lossy(bytes)).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Whether standard output is a terminal.
#[expect(clippy::disallowed_methods, reason = "nothing is written")]
pub fn is_terminal() -> bool {
    io::stdout().is_terminal()
}

/// Writes bytes that are no text, such as a model, to standard output.
///
/// # Errors
/// The error of the output.
#[expect(clippy::disallowed_methods, reason = "these bytes are for a file or a program")]
pub fn data(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

/// A text for a terminal: control characters, and characters without a shape that change the order or the place of others, are escaped. Line
/// ends and tabs stay.
pub fn printable(text: &str) -> Cow<'_, str> {
    let mut shown = String::new();
    let (mut copied, mut before) = (0, ' ');
    for (at, letter) in text.char_indices() {
        if is_obeyed(before, letter) {
            shown.push_str(&text[copied..at]);
            letter.encode_utf16(&mut [0; 2]).iter().for_each(|unit| shown.push_str(&format!("\\u{unit:04x}")));
            copied = at + letter.len_utf8();
        }
        before = letter;
    }
    if copied == 0 {
        return Cow::Borrowed(text);
    }
    shown.push_str(&text[copied..]);
    Cow::Owned(shown)
}

/// Whether a terminal would obey a letter instead of showing it.
fn is_obeyed(before: char, letter: char) -> bool {
    match letter {
        '\n' | '\t' => false,
        // Persian, Hindi and pictures of families are written with joiners. After an English letter one only hides.
        '\u{200c}' | '\u{200d}' => before.is_ascii(),
        // Soft hyphens, marks of direction, blanks without width, line ends of Unicode, tags.
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' => {
            true
        }
        '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e007f}' => true,
        letter => letter.is_control(),
    }
}

/// A picture as XML wants it: with U+FFFD for each character that XML forbids or a terminal obeys. No escape of XML can stand for them.
pub fn well_formed(svg: &[u8]) -> String {
    let text = String::from_utf8_lossy(svg);
    let mut before = ' ';
    let shown = |letter: char| {
        let is_forbidden = is_obeyed(before, letter) || matches!(letter, '\u{fffe}' | '\u{ffff}');
        before = letter;
        if is_forbidden { '\u{fffd}' } else { letter }
    };
    text.chars().map(shown).collect()
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number, as it is written.
    Number(String),
    /// A text, which may come from a file.
    Text(String),
}

impl Cell {
    /// A number.
    pub fn number(number: impl ToString) -> Self {
        Self::Number(number.to_string())
    }

    /// A text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// The cell as it is written. Programs for tables take a text for a formula if it begins with `=`, `+`, `-`, `@`, a tab or a carriage return,
    /// and a formula can read files; so such a text gets an apostrophe, which says that it is text.
    fn written(&self) -> String {
        let text = match self {
            Self::Number(number) => return number.clone(),
            Self::Text(text) if text.starts_with(['=', '+', '-', '@', '\t', '\r']) => format!("'{text}"),
            Self::Text(text) => text.clone(),
        };
        if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
    }
}

/// Writes a line.
///
/// # Errors
/// The error of the output.
pub fn csv_line(out: &mut impl Write, cells: impl IntoIterator<Item = Cell>) -> io::Result<()> {
    let cells: Vec<String> = cells.into_iter().map(|cell| cell.written()).collect();
    writeln!(out, "{}", cells.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_shown_and_not_obeyed() {
        assert_eq!(
            printable("a\u{1b}[31mred.json:1: no\n\tthing\r\u{9b}2J\0"),
            "a\\u001b[31mred.json:1: no\n\tthing\\u000d\\u009b2J\\u0000"
        );
        assert_eq!(printable("file\u{202e}gnp.exe\u{e0041}"), "file\\u202egnp.exe\\udb40\\udc41");
        assert_eq!(printable("ro\u{200d}om\u{200b}"), "ro\\u200dom\\u200b");
    }

    #[test]
    fn every_script_is_shown_as_it_is_written() {
        for text in ["grüner Raum", "می\u{200c}خواهم", "去红房间", "👩\u{200d}👧", "क्\u{200d}ष", ""] {
            assert_eq!(printable(text), text);
        }
    }

    #[test]
    fn escaped_lines_of_json_say_the_same() {
        let line = serde_json::json!({"word\u{9b}": "a\u{202e}\u{e0041}\\\u{7f}\"\u{1b}"});
        let printed = line.to_string();
        let printed = printable(&printed);
        assert!(printed.chars().all(|letter| letter.is_ascii_graphic()), "{printed}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&printed).unwrap(), line);
    }

    #[test]
    fn a_text_is_never_a_formula_and_a_number_stays_one() {
        let texts = ["=1+1", "+49", "-x", "@a", "\t=1", "a,b", "say \"hi\"", "=HYPERLINK(\"a\",1)", "plain"];
        let mut written = Vec::new();
        csv_line(&mut written, texts.map(Cell::text).into_iter().chain([Cell::number(-0.5)])).unwrap();
        let right = "'=1+1,'+49,'-x,'@a,'\t=1,\"a,b\",\"say \"\"hi\"\"\",\"'=HYPERLINK(\"\"a\"\",1)\",plain,-0.5\n";
        assert_eq!(String::from_utf8(written).unwrap(), right);
    }
}
