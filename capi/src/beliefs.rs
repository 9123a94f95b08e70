//! The possible meanings of a command.

use crate::robot::{Goodbot, give, look, with};
use crate::status::GoodbotStatus;
use crate::world::{Surroundings, World, in_world};
use core::ffi::c_char;
use goodbot::Agent;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, ObjectId};
use goodbot::task::{Piece, Wording};

/// How many tasks the command may mean.
///
/// # Safety
/// `robot` is null or a handle, `count` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_task_count(robot: *const Goodbot, count: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { look(robot, |robot| give(count, robot.agent.tasks().len() as u32)) }
}

/// How probable a task is.
///
/// # Safety
/// `robot` is null or a handle, `probability` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_task_probability(robot: *const Goodbot, task: u32, probability: *mut f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            robot.agent.tasks().get(task as usize).ok_or(GoodbotStatus::Unknown)?;
            give(probability, robot.agent.belief().probability(task as usize))
        })
    }
}

/// The most likely task.
///
/// # Safety
/// `robot` is null or a handle, `task` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_most_likely(robot: *mut Goodbot, task: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let best = robot.agent.most_likely_with(&mut robot.random).ok_or(GoodbotStatus::NoSession)?;
            give(task, best as u32)
        })
    }
}

/// Writes a task as text, such as `blockInRoom(block0,room1)` or, with a way, `agentInRoom(agent0,room1) avoiding agentInRoom(agent0,room2)`,
/// with a 0 at its end. `BUFFER` where it does not fit.
///
/// # Safety
/// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_task_text(robot: *const Goodbot, task: u32, buffer: *mut c_char, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let mut writer = Writer::new(buffer, bytes)?;
            in_world!(&robot.world, |domain, _state| put_task(&mut writer, domain, &robot.agent, task as usize)?);
            writer.end()
        })
    }
}

/// Writes a task of the session under way.
pub(crate) fn put_task(
    writer: &mut Writer,
    domain: &Surroundings,
    agent: &Agent<impl AgentMemory>,
    task: usize,
) -> Result<(), GoodbotStatus> {
    let grounded = agent.tasks().get(task).ok_or(GoodbotStatus::Unknown)?;
    let lifted = agent.lifted().get(usize::from(grounded.lifted)).ok_or(GoodbotStatus::Unknown)?;
    if cfg!(feature = "talk") && grounded.is_negated() {
        writer.put("!");
    }
    Wording::FILES.tell(grounded.parts(lifted), |piece| match piece {
        Piece::Between(sign) => writer.put(sign),
        Piece::Proposition(_, part) => {
            writer.put(domain.world().schema.proposition_name(part.proposition));
            let parameters = domain.world().schema.parameters(part.proposition).len();
            for (position, &object) in part.arguments.iter().take(parameters).enumerate() {
                writer.put(if position > 0 { "," } else { "(" });
                put_object(writer, domain, object);
            }
            writer.put(")");
        }
    });
    Ok(())
}

/// Writes the name of an object.
pub(crate) fn put_object(writer: &mut Writer, domain: &Surroundings, object: ObjectId) {
    writer.put(domain.world().objects.name(object));
}

/// Writes to a buffer of the caller's.
pub(crate) struct Writer {
    at: *mut c_char,
    left: usize,
}

impl Writer {
    /// Writes to this many bytes from here on.
    ///
    /// # Safety
    /// The bytes are the caller's and writable.
    pub(crate) unsafe fn new(at: *mut c_char, left: usize) -> Result<Self, GoodbotStatus> {
        if at.is_null() { Err(GoodbotStatus::Null) } else { Ok(Self { at, left }) }
    }

    pub(crate) fn put(&mut self, text: &str) {
        for byte in text.bytes() {
            self.byte(byte);
        }
    }

    /// Writes a number in decimal.
    #[cfg(feature = "explain")]
    pub(crate) fn number(&mut self, number: u32) {
        let mut power = 1_000_000_000_u32;
        while power > 0 {
            if number >= power || power == 1 {
                self.byte(b'0'.wrapping_add((number / power % 10) as u8));
            }
            power /= 10;
        }
    }

    fn byte(&mut self, byte: u8) {
        if self.left > 0 {
            // SAFETY: `left` bytes from `at` on are the caller's room.
            unsafe { self.at.write(byte as c_char) };
            self.at = self.at.wrapping_add(1);
            self.left = self.left.wrapping_sub(1);
        } else {
            self.at = core::ptr::null_mut();
        }
    }

    pub(crate) fn end(mut self) -> Result<GoodbotStatus, crate::status::Failure> {
        self.byte(0);
        if self.at.is_null() { Err(GoodbotStatus::Buffer.into()) } else { Ok(GoodbotStatus::Ok) }
    }
}
