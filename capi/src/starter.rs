//! A robot that begins with everyday sentences.

use crate::robot::{Goodbot, Robot, give, with};
use crate::status::GoodbotStatus;
use goodbot::AgentError;
use goodbot::session::{Finished, Phase};
use goodbot::snapshot::Places;

impl Robot {
    /// What was learned has been replaced, and the starter's sentences with it.
    pub(crate) fn forget_starter(&mut self) {
        self.starter = Places::default();
    }

    /// A session begins to end, and older ones may give way. If that is broken off, nobody knows the sentences' places any more.
    pub(crate) fn set_starter_aside(&mut self) {
        self.starter_aside = core::mem::take(&mut self.starter);
    }

    /// A session has ended.
    pub(crate) fn find_starter_after(&mut self, finished: &Finished) {
        self.starter = core::mem::take(&mut self.starter_aside);
        self.starter.find_after(finished);
    }
}

/// Gives the robot everyday sentences to begin with, from a starter: a model that
/// `goodbot learn --starter en --learner roles --out starter.goodbot` writes. The sentences are learned from beside the robot's own sessions,
/// and the more of these there are, the fewer sentences: beside n sessions, the part 1 / (1 + n / 32). Call it once the robot is made or has
/// its model back, and again after `goodbot_finish`; each call replaces the sentences of the one before. Then call `goodbot_learn` until it
/// is done. A session under way ends unlearned.
///
/// If `model` is null, the sentences go. `goodbot_save` and `goodbot_store` save the sentences too: let them go first. `goodbot_store` then
/// says `STILL_LEARNING` until `goodbot_learn` is done.
///
/// `added` is null, or receives the number of sentences. `FULL` if there is no room for them: the robot then has none, as after a model that
/// is refused. A session that gives way may be one of them. If more than seven give way at once, or `goodbot_finish` or its parts are broken
/// off, those that are left become the robot's own.
///
/// # Safety
/// `robot` is null or a handle; `model` is null or points to `bytes` bytes; `added` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_join_starter(robot: *mut Goodbot, model: *const u8, bytes: usize, added: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let Robot { agent, starter, .. } = robot;
            if matches!(agent.phase(), Phase::Finishing | Phase::Restoring) {
                return Err(AgentError::NotNow(agent.phase()).into());
            }
            starter.leave(agent);
            if !model.is_null() {
                let own = agent.language().bitext().sessions();
                let joined = agent.join_beside(core::slice::from_raw_parts(model, bytes), own)?;
                *starter = Places::last(agent, joined);
            }
            if added.is_null() { Ok(GoodbotStatus::Ok) } else { give(added, starter.count() as u32) }
        })
    }
}
