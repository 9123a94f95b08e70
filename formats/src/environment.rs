//! Environments: the rooms, doors, blocks and the agent of one home.
//!
//! One JSON object. `version` is 1. `objects` is a list; `class` gives each object's kind:
//!
//! | class | further fields |
//! |---|---|
//! | `room` | `name`, `left`, `bottom`, `right`, `top`, `color` |
//! | `door` | `name`, `left`, `bottom`, `right`, `top` |
//! | `agent` | `name`, `x`, `y` |
//! | `block` | `name`, `x`, `y`, `color`, `shape` |
//!
//! With `"derived": true`, the home also has derived facts, such as which room is the leftmost or the largest.
//!
//! Cells are whole numbers of 32 bits, x to the east, y to the north. Names are unique, and a [task](crate::task_text) can hold them. This
//! module does not check whether the home is possible: boxes may be inside out, and an agent may be in a wall.
//!
//! ```
//! use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
//!
//! let text = r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":8,"top":4,"color":"red"},{"class":"door","name":"door0","left":2,"bottom":4,"right":2,"top":4},{"class":"agent","name":"agent0","x":4,"y":2},{"class":"block","name":"block0","x":2,"y":2,"color":"yellow","shape":"chair"}]}"#;
//! let home = EnvironmentFile::parse(text)?;
//! assert!(matches!(&home.objects[2], ObjectRecord::Agent { x: 4, y: 2, .. }));
//! assert_eq!(home.to_json_line(), text);
//!
//! let error = EnvironmentFile::parse("{\"version\": 1, \"objects\": [\n  {\"class\": \"agent\", \"name\": \"a\", \"x\": 4, \"z\": 2}\n]}");
//! assert_eq!(
//!     error.unwrap_err().to_string(),
//!     r#"line 2: field "objects[0].z": is not known here; known are class, name, x, y"#
//! );
//! # Ok::<(), goodbot_formats::FormatError>(())
//! ```

use serde::Serialize;

use crate::error::{FormatError, KNOWN_VERSIONS, twice};
use crate::json::{Node, Object, Source, insert};
use crate::task_text::{TaskTextError, is_usable_name};

/// An environment, as in its file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct EnvironmentFile {
    /// The format's version.
    pub version: u32,
    /// The objects, in their order in the file.
    pub objects: Vec<ObjectRecord>,
    /// Whether the home has derived facts: which room is the leftmost, the largest, and so on.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub derived: bool,
}

/// One object of an environment. Boxes are closed: all four edges belong to them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "class", rename_all = "lowercase")]
pub enum ObjectRecord {
    /// A room, its walls included.
    Room {
        /// The room's name.
        name: String,
        /// The westernmost cells.
        left: i32,
        /// The southernmost cells.
        bottom: i32,
        /// The easternmost cells.
        right: i32,
        /// The northernmost cells.
        top: i32,
        /// The room's colour.
        color: String,
    },
    /// A door, a gap in walls.
    Door {
        /// The door's name.
        name: String,
        /// The westernmost cells.
        left: i32,
        /// The southernmost cells.
        bottom: i32,
        /// The easternmost cells.
        right: i32,
        /// The northernmost cells.
        top: i32,
    },
    /// An agent.
    Agent {
        /// The agent's name.
        name: String,
        /// Its cell, east.
        x: i32,
        /// Its cell, north.
        y: i32,
    },
    /// A block that the agent can move.
    Block {
        /// The block's name.
        name: String,
        /// Its cell, east.
        x: i32,
        /// Its cell, north.
        y: i32,
        /// The block's colour.
        color: String,
        /// The block's shape.
        shape: String,
    },
}

const CLASSES: &[&str] = &["room", "door", "agent", "block"];
const FIELDS: [&[&str]; 4] = [
    &["class", "name", "left", "bottom", "right", "top", "color"],
    &["class", "name", "left", "bottom", "right", "top"],
    &["class", "name", "x", "y"],
    &["class", "name", "x", "y", "color", "shape"],
];

/// An environment without objects, in the newest version.
impl Default for EnvironmentFile {
    fn default() -> Self {
        Self::new(vec![])
    }
}

impl EnvironmentFile {
    /// An environment of these objects, in the newest version.
    pub fn new(objects: Vec<ObjectRecord>) -> Self {
        let version = KNOWN_VERSIONS[KNOWN_VERSIONS.len() - 1];
        EnvironmentFile { version, objects, derived: false }
    }

    /// Reads an environment, on one line or on several.
    pub fn parse(text: &str) -> Result<Self, FormatError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        EnvironmentFile::read(Source::new(text, 1).root()?)
    }

    pub(crate) fn read(node: Node<'_>) -> Result<Self, FormatError> {
        let file = node.object()?;
        let version = file.version()?;
        file.only(&["version", "objects", "derived"])?;
        let derived = file.optional("derived").map(|node| node.truth()).transpose()?.unwrap_or(false);
        let mut names: Vec<String> = Vec::new();
        let mut objects = Vec::new();
        for node in file.required("objects")?.list()? {
            let fields = node.object()?;
            let object = ObjectRecord::read(&fields)?;
            let name = object.name().to_string();
            if !insert(&mut names, name.clone()) {
                return Err(fields.required("name")?.error(twice(&name)));
            }
            objects.push(object);
        }
        Ok(EnvironmentFile { version, objects, derived })
    }

    /// The environment on one line, without a line end.
    pub fn to_json_line(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The line, counted from 1, on which an object of an environment begins, for errors of the home as a whole.
///
/// ```
/// let text = "{\"version\": 1, \"objects\": [\n  {\"class\": \"agent\", \"name\": \"a\", \"x\": 4, \"y\": 2}\n]}";
/// assert_eq!(goodbot_formats::environment::object_line(text, 0), Some(2));
/// assert_eq!(goodbot_formats::environment::object_line(text, 1), None);
/// ```
pub fn object_line(text: &str, object: usize) -> Option<usize> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source::new(text, 1);
    let file = source.root().ok()?.object().ok()?;
    let objects = file.required("objects").ok()?.list().ok()?;
    objects.get(object).map(Node::line)
}

impl ObjectRecord {
    /// The object's name.
    pub fn name(&self) -> &str {
        match self {
            ObjectRecord::Room { name, .. }
            | ObjectRecord::Door { name, .. }
            | ObjectRecord::Agent { name, .. }
            | ObjectRecord::Block { name, .. } => name,
        }
    }

    fn read(fields: &Object<'_>) -> Result<Self, FormatError> {
        let class = fields.required("class")?.word(CLASSES)?;
        fields.only(FIELDS[class])?;
        let text = |name| fields.required(name)?.text();
        let cell = |name| fields.required(name)?.coordinate();
        let name = text("name")?;
        if !is_usable_name(&name) {
            let problem = TaskTextError::UnusableName { name }.to_string();
            return Err(fields.required("name")?.error(problem));
        }
        Ok(match class {
            0 => ObjectRecord::Room {
                name,
                left: cell("left")?,
                bottom: cell("bottom")?,
                right: cell("right")?,
                top: cell("top")?,
                color: text("color")?,
            },
            1 => ObjectRecord::Door { name, left: cell("left")?, bottom: cell("bottom")?, right: cell("right")?, top: cell("top")? },
            2 => ObjectRecord::Agent { name, x: cell("x")?, y: cell("y")? },
            _ => ObjectRecord::Block { name, x: cell("x")?, y: cell("y")?, color: text("color")?, shape: text("shape")? },
        })
    }
}
