//! Worlds of any kind, and commands in them.
//!
//! A world is one JSON object with `"type":"world"`. It has classes, attributes, propositions and objects, and the kinds of task that
//! commands may mean:
//!
//! | field | contents |
//! |---|---|
//! | `name` | the world's name |
//! | `classes` | a list of names |
//! | `parents` | from a class to the one above it: its objects serve where objects of that one are wanted; may be absent |
//! | `attributes` | from each attribute to the list of classes that carry it |
//! | `propositions` | from each proposition to the list of its arguments' classes |
//! | `objects` | a list of objects with `name`, `class` and `attributes`: from attributes to values |
//! | `facts` | propositions that hold, such as `"p(a,b)"`; may be absent |
//! | `task_kinds` | a list of kinds of task, such as `"p(?x,?y)"` |
//! | `license`, `source` | licence and origin; may be absent |
//! | `variables` | propositions of which exactly one last argument holds at a time, such as `at(robot,room)`; may be absent |
//! | `actions` | the actions of a robot; may be absent |
//! | `derived` | facts about an object that follow from others, and that words can mean; may be absent |
//!
//! An action has a `name`, `parameters` (from variables such as `?room` to classes), `conditions` and `effects` (lists of propositions with
//! variables or objects; `!` negates a proposition) and a `cost` of 1 to 255. Only `name` and `effects` are required. If a variable of its
//! conditions is no parameter, it gets a value with which they hold. Further actions of the same name are further cases of it, of the same
//! cost: the first case whose conditions hold takes effect.
//!
//! A derived fact has a `name`, `of`, the variable of the object that it is about, and `conditions` as an action has. It is so for each object
//! with which they hold. Entries of one name are further cases of it.
//!
//! A log of worlds has worlds, and commands and sessions in worlds on earlier lines. A world is valid until another of the same name. A
//! session is as in a log of homes, but in place of `environment` it has `world`, the world's name, and `facts`, the propositions that hold
//! at the time of the command. Its `kind`, `id`, `command`, `intended`, `strategies`, `utterance`, `after`, `conversation` and
//! `closed_words` are as there. A command:
//!
//! | field of a command | contents |
//! |---|---|
//! | `world` | the name of its world |
//! | `command` | the words |
//! | `intended` | the propositions that are to hold |
//! | `id` | the command's name; may be absent |
//! | `group` | commands of one group, such as one speaker's, stay together in a split of the data; may be absent |
//! | `facts` | propositions that hold, if they differ from the world's; may be absent |
//! | `ended` | propositions that are to hold no longer; may be absent |
//! | `before` | the ids of earlier commands of the same sequence; may be absent |
//! | `language`, `part` | for people; may be absent |
//!
//!
//! ```
//! use goodbot_formats::world::{Line, WorldReader};
//!
//! let log = r#"
//! {"type":"world","name":"hall","classes":["lamp"],"attributes":{"color":["lamp"]},"propositions":{"on":["lamp"]},"objects":[{"name":"a","class":"lamp","attributes":{"color":"red"}}],"task_kinds":["on(?l)"]}
//! {"type":"command","world":"hall","command":"the red one","intended":["on(a)"]}
//! "#;
//! let lines: Vec<Line> = WorldReader::new(log.as_bytes()).collect::<Result<_, _>>()?;
//! let [Line::World(world), Line::Command(command)] = lines.as_slice() else { panic!("a world and a command") };
//! assert_eq!((world.objects.len(), command.intended[0].to_string()), (1, "on(a)".to_owned()));
//! # Ok::<(), goodbot_formats::FormatError>(())
//! ```

mod action;
mod classes;
mod command;
mod file;
mod reader;
mod reading;
mod session;
mod writing;

pub use command::CommandRecord;
pub use file::{ActionOfWorld, DerivedOfWorld, Literal, ObjectOfWorld, Term, WorldFile};
pub use reader::{Line, WorldReader};
pub use reading::field_line;
pub use session::SessionInWorld;
