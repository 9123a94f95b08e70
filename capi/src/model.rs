//! Saving and restoring a model.

use crate::robot::{Goodbot, Robot, give, given, look, with};
use crate::status::{Failure, GoodbotStatus};
#[cfg(feature = "table")]
use crate::world::World;
#[cfg(feature = "table")]
use goodbot::oomdp::{Domain, Either};
use goodbot::planning::Progress;
use goodbot::session::Phase;
use goodbot::snapshot::{Restoring, Saving};

/// Bytes that `goodbot_save` would write now.
///
/// # Safety
/// `robot` is null or a handle, `bytes` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_saved_size(robot: *const Goodbot, bytes: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { look(robot, |robot| give(bytes, robot.agent.saved_bytes()?)) }
}

/// Saves everything learned, in a format that is the same on every machine. `written` receives the length.
///
/// # Safety
/// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes; `written` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_save(robot: *mut Goodbot, buffer: *mut u8, bytes: usize, written: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise. The buffer is filled first: a slice of uninitialized bytes is undefined behaviour.
    unsafe {
        with(robot, |robot| {
            given(buffer)?;
            given(written)?;
            buffer.write_bytes(0, bytes);
            let length = robot.agent.save(core::slice::from_raw_parts_mut(buffer, bytes))?;
            give(written, length)
        })
    }
}

/// Replaces everything learned here by a saved model. Call `goodbot_learn` until it is done. On any failure the robot is as
/// before. A robot of the caller's own also takes the model of an earlier version of its table, with fewer propositions or attributes at the
/// ends of their lists: nothing is lost then. `OTHER_DOMAIN` for other names or another order, `NEWER_FORMAT` for a newer library's model.
///
/// # Safety
/// `robot` is null or a handle; `model` is null or points to `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_restore(robot: *mut Goodbot, model: *const u8, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(model)?;
            robot.restore(core::slice::from_raw_parts(model, bytes))
        })
    }
}

impl Robot {
    /// Restores a model, also one that an earlier version of the caller's program learned.
    pub(crate) fn restore(&mut self, model: &[u8]) -> Result<(), Failure> {
        let mut restoring = Restoring::of(model);
        self.continue_vocabulary(&mut restoring);
        while self.agent.restore_on(&mut restoring, u32::MAX)? == Progress::Working {}
        self.forget_starter();
        Ok(())
    }

    /// Homes have one vocabulary.
    fn continue_vocabulary(&self, restoring: &mut Restoring<'_>) {
        #[cfg(feature = "table")]
        #[allow(irrefutable_let_patterns, reason = "without the feature home there is nothing else")]
        if let World::Here(Either::Other(table), _) = &self.world {
            restoring.continue_vocabulary(&table.world().schema);
        }
        #[cfg(not(feature = "table"))]
        let _ = restoring;
    }
}

/// The progress of saving a model in parts, in memory of yours that stays in place: `goodbot_begin_saving`.
#[repr(C)]
#[derive(Debug)]
pub struct GoodbotSaving {
    /// Not to be touched.
    pub opaque: [usize; 16],
}

/// The progress of restoring a model in parts, in memory of yours that stays in place: `goodbot_begin_restoring`.
#[repr(C)]
#[derive(Debug)]
pub struct GoodbotRestoring {
    /// Not to be touched.
    pub opaque: [usize; 80],
}

/// Saving, restoring or storing that was begun, in the caller's memory.
pub(crate) struct Begun<T> {
    mark: usize,
    work: T,
}

/// The mark of begun work, combined with its own address: a copy elsewhere has a wrong one.
fn mark_at<T>(at: *const Begun<T>) -> usize {
    0x676f_6f65 ^ at.addr()
}

/// Writes work that begins.
///
/// # Safety
/// `at` is aligned room for it.
pub(crate) unsafe fn begin<T>(at: *mut Begun<T>, work: T) {
    // SAFETY: the caller's promise.
    unsafe { at.write(Begun { mark: mark_at(at), work }) };
}

struct Writing {
    saving: Saving,
    buffer: *mut u8,
    bytes: usize,
    /// How many bytes of the buffer are filled: a slice of uninitialized bytes is undefined behaviour.
    filled: usize,
}

/// More bytes than the longest record has, and the checksum after the last one.
const LONGEST_RECORD: usize = 1024;

type OfSaving = Begun<Writing>;
type OfRestoring = Begun<Restoring<'static>>;
const _: () = assert!(size_of::<OfSaving>() <= size_of::<GoodbotSaving>() && align_of::<OfSaving>() <= align_of::<GoodbotSaving>());
const _: () =
    assert!(size_of::<OfRestoring>() <= size_of::<GoodbotRestoring>() && align_of::<OfRestoring>() <= align_of::<GoodbotRestoring>());

/// The work at `at`, if any was begun there.
///
/// # Safety
/// `at` is null, or points to room that holds zeros or begun work, which nothing else uses now.
pub(crate) unsafe fn begun<'a, T>(at: *mut Begun<T>) -> Result<&'a mut T, Failure> {
    given(at)?;
    // SAFETY: the caller's promise; the mark is a plain number.
    if at.align_offset(align_of::<usize>()) != 0 || unsafe { (&raw const (*at).mark).read() } != mark_at(at) {
        return Err(GoodbotStatus::BadHandle.into());
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { &mut (*at).work })
}

/// Begins to save as `goodbot_save` does, but in parts, to `buffer`: call `goodbot_save_on` until it is done. `saving` and the buffer stay
/// until then.
///
/// # Safety
/// `saving` is null or room for one; `buffer` is null or room for `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_begin_saving(saving: *mut GoodbotSaving, buffer: *mut u8, bytes: usize) -> GoodbotStatus {
    if saving.is_null() || buffer.is_null() {
        return GoodbotStatus::Null;
    }
    // SAFETY: the caller's promise.
    unsafe { begin(saving.cast::<OfSaving>(), Writing { saving: Saving::new(), buffer, bytes, filled: 0 }) };
    GoodbotStatus::Ok
}

/// Goes on saving, at most about `budget` bytes. `WORKING` means: call again; the robot may hear, plan and act meanwhile. `CHANGED` if a
/// session was learned meanwhile: begin again. Once it is done, `written` receives the length.
///
/// # Safety
/// `robot` is null or a handle; `saving` is null, zeros, or begun by `goodbot_begin_saving`; `written` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_save_on(
    robot: *mut Goodbot,
    saving: *mut GoodbotSaving,
    budget: u32,
    written: *mut usize,
) -> GoodbotStatus {
    // SAFETY: the caller's promise; the bytes of the slice are filled.
    unsafe {
        with(robot, |robot| {
            let work = begun(saving.cast::<OfSaving>())?;
            // Ahead of what this part writes, and in parts too, because a large buffer takes long.
            let more = LONGEST_RECORD.saturating_add(budget as usize).min(work.bytes.saturating_sub(work.filled));
            work.buffer.add(work.filled).write_bytes(0, more);
            work.filled = work.filled.saturating_add(more);
            let buffer = core::slice::from_raw_parts_mut(work.buffer, work.filled);
            match robot.agent.save_on(&mut work.saving, buffer, budget)? {
                Some(length) => give(written, length),
                None => Ok(GoodbotStatus::Working),
            }
        })
    }
}

/// Begins to restore as `goodbot_restore` does, but in parts: call `goodbot_restore_on` until it is done. `restoring` and the model stay until
/// then.
///
/// # Safety
/// `restoring` is null or room for one; `model` is null or points to `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_begin_restoring(restoring: *mut GoodbotRestoring, model: *const u8, bytes: usize) -> GoodbotStatus {
    if restoring.is_null() || model.is_null() {
        return GoodbotStatus::Null;
    }
    // SAFETY: the caller's promise.
    unsafe {
        let model = core::slice::from_raw_parts(model, bytes);
        begin(restoring.cast::<OfRestoring>(), Restoring::of(model));
    }
    GoodbotStatus::Ok
}

/// Goes on restoring, at most about `budget` entries of the model. `WORKING` means: call again. While the model is checked, the robot is as
/// before and may do anything. While it is then read, the robot knows nothing, and answers a command by `STILL_RESTORING`. Once it is done,
/// call `goodbot_learn` until that is done. `CHANGED` if other work began before the whole model was read: the robot then knows nothing.
///
/// # Safety
/// `robot` is null or a handle; `restoring` is null, zeros, or begun by `goodbot_begin_restoring`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_restore_on(robot: *mut Goodbot, restoring: *mut GoodbotRestoring, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let work = begun(restoring.cast::<OfRestoring>())?;
            robot.continue_vocabulary(work);
            let progress = robot.agent.restore_on(work, budget)?;
            if matches!(robot.agent.phase(), Phase::Restoring) || progress == Progress::Done {
                robot.forget_starter();
            }
            Ok(progress)
        })
    }
}
