//! Actions and tasks by name.

use crate::error::value;
use goodbot::oomdp::{Action, Domain, action_named};
use goodbot::task::{GroundedTask, LiftedTask, TaskText};
use pyo3::prelude::*;

/// The action of this name, `noop` included.
pub fn action_of<D: Domain>(domain: &D, name: &str) -> PyResult<Action> {
    action_named(domain, name).ok_or_else(|| {
        let known: Vec<&str> = domain.actions().iter().map(|kind| kind.name).chain(["noop"]).collect();
        value(format!("{name:?} is no action here; there are {}", known.join(", ")))
    })
}

/// A task as logs write it: `agentInRoom(agent0,room1) avoiding agentInRoom(agent0,room2)`.
pub fn task_name<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> String {
    TaskText::new(task, lifted, domain.world()).to_string()
}
