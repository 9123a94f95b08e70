//! Checks a recorded session in a world, and walks through its steps before it is used as evidence.

use super::robot::Robot;
use crate::checked::{CheckedSession, Checker, has_steps};
use crate::fault::{Fault, quoted};
use goodbot::oomdp::{Domain, action_named};
use goodbot::task::LiftedTask;
use goodbot_formats::session::StepRecord;
use goodbot_formats::world::SessionInWorld;

/// Checks a session and walks through it, with the robot of its world. `lifted` are the kinds of task that commands may mean there.
///
/// # Errors
/// All faults of the session.
pub fn check<'w>(
    file: &str,
    recorded: &SessionInWorld,
    robot: Robot<'w>,
    lifted: &[LiftedTask],
) -> Result<CheckedSession<Robot<'w>>, Vec<Fault>> {
    let mut checker = Checker::new(file, &recorded.session, ("world", "objects"));
    checker.command();
    match robot.state_of(&recorded.facts) {
        Ok(start) => checker.session(robot, start, lifted, |robot, _, record| impossible(robot, record)),
        Err(flaw) => {
            checker.fault(flaw.field, flaw.message);
            Err(checker.into_faults())
        }
    }
}

/// As [`check`], for a session that is replayed. A labelled session is refused, because it has no steps.
///
/// # Errors
/// All faults of the session.
pub fn check_steps<'w>(
    file: &str,
    recorded: &SessionInWorld,
    robot: Robot<'w>,
    lifted: &[LiftedTask],
) -> Result<CheckedSession<Robot<'w>>, Vec<Fault>> {
    has_steps(file, &recorded.session)?;
    check(file, recorded, robot, lifted)
}

fn impossible(robot: &Robot<'_>, record: &StepRecord) -> String {
    let action = quoted(&record.action);
    if action_named(robot, &record.action).is_none() {
        let known: Vec<&str> = robot.actions().iter().map(|kind| kind.name).collect();
        return format!("{action} is no action of this world; it has {} and noop", known.join(", "));
    }
    format!(
        "{action} cannot be done here: its conditions do not hold after the steps before it; correct the steps, or leave out the session"
    )
}
