//! How a robot takes evidence and acts, if the defaults do not fit.

use crate::robot::{Goodbot, give, look, with};
use crate::status::GoodbotStatus;
use goodbot::Options;
use goodbot::feedback::{Ending, Hazard};
use goodbot::session::Weights;

/// A meaning's weight is its probability, given the trainer's evidence and the words of the command.
pub const GOODBOT_WEIGHTS_PAPER: u32 = 0;
/// Its weight is the probability of its task.
pub const GOODBOT_WEIGHTS_BELIEF: u32 = 1;
/// Its weight comes from the trainer's evidence alone.
pub const GOODBOT_WEIGHTS_EVIDENCE: u32 = 2;

/// How probable it is that the trainer ends the session after an action, at every moment from 0 to less than 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoodbotHazard {
    /// After a move, where nothing was said in the session.
    pub moved: f32,
    /// After a rest that follows a move, where nothing was said.
    pub rested: f32,
    /// After a later rest in a row, where nothing was said.
    pub resting: f32,
    /// The factor if the last word was "good bot".
    pub praised: f32,
    /// The factor if the last word was "bad bot".
    pub scolded: f32,
}

impl From<Hazard> for GoodbotHazard {
    fn from(Hazard { moved, rested, resting, praised, scolded }: Hazard) -> Self {
        Self { moved, rested, resting, praised, scolded }
    }
}

impl From<GoodbotHazard> for Hazard {
    fn from(GoodbotHazard { moved, rested, resting, praised, scolded }: GoodbotHazard) -> Self {
        Self { moved, rested, resting, praised, scolded }
    }
}

/// How a robot takes evidence and acts: `goodbot_current_options` gives it, `goodbot_set_options` takes it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotOptions {
    /// Among the actions that lead on, choose the one whose feedback says most about the task; otherwise any of them.
    pub telling: bool,
    /// The share of the belief about the trainer that is forgotten at each new command, from 0 to 1.
    pub drift: f32,
    /// How probable it is that the trainer ends the session after an action where the task is done.
    pub ends_at_goal: GoodbotHazard,
    /// The same after an action where it is not done. If both are equal, `goodbot_trainer_ended` is no evidence.
    pub ends_elsewhere: GoodbotHazard,
    /// The weight of each meaning of a command in learning: `GOODBOT_WEIGHTS_PAPER`, `GOODBOT_WEIGHTS_BELIEF` or
    /// `GOODBOT_WEIGHTS_EVIDENCE`.
    pub weights: u32,
    /// Weights up to this are not learned; from 0 to less than 1.
    pub least_weight: f32,
    /// The share of each kind of task that goes to tasks that hold already, from 0 to less than 1: the robot rests for these. 0.08 in a
    /// new robot, as in people's talk. With 0 it never takes a command for what holds, so it undoes what it is told is so already.
    pub done: f32,
}

/// Reads the robot's options, to be changed and handed to `goodbot_set_options`.
///
/// # Safety
/// `robot` is null or a handle, `options` null or room for them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_current_options(robot: *const Goodbot, options: *mut GoodbotOptions) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let &Options { telling, drift, ending, weights, least_weight, done, .. } = robot.agent.options();
            let weights = match weights {
                Weights::Paper => GOODBOT_WEIGHTS_PAPER,
                Weights::Belief => GOODBOT_WEIGHTS_BELIEF,
                Weights::Evidence => GOODBOT_WEIGHTS_EVIDENCE,
            };
            let (ends_at_goal, ends_elsewhere) = (ending.at_goal.into(), ending.elsewhere.into());
            give(options, GoodbotOptions { telling, drift, ends_at_goal, ends_elsewhere, weights, least_weight, done })
        })
    }
}

/// Sets the robot's options. The training data stay; a session under way ends unlearned; one that joins the others already goes on first
/// (`STILL_FINISHING`). `NUMBER` if one is out of range: the options are then unchanged.
///
/// # Safety
/// `robot` is null or a handle, `options` null or points to them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_set_options(robot: *mut Goodbot, options: *const GoodbotOptions) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let &GoodbotOptions { telling, drift, ends_at_goal, ends_elsewhere, weights, least_weight, done } =
                options.as_ref().ok_or(GoodbotStatus::Null)?;
            let weights = match weights {
                GOODBOT_WEIGHTS_PAPER => Weights::Paper,
                GOODBOT_WEIGHTS_BELIEF => Weights::Belief,
                GOODBOT_WEIGHTS_EVIDENCE => Weights::Evidence,
                _ => return Err(GoodbotStatus::Number.into()),
            };
            let ending = Ending { at_goal: ends_at_goal.into(), elsewhere: ends_elsewhere.into() };
            robot.check_not_joining()?;
            robot.agent.set_options(Options { telling, drift, ending, weights, least_weight, done, ..*robot.agent.options() })?;
            Ok(GoodbotStatus::Ok)
        })
    }
}
