//! The steps of a hostile robot: any graph, with loops, cycles, missing states, and changing answers.

use super::super::Bytes;
use std::cell::Cell;
use std::ffi::{c_char, c_void};

/// The context of the callbacks.
#[derive(Debug)]
pub struct Machine {
    /// The state that each step leads to.
    edges: Vec<u32>,
    /// Whether the same question is answered differently each time. The contract forbids it, but a broken program may do it.
    moody: bool,
    asked: Cell<u32>,
}

impl Machine {
    /// A machine of `states` states and `actions` actions.
    pub fn new(choices: &mut Bytes<'_>, states: u32, actions: usize) -> Self {
        let moody = choices.below(8) == 0;
        let kind = choices.below(4);
        let count = (states.min(64) as usize).saturating_mul(actions.max(1));
        let edges = (0..count).map(|edge| {
            let state = (edge / actions.max(1)) as u32;
            match (kind, edge % actions.max(1)) {
                // A line, up and down; a circle; any states, out of range too.
                (0 | 1, 0) => state + 1,
                (0, 1) => state.wrapping_sub(1),
                (1, _) => (state + 1) % states.max(1),
                _ => match choices.below(8) {
                    0 => u32::MAX,
                    1 => states,
                    2 => state,
                    _ => u32::from(choices.byte()) % states.max(1),
                },
            }
        });
        Self { edges: edges.collect(), moody, asked: Cell::new(0) }
    }

    /// Whether the same question is answered differently each time.
    pub fn is_moody(&self) -> bool {
        self.moody
    }

    /// The same as a table of `states` times `actions` entries.
    pub fn table(&self, states: u32, actions: usize) -> Vec<u16> {
        (0..states as usize * actions).map(|edge| self.edge(edge).and_then(|next| u16::try_from(next).ok()).unwrap_or(u16::MAX)).collect()
    }

    fn edge(&self, edge: usize) -> Option<u32> {
        self.edges.get(edge % self.edges.len().max(1)).copied()
    }

    fn mood(&self) -> u32 {
        self.asked.set(self.asked.get().wrapping_add(1));
        if self.moody { self.asked.get().wrapping_mul(0x9e37_79b9) >> 13 } else { 0 }
    }
}

/// The step callback.
pub unsafe extern "C" fn step(context: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
    // SAFETY: the context is a machine that outlives the robot.
    let machine = unsafe { &*context.cast::<Machine>() };
    let edge = (state as usize).wrapping_mul(2).wrapping_add(usize::from(action)).wrapping_add(machine.mood() as usize);
    let Some(target) = machine.edge(edge) else { return false };
    // SAFETY: the interface gives room for a state.
    unsafe { next.write(target) };
    target % 11 != 10
}

/// The callback `holds`: a proposition of a robot and floor `n` holds in the states that leave `n` when divided by four.
pub unsafe extern "C" fn holds(context: *mut c_void, state: u32, proposition: u8, arguments: *const u8) -> bool {
    // SAFETY: the context is a machine that outlives the robot.
    let machine = unsafe { &*context.cast::<Machine>() };
    // SAFETY: the interface hands three over, used or not.
    let arguments = unsafe { std::slice::from_raw_parts(arguments, 3) };
    let sum = arguments.iter().fold(u32::from(proposition), |sum, &object| sum + u32::from(object));
    (state + machine.mood() % 2) % 4 == sum % 4
}

/// The callback for derived facts: for some objects two facts, for some objects of a moody machine invalid texts.
pub unsafe extern "C" fn derived(context: *mut c_void, state: u32, object: u8, number: u32) -> *const c_char {
    // SAFETY: the context is a machine that outlives the robot.
    let machine = unsafe { &*context.cast::<Machine>() };
    let texts = match (u32::from(object) + state + machine.mood()) % 16 {
        0 => [c"highest", c"nearest"],
        7 if machine.moody => [c"", c"\xff"],
        _ => return std::ptr::null(),
    };
    texts.get(number as usize).map_or(std::ptr::null(), |text| text.as_ptr())
}
