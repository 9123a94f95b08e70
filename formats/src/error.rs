//! Errors of a text: the place, the fault and the remedy, for every format.

use std::fmt;

/// The versions of the file formats that this crate reads. It writes the last of them.
pub const KNOWN_VERSIONS: &[u32] = &[1];

/// A text that is not in the format: the place and the fault.
///
/// Displayed as `FILE:LINE: field "x": the fault; the remedy`:
///
/// ```
/// use goodbot_formats::environment::EnvironmentFile;
///
/// let error = EnvironmentFile::parse(r#"{"version":1,"things":[]}"#).unwrap_err();
/// assert_eq!(
///     error.with_file("home.json").to_string(),
///     r#"home.json:1: field "things": is not known here; known are version, objects, derived"#
/// );
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FormatError {
    /// The file's name, if the caller has given one.
    pub file: Option<String>,
    /// The line, counted from 1.
    pub line: usize,
    /// The column in characters, counted from 1, if the fault is at one place.
    pub column: Option<usize>,
    /// The field at fault, with its path from the outside: `environment.objects[2].color`.
    pub field: Option<String>,
    /// The fault and the remedy.
    pub problem: String,
    /// Whether it is reported even inside a broken session.
    pub(crate) is_fatal: bool,
}

/// The fault of a text that is not UTF-8.
pub const NOT_UTF8: &str = "is not UTF-8; save the file in UTF-8";
pub(crate) const EMPTY: &str = "is empty; fill it, or leave out what is optional";
pub(crate) const STEP_BEFORE_SESSION: &str = "a step comes before any session; put a session line before it";
pub(crate) const ANSWER_OUTSIDE_SESSION: &str = "an answer is outside any session; put it between its session line and its end";
pub(crate) const END_OUTSIDE_SESSION: &str = "an end is outside of any session; remove it";

/// The fault of a text that is not JSON, with the message of the JSON reader.
pub(crate) fn not_json(message: impl fmt::Display) -> String {
    format!("is not JSON ({message}); correct it (JSON has no NaN, no comments and no comma at the end of a list)")
}

/// The fault of a number outside the range from 0 to 1.
pub(crate) fn no_probability(found: &str) -> String {
    format!("{found} is no probability; write a number from 0 to 1")
}

/// The fault of a repeated name, where each must be unique.
pub(crate) fn twice(name: &str) -> String {
    format!("{} is here twice; name each once", quoted(name))
}

/// The fault of a name that the world does not have.
pub(crate) fn not_in_world(what: &str, name: &str) -> String {
    format!("the world has no {what} {}; add it, or correct the name", quoted(name))
}

/// The fault of an object or a variable that is not of the class that belongs there.
pub(crate) fn wrong_class(name: &str, class: &str) -> String {
    format!("{} is where an object of the class {} belongs; write one of those", quoted(name), quoted(class))
}

/// The fault of a session without an end, and the line of the next one if the file goes on.
pub(crate) fn no_end(next_session: Option<usize>) -> String {
    let end = match next_session {
        Some(line) => format!("another begins on line {line}; add an end line before that"),
        None => "the file ends; add an end line".to_owned(),
    };
    format!("the session that begins here is not ended when {end}")
}

impl FormatError {
    pub(crate) fn new(line: usize, problem: impl Into<String>) -> Self {
        FormatError { file: None, line, column: None, field: None, problem: problem.into(), is_fatal: false }
    }

    pub(crate) fn with_field(mut self, field: impl Into<String>) -> Self {
        self.field = Some(field.into());
        self
    }

    /// The same error, with the name of its file.
    pub fn with_file(mut self, file: impl Into<String>) -> Self {
        self.file = Some(file.into());
        self
    }
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{file}:{}: ", self.line)?,
            None => write!(f, "line {}: ", self.line)?,
        }
        if let Some(field) = &self.field {
            // Field names come from the text: control characters in them must not reach a terminal.
            write!(f, "field {}: ", quoted(field))?;
        }
        f.write_str(&self.problem)
    }
}

impl std::error::Error for FormatError {}

/// The beginning of a text in quotes, with unprintable characters escaped: it comes from a file and goes to a terminal.
pub fn quoted(text: &str) -> String {
    let text = excerpt(text, 80);
    // On the page, Rust's tables of printable characters would take two kilobytes.
    if cfg!(target_family = "wasm") { format!("\"{text}\"") } else { format!("{text:?}") }
}

/// The beginning of a text, at most this many characters.
pub(crate) fn excerpt(text: &str, characters: usize) -> String {
    match text.char_indices().nth(characters) {
        Some((cut, _)) => format!("{}…", &text[..cut]),
        None => text.to_string(),
    }
}
