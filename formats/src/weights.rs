//! Objects from names to probabilities, in their order in the text.

use std::collections::BTreeSet;

use serde::{Serialize, Serializer};

use crate::error::{FormatError, twice};
use crate::json::Node;
use crate::task_text::{GroundTaskText, TaskTextError};

/// Writes pairs as an object, in their order.
pub(crate) fn in_order<K, P, S>(pairs: &[(K, P)], serializer: S) -> Result<S::Ok, S::Error>
where
    K: Serialize,
    P: Serialize,
    S: Serializer,
{
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}

/// An object from tasks to probabilities up to `1 + excess`. Two spellings of one task count as the same name.
pub(crate) fn tasks(node: Node<'_>, excess: f64) -> Result<Vec<(GroundTaskText, f64)>, FormatError> {
    let object = node.object()?;
    let mut seen = BTreeSet::new();
    let mut tasks = Vec::new();
    for (name, value) in object.entries() {
        let task: GroundTaskText = name.parse().map_err(|error: TaskTextError| object.error(name, error.to_string()))?;
        if !seen.insert(task.clone()) {
            let name = task.to_string();
            return Err(value.error(twice(&name)));
        }
        tasks.push((task, value.probability(excess)?));
    }
    Ok(tasks)
}
