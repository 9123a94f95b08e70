//! Two slots in flash: one always holds a complete model.

use super::error::StorageError;
use super::slot::{SLOT_HEADER_BYTES, SlotHeader};
use crate::checksum::{CHECK, CHECK_BYTES};
use crate::snapshot::check;
use embedded_storage::nor_flash::NorFlash;

/// The largest unit of reading or writing of a flash.
const MOST_UNIT: usize = 256;

/// Two slots in flash. After the first store, one of them always holds a complete model.
///
/// ```no_run
/// # fn example<F: embedded_storage::nor_flash::NorFlash>(flash: F, agent: &mut goodbot::Agent<impl goodbot::memory::AgentMemory>) -> Option<()> {
/// use goodbot::storage::TwoSlots;
/// let mut slots = TwoSlots::new(flash, 0, 4_096).ok()?;
/// let mut buffer = [0; 3_072];
/// if let Some(length) = slots.load(&mut buffer).ok()? {
///     agent.restore(&buffer[..length]).ok()?;
/// }
/// // ... the robot learns ...
/// let length = agent.save(&mut buffer).ok()?;
/// slots.store(&buffer[..length]).ok()?;
/// # Some(())
/// # }
/// ```
#[derive(Debug)]
pub struct TwoSlots<F> {
    flash: F,
    start: u32,
    slot_bytes: u32,
}

/// [`TwoSlots`] over asynchronous flash: `embedded-storage-async`, as in embassy. Both use the same format, and each loads models that the
/// other stored. A store that is cancelled halfway has the effect of a power cut: the previous model stays.
///
/// ```no_run
/// # async fn example<F: embedded_storage_async::nor_flash::NorFlash>(flash: F, agent: &mut goodbot::Agent<impl goodbot::memory::AgentMemory>) -> Option<()> {
/// use goodbot::storage::TwoSlotsAsync;
/// let mut slots = TwoSlotsAsync::new(flash, 0, 4_096).ok()?;
/// let mut buffer = [0; 3_072];
/// if let Some(length) = slots.load(&mut buffer).await.ok()? {
///     agent.restore(&buffer[..length]).ok()?;
/// }
/// // ... the robot learns ...
/// let length = agent.save(&mut buffer).ok()?;
/// slots.store(&buffer[..length]).await.ok()?;
/// # Some(())
/// # }
/// ```
#[derive(Debug)]
pub struct TwoSlotsAsync<F> {
    flash: F,
    start: u32,
    slot_bytes: u32,
}

/// The code of both, with or without `async` and `await`.
macro_rules! two_slots {
    ($Slots:ident, $NorFlash:path, [$($async:tt)?], [$($await:tt)*]) => {
        impl<F: $NorFlash> $Slots<F> {
            /// Two slots of `slot_bytes` each, one after the other from `start`. Nothing is written yet. A slot needs room for the header
            /// and for [`most_bytes`](crate::snapshot::most_bytes) of the robot's capacities.
            ///
            /// # Errors
            /// [`StorageError::Geometry`].
            pub fn new(flash: F, start: u32, slot_bytes: u32) -> Result<Self, StorageError<F::Error>> {
                let block = F::ERASE_SIZE;
                let on_block = |at: u32| (at as usize).checked_rem(block) == Some(0);
                let unit = |size: usize| (1..=MOST_UNIT).contains(&size) && block.checked_rem(size) == Some(0);
                let end = u64::from(start).saturating_add(u64::from(slot_bytes).saturating_mul(2));
                let fits = end <= flash.capacity() as u64 && u32::try_from(end).is_ok();
                if fits && slot_bytes > 0 && on_block(start) && on_block(slot_bytes) && unit(F::WRITE_SIZE) && unit(F::READ_SIZE) {
                    Ok(Self { flash, start, slot_bytes })
                } else {
                    Err(StorageError::Geometry)
                }
            }

            /// Returns the flash.
            pub fn into_flash(self) -> F {
                self.flash
            }

            /// The most bytes of a model in a slot.
            pub fn room(&self) -> usize {
                (self.slot_bytes as usize).saturating_sub(Self::header_bytes())
            }

            /// The header's bytes, rounded up so that the flash can read and write the model at its start.
            fn header_bytes() -> usize {
                let unit = F::WRITE_SIZE.max(F::READ_SIZE);
                SLOT_HEADER_BYTES.next_multiple_of(F::WRITE_SIZE.max(1)).next_multiple_of(unit.max(1))
            }

            fn slot_start(&self, slot: usize) -> u32 {
                if slot == 0 { self.start } else { self.start.saturating_add(self.slot_bytes) }
            }

            fn model_start(&self, slot: usize) -> u32 {
                self.slot_start(slot).saturating_add(Self::header_bytes() as u32)
            }

            /// The address of the newest complete model in the flash, and its length; `None` if none was ever stored. If the processor maps
            /// its flash into memory, the model can be restored from there without a buffer.
            ///
            /// # Errors
            /// [`StorageError::Flash`].
            pub $($async)? fn find(&mut self) -> Result<Option<(u32, usize)>, StorageError<F::Error>> {
                let newest = self.newest()$($await)*?;
                Ok(newest.map(|(slot, header)| (self.model_start(slot), header.length as usize)))
            }

            /// Loads the newest complete model to the front of the buffer. Returns its length; `None` if none was ever stored.
            ///
            /// # Errors
            /// [`StorageError::Flash`], or [`StorageError::Size`] if the buffer is too small.
            pub $($async)? fn load(&mut self, buffer: &mut [u8]) -> Result<Option<usize>, StorageError<F::Error>> {
                let Some((slot, header)) = self.newest()$($await)*? else { return Ok(None) };
                let (needed, given) = (header.length as usize, buffer.len());
                let room = buffer.get_mut(..needed).ok_or(StorageError::Size { needed, given })?;
                let mut written = 0_usize;
                self.read_model(slot, header.length, |bytes| {
                    let end = written.saturating_add(bytes.len());
                    if let Some(part) = room.get_mut(written..end) {
                        // Both have this length. `copy_from_slice` would check it and could panic.
                    part.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = *byte);
                    }
                    written = end;
                })$($await)*?;
                Ok(Some(needed))
            }

            /// Stores a model, or a file of parameters, over the older slot. Until this is complete, the previous one is the newest.
            ///
            /// # Errors
            /// [`StorageError`]; the previous model is then still the newest, unless the flash failed after the last byte was written.
            pub $($async)? fn store(&mut self, model: &[u8]) -> Result<(), StorageError<F::Error>> {
                check(model).map_err(StorageError::NotAModel)?;
                let too_large = StorageError::Size { needed: model.len(), given: self.room() };
                if model.len() > self.room() {
                    return Err(too_large);
                }
                let (slot, sequence) = match self.newest()$($await)*? {
                    Some((newest, header)) => (1_usize.saturating_sub(newest), header.sequence.wrapping_add(1)),
                    None => (0, 0),
                };
                let header = SlotHeader { sequence, length: u32::try_from(model.len()).map_err(|_| too_large)? };
                let from = self.slot_start(slot);
                let used = Self::header_bytes().saturating_add(model.len()).next_multiple_of(F::ERASE_SIZE.max(1));
                self.flash.erase(from, from.saturating_add(used as u32))$($await)*.map_err(StorageError::Flash)?;
                self.write(from.saturating_add(Self::header_bytes() as u32), model)$($await)*?;
                // With the last byte of the header, the new model becomes the newest.
                self.write(from, &header.bytes())$($await)*?;
                if self.complete(slot)$($await)*? == Some(header) { Ok(()) } else { Err(StorageError::NotKept) }
            }

            /// Writes the bytes, padding the last unit with the value of erased flash.
            $($async)? fn write(&mut self, at: u32, bytes: &[u8]) -> Result<(), StorageError<F::Error>> {
                let unit = F::WRITE_SIZE.max(1);
                let whole = bytes.len().saturating_sub(bytes.len().checked_rem(unit).unwrap_or(0));
                let (front, tail) = bytes.split_at_checked(whole).unwrap_or((bytes, &[]));
                if !front.is_empty() {
                    self.flash.write(at, front)$($await)*.map_err(StorageError::Flash)?;
                }
                if !tail.is_empty() {
                    let mut last = [0xff; MOST_UNIT];
                    for (slot, byte) in last.iter_mut().zip(tail) {
                        *slot = *byte;
                    }
                    let last = last.get(..unit).ok_or(StorageError::Geometry)?;
                    self.flash.write(at.saturating_add(whole as u32), last)$($await)*.map_err(StorageError::Flash)?;
                }
                Ok(())
            }

            /// The slot with the newest complete model.
            $($async)? fn newest(&mut self) -> Result<Option<(usize, SlotHeader)>, StorageError<F::Error>> {
                Ok(match (self.complete(0)$($await)*?, self.complete(1)$($await)*?) {
                    (Some(first), Some(second)) => Some(if second.is_newer_than(first) { (1, second) } else { (0, first) }),
                    (Some(first), None) => Some((0, first)),
                    (None, Some(second)) => Some((1, second)),
                    (None, None) => None,
                })
            }

            /// The header of a slot if its model's own check matches.
            $($async)? fn complete(&mut self, slot: usize) -> Result<Option<SlotHeader>, StorageError<F::Error>> {
                let mut bytes = [0; SLOT_HEADER_BYTES];
                let mut filled = 0_usize;
                self.read(self.slot_start(slot), SLOT_HEADER_BYTES, |part| {
                    for (slot, byte) in bytes.iter_mut().skip(filled).zip(part) {
                        *slot = *byte;
                    }
                    filled = filled.saturating_add(part.len());
                })$($await)*?;
                let Some(header) = SlotHeader::read(&bytes).filter(|header| header.length as usize <= self.room()) else { return Ok(None) };
                let Some(checked) = (header.length as usize).checked_sub(CHECK_BYTES) else { return Ok(None) };
                let mut digest = CHECK.digest();
                let (mut seen, mut check) = (0_usize, [0; CHECK_BYTES]);
                self.read_model(slot, header.length, |part| {
                    let (front, tail) = part.split_at_checked(checked.saturating_sub(seen).min(part.len())).unwrap_or((part, &[]));
                    digest.update(front);
                    let missing = seen.saturating_add(front.len()).saturating_sub(checked);
                    for (slot, byte) in check.iter_mut().skip(missing).zip(tail) {
                        *slot = *byte;
                    }
                    seen = seen.saturating_add(part.len());
                })$($await)*?;
                Ok((digest.finalize() == u32::from_le_bytes(check)).then_some(header))
            }

            $($async)? fn read_model(&mut self, slot: usize, length: u32, take: impl FnMut(&[u8])) -> Result<(), StorageError<F::Error>> {
                self.read(self.model_start(slot), length as usize, take)$($await)*
            }

            /// Passes `length` bytes from `at` on to `take`, in parts that the flash can read.
            $($async)? fn read(&mut self, mut at: u32, length: usize, mut take: impl FnMut(&[u8])) -> Result<(), StorageError<F::Error>> {
                let mut chunk = [0; MOST_UNIT];
                let unit = F::READ_SIZE.max(1);
                let most = MOST_UNIT.saturating_sub(MOST_UNIT.checked_rem(unit).unwrap_or(0));
                let mut left = length;
                while left > 0 {
                    let wanted = left.min(most);
                    let part = chunk.get_mut(..wanted.next_multiple_of(unit)).ok_or(StorageError::Geometry)?;
                    self.flash.read(at, part)$($await)*.map_err(StorageError::Flash)?;
                    take(part.get(..wanted).unwrap_or(&[]));
                    at = at.saturating_add(wanted as u32);
                    left = left.saturating_sub(wanted);
                }
                Ok(())
            }
        }
    };
}

two_slots!(TwoSlots, NorFlash, [], []);
two_slots!(TwoSlotsAsync, embedded_storage_async::nor_flash::NorFlash, [async], [.await]);
