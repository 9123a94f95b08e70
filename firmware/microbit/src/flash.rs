//! The last pages of the flash: a home that came with the program's file, and the learned model, which is kept without power.

use crate::memory::{Agent, CAPACITIES};
use crate::nrf51::{self, FLASH, Refused, SLOT, START, check};
use crate::wiring::wiring;
use embedded_storage::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use goodbot::snapshot::{RestoreError, most_bytes};
use goodbot::storage::{SLOT_HEADER_BYTES, StorageError, TwoSlots};
use nrf51_pac::NVMC;

/// The start of the home and the commands that came with the file: text, then erased flash up to the slots. In an emulator, erased flash is
/// 0.
const CHOSEN: u32 = 0x3_DC00;
const ERASED: [u8; 2] = [0xff, 0];

/// The most bytes of a model of this robot: they fit into a slot, and into the memory where it is written.
const MODEL: usize = most_bytes(&CAPACITIES);
const _: () = assert!(MODEL <= SLOT as usize - SLOT_HEADER_BYTES && MODEL <= 8 * CAPACITIES.workspace_words());

/// The processor's own flash.
#[derive(Debug)]
struct Flash;

impl ErrorType for Flash {
    type Error = Refused;
}

fn controller() -> &'static nrf51_pac::nvmc::RegisterBlock {
    // SAFETY: the registers exist for ever, and only this module uses them.
    unsafe { &*NVMC::ptr() }
}

fn wait() {
    while controller().ready.read().ready().is_busy() {}
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
        nrf51::read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        FLASH as usize
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    /// A page of V2, four of V1.
    const ERASE_SIZE: usize = SLOT as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Refused> {
        check(from, to.saturating_sub(from) as usize)?;
        controller().config.write(|config| config.wen().een());
        let mut page = from;
        while page < to {
            // SAFETY: a page that holds no part of the program.
            controller().erasepage().write(|at| unsafe { at.bits(page) });
            wait();
            page = page.saturating_add(wiring().page);
        }
        controller().config.write(|config| config.wen().ren());
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refused> {
        let words = nrf51::words(offset, bytes)?;
        controller().config.write(|config| config.wen().wen());
        for (at, word) in words {
            // SAFETY: an aligned word of the flash that holds no part of the program.
            unsafe { at.write_volatile(word) };
            wait();
        }
        controller().config.write(|config| config.wen().ren());
        Ok(())
    }
}

fn slots() -> Result<TwoSlots<Flash>, StorageError<Refused>> {
    TwoSlots::new(Flash, START, SLOT)
}

/// The model as it is stored. It is written into the robot's own tables: there is no room for a buffer.
pub fn written(agent: &mut Agent) -> Result<&[u8], &'static str> {
    agent.save_in_place().map_err(|_| "what was learned cannot be stored; say `forget` to begin anew")
}

/// Stores the model, and returns the number of its bytes.
#[inline(never)]
pub fn store(agent: &mut Agent) -> Result<usize, &'static str> {
    let model = written(agent)?;
    slots().and_then(|mut slots| slots.store(model)).map_err(|error| match error {
        StorageError::NotKept => "the flash did not keep what was learned; the older knowledge is still there",
        _ => "the flash refused to store; the older knowledge is still there",
    })?;
    Ok(model.len())
}

/// The home and the commands that came with the file, one request a line; `None` if the robot has only its own.
pub fn chosen() -> Option<&'static str> {
    // SAFETY: this is within the flash, which is always readable, and nobody ever writes to it.
    let page = unsafe { core::slice::from_raw_parts(CHOSEN as *const u8, (START - CHOSEN) as usize) };
    let end = page.iter().position(|byte| ERASED.contains(byte)).unwrap_or(page.len());
    page.get(..end).filter(|text| !text.is_empty()).and_then(|text| core::str::from_utf8(text).ok())
}

/// Restores the stored model, and returns its bytes; 0 if nothing is stored. The robot must then learn to the end.
#[inline(never)]
pub fn restore(agent: &mut Agent) -> Result<usize, &'static str> {
    let Some((at, length)) = slots().and_then(|mut slots| slots.find()).map_err(|_| "the flash cannot be read")? else { return Ok(0) };
    let model = nrf51::model(at, length).ok_or("the flash cannot be read")?;
    agent.restore(model).map_err(|error| match error {
        RestoreError::Version { .. } => "what is stored was written by a newer version",
        RestoreError::OtherDomain => "what is stored was learned by another kind of robot",
        RestoreError::Capacity(_) => "what is stored is too large for this robot",
        _ => "what is stored is damaged",
    })?;
    Ok(length)
}

/// Erases the stored model.
pub fn erase() -> Result<(), &'static str> {
    Flash.erase(START, START + 2 * SLOT).map_err(|_| "the flash refused to erase")
}
