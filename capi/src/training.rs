//! Hear, plan, decide, feedback, learn.

#[cfg(feature = "learning")]
use crate::robot::look;
use crate::robot::{Goodbot, Robot, give, given, short_text, text, with};
#[cfg(feature = "learning")]
use crate::status::Failure;
use crate::status::GoodbotStatus;
use crate::world::{World, in_world};
use core::ffi::c_char;
#[cfg(feature = "learning")]
use goodbot::capacity::CapacityError;
#[cfg(feature = "learning")]
use goodbot::feedback::Feedback;
use goodbot::feedback::{LAGS, RESTS, Strategy};
use goodbot::oomdp::Action;
#[cfg(feature = "learning")]
use goodbot::oomdp::apply;
use goodbot::planning::OptimalSet;
use goodbot::session::Hypothesis;
#[cfg(feature = "learning")]
use goodbot::session::{Evidence, Finished};
use heapless::Vec;

/// The action of doing nothing, which every robot has.
pub const GOODBOT_NOOP: u8 = 15;

/// The action with this number in C. In one build with programs for hosts, doing nothing has another number there.
fn action_of(number: u8) -> Action {
    match number {
        GOODBOT_NOOP => Action::NOOP,
        // No robot in C has it.
        number if number == Action::NOOP.index() as u8 => Action::new(GOODBOT_NOOP),
        number => Action::new(number),
    }
}

/// The number of an action in C.
fn number_of(action: Action) -> u8 {
    if action == Action::NOOP { GOODBOT_NOOP } else { action.index() as u8 }
}

/// "Good bot."
pub const GOODBOT_REWARD: i32 = 1;
/// "Bad bot."
pub const GOODBOT_PUNISH: i32 = -1;
/// Silence.
pub const GOODBOT_NEUTRAL: i32 = 0;

/// The task that the robot follows is done here: the robot does nothing.
pub const GOODBOT_PLAN_GOAL: u32 = 0;
/// The action begins a shortest way to the goal.
pub const GOODBOT_PLAN_TOWARD: u32 = 1;
/// No goal can be reached any more: the robot does nothing.
pub const GOODBOT_PLAN_DEAD_END: u32 = 2;
/// The search was too small to tell: the robot does nothing.
pub const GOODBOT_PLAN_UNKNOWN: u32 = 3;
/// The action leads to the goal, but a shorter way may exist: feedback to it is no evidence for or against the task.
pub const GOODBOT_PLAN_APPROXIMATE: u32 = 4;

/// The evidence was used.
pub const GOODBOT_EVIDENCE_USED: u32 = 0;
/// It says nothing, because no task's right actions are known exactly in that state. The belief is unchanged.
pub const GOODBOT_EVIDENCE_UNINFORMATIVE: u32 = 1;
/// It is impossible whatever the task and the trainer, and was ignored.
pub const GOODBOT_EVIDENCE_IMPOSSIBLE: u32 = 2;

/// Sets how the trainer rewards and punishes: the probability of silence after a right action and after a wrong one, and of taking one for
/// the other. Without this the robot expects a trainer who uses both words (0.7, 0.7 and 0.1), praise alone (0.05, 0.7 and 0.1) or blame
/// alone (0.7, 0.05 and 0.1), and finds out which; with fewer than 3 `STRATEGIES`, or fewer `BELIEFS` than 3 times `TASKS`, as in the tiny
/// preset, only the first. A session under way ends unlearned; one that joins the others already goes on first (`STILL_FINISHING`).
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_trainer(robot: *mut Goodbot, mu_plus: f32, mu_minus: f32, epsilon: f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let strategy = Strategy::new(mu_plus, mu_minus, epsilon).map_err(|_| GoodbotStatus::Number)?;
            robot.check_not_joining()?;
            Ok(robot.agent.set_strategies(&[(strategy, 1.0)])?)
        })
    }
}

/// How many delays a word of feedback may have: 0, 1 or 2 actions.
pub const GOODBOT_LAGS: usize = 3;
const _: () = assert!(GOODBOT_LAGS == LAGS);

/// How many numbers of a strategy are about rests.
pub const GOODBOT_RESTS: usize = 4;
const _: () = assert!(GOODBOT_RESTS == RESTS);

/// A way to reward and punish, for `goodbot_trainers`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotStrategy {
    /// The probability of silence after a right action.
    pub mu_plus: f32,
    /// The probability of silence after a wrong action.
    pub mu_minus: f32,
    /// The probability of taking one for the other.
    pub epsilon: f32,
    /// The probability that a word is about the last action, the one before, and the one before that: 1, 0 and 0 where no word is late.
    pub lags: [f32; GOODBOT_LAGS],
    /// Feedback to rests: the probability of silence after a rest at the goal, and after one elsewhere, that of taking one for the other,
    /// and how far a move inside the goal counts as a rest there. A trainer who judges rests like moves has `mu_plus`, `mu_minus`,
    /// `epsilon` and 0.
    pub rests: [f32; GOODBOT_RESTS],
    /// The prior probability that the trainer is like this, in any unit.
    pub prior: f32,
}

/// Most strategies of `goodbot_trainers`; the capacity `STRATEGIES` may allow fewer.
pub const GOODBOT_MOST_STRATEGIES: usize = 16;

/// Sets the `count` strategies that the trainer may have; the robot finds out which. A session under way ends unlearned; one that joins the
/// others already goes on first (`STILL_FINISHING`). `FULL` if they are more than the capacity `STRATEGIES`, `NUMBER` if there are none, a
/// number is out of range, or all priors are 0; the strategies are then unchanged.
///
/// # Safety
/// `robot` is null or a handle, `strategies` null or points to `count` of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_trainers(robot: *mut Goodbot, strategies: *const GoodbotStrategy, count: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(strategies)?;
            let mut given: Vec<(Strategy, f32), GOODBOT_MOST_STRATEGIES> = Vec::new();
            for &GoodbotStrategy { mu_plus, mu_minus, epsilon, lags, rests, prior } in
                core::slice::from_raw_parts(strategies, count as usize)
            {
                let strategy = Strategy::new(mu_plus, mu_minus, epsilon).and_then(|strategy| strategy.with_lags(lags)?.with_rests(rests));
                given.push((strategy.map_err(|_| GoodbotStatus::Number)?, prior)).map_err(|_| GoodbotStatus::Number)?;
            }
            robot.check_not_joining()?;
            Ok(robot.agent.set_strategies(&given)?)
        })
    }
}

/// Hears a command: a session begins in the current state.
///
/// # Safety
/// `robot` is null or a handle, `command` null or a C string in UTF-8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear(robot: *mut Goodbot, command: *const c_char) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let command = text(command)?;
            in_world!(&robot.world, |domain, state| Ok(robot.agent.hear(domain, state, command)?))
        })
    }
}

/// One entry of a speech recogniser's n-best list.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotHypothesis {
    /// The command, in UTF-8.
    pub command: *const c_char,
    /// The recogniser's probability of it, in any unit: a number of 0 or more. For `goodbot_hear_one_of_logs` its natural logarithm.
    pub weight: f32,
}

/// Most transcripts of one command.
pub const GOODBOT_MOST_HYPOTHESES: usize = 16;

/// Hears the most probable of `count` transcripts of one command, by its weight and its possible meanings here. `chosen` receives its
/// position, and the session is as if only that one had been heard. It takes the time of hearing each transcript, and one of them twice.
///
/// # Safety
/// `robot` is null or a handle; `hypotheses` is null or points to `count` of them; the commands are null or C strings; `chosen` is null or
/// room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear_one_of(
    robot: *mut Goodbot,
    hypotheses: *const GoodbotHypothesis,
    count: u32,
    chosen: *mut u32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { hear_most_probable(robot, hypotheses, count, chosen, false) }
}

/// As `goodbot_hear_one_of`, where each weight is the natural logarithm of a probability, as many recognisers give it: any number, because
/// only differences count, or negative infinity for 0. Multiply acoustic scores by the recogniser's acoustic scale first, often 0.1.
///
/// # Safety
/// As `goodbot_hear_one_of`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear_one_of_logs(
    robot: *mut Goodbot,
    hypotheses: *const GoodbotHypothesis,
    count: u32,
    chosen: *mut u32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { hear_most_probable(robot, hypotheses, count, chosen, true) }
}

/// # Safety
/// As `goodbot_hear_one_of`.
unsafe fn hear_most_probable(
    robot: *mut Goodbot,
    hypotheses: *const GoodbotHypothesis,
    count: u32,
    chosen: *mut u32,
    are_logs: bool,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(hypotheses)?;
            given(chosen)?;
            let mut given: Vec<Hypothesis<'_>, GOODBOT_MOST_HYPOTHESES> = Vec::new();
            for &GoodbotHypothesis { command, weight } in core::slice::from_raw_parts(hypotheses, count as usize) {
                given.push(Hypothesis { command: text(command)?, weight }).map_err(|_| GoodbotStatus::Number)?;
            }
            let agent = &mut robot.agent;
            let position = in_world!(&robot.world, |domain, state| match are_logs {
                true => agent.hear_one_of_logs(domain, state, &given)?,
                false => agent.hear_one_of(domain, state, &given)?,
            });
            give(chosen, position as u32)
        })
    }
}

/// Most bytes of a command that is heard in parts.
pub const GOODBOT_MOST_COMMAND_BYTES: usize = 1024;

/// Begins to hear a command as `goodbot_hear` does, but in parts: call `goodbot_hear_on` until it is done. The command is copied; one with
/// more than `GOODBOT_MOST_COMMAND_BYTES` is refused with `TEXT`. `goodbot_hear_on` tells that it has no word, too many, or one that is too
/// long. The tasks are known after its first call.
///
/// # Safety
/// `robot` is null or a handle, `command` null or a C string in UTF-8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_begin_hearing(robot: *mut Goodbot, command: *const c_char) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let command = short_text(command, GOODBOT_MOST_COMMAND_BYTES)?;
            robot.check_not_joining()?;
            in_world!(&robot.world, |domain, state| Ok(robot.agent.begin_hearing(domain, state, command)?))
        })
    }
}

/// Hears the last command again, in the state in which the session began: the belief goes on. This also takes up an ended session, learned
/// from or forgotten; `NO_SESSION` if the last one began in another state.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear_again(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| in_world!(&robot.world, |domain, state| Ok(robot.agent.hear_again(domain, state)?))) }
}

/// Goes on hearing the command, at most about `budget` table cells of work. `WORKING` means: call again.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_hear_on(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(in_world!(&robot.world, |domain, _state| robot.agent.hear_on(domain, budget)?))) }
}

/// Plans for the current state, with at most about `budget` node expansions. `WORKING` means: call again.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_plan(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(in_world!(&robot.world, |domain, state| robot.agent.plan(domain, state, budget)?))) }
}

/// Decides on an action in the current state, for which the plan must be done. `plan` may be null; it receives `GOODBOT_PLAN_GOAL` and so
/// on.
///
/// # Safety
/// `robot` is null or a handle; `action` is room for one, `plan` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_decide(robot: *mut Goodbot, action: *mut u8, plan: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let Robot { agent, random, .. } = robot;
            let decision = in_world!(&robot.world, |domain, state| agent.decide_with(domain, state, random)?);
            let kind = match decision.plan {
                OptimalSet::Goal => GOODBOT_PLAN_GOAL,
                OptimalSet::Toward(_) => GOODBOT_PLAN_TOWARD,
                OptimalSet::Approximate(_) => GOODBOT_PLAN_APPROXIMATE,
                OptimalSet::DeadEnd(_) => GOODBOT_PLAN_DEAD_END,
                OptimalSet::Unknown => GOODBOT_PLAN_UNKNOWN,
            };
            if !plan.is_null() {
                give(plan, kind)?;
            }
            give(action, number_of(decision.action))
        })
    }
}

#[cfg(feature = "learning")]
pub(crate) fn write(evidence: Evidence) -> u32 {
    match evidence {
        Evidence::Used => GOODBOT_EVIDENCE_USED,
        Evidence::Uninformative => GOODBOT_EVIDENCE_UNINFORMATIVE,
        Evidence::Impossible => GOODBOT_EVIDENCE_IMPOSSIBLE,
    }
}

/// Takes in the trainer's feedback to the action that was done last (see `goodbot_acted`): `GOODBOT_REWARD`, `GOODBOT_PUNISH` or
/// `GOODBOT_NEUTRAL`, if nothing was said to it: that silence says something, too. It may be called at any time until the next action is
/// done, also while the robot plans; of several words the last counts. If it is not called, the action is no evidence. `evidence` receives
/// `GOODBOT_EVIDENCE_USED` and so on.
///
/// # Safety
/// `robot` is null or a handle, `evidence` null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_feedback(robot: *mut Goodbot, feedback: i32, evidence: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let feedback = match feedback {
                GOODBOT_REWARD => Feedback::Reward,
                GOODBOT_PUNISH => Feedback::Punish,
                GOODBOT_NEUTRAL => Feedback::Neutral,
                _ => return Err(GoodbotStatus::Number.into()),
            };
            given(evidence)?;
            let came = robot.agent.feedback(feedback)?;
            robot.told.waits = false;
            *(if feedback == Feedback::Neutral { &mut robot.told.silence } else { &mut robot.told.words }) = true;
            give(evidence, write(came))
        })
    }
}

/// Actions of which nothing was told, after which `goodbot_remark` says so.
#[cfg(feature = "learning")]
const MANY: u16 = 8;

/// A remark for whoever writes the program: `text` receives a constant text, which is empty if there is none. There is one if words were told,
/// but nothing of eight actions or more, and silence never: a trainer with one button says something by not pressing it.
///
/// # Safety
/// `robot` is null or a handle, `text` null or room for a pointer.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_remark(robot: *const Goodbot, text: *mut *const c_char) -> GoodbotStatus {
    const SILENCE: &core::ffi::CStr =
        c"silence is never told; call goodbot_feedback with GOODBOT_NEUTRAL for an action that the trainer said nothing to, before the next is done";
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let told = robot.told;
            let is_missing = told.words && !told.silence && told.nothing >= MANY;
            give(text, if is_missing { SILENCE } else { c"" }.as_ptr())
        })
    }
}

/// Takes in that the trainer ended the session in the current state, whose plan must be done, before `goodbot_finish`: people end a session
/// more often where the task is done (`ends_at_goal` and `ends_elsewhere` of the options). `evidence` receives `GOODBOT_EVIDENCE_USED` and so on.
///
/// # Safety
/// `robot` is null or a handle, `evidence` null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_trainer_ended(robot: *mut Goodbot, evidence: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(evidence)?;
            let ended = in_world!(&robot.world, |domain, state| robot.agent.trainer_ended(domain, state)?);
            give(evidence, write(ended))
        })
    }
}

/// Takes in an action that the trainer did to show the way, and applies it to the current state as `goodbot_acted` does. `evidence` receives
/// `GOODBOT_EVIDENCE_USED` and so on.
///
/// # Safety
/// `robot` is null or a handle, `evidence` null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_demonstration(robot: *mut Goodbot, action: u8, evidence: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(evidence)?;
            let agent = &mut robot.agent;
            let came = in_world!(&mut robot.world, |domain, state| {
                let came = agent.demonstrated(domain, state, action_of(action))?;
                *state = apply(domain, state, action_of(action)).ok_or(GoodbotStatus::NotApplicable)?;
                came
            });
            give(evidence, write(came))
        })
    }
}

/// Records that an action was done in the current state, for which the plan must be done, and had the effect that the description says. A
/// robot with sensors calls this after each action too, and then reports the places that differ.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_acted(robot: *mut Goodbot, action: u8) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let agent = &mut robot.agent;
            in_world!(&mut robot.world, |domain, state| *state = agent.acted(domain, state, action_of(action))?);
            #[cfg(feature = "learning")]
            {
                robot.told.nothing = robot.told.nothing.saturating_add(u16::from(robot.told.waits));
                robot.told.waits = true;
            }
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Ends the session and begins to learn from it: call `goodbot_learn` until it is done. `gave_way` is null, or receives the number of older
/// sessions that were forgotten because memory was full; `goodbot_full` then names the table to raise.
///
/// # Safety
/// `robot` is null or a handle, `gave_way` null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_finish(robot: *mut Goodbot, gave_way: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            begin_finishing(robot)?;
            loop {
                if let Some(finished) = in_world!(&robot.world, |domain, _state| robot.agent.finish_on(domain, u32::MAX)?) {
                    return tell(robot, gave_way, finished);
                }
            }
        })
    }
}

/// Begins to end the session as `goodbot_finish` does, but in parts: call `goodbot_finish_on` until it is done.
///
/// # Safety
/// `robot` is null or a handle.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_begin_finishing(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, begin_finishing) }
}

#[cfg(feature = "learning")]
fn begin_finishing(robot: &mut Robot) -> Result<(), Failure> {
    in_world!(&robot.world, |domain, _state| robot.agent.begin_finishing(domain)?);
    robot.set_starter_aside();
    Ok(())
}

/// Goes on ending the session, at most about `budget` table cells of work. `WORKING` means: call again. Once it is done, `gave_way` is
/// set as by `goodbot_finish`.
///
/// # Safety
/// `robot` is null or a handle, `gave_way` null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_finish_on(robot: *mut Goodbot, budget: u32, gave_way: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| match in_world!(&robot.world, |domain, _state| robot.agent.finish_on(domain, budget)?) {
            Some(finished) => tell(robot, gave_way, finished),
            None => Ok(GoodbotStatus::Working),
        })
    }
}

/// # Safety
/// `gave_way` is null or room for a number.
#[cfg(feature = "learning")]
unsafe fn tell(robot: &mut Robot, gave_way: *mut u32, finished: Finished) -> Result<GoodbotStatus, Failure> {
    robot.find_starter_after(&finished);
    if let Some(table) = finished.gave_way.full() {
        let limit = robot.agent.capacities().get(table);
        robot.full = Some(CapacityError::new(table, limit, limit.saturating_add(1)));
    }
    if gave_way.is_null() {
        return Ok(GoodbotStatus::Ok);
    }
    // SAFETY: the caller's promise.
    unsafe { give(gave_way, finished.gave_way.count() as u32) }
}

/// Ends the session without learning from it. It may be called at any time: "stop". `STILL_FINISHING` where it comes too late, because
/// `goodbot_finish_on` has begun to put the session among the others: go on with that.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_forget(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.check_not_joining()?;
            robot.agent.forget();
            Ok(())
        })
    }
}

/// Goes on learning, at most about `budget` table cells of work. `WORKING` means: call again.
///
/// # Safety
/// `robot` is null or a handle.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_learn(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(robot.agent.learn(budget))) }
}
