//! The last pages of the flash, for `embedded-storage-async`. The driver in `embassy-nrf` assumes pages of 4 KiB, but this chip's have 1
//! KiB.

use embassy_futures::yield_now;
use embassy_nrf::Peri;
use embassy_nrf::pac::NVMC;
use embassy_nrf::pac::nvmc::vals::Wen;
use embassy_nrf::peripherals;
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};

const PAGE: u32 = 1_024;
const FLASH: u32 = 256 * 1_024;
/// The start of the two slots: the linker keeps the program out of them.
pub const START: u32 = 0x3_E000;
pub const SLOT: u32 = 4 * PAGE;
const _: () = assert!(START + 2 * SLOT == FLASH);

/// The processor's own flash.
pub struct Flash {
    _alone: Peri<'static, peripherals::NVMC>,
}

impl Flash {
    /// Whoever has the controller may write.
    pub fn new(controller: Peri<'static, peripherals::NVMC>) -> Self {
        Self { _alone: controller }
    }
}

/// The flash refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

impl NorFlashError for Refused {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::OutOfBounds
    }
}

impl ErrorType for Flash {
    type Error = Refused;
}

/// Checks that a range lies where models are stored.
fn check(from: u32, bytes: usize) -> Result<(), Refused> {
    let end = u64::from(from) + bytes as u64;
    if from >= START && end <= u64::from(FLASH) { Ok(()) } else { Err(Refused) }
}

/// Allows writing or erasing, until `Wen::Ren`.
fn allow(what: Wen) {
    NVMC.config().write(|config| config.set_wen(what));
}

fn is_ready() -> bool {
    NVMC.ready().read().ready()
}

/// A model in the flash, as memory.
pub fn model(at: u32, length: usize) -> Option<&'static [u8]> {
    check(at, length).ok()?;
    // SAFETY: this is within the flash, which is always readable, and the only task that writes there holds this only while it restores.
    Some(unsafe { core::slice::from_raw_parts(at as *const u8, length) })
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
        check(offset, bytes.len())?;
        for (byte, at) in bytes.iter_mut().zip(offset..) {
            // SAFETY: this is within the flash, which is always readable, and no part of the program.
            *byte = unsafe { (at as *const u8).read_volatile() };
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        FLASH as usize
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = PAGE as usize;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refused> {
        check(from, to.saturating_sub(from) as usize)?;
        for page in (from..to).step_by(PAGE as usize) {
            allow(Wen::Een);
            NVMC.erasepage().write_value(page);
            while !is_ready() {}
            allow(Wen::Ren);
            // The processor stops while a page is erased, 21 ms; the other tasks run before the next.
            yield_now().await;
        }
        Ok(())
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refused> {
        check(offset, bytes.len())?;
        let (words, rest) = bytes.as_chunks::<4>();
        if !offset.is_multiple_of(4) || !rest.is_empty() {
            return Err(Refused);
        }
        for (word, at) in words.iter().zip((offset..).step_by(4)) {
            allow(Wen::Wen);
            // SAFETY: an aligned word of the flash that holds no part of the program.
            unsafe { (at as *mut u32).write_volatile(u32::from_le_bytes(*word)) };
            while !is_ready() {}
            allow(Wen::Ren);
            yield_now().await;
        }
        Ok(())
    }
}
