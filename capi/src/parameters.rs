//! The learned parameters alone, for a robot that only obeys.

#[cfg(feature = "learning")]
use crate::robot::give;
use crate::robot::{Goodbot, given, with};
use crate::status::GoodbotStatus;

/// Saves the parameters for a robot that only obeys, which reads them by `goodbot_restore_parameters`. `written` receives the length, also
/// with `BUFFER`, if `bytes` are too few. `STILL_LEARNING` until `goodbot_learn` is done.
///
/// # Safety
/// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes; `written` is null or room for a number.
#[cfg(feature = "learning")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_save_parameters(robot: *mut Goodbot, buffer: *mut u8, bytes: usize, written: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise. The buffer is filled first: a slice of uninitialized bytes is undefined behaviour.
    unsafe {
        with(robot, |robot| {
            given(buffer)?;
            given(written)?;
            buffer.write_bytes(0, bytes);
            let saved = robot.agent.save_parameters(core::slice::from_raw_parts_mut(buffer, bytes));
            if let Err(goodbot::snapshot::SaveError::Buffer { needed, .. }) = saved {
                written.write(needed);
            }
            give(written, saved?)
        })
    }
}

/// Replaces everything learned here by the parameters that `goodbot_save_parameters` or `goodbot parameters` wrote. The robot then
/// understands like the one that learned them, without training. Parameters hold no lessons: a lesson given to this robot replaces them.
/// On any failure the robot is as before.
///
/// # Safety
/// `robot` is null or a handle; `parameters` is null or points to `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_restore_parameters(robot: *mut Goodbot, parameters: *const u8, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(parameters)?;
            robot.agent.restore_parameters(core::slice::from_raw_parts(parameters, bytes))?;
            #[cfg(feature = "learning")]
            robot.forget_starter();
            Ok(GoodbotStatus::Ok)
        })
    }
}
