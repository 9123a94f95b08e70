//! Sessions in worlds: a command, steps, and their feedback.

use super::WorldClasses;
use super::file::WorldFile;
use crate::environment::EnvironmentFile;
use crate::error::FormatError;
use crate::json::{Object, Source};
use crate::session::{RecordedSession, SessionHeader};
use crate::task_text::GroundAtomText;
use std::sync::Arc;

/// A session in a world.
///
/// ```
/// use goodbot_formats::world::{Line, WorldReader};
///
/// let log = r#"{"type":"world","name":"hall","classes":["lamp"],"attributes":{},"propositions":{"on":["lamp"]},"objects":[{"name":"a","class":"lamp"}],"actions":[{"name":"light","effects":["on(a)"]}],"task_kinds":["on(?l)"]}
/// {"type":"session","version":1,"kind":"feedback","world":"hall","facts":[],"command":"light please"}
/// {"type":"step","action":"light","feedback":"reward"}
/// {"type":"end","learn":true}"#;
/// let lines: Vec<Line> = WorldReader::new(log.as_bytes()).collect::<Result<_, _>>()?;
/// let [Line::World(world), Line::Session(session)] = lines.as_slice() else { panic!("a world and a session") };
/// assert_eq!(session.session.steps[0].1.action, "light");
/// let written = [vec![world.to_json_line()?], session.to_lines()?].concat();
/// assert_eq!(written.join("\n"), log);
/// # Ok::<(), goodbot_formats::FormatError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SessionInWorld {
    /// The world.
    pub world: Arc<WorldFile>,
    /// The propositions that held at the time of the command.
    pub facts: Vec<GroundAtomText>,
    /// The session. Its environment has no objects: it is in no home.
    pub session: RecordedSession,
}

const FIELDS: &[&str] = &[
    "type",
    "version",
    "id",
    "kind",
    "world",
    "facts",
    "command",
    "intended",
    "strategies",
    "utterance",
    "after",
    "conversation",
    "closed_words",
];

impl SessionInWorld {
    /// Reads the first line of a session in a world.
    pub(super) fn header(
        fields: &Object<'_>,
        world: Arc<WorldFile>,
    ) -> Result<(Arc<WorldFile>, Vec<GroundAtomText>, SessionHeader), FormatError> {
        fields.version()?;
        fields.only(FIELDS)?;
        let known = WorldClasses::of(&world);
        let facts = match fields.optional("facts") {
            Some(facts) => known.atoms(&facts)?,
            None => world.facts.clone(),
        };
        if let Some(intended) = fields.optional("intended") {
            known.atoms(&intended)?;
        }
        let header = SessionHeader::read_in(EnvironmentFile::default(), fields)?;
        drop(known);
        Ok((world, facts, header))
    }

    /// The session as lines without line ends. Write the line of its world before it. The line numbers in `self` are not used.
    ///
    /// # Errors
    /// An error if the session could not be read again; its line counts from the session line, which is 1.
    pub fn to_lines(&self) -> Result<Vec<String>, FormatError> {
        let header = &self.session.header;
        let [name, facts] = [serde_json::to_string(&self.world.name), serde_json::to_string(&self.facts)].map(Result::unwrap_or_default);
        let first = header.line_elsewhere(&format!("\"world\":{name},\"facts\":{facts}"))?;
        Self::header(&Source::new(&first, 1).root()?.object()?, Arc::clone(&self.world))?;
        self.session.to_lines_with(first, |step, line| header.check_feedback(step, line))
    }
}

/// A command in a world.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CommandRecord {
    /// Its line, counted from 1.
    pub line: usize,
    /// The name of its world.
    pub world: String,
    /// Its name.
    pub id: Option<String>,
    /// The group to keep on one side of a split between training and test data.
    pub group: Option<String>,
    /// The words.
    pub command: String,
    /// The propositions that are to hold. Empty if the command only ends something.
    pub intended: Vec<GroundAtomText>,
    /// The names of commands before it in the same conversation.
    pub before: Vec<String>,
    /// The propositions that are to hold no longer.
    pub ended: Vec<GroundAtomText>,
    /// The propositions that held at the time of the command, if they differ from the world's.
    pub facts: Option<Vec<GroundAtomText>>,
}

const COMMAND_FIELDS: &[&str] = &["type", "world", "id", "group", "language", "command", "intended", "before", "facts", "ended", "part"];

impl CommandRecord {
    pub(super) fn read(fields: &Object<'_>, line: usize, world: &WorldFile) -> Result<Self, FormatError> {
        fields.only(COMMAND_FIELDS)?;
        let text = |name: &str| fields.optional(name).map(|node| node.text()).transpose();
        for name in ["language", "part"] {
            text(name)?;
        }
        let before = fields.optional("before").map(|before| before.list()?.iter().map(|id| id.text()).collect()).transpose()?;
        let known = WorldClasses::of(world);
        let atoms = |name: &str| fields.optional(name).map(|node| known.atoms(&node)).transpose();
        Ok(Self {
            line,
            world: world.name.clone(),
            id: text("id")?,
            group: text("group")?,
            command: fields.required("command")?.filled_text()?,
            intended: known.atoms(&fields.required("intended")?)?,
            before: before.unwrap_or_default(),
            ended: atoms("ended")?.unwrap_or_default(),
            facts: atoms("facts")?,
        })
    }
}
