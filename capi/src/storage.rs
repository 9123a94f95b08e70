//! A model in the caller's flash. A power cut at any moment leaves a whole model.

use crate::model::{Begun, begin, begun};
use crate::robot::{Goodbot, give, given, with};
use crate::status::{Failure, GoodbotStatus};
use core::ffi::c_void;
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use goodbot::storage::{StorageError, Storing, TwoSlots};

/// `goodbot_flash.write` is called for whole units of this many bytes, at multiples of it. The flash's own unit may be smaller, not larger.
pub const GOODBOT_FLASH_UNIT: usize = 256;

/// A flash of the caller's: two slots, one after the other. Each function returns false if the flash refuses, and must not call goodbot.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotFlash {
    /// Handed to each function.
    pub context: *mut c_void,
    /// Reads `bytes` bytes from `at` on.
    pub read: Option<unsafe extern "C" fn(context: *mut c_void, at: u32, to: *mut u8, bytes: u32) -> bool>,
    /// Writes `bytes` bytes from `at` on, where all is erased.
    pub write: Option<unsafe extern "C" fn(context: *mut c_void, at: u32, from: *const u8, bytes: u32) -> bool>,
    /// Erases one slot: `bytes` bytes from `at` on.
    pub erase: Option<unsafe extern "C" fn(context: *mut c_void, at: u32, bytes: u32) -> bool>,
    /// The address of the first slot: a multiple of the flash's erase size, and of `GOODBOT_FLASH_UNIT`.
    pub start: u32,
    /// Bytes of each slot: a multiple of the same sizes, and at least `GOODBOT_FLASH_UNIT` more than the model.
    pub slot_bytes: u32,
}

/// The flash refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

impl NorFlashError for Refused {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

fn done(done: bool) -> Result<(), Refused> {
    if done { Ok(()) } else { Err(Refused) }
}

impl ErrorType for GoodbotFlash {
    type Error = Refused;
}

impl ReadNorFlash for GoodbotFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
        let read = self.read.ok_or(Refused)?;
        // SAFETY: the caller's function, for as many bytes as there are.
        done(unsafe { read(self.context, offset, bytes.as_mut_ptr(), bytes.len() as u32) })
    }

    fn capacity(&self) -> usize {
        (self.start as usize).saturating_add((self.slot_bytes as usize).saturating_mul(2))
    }
}

impl NorFlash for GoodbotFlash {
    const WRITE_SIZE: usize = GOODBOT_FLASH_UNIT;
    const ERASE_SIZE: usize = GOODBOT_FLASH_UNIT;

    fn erase(&mut self, from: u32, _to: u32) -> Result<(), Refused> {
        let erase = self.erase.ok_or(Refused)?;
        // Erasing begins at the front of a slot, which is a whole number of the flash's blocks: the first part has erased all of it.
        if from != self.start && from != self.start.saturating_add(self.slot_bytes) {
            return Ok(());
        }
        // SAFETY: the caller's function.
        done(unsafe { erase(self.context, from, self.slot_bytes) })
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refused> {
        let write = self.write.ok_or(Refused)?;
        // SAFETY: the caller's function, for as many bytes as there are.
        done(unsafe { write(self.context, offset, bytes.as_ptr(), bytes.len() as u32) })
    }
}

impl From<StorageError<Refused>> for Failure {
    fn from(error: StorageError<Refused>) -> Self {
        match error {
            StorageError::Geometry => GoodbotStatus::Number,
            StorageError::Size { .. } => GoodbotStatus::Buffer,
            StorageError::NotAModel(error) => return error.into(),
            _ => GoodbotStatus::Flash,
        }
        .into()
    }
}

/// The slots of a flash; an error if one of its functions is null.
///
/// # Safety
/// `flash` is null or points to a flash.
unsafe fn slots(flash: *const GoodbotFlash) -> Result<TwoSlots<GoodbotFlash>, Failure> {
    // SAFETY: the caller's promise.
    let Some(&flash) = (unsafe { flash.as_ref() }) else { return Err(GoodbotStatus::Null.into()) };
    if flash.read.is_none() || flash.write.is_none() || flash.erase.is_none() {
        return Err(GoodbotStatus::Null.into());
    }
    Ok(TwoSlots::new(flash, flash.start, flash.slot_bytes)?)
}

/// Stores everything learned in the older of two slots, without a buffer; a plan under way is forgotten. `stored` is null, or receives the
/// model's bytes. After a power cut at any moment, a whole model is left: this one or the previous one. `STILL_LEARNING` until
/// `goodbot_learn` is done, `FLASH` if the flash refused or did not keep the bytes, `BUFFER` if a slot is too small, `NUMBER` if `start` or
/// `slot_bytes` is no such multiple as `goodbot_flash` says.
///
/// # Safety
/// `robot` is null or a handle, `flash` null or points to a flash, `stored` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_store(robot: *mut Goodbot, flash: *const GoodbotFlash, stored: *mut usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let mut slots = slots(flash)?;
            let model = robot.agent.save_in_place()?;
            slots.store(model)?;
            if stored.is_null() { Ok(GoodbotStatus::Ok) } else { give(stored, model.len()) }
        })
    }
}

/// The progress of storing a model in parts, in memory of yours that stays in place: `goodbot_begin_storing`.
#[repr(C)]
#[derive(Debug)]
pub struct GoodbotStoring {
    /// Not to be touched.
    pub opaque: [usize; 32],
}

struct Writing {
    slots: TwoSlots<GoodbotFlash>,
    storing: Storing,
    model: *const u8,
    bytes: usize,
}

type OfStoring = Begun<Writing>;
const _: () = assert!(size_of::<OfStoring>() <= size_of::<GoodbotStoring>() && align_of::<OfStoring>() <= align_of::<GoodbotStoring>());

/// Begins to store a model as `goodbot_store` does, but in parts: call `goodbot_store_on` until it is done. `model` is what `goodbot_save_on`
/// wrote. It, `storing` and what `flash` leads to stay until then; the robot may do anything meanwhile. Errors as of `goodbot_store`.
///
/// # Safety
/// `storing` is null or room for one, `flash` null or points to a flash, `model` null or points to `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_begin_storing(
    storing: *mut GoodbotStoring,
    flash: *const GoodbotFlash,
    model: *const u8,
    bytes: usize,
) -> GoodbotStatus {
    if storing.is_null() || model.is_null() {
        return GoodbotStatus::Null;
    }
    // SAFETY: the caller's promise.
    unsafe {
        match slots(flash) {
            Ok(slots) => begin(storing.cast::<OfStoring>(), Writing { slots, storing: Storing::new(), model, bytes }),
            Err(failure) => return failure.status,
        }
    }
    GoodbotStatus::Ok
}

/// Goes on storing: reads, writes or erases at most about `budget` bytes, and at least `GOODBOT_FLASH_UNIT`; a slot is erased at once, at the
/// end of a part. `WORKING` means: call again. After a power cut at any moment, a whole model is left: this one or the previous one. `FLASH` if
/// the flash refuses or did not keep the bytes, `BUFFER` if a slot is too small, `BAD_MODEL` if the model's checksum is wrong; storing then
/// begins anew.
///
/// # Safety
/// `storing` is null, zeros, or begun by `goodbot_begin_storing`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_store_on(storing: *mut GoodbotStoring, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        let work = match begun(storing.cast::<OfStoring>()) {
            Ok(work) => work,
            Err(failure) => return failure.status,
        };
        let model = core::slice::from_raw_parts(work.model, work.bytes);
        match work.slots.store_on(&mut work.storing, model, budget.max(GOODBOT_FLASH_UNIT as u32)) {
            Ok(progress) => progress.into(),
            Err(error) => Failure::from(error).status,
        }
    }
}

/// Restores the newest model of two slots, as `goodbot_restore` does: call `goodbot_learn` until it is done. `buffer` has room for it,
/// and is free again afterwards. `NOTHING_STORED` if there is none; otherwise as `goodbot_store` and `goodbot_restore`.
///
/// # Safety
/// `robot` is null or a handle, `flash` null or points to a flash, `buffer` null or room for `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_load(robot: *mut Goodbot, flash: *const GoodbotFlash, buffer: *mut u8, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise. The buffer is filled first: a slice of uninitialized bytes is undefined behaviour.
    unsafe {
        with(robot, |robot| {
            let mut slots = slots(flash)?;
            given(buffer)?;
            buffer.write_bytes(0, bytes);
            let buffer = core::slice::from_raw_parts_mut(buffer, bytes);
            let length = slots.load(buffer)?.ok_or(GoodbotStatus::NothingStored)?;
            robot.restore(buffer.get(..length).unwrap_or(&[]))
        })
    }
}
