//! Files, and standard input under the name `-`. The kind of a file is recognized by its first bytes.

use crate::messages;
use crate::output::is_standard;
use crate::whole_file::MOST_BYTES;
use goodbot::talk::Class;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_formats::world::{Line, WorldFile, WorldReader, field_line};
use goodbot_formats::{FormatError, NOT_UTF8};
use goodbot_lesson::{Fault, home};
use std::ffi::OsString;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// The name of standard input in messages.
const STANDARD_INPUT: &str = "standard input";

/// A file to read, by any name that the system allows. `-` is standard input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputFile {
    path: PathBuf,
    /// The name in messages: not every name of a file is text.
    name: String,
}

impl From<OsString> for InputFile {
    fn from(typed: OsString) -> Self {
        let name = if typed == "-" { STANDARD_INPUT.to_owned() } else { typed.to_string_lossy().into_owned() };
        Self { path: typed.into(), name }
    }
}

impl AsRef<Path> for InputFile {
    fn as_ref(&self) -> &Path {
        &self.path
    }
}

impl InputFile {
    /// Standard input.
    pub fn standard() -> Self {
        Self::from(OsString::from("-"))
    }

    /// Whether it is standard input.
    pub fn is_standard(&self) -> bool {
        is_standard(&self.path)
    }
}

/// The name of a file in messages.
pub fn name(file: &InputFile) -> &str {
    &file.name
}

/// Opens a file.
pub fn open(file: &InputFile) -> Result<BufReader<Box<dyn Read>>, Fault> {
    let opened: Box<dyn Read> =
        if file.is_standard() { Box::new(std::io::stdin()) } else { Box::new(File::open(&file.path).map_err(unreadable(&file.name))?) };
    Ok(BufReader::with_capacity(HEAD, opened))
}

/// Opens a session log, and refuses a file of another kind.
pub fn log(file: &InputFile) -> Result<BufReader<Box<dyn Read>>, Fault> {
    let mut opened = open(file)?;
    let content = Content::of(opened.fill_buf().map_err(unreadable(name(file)))?);
    let is_other = matches!(content, Content::Map | Content::Beliefs | Content::Model | Content::Picture | Content::ClosedWords);
    if is_other || is_home(opened.buffer()) {
        let message = format!("this is {}, not a session log; name a log (goodbot example log prints one)", content.name());
        return Err(Fault::new(name(file), message));
    }
    Ok(opened)
}

/// The sessions of a log of homes or worlds.
pub fn sessions<'l>(mut log: impl BufRead + 'l) -> Box<dyn Iterator<Item = Result<RecordedSession, FormatError>> + 'l> {
    // A read error is reported with the first session.
    if !log.fill_buf().is_ok_and(|head| Content::of(head) == Content::Worlds) {
        return Box::new(SessionReader::new(log));
    }
    Box::new(WorldReader::new(log).filter_map(|line| match line {
        Ok(Line::Session(session)) => Some(Ok(session.session)),
        Ok(Line::World(_) | Line::Command(_)) => None,
        Err(error) => Some(Err(error)),
    }))
}

/// Whether this is the beginning of a home as JSON, on one line or on several.
fn is_home(head: &[u8]) -> bool {
    let text: String = String::from_utf8_lossy(head).chars().filter(|c| !c.is_whitespace()).take(200).collect();
    text.trim_start_matches('\u{feff}').starts_with('{') && text.contains("\"objects\":[") && !text.contains("\"type\":")
}

/// The place where a robot lives.
#[derive(Debug)]
pub enum Place {
    /// In a home.
    Home(EnvironmentFile),
    /// In a world of another kind.
    World(Box<WorldInFile>),
}

/// A home or a world from a file.
///
/// # Errors
/// The fault of the file.
pub fn place(file: &InputFile) -> Result<Place, Fault> {
    let bytes = bytes(file)?;
    if Content::of(&bytes) == Content::Worlds {
        return WorldInFile::parse(name(file), bytes).map(|world| Place::World(Box::new(world)));
    }
    home_of(file, bytes).map(Place::Home)
}

/// A home from a file, as JSON or drawn as text.
///
/// # Errors
/// The fault of the file.
pub fn home(file: &InputFile) -> Result<EnvironmentFile, Fault> {
    home_of(file, bytes(file)?)
}

fn home_of(file: &InputFile, bytes: Vec<u8>) -> Result<EnvironmentFile, Fault> {
    let name = name(file);
    let content = Content::of(&bytes);
    if !matches!(content, Content::Environment | Content::Map) {
        return Err(Fault::new(name, format!("this is {}, not a home; name a home (goodbot example home prints one)", content.name())));
    }
    let text = String::from_utf8(bytes).map_err(|_| Fault::new(name, NOT_UTF8))?;
    home::parse(name, &text)
}

/// A world from a file.
#[derive(Debug)]
pub struct WorldInFile {
    /// The world.
    pub world: WorldFile,
    name: String,
    text: String,
}

impl WorldInFile {
    /// A world from the text of a file.
    ///
    /// # Errors
    /// The fault of the world.
    pub fn parse(name: &str, bytes: Vec<u8>) -> Result<Self, Fault> {
        let text = String::from_utf8(bytes).map_err(|_| Fault::new(name, NOT_UTF8))?;
        let world = WorldFile::parse(&text).map_err(|error| Fault::from_format(name, error))?;
        Ok(Self { world, name: name.to_owned(), text })
    }

    /// A fault of one of its fields, with the field's line.
    pub fn fault(&self, field: &str, message: &str) -> Fault {
        Fault { line: field_line(&self.text, field), ..Fault::new(&self.name, message) }.in_field(field)
    }
}

/// A world from a file.
///
/// # Errors
/// The fault of the file.
pub fn world(file: &InputFile) -> Result<WorldInFile, Fault> {
    let bytes = bytes(file)?;
    if Content::of(&bytes) != Content::Worlds {
        return Err(Fault::new(name(file), "is no world; goodbot example world prints one"));
    }
    WorldInFile::parse(name(file), bytes)
}

/// Writes faults to standard error.
pub fn tell(faults: &[Fault]) {
    faults.iter().for_each(|fault| messages::tell(&fault.to_string()));
}

/// The whole content of a file.
pub fn bytes(file: &InputFile) -> Result<Vec<u8>, Fault> {
    rest(name(file), open(file)?)
}

/// The whole content of a file, as text.
///
/// # Errors
/// A fault if it cannot be read, or is not UTF-8.
pub fn text(file: &InputFile) -> Result<String, Fault> {
    String::from_utf8(bytes(file)?).map_err(|_| Fault::new(name(file), NOT_UTF8))
}

/// The rest of an opened file, with its name for messages.
pub fn rest(file: &str, opened: impl Read) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    opened.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable(file))?;
    if bytes.len() as u64 > MOST_BYTES {
        let message = format!("has more than {} MiB, too much for a file that is read whole; check its name", MOST_BYTES >> 20);
        return Err(Fault::new(file, message));
    }
    Ok(bytes)
}

/// The fault of a file that cannot be read.
pub fn unreadable(file: &str) -> impl FnOnce(std::io::Error) -> Fault {
    move |error| Fault::new(file, format!("cannot be read ({error}); check its name and that you may read it"))
}

/// How many bytes tell the kind of a file.
pub const HEAD: usize = 1 << 16;

/// Kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// A home, as JSON.
    Environment,
    /// A home, drawn as text.
    Map,
    /// A session log.
    Log,
    /// A world, or a log of worlds and commands in them.
    Worlds,
    /// Recorded beliefs.
    Beliefs,
    /// A model that `goodbot learn` wrote.
    Model,
    /// A picture.
    Picture,
    /// A table of closed classes of words.
    ClosedWords,
}

impl Content {
    /// The kind of a file that begins with these bytes. Only the first [`HEAD`] are looked at: as a tree, a long line of JSON takes sixteen times
    /// its length.
    pub fn of(bytes: &[u8]) -> Self {
        let bytes = bytes.get(..HEAD).unwrap_or(bytes);
        if bytes.starts_with(b"goodbot\0") {
            return Self::Model;
        }
        let text = String::from_utf8_lossy(bytes);
        let text = text.trim_start_matches('\u{feff}');
        if text.trim_start().starts_with("<svg") {
            return Self::Picture;
        }
        if goodbot_formats::map::is_map(text) {
            return Self::Map;
        }
        let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
        match serde_json::from_str::<serde_json::Value>(first) {
            Ok(line) if matches!(line.get("type").and_then(|it| it.as_str()), Some("world" | "command")) => Self::Worlds,
            Ok(line) if line.get("objects").is_some() => Self::Environment,
            Ok(line) if line.get("type").is_some() => Self::Log,
            Ok(line) if line.get("session").is_some() && line.get("step").is_some() => Self::Beliefs,
            Ok(_) => Self::Environment,
            Err(_) if is_world(text) => Self::Worlds,
            // A session line may be at fault, or longer than the bytes read so far.
            Err(_) if first.contains("\"type\"") && first.contains("\"session\"") => Self::Log,
            Err(_) if is_table(text) => Self::ClosedWords,
            Err(_) => Self::Environment,
        }
    }

    /// The kind's name, with its article.
    pub fn name(self) -> &'static str {
        match self {
            Self::Environment | Self::Map => "a home",
            Self::Log => "a session log",
            Self::Worlds => "a world",
            Self::Beliefs => "a file of beliefs",
            Self::Model => "a model",
            Self::Picture => "a picture",
            Self::ClosedWords => "a table of closed words",
        }
    }
}

/// Whether this is the beginning of a world, on one line or on several.
fn is_world(text: &str) -> bool {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).take(1_000).collect();
    text.starts_with('{') && text.contains("\"type\":\"world\"")
}

/// Whether a line begins with a class of words. No line of JSON does.
fn is_table(text: &str) -> bool {
    let names = text.lines().filter_map(|line| Some(line.split_once(':')?.0.trim()));
    !text.trim_start().starts_with(['{', '[']) && names.into_iter().any(|name| Class::ALL.iter().any(|class| class.name() == name))
}
