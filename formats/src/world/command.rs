//! Commands in worlds, with the intended propositions.

use super::classes::WorldClasses;
use super::file::WorldFile;
use crate::error::FormatError;
use crate::json::Object;
use crate::task_text::GroundAtomText;

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

const FIELDS: &[&str] = &["type", "world", "id", "group", "language", "command", "intended", "before", "facts", "ended", "part"];

impl CommandRecord {
    pub(super) fn read(fields: &Object<'_>, line: usize, world: &WorldFile) -> Result<Self, FormatError> {
        fields.only(FIELDS)?;
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
