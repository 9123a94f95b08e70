//! The handle: a robot at the beginning of the caller's memory.

use crate::arena::{Arena, memory};
use crate::capacities::GoodbotCapacities;
use crate::status::{Failure, GoodbotStatus};
use crate::table::TableDomain;
use core::ffi::{CStr, c_char};
use goodbot::capacity::CapacityError;
use goodbot::home::{Home, HomeBuilder, HomeMemory, HomeState};
use goodbot::memory::Memory;
use goodbot::oomdp::objects::ObjectMemory;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use rand_pcg::Pcg32;

const MAGIC: u32 = 0x676f_6f64;

/// A robot. Its memory is the caller's and must not be moved, copied over or freed while it is used.
#[derive(Debug)]
pub struct Goodbot {
    magic: u32,
    pub(crate) full: Option<CapacityError>,
    pub(crate) random: Pcg32,
    pub(crate) agent: Agent<'static>,
    rooms: RawHome,
    pub(crate) world: World,
}

/// What the robot lives in.
#[derive(Debug)]
pub enum World {
    /// Nothing yet.
    Nothing,
    /// A home that is being described.
    Plan(HomeBuilder<'static>),
    /// A home, where things stand now, and where they stood when it was built.
    Home(Home<'static>, HomeState),
    /// The caller's own.
    Table(TableDomain, u32),
}

/// The memory of a home, to be lent again and again.
#[derive(Clone, Copy, Debug)]
struct RawHome {
    objects: *mut [goodbot::oomdp::Object],
    name_bytes: *mut [u8],
    name_ends: *mut [u16],
    areas: *mut [goodbot::home::layout::StoredArea],
    places: *mut [goodbot::home::Place],
}

impl RawHome {
    fn of(memory: HomeMemory<'static>) -> Self {
        Self {
            objects: memory.objects.objects,
            name_bytes: memory.objects.name_bytes,
            name_ends: memory.objects.name_ends,
            areas: memory.areas,
            places: memory.places,
        }
    }

    /// # Safety
    /// What was lent before is not used any more.
    unsafe fn lend(self) -> HomeMemory<'static> {
        // SAFETY: the pointers come from references to the caller's memory, which stays; nothing else refers to it, as the caller of this
        // promises.
        unsafe {
            HomeMemory {
                objects: ObjectMemory { objects: &mut *self.objects, name_bytes: &mut *self.name_bytes, name_ends: &mut *self.name_ends },
                areas: &mut *self.areas,
                places: &mut *self.places,
            }
        }
    }
}

impl Goodbot {
    /// The home's memory for a new description; the world there was is gone.
    pub(crate) fn empty_home(&mut self) -> HomeMemory<'static> {
        self.agent.forget();
        self.world = World::Nothing;
        // SAFETY: the world was all that used it.
        unsafe { self.rooms.lend() }
    }
}

/// Memory that was checked and dealt out, for a robot that is not made yet.
pub(crate) struct Plot {
    pub(crate) at: *mut Goodbot,
    pub(crate) memory: Memory<'static>,
    pub(crate) arena: Arena,
}

/// Deals out the caller's memory.
///
/// # Safety
/// `capacities` is null or points to capacities; `bytes` bytes from `at` on are the caller's alone and stay.
pub(crate) unsafe fn plot(at: *mut u8, bytes: usize, capacities: *const GoodbotCapacities) -> Result<Plot, GoodbotStatus> {
    // SAFETY: the caller's promise.
    let Some(capacities) = (unsafe { capacities.as_ref() }) else { return Err(GoodbotStatus::Null) };
    if at.is_null() {
        return Err(GoodbotStatus::Null);
    }
    if at.align_offset(8) != 0 {
        return Err(GoodbotStatus::Alignment);
    }
    // SAFETY: the caller's promise.
    let mut arena = unsafe { Arena::new(at, bytes) };
    let at = arena.place::<Goodbot>(1).ok_or(GoodbotStatus::Memory)?;
    let memory = memory(&mut arena, &Capacities::from(capacities)).ok_or(GoodbotStatus::Memory)?;
    Ok(Plot { at, memory, arena })
}

/// Makes the robot and gives its handle.
///
/// # Safety
/// `at` is room for a robot, and `robot` for a handle.
pub(crate) unsafe fn settle(
    at: *mut Goodbot,
    memory: Memory<'static>,
    tasks: &[LiftedTask],
    world: impl FnOnce(HomeMemory<'static>) -> Result<World, Failure>,
    robot: *mut *mut Goodbot,
) -> GoodbotStatus {
    let rooms = RawHome::of(memory.home);
    let agent = match Agent::new(memory.agent, tasks, Options::DEFAULT) {
        Ok(agent) => agent,
        Err(error) => return Failure::from(error).status,
    };
    // SAFETY: nothing else uses it yet.
    let world = match world(unsafe { rooms.lend() }) {
        Ok(world) => world,
        Err(failure) => return failure.status,
    };
    // SAFETY: the caller's promise.
    unsafe {
        at.write(Goodbot { magic: MAGIC, full: None, random: Pcg32::new(0, 0x2014), agent, rooms, world });
        robot.write(at);
    }
    GoodbotStatus::Ok
}

/// Does something with the robot, if the handle is one; remembers which table was full.
///
/// # Safety
/// `robot` is null or a handle that an init function gave, and no other call uses it now.
pub(crate) unsafe fn with(robot: *mut Goodbot, run: impl FnOnce(&mut Goodbot) -> Result<GoodbotStatus, Failure>) -> GoodbotStatus {
    if robot.is_null() {
        return GoodbotStatus::Null;
    }
    if robot.align_offset(align_of::<Goodbot>()) != 0 {
        return GoodbotStatus::BadHandle;
    }
    // SAFETY: the caller's promise; the first words of a robot are plain numbers.
    if unsafe { (&raw const (*robot).magic).read() } != MAGIC {
        return GoodbotStatus::BadHandle;
    }
    // SAFETY: as above.
    let robot = unsafe { &mut *robot };
    match run(robot) {
        Ok(status) => status,
        Err(failure) => {
            robot.full = failure.full.or(robot.full);
            failure.status
        }
    }
}

/// A text of the caller's.
///
/// # Safety
/// `text` is null or a C string that stays as long as `'a`.
pub(crate) unsafe fn text<'a>(text: *const c_char) -> Result<&'a str, GoodbotStatus> {
    if text.is_null() {
        return Err(GoodbotStatus::Null);
    }
    // SAFETY: the caller's promise.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|_| GoodbotStatus::Text)
}

/// Gives a value to the caller.
///
/// # Safety
/// `to` is null or room for the value.
pub(crate) unsafe fn give<T>(to: *mut T, value: T) -> Result<GoodbotStatus, Failure> {
    if to.is_null() {
        return Err(GoodbotStatus::Null.into());
    }
    // SAFETY: the caller's promise.
    unsafe { to.write(value) };
    Ok(GoodbotStatus::Ok)
}

/// Begins the robot's own random choices anew: the same seed, the same choices.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_seed(robot: *mut Goodbot, seed: u64) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.random = Pcg32::new(seed, 0x2014);
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// The table that was full last: its name in `name` (cut to `bytes` with its 0), how much it holds, and how much was asked of it.
/// `UNKNOWN` where none was.
///
/// # Safety
/// `robot` is null or a handle; `name` is room for `bytes` bytes; the others are room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_full(
    robot: *mut Goodbot,
    name: *mut c_char,
    bytes: usize,
    limit: *mut u32,
    given: *mut u32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise, for each of them.
    unsafe {
        with(robot, |robot| {
            let full = robot.full.ok_or(GoodbotStatus::Unknown)?;
            let field = full.capacity.field();
            let behind_path = field.bytes().rposition(|byte| byte == b':').map_or(0, |colon| colon.saturating_add(1));
            let field = field.get(behind_path..).unwrap_or(field);
            if name.is_null() || bytes == 0 {
                return Err(GoodbotStatus::Null.into());
            }
            let written = field.bytes().take(bytes.saturating_sub(1)).enumerate();
            let end = written.fold(0, |_, (at, byte)| {
                name.add(at).write(byte as c_char);
                at.saturating_add(1)
            });
            name.add(end).write(0);
            give(limit, full.limit)?;
            give(given, full.given)
        })
    }
}
