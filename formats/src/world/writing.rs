//! Writes a world as a line of a log.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::{ActionOfWorld, Literal, ObjectOfWorld, Term, WorldFile};
use crate::error::{FormatError, not_json};
use crate::json::Source;

/// Writes pairs as an object, in their order.
struct Pairs<'a, V>(&'a [(String, V)]);

impl<V: Serialize> Serialize for Pairs<'_, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
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

impl Serialize for ObjectOfWorld {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("name", &self.name)?;
        map.serialize_entry("class", &self.class)?;
        if !self.attributes.is_empty() {
            map.serialize_entry("attributes", &Pairs(&self.attributes))?;
        }
        map.end()
    }
}

impl Serialize for ActionOfWorld {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("name", &self.name)?;
        if !self.parameters.is_empty() {
            let named: Vec<(String, &str)> = self.parameters.iter().map(|(name, class)| (format!("?{name}"), class.as_str())).collect();
            map.serialize_entry("parameters", &Pairs(&named))?;
        }
        if !self.conditions.is_empty() {
            map.serialize_entry("conditions", &self.conditions)?;
        }
        map.serialize_entry("effects", &self.effects)?;
        if self.cost != 1 {
            map.serialize_entry("cost", &self.cost)?;
        }
        map.end()
    }
}

impl Serialize for WorldFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let kinds: Vec<String> = self.task_kinds.iter().map(ToString::to_string).collect();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("type", "world")?;
        map.serialize_entry("name", &self.name)?;
        map.serialize_entry("classes", &self.classes)?;
        map.serialize_entry("attributes", &Pairs(&self.attributes))?;
        map.serialize_entry("propositions", &Pairs(&self.propositions))?;
        if !self.variables.is_empty() {
            map.serialize_entry("variables", &self.variables)?;
        }
        map.serialize_entry("objects", &self.objects)?;
        if !self.facts.is_empty() {
            map.serialize_entry("facts", &self.facts)?;
        }
        if !self.actions.is_empty() {
            map.serialize_entry("actions", &self.actions)?;
        }
        map.serialize_entry("task_kinds", &kinds)?;
        map.end()
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
