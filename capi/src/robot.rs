//! The handle: a robot at the beginning of the caller's memory.

use crate::arena::{Arena, Dealt, deal_agent, deal_home};
use crate::capacities::GoodbotCapacities;
use crate::status::{At, Failure, Fault, GoodbotStatus, Place};
use crate::world::World;
use core::cell::UnsafeCell;
use core::ffi::{CStr, c_char};
use core::ptr::NonNull;
use core::sync::atomic::{AtomicU32, Ordering};
use goodbot::capacity::CapacityError;
use goodbot::feedback::Strategy;
use goodbot::memory::HomeTables;
#[cfg(feature = "home")]
use goodbot::oomdp::Either;
#[cfg(feature = "learning")]
use goodbot::snapshot::Places;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use rand_pcg::Pcg32;

/// The mark of a robot at rest, and of one that a call uses, each combined with the handle's own address: a copy elsewhere has a wrong one.
const AT_REST: u32 = 0x676f_6f64;
const IN_A_CALL: u32 = !AT_REST;

/// A robot. Its memory is the caller's and must not be moved, copied over or freed while it is used.
#[derive(Debug)]
pub struct Goodbot {
    /// Beside the robot, so that a second call reads it while the first one changes the robot.
    mark: AtomicU32,
    robot: UnsafeCell<Robot>,
}

/// Everything that is behind a handle.
#[derive(Debug)]
pub(crate) struct Robot {
    pub(crate) full: Option<CapacityError>,
    pub(crate) random: Pcg32,
    pub(crate) agent: Agent<Dealt>,
    pub(crate) world: World,
    #[cfg(feature = "learning")]
    pub(crate) told: Told,
    #[cfg(feature = "learning")]
    pub(crate) starter: Places,
    /// The starter's places before the session that is ending.
    #[cfg(feature = "learning")]
    pub(crate) starter_aside: Places,
}

/// What the robot was told of its actions so far.
#[cfg(feature = "learning")]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Told {
    /// How many actions nothing was told of, not even silence.
    pub(crate) nothing: u16,
    /// Whether the last action is one of them, so far.
    pub(crate) waits: bool,
    /// Whether a word was told, and whether silence was.
    pub(crate) words: bool,
    pub(crate) silence: bool,
}

impl Robot {
    /// Refuses what would end a session that joins the training data: the rest of that would be done at once, which takes a control loop too long.
    pub(crate) fn check_not_joining(&self) -> Result<(), Failure> {
        if cfg!(feature = "learning") && self.agent.is_joining() { Err(GoodbotStatus::StillFinishing.into()) } else { Ok(()) }
    }
}

#[cfg(feature = "home")]
impl Robot {
    /// The home's memory, for a new description. The old world is gone, and a session under way with it.
    pub(crate) fn empty_home(&mut self) -> Result<HomeTables<'static>, Failure> {
        if !matches!(self.world, World::Nothing(_) | World::Plan(_) | World::Here(Either::Floor(_), _)) {
            return Err(GoodbotStatus::World.into());
        }
        self.check_not_joining()?;
        self.agent.leave();
        match core::mem::replace(&mut self.world, World::Changing) {
            World::Nothing(memory) => Ok(memory),
            World::Plan(builder) => Ok(builder.into_memory()),
            World::Here(Either::Floor(home), _) => Ok(home.into_memory()),
            _ => Err(GoodbotStatus::World.into()),
        }
    }
}

/// Memory that was checked and dealt out, for a robot that is not made yet.
pub(crate) struct Plot {
    at: NonNull<Goodbot>,
    pub(crate) home: HomeTables<'static>,
    agent: Dealt,
    /// Whether there is room to find out which buttons a trainer uses.
    expects_buttons: bool,
    #[cfg_attr(not(feature = "table"), expect(dead_code, reason = "only a table takes more of it"))]
    pub(crate) arena: Arena,
}

/// Deals out the caller's memory.
///
/// # Safety
/// `capacities` is null or points to capacities; `bytes` bytes from `at` on are the caller's alone and stay.
pub(crate) unsafe fn plot(at: *mut u8, bytes: usize, capacities: *const GoodbotCapacities) -> Result<Plot, GoodbotStatus> {
    // SAFETY: the caller's promise.
    let Some(capacities) = (unsafe { capacities.as_ref() }) else { return Err(GoodbotStatus::Null) };
    given(at)?;
    if at.align_offset(8) != 0 {
        return Err(GoodbotStatus::Alignment);
    }
    // SAFETY: the caller's promise.
    let mut arena = unsafe { Arena::new(at, bytes) };
    let capacities = Capacities::from(capacities);
    let at = arena.place::<Goodbot>(1).ok_or(GoodbotStatus::Memory)?;
    let home = deal_home(&mut arena, &capacities).ok_or(GoodbotStatus::Memory)?;
    let agent = deal_agent(&mut arena, &capacities).ok_or(GoodbotStatus::Memory)?;
    let expects_buttons = capacities.beliefs >= capacities.tasks.saturating_mul(Strategy::ONE_BUTTON_OR_BOTH.len());
    Ok(Plot { at, home, agent: Dealt(agent), expects_buttons, arena })
}

/// Makes the robot in its place, because a copy of it on the stack takes kilobytes, and writes its handle. One function for all kinds of
/// worlds.
///
/// # Safety
/// `robot` is room for a handle.
pub(crate) unsafe fn settle(
    plot: Plot,
    tasks: &[LiftedTask],
    world: &mut dyn FnMut(HomeTables<'static>) -> Result<World, Fault>,
    robot: *mut *mut Goodbot,
) -> Result<GoodbotStatus, Fault> {
    let Plot { at, home, agent, expects_buttons, .. } = plot;
    // SAFETY: `plot` made sure of the room, which nobody else uses: without the right mark no handle leads to it.
    unsafe {
        let mark = &raw mut (*at.as_ptr()).mark;
        let inner = UnsafeCell::raw_get(&raw const (*at.as_ptr()).robot);
        mark.write(AtomicU32::new(0));
        place_agent(&raw mut (*inner).agent, agent);
        set_tasks(&mut (*inner).agent, tasks, expects_buttons)?;
        (&raw mut (*inner).world).write(world(home)?);
        (&raw mut (*inner).full).write(None);
        (&raw mut (*inner).random).write(Pcg32::new(0, 0x2014));
        #[cfg(feature = "learning")]
        {
            (&raw mut (*inner).told).write(Told::default());
            (&raw mut (*inner).starter).write(Places::default());
            (&raw mut (*inner).starter_aside).write(Places::default());
        }
        mark.write(AtomicU32::new(marked(AT_REST, at.as_ptr())));
        // SAFETY: the caller's promise.
        robot.write(at.as_ptr());
    }
    Ok(GoodbotStatus::Ok)
}

/// Writes an agent without tasks. Not inlined, as the next: their room on the stack is free again for what follows.
///
/// # Safety
/// `at` is room for it.
#[inline(never)]
unsafe fn place_agent(at: *mut Agent<Dealt>, memory: Dealt) {
    // SAFETY: the caller's promise.
    unsafe { at.write(Agent::without_tasks(memory)) };
}

#[inline(never)]
fn set_tasks(agent: &mut Agent<Dealt>, tasks: &[LiftedTask], expects_buttons: bool) -> Result<(), Fault> {
    // People also tell it what is so already: it must not undo that.
    agent.set_tasks(tasks, Options { done: Options::SELDOM_DONE, ..Options::DEFAULT })?;
    // One button is enough, where there is room to find out which.
    if expects_buttons {
        let _ = agent.set_strategies(&Strategy::ONE_BUTTON_OR_BOTH);
    }
    Ok(())
}

/// Runs a call on the robot, if the handle is valid and no other call uses it; remembers which table was full.
///
/// # Safety
/// `handle` is null or a handle that an init function gave.
pub(crate) unsafe fn with<S: Into<GoodbotStatus>>(
    handle: *mut Goodbot,
    run: impl FnOnce(&mut Robot) -> Result<S, Failure>,
) -> GoodbotStatus {
    // SAFETY: the caller's promise. The mark keeps every other call from the robot until this one has ended.
    unsafe {
        let robot = match entered(handle) {
            Ok(robot) => &mut *robot,
            Err(status) => return status,
        };
        let result = run(robot).map(S::into);
        ended(handle, result)
    }
}

/// As [`with`], for a call that changes nothing.
///
/// # Safety
/// As [`with`].
pub(crate) unsafe fn look(handle: *const Goodbot, run: impl FnOnce(&Robot) -> Result<GoodbotStatus, Failure>) -> GoodbotStatus {
    // SAFETY: as in `with`.
    unsafe {
        let robot = match entered(handle) {
            Ok(robot) => &*robot,
            Err(status) => return status,
        };
        let result = run(robot);
        left(handle);
        result.unwrap_or_else(|failure| failure.status)
    }
}

fn marked(mark: u32, handle: *const Goodbot) -> u32 {
    mark ^ handle.addr() as u32
}

/// The robot, if the handle is valid and no other call uses it; it is then in use until [`left`]. A function of its own, as the next: every
/// call links them.
///
/// # Safety
/// As [`with`].
#[inline(never)]
unsafe fn entered(handle: *const Goodbot) -> Result<*mut Robot, GoodbotStatus> {
    given(handle)?;
    if handle.align_offset(align_of::<Goodbot>()) != 0 {
        return Err(GoodbotStatus::BadHandle);
    }
    // SAFETY: the caller's promise; the mark is a plain number, which no reference to the robot covers.
    let mark = unsafe { &(*handle).mark };
    match mark.load(Ordering::Acquire) {
        found if found == marked(AT_REST, handle) => {}
        found if found == marked(IN_A_CALL, handle) => return Err(GoodbotStatus::Busy),
        _ => return Err(GoodbotStatus::BadHandle),
    }
    mark.store(marked(IN_A_CALL, handle), Ordering::Release);
    // SAFETY: the caller's promise.
    Ok(unsafe { UnsafeCell::raw_get(&raw const (*handle).robot) })
}

/// Ends a call that used the robot.
///
/// # Safety
/// `handle` is one that [`entered`] took.
unsafe fn left(handle: *const Goodbot) {
    // SAFETY: the caller's promise.
    unsafe { (*handle).mark.store(marked(AT_REST, handle), Ordering::Release) };
}

/// # Safety
/// As [`left`]; the call's own reference to the robot is used no more.
#[inline(never)]
unsafe fn ended(handle: *mut Goodbot, result: Result<GoodbotStatus, Failure>) -> GoodbotStatus {
    let status = result.unwrap_or_else(|failure| {
        // SAFETY: the caller's promise.
        let robot = unsafe { &mut *UnsafeCell::raw_get(&raw const (*handle).robot) };
        robot.full = failure.full.or(robot.full);
        failure.status
    });
    // SAFETY: the caller's promise.
    unsafe { left(handle) };
    status
}

/// A list of the caller's.
///
/// # Safety
/// `items` is null or points to `count` items that stay.
pub(crate) unsafe fn list<T>(items: *const T, count: u32, most: usize, place: Place, counted: Place) -> Result<&'static [T], Fault> {
    if count == 0 {
        return Ok(&[]);
    }
    if items.is_null() {
        return Err(GoodbotStatus::Null).at(place);
    }
    if count as usize > most {
        return Err(GoodbotStatus::Number).at(counted.number(count, 0, most as u32));
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts(items, count as usize) })
}

/// A text of the caller's.
///
/// # Safety
/// `text` is null or a C string that stays as long as `'a`.
pub(crate) unsafe fn text<'a>(text: *const c_char) -> Result<&'a str, GoodbotStatus> {
    given(text)?;
    // SAFETY: the caller's promise.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|_| GoodbotStatus::Text)
}

/// A text of at most this many bytes. No more of a longer one is read.
///
/// # Safety
/// As [`text`].
pub(crate) unsafe fn short_text<'a>(text: *const c_char, most: usize) -> Result<&'a str, GoodbotStatus> {
    given(text)?;
    // SAFETY: the caller's promise; no byte after the text's end is looked at.
    let is_end = |at: usize| unsafe { *text.add(at) } == 0;
    let mut length = 0_usize;
    // Four at a time, because the loop itself takes most of the instructions.
    let end = loop {
        if length > most || is_end(length) {
            break length;
        } else if is_end(length.wrapping_add(1)) {
            break length.wrapping_add(1);
        } else if is_end(length.wrapping_add(2)) {
            break length.wrapping_add(2);
        } else if is_end(length.wrapping_add(3)) {
            break length.wrapping_add(3);
        }
        length = length.wrapping_add(4);
    };
    let length = Some(end).filter(|&end| end <= most).ok_or(GoodbotStatus::Text)?;
    // SAFETY: the text has these bytes.
    core::str::from_utf8(unsafe { core::slice::from_raw_parts(text.cast(), length) }).map_err(|_| GoodbotStatus::Text)
}

/// Writes a value to the caller's pointer.
///
/// # Safety
/// `to` is null or room for the value.
pub(crate) unsafe fn give<T>(to: *mut T, value: T) -> Result<GoodbotStatus, Failure> {
    given(to)?;
    // SAFETY: the caller's promise.
    unsafe { to.write(value) };
    Ok(GoodbotStatus::Ok)
}

/// Refuses a pointer that is null.
pub(crate) const fn given<T>(at: *const T) -> Result<(), GoodbotStatus> {
    if at.is_null() { Err(GoodbotStatus::Null) } else { Ok(()) }
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

/// The table that was full last, after `FULL` or after a session gave way. `name` receives its name (cut to `bytes` with its 0), `limit`
/// the entries that it holds, and `given` the entries that were needed. `UNKNOWN` if none was full.
///
/// # Safety
/// `robot` is null or a handle; `name` is room for `bytes` bytes; the others are room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_full(
    robot: *const Goodbot,
    name: *mut c_char,
    bytes: usize,
    limit: *mut u32,
    given: *mut u32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise, for each of them.
    unsafe {
        look(robot, |robot| {
            let full = robot.full.ok_or(GoodbotStatus::Unknown)?;
            let field = full.capacity.name();
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
