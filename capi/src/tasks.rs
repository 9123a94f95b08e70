//! The kinds of tasks that the caller's robot can be told.

use crate::robot::{list, text};
use crate::status::{At, Failure, GoodbotStatus, Place};
use core::ffi::c_char;
use goodbot::oomdp::Schema;
use goodbot::task::LiftedTask;
use heapless::Vec;

/// Most tasks.
pub const GOODBOT_MOST_TASKS: usize = 8;

/// The kinds of tasks that commands may mean.
///
/// # Safety
/// `tasks` is null or points to that many texts, each null or ended by a 0.
pub(crate) unsafe fn kinds_of_tasks(
    tasks: *const *const c_char,
    count: u32,
    schema: &Schema<'_>,
) -> Result<Vec<LiftedTask, GOODBOT_MOST_TASKS>, Failure> {
    let mut kinds = Vec::new();
    // SAFETY: the caller's promise.
    let given = unsafe { list(tasks, count, GOODBOT_MOST_TASKS, Place::of("tasks"), Place::of("task_count")) }?;
    for (number, &task) in given.iter().enumerate() {
        let place = Place::item("tasks", number, "");
        // SAFETY: the caller's promise.
        let kind = LiftedTask::parse(unsafe { text(task) }.at(place)?, schema).at(place)?;
        kinds.push(kind).map_err(|_| GoodbotStatus::Number).at(place)?;
    }
    Ok(kinds)
}
