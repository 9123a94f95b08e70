//! JSON values that know their lines.
//!
//! Serde's derived readers buffer a tagged record until its tag is known, and lose the lines of its fields. Here each value is a slice of
//! the checked text, so its address gives its line. `serde_json`'s reader would also cost the page 8.8 KB packed; a test compares both on
//! more than 10,000 texts.

mod scan;

use crate::error::{EMPTY, FormatError, KNOWN_VERSIONS, excerpt, no_probability, not_json, quoted, twice};
use crate::task_text::TaskTextError;
use scan::{JsonFault, Member};
use std::str::FromStr;

/// A value in a text.
#[derive(Clone)]
pub(crate) struct Node<'a> {
    source: &'a Source<'a>,
    raw: &'a str,
    path: String,
}

/// An object in a text, with each field once.
pub(crate) struct Object<'a> {
    node: Node<'a>,
    members: Vec<Member<'a>>,
}

/// Inserts a text into a sorted list, unless the list has it. A tree would be too much code for the page.
pub(crate) fn insert<T: AsRef<str>>(sorted: &mut Vec<T>, text: T) -> bool {
    let place = sorted.binary_search_by(|known| known.as_ref().cmp(text.as_ref()));
    place.map_err(|place| sorted.insert(place, text)).is_err()
}

impl<'a> Node<'a> {
    /// An error at this value.
    pub(crate) fn error(&self, problem: impl Into<String>) -> FormatError {
        self.error_at(self.raw, &self.path, problem)
    }

    fn error_at(&self, at: &str, path: &str, problem: impl Into<String>) -> FormatError {
        let (line, column) = self.source.place(at);
        let mut error = FormatError::new(line, problem);
        error.column = Some(column);
        if !path.is_empty() {
            error.field = Some(path.to_string());
        }
        error
    }

    /// The line on which this value begins.
    pub(crate) fn line(&self) -> usize {
        self.source.place(self.raw).0
    }

    fn field(&self, name: &str) -> String {
        match self.path.is_empty() {
            true => name.to_string(),
            false => format!("{}.{name}", self.path),
        }
    }

    fn kind(&self) -> &'static str {
        match self.raw.as_bytes().first() {
            Some(b'{') => "an object",
            Some(b'[') => "a list",
            Some(b'"') => "a text",
            Some(b'n') => "null",
            Some(b't') | Some(b'f') => "true or false",
            _ => "a number",
        }
    }

    fn expect(&self, expected: &'static str) -> Result<(), FormatError> {
        match self.kind() {
            found if found == expected => Ok(()),
            found => Err(self.error(format!("is {found}; write {expected}"))),
        }
    }

    /// The value as written, or its beginning.
    fn written(&self) -> String {
        excerpt(self.raw, 40).replace(char::is_control, "?")
    }

    pub(crate) fn object(self) -> Result<Object<'a>, FormatError> {
        self.expect("an object")?;
        let members = scan::members(self.raw).map_err(|message| self.error(not_json(message)))?;
        let members = self.limited(members)?;
        let mut seen = Vec::new();
        for member in &members {
            if !insert(&mut seen, member.name.as_str()) {
                let path = self.field(&member.name);
                return Err(self.error_at(member.key, &path, "is given twice; keep one of the two"));
            }
        }
        Ok(Object { node: self, members })
    }

    pub(crate) fn list(&self) -> Result<Vec<Node<'a>>, FormatError> {
        self.expect("a list")?;
        let items = self.limited(scan::items(self.raw))?;
        let item = |(index, raw)| Node { source: self.source, raw, path: format!("{}[{index}]", self.path) };
        Ok(items.into_iter().enumerate().map(item).collect())
    }

    fn limited<T>(&self, entries: Option<Vec<T>>) -> Result<Vec<T>, FormatError> {
        entries.ok_or_else(|| self.error(format!("has more than {} entries; write no more than that", scan::LIMIT)))
    }

    pub(crate) fn text(&self) -> Result<String, FormatError> {
        self.expect("a text")?;
        // Checked JSON can still have half a surrogate pair in a text.
        scan::unescaped(self.raw).map_err(|message| self.error(not_json(message)))
    }

    /// The task, or the part of one, that the text is.
    pub(crate) fn task<T: FromStr<Err = TaskTextError>>(&self) -> Result<T, FormatError> {
        self.text()?.parse().map_err(|error: TaskTextError| self.error(error.to_string()))
    }

    pub(crate) fn filled_text(&self) -> Result<String, FormatError> {
        let text = self.text()?;
        match text.is_empty() {
            true => Err(self.error(EMPTY)),
            false => Ok(text),
        }
    }

    pub(crate) fn filled_list(&self) -> Result<Vec<Node<'a>>, FormatError> {
        let list = self.list()?;
        match list.is_empty() {
            true => Err(self.error(EMPTY)),
            false => Ok(list),
        }
    }

    /// The items of a filled list, each once.
    pub(crate) fn each_once<T: ToString>(&self, read: impl Fn(&Node<'a>) -> Result<T, FormatError>) -> Result<Vec<T>, FormatError> {
        let mut seen = Vec::new();
        let each = |item: Node<'a>| {
            let read = read(&item)?;
            let text = read.to_string();
            if insert(&mut seen, text.clone()) { Ok(read) } else { Err(item.error(twice(&text))) }
        };
        self.filled_list()?.into_iter().map(each).collect()
    }

    /// The position of a word in the list of allowed words.
    pub(crate) fn word(&self, known: &'static [&'static str]) -> Result<usize, FormatError> {
        let found = self.text()?;
        match known.iter().position(|word| *word == found) {
            Some(index) => Ok(index),
            None => {
                let known = match known {
                    [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
                    known => known.concat(),
                };
                Err(self.error(format!("{} is not known; write {known}", quoted(&found))))
            }
        }
    }

    pub(crate) fn truth(&self) -> Result<bool, FormatError> {
        self.expect("true or false")?;
        Ok(self.raw == "true")
    }

    pub(crate) fn coordinate(&self) -> Result<i32, FormatError> {
        self.expect("a number")?;
        let found = self.raw.parse();
        found.map_err(|_| self.error(format!("{} is no cell; write a whole number from {} to {}", self.written(), i32::MIN, i32::MAX)))
    }

    pub(crate) fn count(&self) -> Result<u64, FormatError> {
        self.expect("a number")?;
        let found = self.raw.parse();
        found.map_err(|_| self.error(format!("{} is no count; write a whole number from 0", self.written())))
    }

    /// A number from 0 to 1 + `excess`. The nearest double is read.
    pub(crate) fn probability(&self, excess: f64) -> Result<f64, FormatError> {
        self.expect("a number")?;
        match self.raw.parse::<f64>() {
            Ok(value) if (0.0..=1.0 + excess).contains(&value) => Ok(value),
            _ => Err(self.error(no_probability(&self.written()))),
        }
    }
}

impl<'a> Object<'a> {
    /// An error of the object as a whole, reported at one of its fields.
    pub(crate) fn error(&self, name: &str, problem: impl Into<String>) -> FormatError {
        let at = self.members.iter().find(|m| m.name == name);
        let at = at.map_or(self.node.raw, |m| m.key);
        self.node.error_at(at, &self.node.field(name), problem)
    }

    /// Refuses fields other than these.
    pub(crate) fn only(&self, known: &'static [&'static str]) -> Result<(), FormatError> {
        match self.members.iter().find(|m| !known.contains(&m.name.as_str())) {
            Some(unknown) => Err(self.error(&unknown.name, format!("is not known here; known are {}", known.join(", ")))),
            None => Ok(()),
        }
    }

    /// Checks the field `version`. Call it first: another version has other fields.
    pub(crate) fn version(&self) -> Result<u32, FormatError> {
        let node = self.required("version")?;
        let found = node.raw.parse::<u32>();
        match found.ok().filter(|v| KNOWN_VERSIONS.contains(v)) {
            Some(version) => Ok(version),
            None => {
                let known = KNOWN_VERSIONS.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
                Err(node.error(format!("version {} is unknown; write {known}, or use a newer goodbot", node.written())))
            }
        }
    }

    pub(crate) fn required(&self, name: &'static str) -> Result<Node<'a>, FormatError> {
        self.optional(name).ok_or_else(|| self.error(name, "is missing; add it"))
    }

    pub(crate) fn optional(&self, name: &str) -> Option<Node<'a>> {
        let member = self.members.iter().find(|m| m.name == name)?;
        Some(self.member(member))
    }

    /// All fields in their order in the text, for objects with arbitrary names.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (&str, Node<'a>)> {
        self.members.iter().map(|m| (m.name.as_str(), self.member(m)))
    }

    fn member(&self, member: &Member<'a>) -> Node<'a> {
        Node { source: self.node.source, raw: member.value, path: self.node.field(&member.name) }
    }
}

/// A JSON text and the number of its first line.
pub(crate) struct Source<'a> {
    text: &'a str,
    first_line: usize,
}

impl<'a> Source<'a> {
    pub(crate) fn new(text: &'a str, first_line: usize) -> Self {
        Source { text, first_line }
    }

    /// The text's one value, if the text is JSON.
    pub(crate) fn root(&'a self) -> Result<Node<'a>, FormatError> {
        if self.text.trim().is_empty() {
            return Err(FormatError::new(self.first_line, "there is nothing here; give a file with a JSON text"));
        }
        match scan::whole(self.text) {
            Ok(raw) => Ok(Node { source: self, raw, path: String::new() }),
            Err(JsonFault { at, message }) => {
                let problem = message.map_or_else(
                    || "the text ends in the middle of a value; complete it, or remove what is left of it".to_owned(),
                    not_json,
                );
                let (line, column) = self.place_of(at);
                let mut error = FormatError::new(line, problem);
                error.column = Some(column);
                Err(error)
            }
        }
    }

    /// The line and the column of a slice of the text.
    pub(super) fn place(&self, slice: &str) -> (usize, usize) {
        self.place_of((slice.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize))
    }

    fn place_of(&self, offset: usize) -> (usize, usize) {
        let before = &self.text.as_bytes()[..offset.min(self.text.len())];
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let lines = before.iter().filter(|&&b| b == b'\n').count();
        (self.first_line + lines, 1 + characters(&before[line_start..]))
    }
}

/// The number of characters in these bytes of a UTF-8 text.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&b| b & 0xC0 != 0x80).count()
}
