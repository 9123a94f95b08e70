//! Posteriors: the robot's belief before the first step of a session, and after each step.
//!
//! JSON Lines, one object for each belief. `session` is the session's id. `step` counts from 0, the prior. `tasks` maps
//! [tasks](crate::task_text) to probabilities, `strategies` maps the names of trainer strategies to probabilities. Order is kept. A
//! probability may be above 1 by a rounding error of single precision.
//!
//! A belief is read in double precision, and written in the caller's precision. A number of single precision is written with the fewest
//! digits that give the same number again.
//!
//! ```
//! use goodbot_formats::posterior::PosteriorLine;
//!
//! let text = r#"{"session":"w01-3","step":0,"tasks":{"agentInRoom(agent0,room0)":0.3},"strategies":{"balanced":0.32}}"#;
//! let read = PosteriorLine::parse(text, 1)?;
//! assert_eq!(read.tasks[0].1, 0.3);
//!
//! let own = PosteriorLine { session: "w01-3".to_string(), step: 0,
//!     tasks: vec![("agentInRoom(agent0,room0)".parse().unwrap(), 0.3_f32)],
//!     strategies: vec![("balanced".to_string(), 0.32_f32)] };
//! assert_eq!(own.to_json_line()?, text);
//! # Ok::<(), goodbot_formats::FormatError>(())
//! ```

use std::collections::BTreeSet;

use serde::Serialize;

use crate::error::{FormatError, no_probability, not_json, twice};
use crate::json::Source;
use crate::task_text::GroundTaskText;
use crate::weights;

/// One belief. `P` is `f64` for reading, and the program's own type for writing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PosteriorLine<P = f64> {
    /// The id of the session.
    pub session: String,
    /// How many steps came before; 0 is the prior.
    pub step: u64,
    /// The tasks' probabilities, in their order in the text.
    #[serde(serialize_with = "weights::in_order")]
    #[serde(bound(serialize = "P: Serialize"))]
    pub tasks: Vec<(GroundTaskText, P)>,
    /// The strategies' probabilities, in their order in the text.
    #[serde(serialize_with = "weights::in_order")]
    pub strategies: Vec<(String, P)>,
}

/// How far a sum of rounded probabilities may exceed 1.
const EXCESS: f64 = 1e-5;

impl PosteriorLine<f64> {
    /// Reads a line; `line` is its number in the file, for errors.
    pub fn parse(text: &str, line: usize) -> Result<Self, FormatError> {
        let source = Source::new(text, line);
        let fields = source.root()?.object()?;
        fields.only(&["session", "step", "tasks", "strategies"])?;
        let mut strategies = Vec::new();
        for (name, value) in fields.required("strategies")?.object()?.entries() {
            strategies.push((name.to_string(), value.probability(EXCESS)?));
        }
        Ok(PosteriorLine {
            session: fields.required("session")?.text()?,
            step: fields.required("step")?.count()?,
            tasks: weights::tasks(fields.required("tasks")?, EXCESS)?,
            strategies,
        })
    }
}

impl<P: Copy + Into<f64> + Serialize> PosteriorLine<P> {
    /// The belief on one line, without a line end. It is an error if the line could not be read again: if a number is no probability, or a
    /// name occurs twice.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        let wrong = |field: &str, problem: String| FormatError::new(1, problem).with_field(field);
        let (mut tasks, mut strategies) = (BTreeSet::new(), BTreeSet::new());
        let values = self.tasks.iter().map(|(_, p)| ("tasks", *p));
        for (field, p) in values.chain(self.strategies.iter().map(|(_, p)| ("strategies", *p))) {
            let value: f64 = p.into();
            if !(0.0..=1.0 + EXCESS).contains(&value) {
                return Err(wrong(field, no_probability(&value.to_string())));
            }
        }
        if let Some((task, _)) = self.tasks.iter().find(|(task, _)| !tasks.insert(task)) {
            return Err(wrong("tasks", twice(&task.to_string())));
        }
        if let Some((name, _)) = (self.strategies.iter()).find(|(name, _)| !strategies.insert(name)) {
            return Err(wrong("strategies", twice(name)));
        }
        serde_json::to_string(self).map_err(|error| FormatError::new(1, not_json(error)))
    }
}
