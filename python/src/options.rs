//! Settings by name: how large an agent's tables are, and how it understands and learns.

use crate::error::value;
use goodbot::capacity::Capacity;
use goodbot::language::Settings;
use goodbot::session::Weights;
use goodbot::task::TaskSet;
use goodbot::{Capacities, Options};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The most entries of any table: a greater number is a slip, and would take all memory.
const MOST: usize = 1 << 28;

const PRESETS: [(&str, Capacities); 3] = [("tiny", Capacities::TINY), ("small", Capacities::SMALL), ("standard", Capacities::STANDARD)];

fn preset(name: &str) -> PyResult<Capacities> {
    let found = PRESETS.iter().find(|(known, _)| *known == name);
    found
        .map(|(_, capacities)| *capacities)
        .ok_or_else(|| value(format!("no capacities are called {name:?}; give tiny, small or standard")))
}

/// Capacities from a preset's name, or from a dict of the fields to replace in `standard`.
pub fn capacities_of(given: Option<&Bound<'_, PyAny>>) -> PyResult<Capacities> {
    let Some(given) = given else { return Ok(Capacities::STANDARD) };
    if let Ok(name) = given.extract::<&str>() {
        return preset(name);
    }
    let mut capacities = Capacities::STANDARD;
    for (field, entries) in given.cast::<PyDict>().map_err(|_| value("capacities are a preset's name or a dict"))? {
        let capacity: Capacity = field.extract::<&str>()?.parse().map_err(|error| value(format!("{field}: {error}")))?;
        let entries: usize = entries.extract()?;
        if entries > MOST {
            return Err(value(format!("{}: {entries} is more than {MOST}; check the number", capacity.name())));
        }
        if capacity == Capacity::Tasks && entries > TaskSet::MOST {
            return Err(value(format!("tasks: {entries} is more than {}, the most that one command can choose from", TaskSet::MOST)));
        }
        capacities.set(capacity, entries);
    }
    Ok(capacities)
}

/// Capacities as a dict.
pub fn as_dict<'py>(py: Python<'py>, capacities: &Capacities) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for capacity in Capacity::ALL {
        dict.set_item(capacity.name(), capacities.get(capacity))?;
    }
    Ok(dict)
}

/// The sizes of all tables of a preset, `tiny`, `small` or `standard`: a dict that `Agent(capacities=...)` takes.
///
/// >>> goodbot.capacities("tiny")["words"]
/// 14
#[pyfunction]
#[pyo3(signature = (preset="standard"))]
pub fn capacities<'py>(py: Python<'py>, preset: &str) -> PyResult<Bound<'py, PyDict>> {
    as_dict(py, &self::preset(preset)?)
}

/// Options from the names of a learner and of its weights.
pub fn options(learner: &str, weights: Option<&str>) -> PyResult<Options> {
    let options = match learner {
        "default" => Options { language: Settings::LAYERED, ..Options::DEFAULT },
        "roles" => Options::DEFAULT,
        "paper" => Options::PAPER,
        "smoothed" => Options::SMOOTHED,
        _ => return Err(value(format!("no learner is called {learner:?}; give default, roles, paper or smoothed"))),
    };
    let weights = match weights {
        None => options.weights,
        Some("paper") => Weights::Paper,
        Some("belief") => Weights::Belief,
        Some("evidence") => Weights::Evidence,
        Some(other) => return Err(value(format!("no weights are called {other:?}; give paper, belief or evidence"))),
    };
    Ok(Options { weights, ..options })
}
