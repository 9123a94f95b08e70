//! Hear, plan, decide, feedback, learn.

use crate::robot::{Goodbot, World, give, text, with};
use crate::status::{Failure, GoodbotStatus};
use core::ffi::c_char;
use goodbot::feedback::{Feedback, Strategy};
use goodbot::oomdp::{Action, apply};
use goodbot::planning::{OptimalSet, Progress};

/// The action of doing nothing, which every robot has.
pub const GOODBOT_NOOP: u8 = 15;
/// "Good bot."
pub const GOODBOT_REWARD: i32 = 1;
/// "Bad bot."
pub const GOODBOT_PUNISH: i32 = -1;
/// Silence.
pub const GOODBOT_NEUTRAL: i32 = 0;

/// What the plan says for the task that the robot follows.
pub const GOODBOT_PLAN_GOAL: u32 = 0;
/// The action begins a shortest way to the goal.
pub const GOODBOT_PLAN_TOWARD: u32 = 1;
/// No goal can be reached any more: the robot does nothing.
pub const GOODBOT_PLAN_DEAD_END: u32 = 2;
/// The search was too small to find out: the robot does nothing.
pub const GOODBOT_PLAN_UNKNOWN: u32 = 3;

/// Runs an expression on the world and its state, whichever it is.
macro_rules! in_world {
    ($world:expr, |$domain:ident, $state:ident| $run:expr) => {
        match $world {
            World::Home($domain, $state) => $run,
            World::Table($domain, $state) => $run,
            World::Nothing | World::Plan(_) => return Err(GoodbotStatus::NoWorld.into()),
        }
    };
}
pub(crate) use in_world;

fn of(progress: Progress) -> Result<GoodbotStatus, Failure> {
    Ok(if progress == Progress::Done { GoodbotStatus::Ok } else { GoodbotStatus::Working })
}

/// Says how the trainer rewards and punishes: the probability of silence after a right action and after a wrong one, and of taking one
/// for the other. Without this, it is 0.7, 0.7 and 0.1. A session under way ends unlearned.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_trainer(robot: *mut Goodbot, mu_plus: f32, mu_minus: f32, epsilon: f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let strategy = Strategy::new(mu_plus, mu_minus, epsilon).map_err(|_| GoodbotStatus::Number)?;
            robot.agent.set_strategies(&[(strategy, 1.0)])?;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Hears a command: a session begins in the state in which things are now.
///
/// # Safety
/// `robot` is null or a handle, `command` null or a C string in UTF-8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear(robot: *mut Goodbot, command: *const c_char) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let command = text(command)?;
            in_world!(&robot.world, |domain, state| robot.agent.hear(domain, state, command)?);
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Plans for the state in which things are now, at most about `budget` looks of the search, each at a state or a row of states. `WORKING` means: call again.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_plan(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| of(in_world!(&robot.world, |domain, state| robot.agent.plan(domain, state, budget)?))) }
}

/// Decides on an action in the state that was planned for. `plan` may be null; it is given `GOODBOT_PLAN_GOAL` and so on.
///
/// # Safety
/// `robot` is null or a handle; `action` is room for one, `plan` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_decide(robot: *mut Goodbot, action: *mut u8, plan: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let decision = robot.agent.decide(Some(&mut robot.random))?;
            let kind = match decision.plan {
                OptimalSet::Goal => GOODBOT_PLAN_GOAL,
                OptimalSet::Toward(_) => GOODBOT_PLAN_TOWARD,
                OptimalSet::DeadEnd(_) => GOODBOT_PLAN_DEAD_END,
                OptimalSet::Unknown => GOODBOT_PLAN_UNKNOWN,
            };
            if !plan.is_null() {
                give(plan, kind)?;
            }
            give(action, decision.action.0)
        })
    }
}

/// Takes in what the trainer said to an action that was done in the state that was planned for: `GOODBOT_REWARD`, `GOODBOT_PUNISH` or
/// `GOODBOT_NEUTRAL`.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_feedback(robot: *mut Goodbot, action: u8, feedback: i32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let feedback = match feedback {
                GOODBOT_REWARD => Feedback::Reward,
                GOODBOT_PUNISH => Feedback::Punish,
                GOODBOT_NEUTRAL => Feedback::Neutral,
                _ => return Err(GoodbotStatus::Number.into()),
            };
            robot.agent.feedback(Action(action), feedback)?;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Takes in that the trainer did an action to show the way.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_demonstration(robot: *mut Goodbot, action: u8) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.agent.demonstration(Action(action))?;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Takes note that an action was done and did what the description says. A robot that senses where things are says that instead.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_done(robot: *mut Goodbot, action: u8) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            in_world!(&mut robot.world, |domain, state| {
                *state = apply(domain, state, Action(action)).ok_or(GoodbotStatus::NotApplicable)?;
            });
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Ends the session and begins to learn from it: call `goodbot_learn` until it is done.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_finish(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            in_world!(&robot.world, |domain, _state| robot.agent.finish(domain)?);
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Ends the session without learning from it.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_forget(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.agent.forget();
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Goes on learning, at most about `budget` table cells of work. `WORKING` means: call again.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_learn(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| of(robot.agent.learn(budget))) }
}
