//! The trainer's voice: praise, blame, "stop", "yes" and the like, in words.

use crate::robot::{Goodbot, give, look, text};
use crate::status::{Failure, GoodbotStatus};
use crate::world::{World, in_world};
use core::ffi::c_char;
use goodbot::asking::Answer;
use goodbot::feedback::Feedback;
use goodbot::voice::{ClosedWords, Said, Stage};

/// What words ask the robot to do.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotSaid {
    /// A command: `goodbot_listen`.
    Command,
    /// A word to the last step: `goodbot_feedback` with `GOODBOT_REWARD`.
    Good,
    /// The same with `GOODBOT_PUNISH`.
    Bad,
    /// Praise for a robot that rests at its goal: `goodbot_finish`.
    Finish,
    /// The answer to the open question, which `answer` is given: `goodbot_answer`.
    Answer,
    /// Words that correct the robot on its way: `goodbot_correct`. A library without `talk` says so only of words that begin with a no, a not
    /// or blame, or have a word such as "meant": they blame the robot.
    Correction,
    /// The robot shall stop: `goodbot_forget`.
    Stop,
    /// Take something back.
    Undo,
    /// The last command once more.
    Again,
    /// There is nothing to do.
    Nothing,
}

/// The caller's table of closed words; none for null.
///
/// # Safety
/// `table` is null or a C string.
pub(crate) unsafe fn closed<'t>(table: *const c_char) -> Result<ClosedWords<'t>, Failure> {
    if table.is_null() {
        return Ok(ClosedWords::NONE);
    }
    // SAFETY: the caller's promise.
    let table = unsafe { text(table)? };
    ClosedWords::new(table).map_err(|_| GoodbotStatus::ClosedWords.into())
}

/// A robot without a table of words stops at these words alone.
const STOP_ALONE: &str = "stop: stop halt emergency";
/// It looks at so many bytes of what was said: they are enough to stop it, and a long text must not keep a control loop waiting.
const LOOKED_AT: usize = 64;

/// The whole words among the first bytes.
fn beginning(words: &str) -> &str {
    let Some(head) = (words.len() > LOOKED_AT).then(|| (0..=LOOKED_AT).rev().find_map(|end| words.get(..end))).flatten() else {
        return words;
    };
    head.bytes().rposition(|byte| byte == b' ').and_then(|end| head.get(..end)).unwrap_or(head)
}

/// Finds what a person's words ask for, given the session under way, the actions that `goodbot_acted` reported, and the open question. It
/// only says so: the caller does it. No lesson is needed, and no button. `answer` receives the answer for `goodbot_answer`, if the words are
/// one. `closed_words` is the table of the language that is spoken (`docs/talk.md`). Without it, if it is null, "stop", "halt" and "emergency
/// stop" stop the robot, and everything else is a command, also praise and blame; the call is then short, so a control loop may look for
/// "stop" at any moment. The function is in a library with the feature `voice`, as in the packages for boards.
///
/// # Safety
/// `robot` is null or a handle; the texts are null or C strings; `said` and `answer` are null or room for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_said(
    robot: *const Goodbot,
    words: *const c_char,
    closed_words: *const c_char,
    said: *mut GoodbotSaid,
    answer: *mut i32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let (words, closed) = (text(words)?, closed(closed_words)?);
            let closed = if closed_words.is_null() { ClosedWords::new(STOP_ALONE).unwrap_or(closed) } else { closed };
            let agent = &robot.agent;
            let heard = in_world!(&robot.world, |domain, state| match closed_words.is_null() {
                // No answer and no correction can be told from a command, so nothing but the words themselves is looked at.
                true => agent.said(beginning(words), closed, Stage::Between, |_| None)?,
                false => agent.said(words, closed, agent.stage(domain, state), |_| None)?,
            });
            if let Said::Answer(heard) = heard {
                give(
                    answer,
                    match heard {
                        Answer::Yes => crate::asking::GOODBOT_YES,
                        Answer::No => crate::asking::GOODBOT_NO,
                        Answer::This(choice) => i32::from(choice),
                    },
                )?;
            }
            give(
                said,
                match heard {
                    Said::Command => GoodbotSaid::Command,
                    Said::Judgement(Feedback::Punish) => GoodbotSaid::Bad,
                    Said::Judgement(_) => GoodbotSaid::Good,
                    Said::Finish => GoodbotSaid::Finish,
                    Said::Answer(_) => GoodbotSaid::Answer,
                    Said::Correction => GoodbotSaid::Correction,
                    Said::Stop => GoodbotSaid::Stop,
                    Said::Undo => GoodbotSaid::Undo,
                    Said::Again => GoodbotSaid::Again,
                    Said::Nothing(_) => GoodbotSaid::Nothing,
                },
            )
        })
    }
}
