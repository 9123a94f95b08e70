//! Writes a world as a line of a log.

use serde::ser::{Serialize, Serializer};

use super::{Literal, Term, WorldFile};
use crate::error::{FormatError, not_json};
use crate::json::Source;

/// Writes the parameters of an action, with their `?`, as an object.
pub(super) fn write_parameters<S: Serializer>(parameters: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|(name, class)| (format!("?{name}"), class)))
}

/// Writes a variable, with its `?`.
pub(super) fn write_variable<S: Serializer>(variable: &str, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("?{variable}"))
}

impl Serialize for Literal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl std::fmt::Display for Literal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sign = if self.negated { "!" } else { "" };
        write!(f, "{sign}{}(", self.proposition)?;
        for (position, term) in self.terms.iter().enumerate() {
            let comma = if position > 0 { "," } else { "" };
            match term {
                Term::Variable(name) => write!(f, "{comma}?{name}")?,
                Term::Object(name) => write!(f, "{comma}{name}")?,
            }
        }
        f.write_str(")")
    }
}

impl WorldFile {
    /// The world on one line, without a line end. Licence and source are left out.
    ///
    /// # Errors
    /// An error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        let line = serde_json::to_string(self).map_err(|error| FormatError::new(1, not_json(error)))?;
        Self::read(&Source::new(&line, 1).root()?.object()?)?;
        Ok(line)
    }
}
