//! The home environment: rooms, doors, blocks, an agent.

use crate::capacities::GoodbotCapacities;
use crate::robot::{Goodbot, Robot, give, given, look, plot, settle, text, with};
use crate::status::{Failure, GoodbotStatus};
use crate::tasks::kinds_of_tasks;
use crate::world::World;
use core::ffi::c_char;
use goodbot::capacity::BLOCKS;
use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
use goodbot::memory::HomeTables;
use goodbot::oomdp::{Either, ObjectId};
use goodbot::task::LiftedTask;
use heapless::Vec;

/// Makes a robot that will live in homes, in the caller's memory: `bytes` bytes, aligned to 8, as many as `goodbot_size` says. It
/// understands commands to go to a room and to bring a block to a room.
///
/// # Safety
/// `memory` is null, or the caller's memory for the robot alone, which does not move; `capacities` and `robot` are null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_init_home(
    memory: *mut core::ffi::c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    robot: *mut *mut Goodbot,
) -> GoodbotStatus {
    let Ok(tasks) = home::paper_tasks() else { return GoodbotStatus::Other };
    // SAFETY: the caller's promise.
    unsafe { init(memory, bytes, capacities, &tasks, robot) }
}

/// # Safety
/// As [`goodbot_init_home`].
unsafe fn init(
    memory: *mut core::ffi::c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    tasks: &[LiftedTask],
    robot: *mut *mut Goodbot,
) -> GoodbotStatus {
    if robot.is_null() {
        return GoodbotStatus::Null;
    }
    // SAFETY: the caller's promise, and `robot` is not null.
    unsafe {
        match plot(memory.cast(), bytes, capacities) {
            Ok(plot) => settle(plot, tasks, &mut |home| Ok(World::Nothing(home)), robot).unwrap_or_else(|fault| fault.status),
            Err(status) => status,
        }
    }
}

/// As `goodbot_init_home`, for commands that may mean tasks of these kinds, `GOODBOT_MOST_TASKS` at most: `agentInRoom(?a, ?goal)`,
/// `blockInRoom(?o, ?r)`, or with a way, `agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?not)`, `... through agentInRoom(?a, ?via)`,
/// `... through agentInRoom(?a, ?via) or agentInRoom(?a, ?other)`. Where a text is no kind of task, `TASK_FORM` and the four after it say why;
/// `NUMBER` if there is no text or too many. The texts are not needed afterwards.
///
/// # Safety
/// As for `goodbot_init_home`; `tasks` is null or points to `task_count` texts, each null or ended by a 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_init_home_tasks(
    memory: *mut core::ffi::c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    tasks: *const *const c_char,
    task_count: u32,
    robot: *mut *mut Goodbot,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        match kinds_of_tasks(tasks, task_count, &home::SCHEMA) {
            Ok(tasks) => init(memory, bytes, capacities, &tasks, robot),
            Err(fault) => fault.status,
        }
    }
}

/// Begins to describe a home. What was learned stays; a session under way ends unlearned.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_begin(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let memory = robot.empty_home()?;
            robot.world = World::Plan(HomeBuilder::new(memory));
            Ok(GoodbotStatus::Ok)
        })
    }
}

fn plan(robot: &mut Robot) -> Result<&mut HomeBuilder<HomeTables<'static>>, Failure> {
    match &mut robot.world {
        World::Plan(builder) => Ok(builder),
        World::Nothing(_) => Err(GoodbotStatus::NoWorld.into()),
        _ => Err(GoodbotStatus::World.into()),
    }
}

/// Adds a room: the box of its border, whose cells are wall where no door is, and its colour.
///
/// # Safety
/// `robot` is null or a handle; the texts are null or C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_room(
    robot: *mut Goodbot,
    name: *const c_char,
    left: i32,
    bottom: i32,
    right: i32,
    top: i32,
    color: *const c_char,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(plan(robot)?.room(text(name)?, Area::new(left, bottom, right, top), text(color)?).map(drop)?)) }
}

/// Adds a door: a box of cells without walls.
///
/// # Safety
/// As `goodbot_home_room`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_door(
    robot: *mut Goodbot,
    name: *const c_char,
    left: i32,
    bottom: i32,
    right: i32,
    top: i32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(plan(robot)?.door(text(name)?, Area::new(left, bottom, right, top)).map(drop)?)) }
}

/// Adds a block.
///
/// # Safety
/// As `goodbot_home_room`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_block(
    robot: *mut Goodbot,
    name: *const c_char,
    x: i32,
    y: i32,
    color: *const c_char,
    shape: *const c_char,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(plan(robot)?.block(text(name)?, Cell::new(x, y), text(color)?, text(shape)?).map(drop)?)) }
}

/// Adds the robot itself.
///
/// # Safety
/// As `goodbot_home_room`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_agent(robot: *mut Goodbot, name: *const c_char, x: i32, y: i32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(plan(robot)?.agent(text(name)?, Cell::new(x, y)).map(drop)?)) }
}

/// Finds the free cells of the home, at most `budget` in a call, so that a control loop goes on while a large home is built. `WORKING` means: call
/// again. Once it is done, `goodbot_home_build` is short. Adding an object starts it anew.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_find_cells(robot: *mut Goodbot, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| Ok(plan(robot)?.find_cells(budget)?)) }
}

/// Checks the whole home. Actions 0 to 3 are then north, south, east and west; a block in the way is pushed. If it fails, begin the
/// description again.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_build(robot: *mut Goodbot) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            plan(robot)?;
            let World::Plan(builder) = core::mem::replace(&mut robot.world, World::Changing) else {
                return Err(GoodbotStatus::NoWorld.into());
            };
            let (world, result) = match builder.try_build(Moves::Push) {
                Ok((home, start)) => (World::Here(Either::Floor(home), Either::Floor(start)), Ok(GoodbotStatus::Ok)),
                Err((error, memory)) => (World::Nothing(memory), Err(error.into())),
            };
            robot.world = world;
            result
        })
    }
}

/// Sets whether words may mean derived facts, as well as colours and shapes: the `leftmost`, `rightmost`, `topmost`, `bottommost`,
/// `largest` or `smallest` room, the `nearest` or `farthest` room or block. It holds for this home, once it is built; the next home begins
/// without. A session under way ends unlearned; one that joins the others already goes on first (`STILL_FINISHING`). One model can have
/// lessons with derived facts and lessons without.
///
/// # Safety
/// `robot` is null or a handle.
#[cfg(feature = "ways")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_derived(robot: *mut Goodbot, derived: bool) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            robot.check_not_joining()?;
            let (world, status) = match core::mem::replace(&mut robot.world, World::Changing) {
                World::Here(Either::Floor(home), standing) => {
                    robot.agent.leave();
                    (World::Here(Either::Floor(home.with_derived(derived)), standing), Ok(GoodbotStatus::Ok))
                }
                other @ World::Here(Either::Other(_), _) => (other, Err(GoodbotStatus::World.into())),
                other => (other, Err(GoodbotStatus::NoWorld.into())),
            };
            robot.world = world;
            status
        })
    }
}

/// Says where the robot itself or a block is, as sensed.
///
/// # Safety
/// As `goodbot_home_room`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_place(robot: *mut Goodbot, name: *const c_char, x: i32, y: i32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let World::Here(Either::Floor(home), Either::Floor(state)) = &mut robot.world else {
                return Err(GoodbotStatus::NoWorld.into());
            };
            let object = home.objects().find(text(name)?).ok_or(GoodbotStatus::Unknown)?;
            *state = home.placed(state, &[(object, Cell::new(x, y))]).ok_or(GoodbotStatus::Number)?;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// A thing and the cell where it was sensed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotSensed {
    /// The robot's own name or a block's.
    pub name: *const c_char,
    /// The cell's column.
    pub x: i32,
    /// The cell's row.
    pub y: i32,
}

/// Says where the robot itself and blocks are, all at once, as sensed, so that two of them can change places. Things that are not named
/// stay. `UNKNOWN` if a name is that of nothing that moves, `NUMBER` if a cell is wall or two things are in one cell; nothing changes then.
///
/// # Safety
/// `robot` is null or a handle; `sensed` is null or points to `count` of them; the names are null or C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_sense(robot: *mut Goodbot, sensed: *const GoodbotSensed, count: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let World::Here(Either::Floor(home), Either::Floor(state)) = &mut robot.world else {
                return Err(GoodbotStatus::NoWorld.into());
            };
            given(sensed)?;
            let mut things: Vec<(ObjectId, Cell), { BLOCKS + 1 }> = Vec::new();
            for &GoodbotSensed { name, x, y } in core::slice::from_raw_parts(sensed, count as usize) {
                let object = home.objects().find(text(name)?).filter(|&object| home.piece(object).is_some());
                things.push((object.ok_or(GoodbotStatus::Unknown)?, Cell::new(x, y))).map_err(|_| GoodbotStatus::Number)?;
            }
            *state = home.placed(state, &things).ok_or(GoodbotStatus::Number)?;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Where the robot itself or a block is.
///
/// # Safety
/// As `goodbot_home_room`; `x` and `y` are null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_home_where(robot: *const Goodbot, name: *const c_char, x: *mut i32, y: *mut i32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let World::Here(Either::Floor(home), Either::Floor(state)) = &robot.world else {
                return Err(GoodbotStatus::NoWorld.into());
            };
            let object = home.objects().find(text(name)?).ok_or(GoodbotStatus::Unknown)?;
            let cell = if object == home.agent() { Some(home.agent_cell(state)) } else { home.block_cell(state, object) };
            let cell = cell.ok_or(GoodbotStatus::Unknown)?;
            give(x, cell.x)?;
            give(y, cell.y)
        })
    }
}
