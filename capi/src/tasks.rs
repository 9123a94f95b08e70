//! The kinds of tasks that the caller's robot can be told.

use crate::robot::{list, text};
use crate::status::{At, Fault, GoodbotStatus, Place};
#[cfg(feature = "table")]
use crate::table::description::{GOODBOT_MOST_CONJUNCTS, GOODBOT_MOST_VARIABLES, GoodbotTable};
use core::ffi::c_char;
use goodbot::oomdp::Schema;
#[cfg(feature = "table")]
use goodbot::oomdp::{ClassId, PropositionId};
#[cfg(feature = "table")]
use goodbot::task::LiftedProposition;
use goodbot::task::LiftedTask;
use heapless::Vec;

/// Most kinds of tasks.
pub const GOODBOT_MOST_TASKS: usize = 8;

/// The kinds of tasks that commands may mean.
///
/// # Safety
/// `tasks` is null or points to that many texts, each null or ended by a 0.
pub(crate) unsafe fn kinds_of_tasks(
    tasks: *const *const c_char,
    count: u32,
    schema: &Schema<'_>,
) -> Result<Vec<LiftedTask, GOODBOT_MOST_TASKS>, Fault> {
    let mut kinds = Vec::new();
    // SAFETY: the caller's promise.
    let given = unsafe { some(tasks, count, Place::of("tasks")) }?;
    for (number, &task) in given.iter().enumerate() {
        let place = Place::item("tasks", number, "");
        // SAFETY: the caller's promise.
        let kind = LiftedTask::parse(unsafe { text(task) }.at(place)?, schema).at(place)?;
        kinds.push(kind).map_err(|_| GoodbotStatus::Number).at(place)?;
    }
    Ok(kinds)
}

/// One kind of task at least: a robot without any could be told nothing.
///
/// # Safety
/// As [`list`].
unsafe fn some<T>(items: *const T, count: u32, place: Place) -> Result<&'static [T], Fault> {
    let counted = Place::of("task_count");
    if count == 0 || count as usize > GOODBOT_MOST_TASKS {
        return Err(GoodbotStatus::Number).at(counted.number(count, 1, GOODBOT_MOST_TASKS as u32));
    }
    // SAFETY: the caller's promise.
    unsafe { list(items, count, GOODBOT_MOST_TASKS, place, counted) }
}

#[cfg(feature = "table")]
const _: () = assert!(
    GOODBOT_MOST_CONJUNCTS == goodbot::capacity::PROPOSITIONS_PER_TASK && GOODBOT_MOST_VARIABLES == goodbot::capacity::VARIABLES_PER_TASK
);

/// The kinds of tasks of a table that was checked.
///
/// # Safety
/// `table.kinds` is null or points to as many as there are tasks.
#[cfg(feature = "table")]
pub(crate) unsafe fn written_kinds(table: &GoodbotTable, schema: &Schema<'_>) -> Result<Vec<LiftedTask, GOODBOT_MOST_TASKS>, Fault> {
    if table.kinds.is_null() {
        return Err(GoodbotStatus::Unchecked).at(Place::of("kinds"));
    }
    let mut kinds = Vec::new();
    // SAFETY: the caller's promise.
    let given = unsafe { some(table.kinds, table.task_count, Place::of("kinds")) }?;
    for kind in given {
        let mut propositions = kind.variables.map(|variables| LiftedProposition { proposition: PropositionId::new(0), variables });
        for (slot, &proposition) in propositions.iter_mut().zip(&kind.propositions) {
            slot.proposition = PropositionId::new(proposition);
        }
        let classes = kind.classes.map(ClassId::new);
        let propositions = propositions.get(..usize::from(kind.proposition_count)).ok_or(GoodbotStatus::Number)?;
        let classes = classes.get(..usize::from(kind.class_count)).ok_or(GoodbotStatus::Number)?;
        kinds.push(LiftedTask::written(propositions, classes, schema)?).map_err(|_| GoodbotStatus::Number)?;
    }
    Ok(kinds)
}

#[cfg(all(test, feature = "table"))]
mod tests {
    use super::*;
    use crate::table::description::GoodbotKind;
    use goodbot::oomdp::{Class, Proposition};

    const SCHEMA: Schema<'static> = Schema {
        classes: &[Class { name: "lift" }, Class { name: "floor" }],
        attributes: &[],
        propositions: &[
            Proposition { name: "above", parameters: &[ClassId::new(1), ClassId::new(1)] },
            Proposition { name: "liftAtFloor", parameters: &[ClassId::new(0), ClassId::new(1)] },
        ],
    };

    fn of(kinds: *const GoodbotKind, task_count: u32) -> Result<Vec<LiftedTask, GOODBOT_MOST_TASKS>, Fault> {
        // SAFETY: zero is a value of each of its fields: null, none, or a number.
        let table = GoodbotTable { kinds, task_count, ..unsafe { core::mem::zeroed() } };
        // SAFETY: the kinds are as many.
        unsafe { written_kinds(&table, &SCHEMA) }
    }

    #[test]
    fn written_kinds_are_those_that_were_read() {
        let kind = GoodbotKind {
            classes: [1, 1, 0, 0, 0, 0],
            class_count: 3,
            propositions: [0, 1, 0, 0],
            proposition_count: 2,
            variables: [[0, 1, 255], [2, 0, 255], [0; 3], [0; 3]],
        };
        let read = LiftedTask::parse("above(?up, ?down) & liftAtFloor(?lift, ?up)", &SCHEMA).unwrap();
        assert_eq!(of(&kind, 1).unwrap().as_slice(), [read]);
        assert_eq!(of(&GoodbotKind { class_count: 7, ..kind }, 1).unwrap_err().status, GoodbotStatus::Number);
        assert_eq!(of(&GoodbotKind { proposition_count: 5, ..kind }, 1).unwrap_err().status, GoodbotStatus::Number);
    }

    #[test]
    fn a_table_that_was_not_checked_is_refused_without_checks() {
        assert_eq!(of(core::ptr::null(), 1).unwrap_err().status, GoodbotStatus::Unchecked);
        assert_eq!(of(core::ptr::null(), 0).unwrap_err().status, GoodbotStatus::Unchecked);
    }
}
