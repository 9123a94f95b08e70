//! goodbot for the browser: one world with one robot, for a page to show.
//!
//! [`World`] is plain Rust and is tested on the host; JavaScript has it as `Goodbot`, by [`bindings`] too. The page gets JSON texts, whose
//! fields are those of the public structs of [`view`].
//!
//! | module | what it holds |
//! |---|---|
//! | [`world`] | the home, the robot's mind, their capacities, and the session under way |
//! | [`starter`] | everyday sentences that the robot knows beside its own sessions |
//! | [`talk`] | utterances that may be no command, and sessions that begin with one |
//! | [`training`] | a session from a command to a robot that has learned |
//! | [`asking`] | questions and the trainer's answers; which word of a command speaks for which task; the next lesson to teach |
//! | [`replay`] | the replay of a session from a log |
//! | [`view`] | the data that the page draws: the scene, the beliefs, the evidence, the heat map |
//! | [`route`] | where a task would lead the robot, for the ghost on the floor plan |
//! | [`course`] | the paper's lessons and tests |
//! | [`bindings`] | what JavaScript calls otherwise than Rust |

#![deny(missing_docs)]

pub mod asking;
pub mod bindings;
pub mod course;
mod log;
pub mod replay;
pub mod route;
pub mod starter;
pub mod talk;
pub mod training;
pub mod view;
pub mod world;

pub use world::{Refusal, World};

/// Takes less room in the page than the standard library's.
#[cfg(target_family = "wasm")]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();
