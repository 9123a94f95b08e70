//! Utterances other than commands.

use crate::robot::{Goodbot, give, given, text, with};
use crate::status::GoodbotStatus;
use crate::voice::closed;
use crate::world::{World, in_world};
use core::ffi::{c_char, c_void};
use goodbot::talk::{Conversation, Hypothesis, Listened, Verdict};

/// The robot's verdict on an utterance.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotVerdict {
    /// The task is meant: plan and act.
    Sure,
    /// It is not sure which task is meant: ask, or wait. `goodbot_forget` ends the session.
    Unsure,
    /// The task is meant, and is done already.
    Done,
    /// It means nothing that the robot can do here.
    None,
}

/// The most likely reading of an utterance.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotTakenFor {
    /// A command for one task.
    Command,
    /// Nothing that the robot can do.
    Nothing,
    /// A command about a thing that is not here.
    Absent,
    /// A thing, but not what to do with it.
    About,
    /// Something that shall not be: the session's tasks are negated.
    Negated,
    /// Perhaps the opposite of a command.
    Reversed,
    /// Several commands: the session is about the first.
    Several,
    /// All things of a kind.
    All,
    /// The previous task once more.
    Again,
    /// Praise, stop, a greeting and the like: `goodbot_said` says which.
    Talk,
}

/// There is no such place in the utterance.
pub const GOODBOT_NOWHERE: u32 = u32::MAX;

/// The robot's reading of an utterance.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotListened {
    /// The tasks that are meant, one bit each by their positions; several if all things of a kind are meant.
    pub tasks: u64,
    /// What to do.
    pub verdict: GoodbotVerdict,
    /// The reading.
    pub taken_for: GoodbotTakenFor,
    /// The most likely task, by its position.
    pub task: u32,
    /// How probable it is that the tasks are meant, from 0 to 1.
    pub probability: f32,
    /// How probable it is that one of the session's tasks is meant, from 0 to 1.
    pub command: f32,
    /// The least `probability` for the verdict `SURE`.
    pub sure: f32,
    /// Where the rest of several commands begins, in bytes: `goodbot_listen_on` takes it when the first is done. `GOODBOT_NOWHERE`
    /// without a rest.
    pub rest: u32,
    /// Where the unread words begin, in bytes: those after the 64th. `GOODBOT_NOWHERE` if all were read.
    pub unread: u32,
}

/// The caller's function, called between two parts of listening; false stops it.
pub type GoodbotPause = Option<unsafe extern "C" fn(context: *mut c_void) -> bool>;

fn written(listened: &Listened) -> GoodbotListened {
    let place = |place: Option<usize>| place.map_or(GOODBOT_NOWHERE, |place| place as u32);
    GoodbotListened {
        tasks: listened.tasks.iter().fold(0, |tasks, task| tasks | 1 << task),
        verdict: match listened.verdict {
            Verdict::Sure => GoodbotVerdict::Sure,
            Verdict::Unsure => GoodbotVerdict::Unsure,
            Verdict::Done => GoodbotVerdict::Done,
            Verdict::None => GoodbotVerdict::None,
        },
        taken_for: match listened.hypothesis {
            Hypothesis::Command => GoodbotTakenFor::Command,
            Hypothesis::Absent => GoodbotTakenFor::Absent,
            Hypothesis::About => GoodbotTakenFor::About,
            Hypothesis::Negated => GoodbotTakenFor::Negated,
            Hypothesis::Reversed => GoodbotTakenFor::Reversed,
            Hypothesis::Several => GoodbotTakenFor::Several,
            Hypothesis::All => GoodbotTakenFor::All,
            Hypothesis::Again => GoodbotTakenFor::Again,
            Hypothesis::Talk(_) => GoodbotTakenFor::Talk,
            _ => GoodbotTakenFor::Nothing,
        },
        task: listened.task as u32,
        probability: listened.probability,
        command: listened.command,
        sure: listened.sure,
        rest: place(listened.rest),
        unread: place(listened.unread),
    }
}

/// # Safety
/// As [`goodbot_listen`].
unsafe fn listen(
    robot: *mut Goodbot,
    utterance: *const c_char,
    table: *const c_char,
    is_rest: bool,
    pause: GoodbotPause,
    context: *mut c_void,
    listened: *mut GoodbotListened,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(listened)?;
            let (utterance, closed) = (text(utterance)?, closed(table)?);
            let go_on = || pause.is_none_or(|pause| pause(context));
            let agent = &mut robot.agent;
            let heard = in_world!(&robot.world, |domain, state| {
                let heard = agent.listen_in_parts(domain, state, utterance, closed, is_rest, &go_on)?;
                agent.leave_out_done(domain, &heard)?;
                heard
            });
            give(listened, written(&heard))
        })
    }
}

/// The functions from here to `goodbot_correct` are in a library with the feature `talk`. The packages for boards have none of them.
///
/// Hears an utterance that may be no command, in the current state, and finds its reading. A session begins as with `goodbot_hear`; unless
/// the verdict is `SURE`, ask or wait. A robot with few lessons is seldom sure.
///
/// `closed_words` is a table of words such as "not", "and", "stop", in the language that is spoken (`docs/talk.md`), or null: a robot
/// without one asks back more often. `CLOSED_WORDS` if it is no such table. `pause` is null, or is called after each part of the work, with
/// `context`: it must not use this robot, and returns whether to go on. If it returns false, the status is `STOPPED`, and no session is
/// under way.
///
/// # Safety
/// `robot` is null or a handle; the texts are null or C strings; `listened` is null or room for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_listen(
    robot: *mut Goodbot,
    utterance: *const c_char,
    closed_words: *const c_char,
    pause: GoodbotPause,
    context: *mut c_void,
    listened: *mut GoodbotListened,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { listen(robot, utterance, closed_words, false, pause, context, listened) }
}

/// As `goodbot_listen`, for the rest of an utterance of several commands, when the previous command is done and its session over: `rest` is
/// the utterance from `goodbot_listened.rest` on. It may leave out a word that the previous command has.
///
/// # Safety
/// As `goodbot_listen`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_listen_on(
    robot: *mut Goodbot,
    rest: *const c_char,
    closed_words: *const c_char,
    pause: GoodbotPause,
    context: *mut c_void,
    listened: *mut GoodbotListened,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { listen(robot, rest, closed_words, true, pause, context, listened) }
}

/// Remembers that the robot followed a task of the session, by its position: `goodbot_listen` then knows what "it", "there", "back", "the
/// other one" and "again" mean. Call it before the session is finished or forgotten.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_remember(robot: *mut Goodbot, task: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let agent = &mut robot.agent;
            let task = *agent.tasks().get(task as usize).ok_or(GoodbotStatus::Unknown)?;
            in_world!(&robot.world, |domain, _state| {
                let start = agent.started_from(domain).ok_or(GoodbotStatus::NoSession)?;
                agent.remember(domain, &start, &task);
            });
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Begins another conversation: the previous one is forgotten.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_converse_anew(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.agent.resume(Conversation::NEW);
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Takes in words that correct a robot on its way: "no, the other one", "I meant the blue one", "not the red one". The belief in the task
/// that it follows drops to at most a twentieth of that in the next one.
///
/// # Safety
/// `robot` is null or a handle; the texts are null or C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_correct(robot: *mut Goodbot, words: *const c_char, closed_words: *const c_char) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let (words, closed) = (text(words)?, closed(closed_words)?);
            let agent = &mut robot.agent;
            let _ = in_world!(&robot.world, |domain, _state| agent.correct(domain, words, closed, None)?);
            Ok(GoodbotStatus::Ok)
        })
    }
}
