//! A flash in RAM, since the board has none that a program can write: it takes a while to erase, and what is not erased cannot be written.

use embassy_time::Timer;
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use goodbot_embassy::SLOT;

const BYTES: usize = 2 * SLOT as usize;
const ERASED: u8 = 0xff;

pub struct Flash([u8; BYTES]);

impl Flash {
    pub fn new() -> Self {
        Self([ERASED; BYTES])
    }

    fn part(&mut self, from: u32, bytes: usize) -> Result<&mut [u8], Refused> {
        self.0.get_mut(from as usize..).and_then(|rest| rest.get_mut(..bytes)).ok_or(Refused)
    }
}

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

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
        bytes.copy_from_slice(self.part(offset, bytes.len())?);
        Ok(())
    }

    fn capacity(&self) -> usize {
        BYTES
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = 1_024;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refused> {
        Timer::after_millis(20).await;
        self.part(from, to.saturating_sub(from) as usize)?.fill(ERASED);
        Ok(())
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refused> {
        Timer::after_millis(1).await;
        let part = self.part(offset, bytes.len())?;
        if part.iter().any(|&byte| byte != ERASED) {
            return Err(Refused);
        }
        part.copy_from_slice(bytes);
        Ok(())
    }
}
