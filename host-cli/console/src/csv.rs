//! Tables as comma-separated values.

use std::io::{self, Write};

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
pub fn line(out: &mut impl Write, cells: impl IntoIterator<Item = Cell>) -> io::Result<()> {
    let cells: Vec<String> = cells.into_iter().map(|cell| cell.written()).collect();
    writeln!(out, "{}", cells.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_never_a_formula_and_a_number_stays_one() {
        let texts = ["=1+1", "+49", "-x", "@a", "\t=1", "a,b", "say \"hi\"", "=HYPERLINK(\"a\",1)", "plain"];
        let mut written = Vec::new();
        line(&mut written, texts.map(Cell::text).into_iter().chain([Cell::number(-0.5)])).unwrap();
        let right = "'=1+1,'+49,'-x,'@a,'\t=1,\"a,b\",\"say \"\"hi\"\"\",\"'=HYPERLINK(\"\"a\"\",1)\",plain,-0.5\n";
        assert_eq!(String::from_utf8(written).unwrap(), right);
    }
}
