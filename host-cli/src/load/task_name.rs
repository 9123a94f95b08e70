//! A grounded task as a text.

use goodbot::oomdp::Domain;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText, TaskTextError};

/// The text of a task: `blockInRoom(block0,room1)`. `lifted` is the task that it grounds.
///
/// # Errors
/// A [`TaskTextError`] where a name could not be read again; names from files always can.
pub fn task_name<D: Domain + ?Sized>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> Result<GroundTaskText, TaskTextError> {
    let schema = domain.world().schema;
    let atoms = task.propositions(lifted).map(|part| {
        let parameters = schema.parameters(part.proposition).len();
        let names = part.arguments.iter().take(parameters).map(|&object| domain.world().objects.name(object));
        GroundAtomText::new(schema.proposition_name(part.proposition), names)
    });
    GroundTaskText::new(atoms.collect::<Result<_, _>>()?)
}
