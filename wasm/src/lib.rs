//! goodbot for the browser: one world, one robot, and what a page needs to show them.
//!
//! [`World`] is plain Rust and is tested on the host; [`bindings`] is the same surface for JavaScript. What the page draws comes as JSON
//! texts, whose fields are the public structs of [`view`].
//!
//! | module | what it holds |
//! |---|---|
//! | [`world`] | the home, the robot's mind and the session under way |
//! | [`talk`] | what people say beside commands, and how a session begins with it |
//! | [`training`] | a session from a command to a robot that has learned |
//! | [`asking`] | questions, and the trainer's answers |
//! | [`next`] | which lesson next |
//! | [`replay`] | a session of a log, once more, with all that logs may say |
//! | [`view`] | what the page draws: the scene, the beliefs, the evidence, the heat map |
//! | [`words`] | which word of a command speaks for which task |
//! | [`route`] | where a task would lead the robot, for the ghost on the floor plan |
//! | [`cells`] | memory together with what lives in it |
//! | [`course`] | the paper's lessons and tests |
//! | [`bindings`] | the surface for JavaScript |

#![deny(missing_docs)]

pub mod asking;
pub mod bindings;
pub mod cells;
pub mod course;
mod json;
mod log;
pub mod next;
pub mod replay;
pub mod route;
pub mod talk;
pub mod training;
pub mod view;
pub mod words;
pub mod world;

pub use world::{Refusal, World};

/// Takes less room in the page than the standard library's.
#[cfg(target_family = "wasm")]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();
