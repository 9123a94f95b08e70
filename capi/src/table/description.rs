//! The caller's description of a robot. All of it must stay as long as the robot is used.

use core::ffi::{c_char, c_void};

/// Most classes.
pub const GOODBOT_MOST_CLASSES: usize = 8;
/// Most attributes.
pub const GOODBOT_MOST_ATTRIBUTES: usize = 4;
/// Most carriers of all attributes together.
pub const GOODBOT_MOST_CARRIERS: usize = 16;
/// Most propositional functions.
pub const GOODBOT_MOST_PROPOSITIONS: usize = 8;
/// Most arguments of a propositional function.
pub const GOODBOT_MOST_ARGUMENTS: usize = 3;
/// Most propositional functions of a task.
pub const GOODBOT_MOST_CONJUNCTS: usize = 4;
/// Most variables of a task.
pub const GOODBOT_MOST_VARIABLES: usize = 6;
/// Most actions, doing nothing not counted.
pub const GOODBOT_MOST_ACTIONS: usize = 15;
/// Most texts that `derived` returns for one object in one state.
pub const GOODBOT_MOST_DERIVED: u32 = 8;
/// In a table of steps: the action cannot be done there.
pub const GOODBOT_CANNOT: u16 = 0xffff;

/// A class that carries an attribute, and the prefix of the capitalised value: `roomIs` makes `roomIsRed`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotCarrier {
    /// The class, by position.
    pub object_class: u8,
    /// The prefix.
    pub prefix: *const c_char,
}

/// An attribute, such as colour.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotAttribute {
    /// The name.
    pub name: *const c_char,
    /// The classes that carry it.
    pub carriers: *const GoodbotCarrier,
    /// How many.
    pub carrier_count: u32,
}

/// A propositional function, such as `blockInRoom`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotProposition {
    /// The name.
    pub name: *const c_char,
    /// The class of each argument, by position.
    pub parameters: [u8; GOODBOT_MOST_ARGUMENTS],
    /// How many arguments, one at least.
    pub parameter_count: u32,
}

/// An object.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotObject {
    /// The class, by position.
    pub object_class: u8,
    /// The name.
    pub name: *const c_char,
    /// The value of each attribute, in the order of the attributes; null for none.
    pub values: [*const c_char; GOODBOT_MOST_ATTRIBUTES],
}

/// An action.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotAction {
    /// The name.
    pub name: *const c_char,
    /// The cost, 1 to 16.
    pub cost: u32,
}

/// A kind of task, parsed by `goodbot table --c`: a library without the feature `checks` parses no texts of tasks.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotKind {
    /// The class of each variable, by position.
    pub classes: [u8; GOODBOT_MOST_VARIABLES],
    /// How many.
    pub class_count: u8,
    /// The propositional functions that are to hold, by position.
    pub propositions: [u8; GOODBOT_MOST_CONJUNCTS],
    /// How many.
    pub proposition_count: u8,
    /// The variables of each propositional function, by position.
    pub variables: [[u8; GOODBOT_MOST_ARGUMENTS]; GOODBOT_MOST_CONJUNCTS],
}

/// Sets `next` to the state that an action leads to and returns true, or returns false if the action cannot be done. It must always answer
/// the same, and must not call goodbot.
pub type GoodbotStep = Option<unsafe extern "C" fn(context: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool>;

/// Whether a proposition, by position, holds of the objects, by position, in a state. It must always answer the same, and must not call
/// goodbot.
pub type GoodbotHolds = Option<unsafe extern "C" fn(context: *mut c_void, state: u32, proposition: u8, arguments: *const u8) -> bool>;

/// Returns a derived fact about an object, by position, in a state, such as `leftmost`: the text with this number, counted from 0, or
/// null if there are no more. It must always answer the same, and must not call goodbot. Each text must stay until the function is called
/// again.
pub type GoodbotDerived = Option<unsafe extern "C" fn(context: *mut c_void, state: u32, object: u8, number: u32) -> *const c_char>;

/// A robot of the caller's own.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotTable {
    /// The names of the classes.
    pub classes: *const *const c_char,
    /// How many.
    pub class_count: u32,
    /// The attributes; may be null if there is none.
    pub attributes: *const GoodbotAttribute,
    /// How many.
    pub attribute_count: u32,
    /// The propositional functions.
    pub propositions: *const GoodbotProposition,
    /// How many.
    pub proposition_count: u32,
    /// The objects.
    pub objects: *const GoodbotObject,
    /// How many.
    pub object_count: u32,
    /// The actions.
    pub actions: *const GoodbotAction,
    /// How many.
    pub action_count: u32,
    /// The tasks that commands may mean, such as `blockInRoom(?o, ?r)`.
    pub tasks: *const *const c_char,
    /// How many, one at least.
    pub task_count: u32,
    /// How many states there are, one at least. They are numbered from 0.
    pub state_count: u32,
    /// The first state.
    pub start: u32,
    /// The state that each action leads to from each state, `next[state * action_count + action]`, or `GOODBOT_CANNOT`. Null if `step` is
    /// given.
    pub next: *const u16,
    /// What an action leads to, if there is no table of steps.
    pub step: GoodbotStep,
    /// Which propositions hold.
    pub holds: GoodbotHolds,
    /// Derived facts about objects; null for none.
    pub derived: GoodbotDerived,
    /// Handed to all functions.
    pub context: *mut c_void,
    /// The tasks once more, parsed by `goodbot table --c`, in a table that it has checked; else null. A library with the feature `checks`
    /// parses and checks everything itself.
    pub kinds: *const GoodbotKind,
}
