//! Power is cut at every single byte that a simulated flash writes or erases: the robot loads the last complete model.

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::planning::Progress;
use goodbot::storage::{StorageError, Storing, TwoSlots, TwoSlotsAsync};
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, train};
use rand_core::Rng;
use rand_pcg::Pcg32;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

/// A NOR flash of `ERASE`-byte blocks, written `WRITE` bytes at a time and read `READ` bytes at a time. Its power is cut after `power`
/// bytes of writing and erasing.
struct Flash<const READ: usize, const WRITE: usize, const ERASE: usize> {
    bytes: Vec<u8>,
    /// Whether each byte was written since it was erased.
    written: Vec<bool>,
    /// Bytes until the power is cut.
    power: Option<u64>,
    /// Bytes written and erased so far.
    worn: u64,
    random: Pcg32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Refusal {
    NoPower,
    OutOfBounds,
    NotAligned,
    NotErased,
}

impl NorFlashError for Refusal {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::OutOfBounds => NorFlashErrorKind::OutOfBounds,
            Self::NotAligned => NorFlashErrorKind::NotAligned,
            Self::NoPower | Self::NotErased => NorFlashErrorKind::Other,
        }
    }
}

impl<const READ: usize, const WRITE: usize, const ERASE: usize> Flash<READ, WRITE, ERASE> {
    /// A new flash, not erased yet.
    fn new(blocks: usize) -> Self {
        let mut random = Pcg32::new(11, 13);
        let bytes = (0..blocks * ERASE).map(|_| random.next_u32() as u8).collect();
        Self { bytes, written: vec![true; blocks * ERASE], power: None, worn: 0, random }
    }

    fn check(&self, from: usize, length: usize, unit: usize) -> Result<(), Refusal> {
        if from + length > self.bytes.len() {
            return Err(Refusal::OutOfBounds);
        }
        if !from.is_multiple_of(unit) || !length.is_multiple_of(unit) { Err(Refusal::NotAligned) } else { Ok(()) }
    }

    /// Spends the power for one byte.
    fn spend(&mut self) -> Result<(), Refusal> {
        if self.power == Some(0) {
            return Err(Refusal::NoPower);
        }
        self.power = self.power.map(|power| power - 1);
        self.worn += 1;
        Ok(())
    }
}

impl<const READ: usize, const WRITE: usize, const ERASE: usize> ErrorType for Flash<READ, WRITE, ERASE> {
    type Error = Refusal;
}

impl<const READ: usize, const WRITE: usize, const ERASE: usize> ReadNorFlash for Flash<READ, WRITE, ERASE> {
    const READ_SIZE: usize = READ;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        let from = offset as usize;
        self.check(from, bytes.len(), READ)?;
        bytes.copy_from_slice(&self.bytes[from..from + bytes.len()]);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const READ: usize, const WRITE: usize, const ERASE: usize> NorFlash for Flash<READ, WRITE, ERASE> {
    const WRITE_SIZE: usize = WRITE;
    const ERASE_SIZE: usize = ERASE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        let (from, to) = (from as usize, to as usize);
        self.check(from, to - from, ERASE)?;
        for at in from..to {
            if let Err(refusal) = self.spend() {
                // The rest of the block is neither erased nor unchanged.
                for byte in &mut self.bytes[at..at.next_multiple_of(ERASE)] {
                    *byte |= self.random.next_u32() as u8;
                }
                return Err(refusal);
            }
            self.bytes[at] = 0xff;
            self.written[at] = false;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let from = offset as usize;
        self.check(from, bytes.len(), WRITE)?;
        for (at, &byte) in (from..).zip(bytes) {
            if self.written[at] {
                return Err(Refusal::NotErased);
            }
            if let Err(refusal) = self.spend() {
                // Some bits of the byte are written, others not.
                self.bytes[at] &= byte | self.random.next_u32() as u8;
                self.written[at] = true;
                return Err(refusal);
            }
            self.bytes[at] &= byte;
            self.written[at] = true;
        }
        Ok(())
    }
}

/// Models of a robot after each of the first lessons, each longer than the one before.
fn models(count: usize) -> Vec<Vec<u8>> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = Pcg32::new(2, 2);
    let mut models = Vec::new();
    for lesson in &school::lessons()[..count] {
        train(&mut agent, lesson, Strategy::BALANCED, &mut random).unwrap();
        let mut buffer = vec![0; agent.saved_bytes().unwrap()];
        agent.save(&mut buffer).unwrap();
        models.push(buffer);
    }
    models
}

/// The model that the robot loads.
fn load<F: NorFlash<Error = Refusal>>(slots: &mut TwoSlots<F>) -> Option<Vec<u8>> {
    let mut buffer = vec![0; 4_096];
    let length = slots.load(&mut buffer).expect("the flash can be read")?;
    buffer.truncate(length);
    Some(buffer)
}

/// Cuts the power at every byte while the next model is stored. Returns the number of cuts.
fn cut_everywhere<const READ: usize, const WRITE: usize, const ERASE: usize>(blocks: usize) -> u64 {
    let models = models(3);
    let slot_bytes = (blocks * ERASE) as u32;
    let mut cuts = 0;
    // Into an empty flash, then over one model, then over two.
    for stored in 0..models.len() {
        let prepared = || {
            let mut slots = TwoSlots::new(Flash::<READ, WRITE, ERASE>::new(2 * blocks + 2), ERASE as u32, slot_bytes).unwrap();
            for model in &models[..stored] {
                slots.store(model).unwrap();
            }
            slots
        };
        let (old, new) = (stored.checked_sub(1).map(|last| models[last].clone()), &models[stored]);
        let mut slots = prepared();
        assert_eq!(load(&mut slots), old);
        let before = slots.into_flash().worn;
        let mut slots = prepared();
        slots.store(new).unwrap();
        let whole = slots.into_flash().worn - before;
        for power in 0..whole {
            let mut flash = prepared().into_flash();
            flash.power = Some(power);
            let mut slots = TwoSlots::new(flash, ERASE as u32, slot_bytes).unwrap();
            assert_eq!(slots.store(new), Err(StorageError::Flash(Refusal::NoPower)));
            // The power is back.
            let mut flash = slots.into_flash();
            flash.power = None;
            flash.random = Pcg32::new(power, 1);
            let mut slots = TwoSlots::new(flash, ERASE as u32, slot_bytes).unwrap();
            let loaded = load(&mut slots);
            assert!(loaded == old || loaded.as_ref() == Some(new), "cut after {power} bytes");
            slots.store(new).unwrap();
            assert_eq!(load(&mut slots).as_ref(), Some(new));
            cuts += 1;
        }
    }
    cuts
}

#[test]
fn a_power_cut_at_any_byte_leaves_the_old_or_the_new_model() {
    let cuts = [
        cut_everywhere::<1, 1, 256>(4),
        cut_everywhere::<1, 4, 1_024>(1),
        cut_everywhere::<4, 8, 512>(2),
        cut_everywhere::<1, 32, 1_024>(1),
        cut_everywhere::<16, 64, 128>(8),
        cut_everywhere::<1, 256, 1_024>(1),
        cut_everywhere::<256, 1, 1_024>(1),
    ];
    println!("power cuts survived: {} ({cuts:?} for each flash)", cuts.iter().sum::<u64>());
    assert!(cuts.iter().all(|&cuts| cuts > 1_000));
}

#[test]
fn a_life_of_power_cuts_never_loses_more_than_the_last_model() {
    let models = models(7);
    let mut random = Pcg32::new(5, 5);
    let mut slots = TwoSlots::new(Flash::<1, 4, 1_024>::new(4), 0, 2_048).unwrap();
    let mut newest: Option<Vec<u8>> = None;
    let mut survived = 0;
    for model in models.iter().cycle().take(2_000) {
        let mut flash = slots.into_flash();
        flash.power = Some(u64::from(random.next_u32() % 4_000));
        slots = TwoSlots::new(flash, 0, 2_048).unwrap();
        let stored = slots.store(model);
        let loaded = load(&mut slots);
        match stored {
            Ok(()) => assert_eq!(loaded.as_ref(), Some(model)),
            Err(_) => {
                survived += 1;
                assert!(loaded == newest || loaded.as_ref() == Some(model));
            }
        }
        newest = loaded;
    }
    println!("power cuts survived in one life: {survived} of 2000 models stored");
    assert!(survived > 500);
}

#[test]
fn a_model_stored_in_parts_of_any_size_leaves_the_older_one_until_it_is_whole() {
    let models = models(3);
    let store = |slots: &mut TwoSlots<Flash<4, 8, 512>>, model: &[u8], budget| {
        let (mut storing, mut parts) = (Storing::new(), 1);
        while slots.store_on(&mut storing, model, budget)? == Progress::Working {
            parts += 1;
        }
        Ok::<u32, StorageError<Refusal>>(parts)
    };
    for (budget, least) in [(1, 400), (100, 10), (u32::MAX, 1)] {
        let mut newest = None;
        for power in (0..).step_by(37) {
            let mut slots = TwoSlots::new(Flash::<4, 8, 512>::new(8), 0, 2_048).unwrap();
            store(&mut slots, &models[0], budget).unwrap();
            store(&mut slots, &models[1], budget).unwrap();
            let mut flash = slots.into_flash();
            flash.power = Some(power);
            let mut slots = TwoSlots::new(flash, 0, 2_048).unwrap();
            let stored = store(&mut slots, &models[2], budget);
            newest = load(&mut slots);
            match stored {
                Ok(parts) => {
                    assert!(parts >= least && newest.as_ref() == Some(&models[2]), "{parts} parts of {budget} bytes");
                    break;
                }
                Err(_) => {
                    assert!(newest.as_ref() == Some(&models[1]) || newest.as_ref() == Some(&models[2]), "{budget} bytes, cut at {power}")
                }
            }
        }
        assert!(newest.is_some());
    }
    // What failed begins anew.
    let (mut slots, mut storing) = (TwoSlots::new(Flash::<4, 8, 512>::new(8), 0, 2_048).unwrap(), Storing::default());
    let mut wrong = models[0].clone();
    wrong[40] ^= 1;
    while slots.store_on(&mut storing, &wrong, 64) == Ok(Progress::Working) {}
    assert_eq!(slots.find(), Ok(None));
    while slots.store_on(&mut storing, &models[0], 64).unwrap() == Progress::Working {}
    assert_eq!(load(&mut slots).as_ref(), Some(&models[0]));
}

#[test]
fn a_model_that_is_too_long_and_what_is_no_model_leave_the_stored_one() {
    let models = models(3);
    let mut slots = TwoSlots::new(Flash::<1, 4, 256>::new(4), 0, 512).unwrap();
    slots.store(&models[0]).unwrap();
    let mut long = models[1].clone();
    assert!(slots.store(&[1, 2, 3]).is_err());
    long[40] ^= 1;
    assert!(matches!(slots.store(&long), Err(StorageError::NotAModel(_))));
    assert_eq!(load(&mut slots).as_ref(), Some(&models[0]));
    assert_eq!(slots.load(&mut [0; 10]), Err(StorageError::Size { needed: models[0].len(), given: 10 }));
    let mut slots = TwoSlots::new(Flash::<1, 4, 256>::new(2), 0, 256).unwrap();
    assert_eq!(slots.store(&models[2]), Err(StorageError::Size { needed: models[2].len(), given: 240 }));
}

#[test]
fn a_robot_that_only_obeys_keeps_its_parameters_in_flash() {
    let new = || Agent::new(HeapMemory::new(&Capacities::SMALL).agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    let parameters = |agent: &Agent<_>| {
        let mut file = vec![0; 4_096];
        let length = agent.save_parameters(&mut file).unwrap();
        file.truncate(length);
        file
    };
    let mut taught = new();
    train(&mut taught, &school::lessons()[0], Strategy::BALANCED, &mut Pcg32::new(2, 2)).unwrap();
    let mut file = parameters(&taught);
    let mut slots = TwoSlots::new(Flash::<1, 4, 256>::new(32), 0, 4_096).unwrap();
    slots.store(&file).unwrap();
    let mut obeying = new();
    obeying.restore_parameters(&load(&mut slots).unwrap()).unwrap();
    assert!(parameters(&obeying) == file);
    file[20] ^= 1;
    assert!(matches!(slots.store(&file), Err(StorageError::NotAModel(_))));
}

#[test]
fn slots_off_the_erase_blocks_or_beyond_the_flash_are_refused() {
    for (start, slot) in [(1, 256), (0, 255), (0, 512), (256, 512), (u32::MAX, 256), (0, 0), (0, u32::MAX)] {
        assert_eq!(TwoSlots::new(Flash::<1, 4, 256>::new(3), start, slot).map(|_| ()), Err(StorageError::Geometry), "{start} {slot}");
    }
}

/// The same flash with asynchronous calls, as a controller uses it that works on while the flash is busy: every call is pending once.
struct Slow(Flash<1, 4, 256>);

async fn wait() {
    let mut waited = false;
    std::future::poll_fn(|context| {
        context.waker().wake_by_ref();
        if std::mem::replace(&mut waited, true) { Poll::Ready(()) } else { Poll::Pending }
    })
    .await
}

impl ErrorType for Slow {
    type Error = Refusal;
}

impl embedded_storage_async::nor_flash::ReadNorFlash for Slow {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        wait().await;
        ReadNorFlash::read(&mut self.0, offset, bytes)
    }

    fn capacity(&self) -> usize {
        ReadNorFlash::capacity(&self.0)
    }
}

impl embedded_storage_async::nor_flash::NorFlash for Slow {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = 256;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        wait().await;
        NorFlash::erase(&mut self.0, from, to)
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        wait().await;
        NorFlash::write(&mut self.0, offset, bytes)
    }
}

/// Polls at most this many times. `None` if that was not enough.
fn poll<T>(future: impl Future<Output = T>, times: usize) -> Option<T> {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    (0..times).find_map(|_| match future.as_mut().poll(&mut context) {
        Poll::Ready(done) => Some(done),
        Poll::Pending => None,
    })
}

#[test]
fn a_flash_that_is_waited_for_keeps_what_the_other_form_finds() {
    let models = models(2);
    let mut slots = TwoSlotsAsync::new(Slow(Flash::new(8)), 0, 1_024).unwrap();
    for model in &models {
        assert_eq!(poll(slots.store(model), usize::MAX), Some(Ok(())));
        let mut buffer = [0; 1_024];
        assert_eq!(poll(slots.load(&mut buffer), usize::MAX), Some(Ok(Some(model.len()))));
        assert_eq!(&buffer[..model.len()], model);
    }
    let mut other = TwoSlots::new(slots.into_flash().0, 0, 1_024).unwrap();
    assert_eq!(load(&mut other).as_ref(), Some(&models[1]));
}

#[test]
fn a_store_that_is_given_up_after_any_wait_leaves_the_old_or_the_new_model() {
    let models = models(2);
    let mut given_up = 0;
    for polls in 0.. {
        let mut slots = TwoSlotsAsync::new(Slow(Flash::new(8)), 0, 1_024).unwrap();
        assert_eq!(poll(slots.store(&models[0]), usize::MAX), Some(Ok(())));
        let stored = poll(slots.store(&models[1]), polls);
        let mut after = TwoSlots::new(slots.into_flash().0, 0, 1_024).unwrap();
        let found = load(&mut after);
        if stored.is_some() {
            assert_eq!(found.as_ref(), Some(&models[1]));
            break;
        }
        assert!(found.as_ref() == Some(&models[0]) || found.as_ref() == Some(&models[1]), "given up after {polls} polls");
        given_up += 1;
    }
    assert!(given_up > 10, "{given_up} waits are too few to try anything");
}
