//! The last pages of the flash, for `embedded-storage-async`. The driver in `embassy-nrf` assumes pages of 4 KiB, but this chip's have 1
//! KiB.

use crate::nrf51::{self, FLASH, Refused, check};
use embassy_futures::yield_now;
use embassy_nrf::Peri;
use embassy_nrf::pac::NVMC;
use embassy_nrf::pac::nvmc::vals::Wen;
use embassy_nrf::peripherals;
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, ReadNorFlash};

const PAGE: u32 = 1_024;

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

impl ErrorType for Flash {
    type Error = Refused;
}

/// Allows writing or erasing, until `Wen::Ren`.
fn allow(what: Wen) {
    NVMC.config().write(|config| config.set_wen(what));
}

fn is_ready() -> bool {
    NVMC.ready().read().ready()
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
        nrf51::read(offset, bytes)
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
        for (at, word) in nrf51::words(offset, bytes)? {
            allow(Wen::Wen);
            // SAFETY: an aligned word of the flash that holds no part of the program.
            unsafe { at.write_volatile(word) };
            while !is_ready() {}
            allow(Wen::Ren);
            yield_now().await;
        }
        Ok(())
    }
}
