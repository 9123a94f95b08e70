//! Recognizes the kind of a file by its first bytes.

use goodbot::talk::Class;

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
