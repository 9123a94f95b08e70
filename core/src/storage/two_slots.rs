//! Two slots in flash: one always holds a complete model.

use super::error::StorageError;
use super::slot::{SLOT_HEADER_BYTES, SlotHeader};
use crate::checksum::{CHECK_BYTES, Running};
use crate::planning::Progress;
use crate::snapshot::{RestoreError, check};
use embedded_storage::nor_flash::NorFlash;

/// The largest unit of reading or writing of a flash.
const MOST_UNIT: usize = 256;

/// The bytes of the flash that are looked at, and its next step.
#[derive(Clone, Debug)]
struct Look {
    /// The header of the slot, once it is read.
    header: Option<SlotHeader>,
    checked: Checked,
}

impl Look {
    fn new() -> Self {
        Self { header: None, checked: Checked::new() }
    }
}

/// A model's own check, in parts: its last bytes are the checksum of those before.
#[derive(Clone, Debug)]
struct Checked {
    at: usize,
    sum: Running,
    stated: [u8; CHECK_BYTES],
}

impl Checked {
    fn new() -> Self {
        Self { at: 0, sum: Running::new(), stated: [0; CHECK_BYTES] }
    }

    /// Takes the next bytes of a model of this length.
    fn take(&mut self, length: usize, part: &[u8]) {
        let summed = length.saturating_sub(CHECK_BYTES);
        let (front, tail) = part.split_at_checked(summed.saturating_sub(self.at).min(part.len())).unwrap_or((part, &[]));
        self.sum.update(front);
        let missing = self.at.saturating_add(front.len()).saturating_sub(summed);
        for (slot, byte) in self.stated.iter_mut().skip(missing).zip(tail) {
            *slot = *byte;
        }
        self.at = self.at.saturating_add(part.len());
    }

    fn is_right(&self) -> bool {
        self.sum.value() == u32::from_le_bytes(self.stated)
    }
}

/// A model that is being stored in parts: [`TwoSlots::store_on`].
///
/// ```no_run
/// # fn example<F: embedded_storage::nor_flash::NorFlash>(slots: &mut goodbot::storage::TwoSlots<F>, model: &[u8]) -> Option<()> {
/// use goodbot::{planning::Progress, storage::Storing};
/// let mut storing = Storing::new();
/// while slots.store_on(&mut storing, model, 256).ok()? == Progress::Working {
///     // the rest of the control loop
/// }
/// # Some(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Storing {
    stage: Stage,
    look: Look,
    /// The slot to write, and its header; until then, of the newest complete model.
    slot: usize,
    header: Option<SlotHeader>,
}

/// The next step of storing a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The model's own check.
    Model,
    /// Which slot has the older model; this one is looked at.
    Slot(usize),
    /// The slot is erased, from this byte on.
    Erase(usize),
    /// The model is written, from this byte on.
    Write(usize),
    /// With the last byte of the header, the new model becomes the newest.
    Header,
    /// What was written is read.
    Kept,
}

impl Storing {
    /// Nothing is stored yet.
    pub fn new() -> Self {
        Self { stage: Stage::Model, look: Look::new(), slot: 1, header: None }
    }
}

impl Default for Storing {
    fn default() -> Self {
        Self::new()
    }
}

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
                self.read(self.model_start(slot), needed, |bytes| {
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
                let mut storing = Storing::new();
                while self.store_on(&mut storing, model, u32::MAX)$($await)*? == Progress::Working {}
                Ok(())
            }

            /// Stores a model as [`store`](Self::store) does, but in parts: each reads, writes or erases at most about `budget` bytes, and at
            /// least one unit of the flash. Erasing ends a part. The model must stay the same until the last one. Of its contents only the
            /// checksum is checked.
            ///
            /// # Errors
            /// As [`store`](Self::store); storing then begins anew.
            pub $($async)? fn store_on(
                &mut self,
                storing: &mut Storing,
                model: &[u8],
                budget: u32,
            ) -> Result<Progress, StorageError<F::Error>> {
                let mut left = (budget as usize).max(1);
                while left > 0 {
                    let before = storing.stage;
                    match self.store_step(storing, model, left)$($await)* {
                        Ok(Some(bytes)) => left = left.saturating_sub(bytes.max(1)),
                        done => {
                            *storing = Storing::new();
                            return done.map(|_| Progress::Done);
                        }
                    }
                    if matches!(before, Stage::Erase(_)) && budget < u32::MAX {
                        break;
                    }
                }
                Ok(Progress::Working)
            }

            /// Does one step of storing. Returns its bytes, `None` if it was the last.
            $($async)? fn store_step(
                &mut self,
                storing: &mut Storing,
                model: &[u8],
                left: usize,
            ) -> Result<Option<usize>, StorageError<F::Error>> {
                let Storing { stage, look, slot, header } = storing;
                match *stage {
                    Stage::Model => {
                        if model.len() > self.room() {
                            return Err(StorageError::Size { needed: model.len(), given: self.room() });
                        }
                        let end = look.checked.at.saturating_add(left.min(MOST_UNIT)).min(model.len());
                        let part = model.get(look.checked.at..end).unwrap_or(&[]);
                        look.checked.take(model.len(), part);
                        if end == model.len() {
                            if end <= CHECK_BYTES || !look.checked.is_right() {
                                return Err(StorageError::NotAModel(RestoreError::Damaged));
                            }
                            (*stage, *look) = (Stage::Slot(0), Look::new());
                        }
                        Ok(Some(part.len()))
                    }
                    Stage::Slot(at) => {
                        let (bytes, found) = self.look_on(at, look, left)$($await)*?;
                        let Some(found) = found else { return Ok(Some(bytes)) };
                        if let Some(found) = found && header.is_none_or(|first| found.is_newer_than(first)) {
                            (*slot, *header) = (at, Some(found));
                        }
                        (*stage, *look) = (Stage::Slot(1), Look::new());
                        if at > 0 {
                            let sequence = header.map_or(0, |newest| newest.sequence.wrapping_add(1));
                            *slot = 1_usize.saturating_sub(*slot);
                            *header = Some(SlotHeader { sequence, length: model.len() as u32 });
                            *stage = Stage::Erase(0);
                        }
                        Ok(Some(bytes))
                    }
                    Stage::Erase(at) => {
                        // The header's block goes first: what is left of an older model never counts.
                        let block = F::ERASE_SIZE.max(1);
                        let used = Self::header_bytes().saturating_add(model.len()).next_multiple_of(block);
                        let end = at.saturating_add(left).min(used).next_multiple_of(block);
                        let from = self.slot_start(*slot);
                        self.flash.erase(from.saturating_add(at as u32), from.saturating_add(end as u32))$($await)*.map_err(StorageError::Flash)?;
                        *stage = if end < used { Stage::Erase(end) } else { Stage::Write(0) };
                        Ok(Some(end.saturating_sub(at)))
                    }
                    Stage::Write(at) => {
                        let end = at.saturating_add(left).min(model.len()).next_multiple_of(F::WRITE_SIZE.max(1)).min(model.len());
                        self.write(self.model_start(*slot).saturating_add(at as u32), model.get(at..end).unwrap_or(&[]))$($await)*?;
                        *stage = if end < model.len() { Stage::Write(end) } else { Stage::Header };
                        Ok(Some(end.saturating_sub(at)))
                    }
                    Stage::Header => {
                        let bytes = header.map_or([0; SLOT_HEADER_BYTES], SlotHeader::bytes);
                        self.write(self.slot_start(*slot), &bytes)$($await)*?;
                        *stage = Stage::Kept;
                        Ok(Some(Self::header_bytes()))
                    }
                    Stage::Kept => {
                        let (bytes, found) = self.look_on(*slot, look, left)$($await)*?;
                        match found {
                            None => Ok(Some(bytes)),
                            Some(found) if found == *header => Ok(None),
                            Some(_) => Err(StorageError::NotKept),
                        }
                    }
                }
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
                let mut look = Look::new();
                loop {
                    if let (_, Some(found)) = self.look_on(slot, &mut look, MOST_UNIT)$($await)*? {
                        return Ok(found);
                    }
                }
            }

            /// Reads on in a slot: its header, or at most about so many bytes of its model. Returns how many, and after the last ones the
            /// header, if the model's own check matches.
            $($async)? fn look_on(
                &mut self,
                slot: usize,
                look: &mut Look,
                most: usize,
            ) -> Result<(usize, Option<Option<SlotHeader>>), StorageError<F::Error>> {
                let Look { header, checked } = look;
                let Some(known) = *header else {
                    let mut bytes = [0; SLOT_HEADER_BYTES];
                    let mut filled = 0_usize;
                    self.read(self.slot_start(slot), SLOT_HEADER_BYTES, |part| {
                        for (slot, byte) in bytes.iter_mut().skip(filled).zip(part) {
                            *slot = *byte;
                        }
                        filled = filled.saturating_add(part.len());
                    })$($await)*?;
                    let is_whole = |header: &SlotHeader| (CHECK_BYTES..=self.room()).contains(&(header.length as usize));
                    *header = SlotHeader::read(&bytes).filter(is_whole);
                    return Ok((SLOT_HEADER_BYTES, header.is_none().then_some(None)));
                };
                let (length, unit) = (known.length as usize, F::READ_SIZE.max(1));
                let part = most.min(MOST_UNIT).next_multiple_of(unit).min(length.saturating_sub(checked.at));
                let from = self.model_start(slot).saturating_add(checked.at as u32);
                self.read(from, part, |bytes| checked.take(length, bytes))$($await)*?;
                let is_read = checked.at >= length;
                Ok((part, is_read.then(|| Some(known).filter(|_| checked.is_right()))))
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
