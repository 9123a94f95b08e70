//! A command in a world, and what was meant by it.

use super::file::{Known, WorldFile};
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
    /// What must stay together when data are parted.
    pub group: Option<String>,
    /// What was said.
    pub command: String,
    /// What was meant: all of this is to hold. Nothing where something was only to end.
    pub intended: Vec<GroundAtomText>,
    /// The names of commands before it in the same conversation.
    pub before: Vec<String>,
    /// What was to hold no more.
    pub ended: Vec<GroundAtomText>,
    /// What held when it was said, where that is not what the world says.
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
        let known = Known::of(world);
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
