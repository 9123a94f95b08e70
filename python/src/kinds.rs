//! The kinds of tasks that commands may mean.

use crate::error::{self, value};
use goodbot::home;
use goodbot::oomdp::Schema;
use goodbot::task::LiftedTask;
use goodbot_lesson::kept_kinds;
use pyo3::prelude::*;

/// Kinds of tasks that commands may mean, and their texts if a model file shall keep them.
pub struct Kinds {
    pub lifted: Vec<LiftedTask>,
    pub texts: Option<Vec<String>>,
}

/// The kinds of tasks that commands may mean: those named, or the paper's two. A model file without kinds means the paper's two.
pub fn kinds_of_tasks(py: Python<'_>, kinds: Option<Vec<String>>, schema: &Schema<'_>) -> PyResult<Kinds> {
    let paper = home::paper_tasks().map_err(value)?.to_vec();
    let Some(kinds) = kinds else { return Ok(Kinds { lifted: paper, texts: None }) };
    let parse = |text: &String| {
        LiftedTask::parse(text, schema).map_err(|problem| match problem {
            goodbot::task::TaskTextError::Capacity(full) => error::full(py, full),
            problem => value(format!("{text:?}: {problem}")),
        })
    };
    let lifted = kinds.iter().map(parse).collect::<PyResult<Vec<_>>>()?;
    let texts = (!are_same(&lifted, &paper)).then(|| lifted.iter().map(|kind| kept_kinds::text(kind, schema)).collect());
    Ok(Kinds { lifted, texts })
}

/// Whether two lists have the same kinds, in any order.
pub fn are_same(some: &[LiftedTask], others: &[LiftedTask]) -> bool {
    some.iter().all(|kind| others.contains(kind)) && others.iter().all(|kind| some.contains(kind))
}
