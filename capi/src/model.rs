//! Saving and restoring a model.

use crate::robot::{Goodbot, give, with};
use crate::status::GoodbotStatus;

/// Bytes that `goodbot_save` would write now.
///
/// # Safety
/// `robot` is null or a handle, `bytes` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_saved_size(robot: *mut Goodbot, bytes: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| give(bytes, robot.agent.saved_bytes()?)) }
}

/// Saves all that was learned, in a format that is the same on every machine. `written` is given the length.
///
/// # Safety
/// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes; `written` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_save(robot: *mut Goodbot, buffer: *mut u8, bytes: usize, written: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise. The room is filled first: a slice of bytes that were never written must not be.
    unsafe {
        with(robot, |robot| {
            if buffer.is_null() || written.is_null() {
                return Err(GoodbotStatus::Null.into());
            }
            buffer.write_bytes(0, bytes);
            let length = robot.agent.save(core::slice::from_raw_parts_mut(buffer, bytes))?;
            give(written, length)
        })
    }
}

/// Replaces everything learned here by a saved model. Call `goodbot_learn` until it is done. On any failure the robot is as
/// before.
///
/// # Safety
/// `robot` is null or a handle; `model` is null or points to `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_restore(robot: *mut Goodbot, model: *const u8, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            if model.is_null() {
                return Err(GoodbotStatus::Null.into());
            }
            robot.agent.restore(core::slice::from_raw_parts(model, bytes))?;
            Ok(GoodbotStatus::Ok)
        })
    }
}
