//! goodbot for C: the interface that `include/goodbot.h` declares.
//!
//! The caller owns all memory, every function that can fail returns a status, nothing is global, and nothing panics or unwinds into C.
//! `docs/robot.md` leads through it.
//!
//! - [`status`]: the status that functions return;
//! - [`version`]: which interface this is;
//! - [`capacities`]: the sizes of the tables;
//! - [`arena`]: the caller's memory, dealt out;
//! - [`robot`]: the handle;
//! - [`memory`]: the memory that a robot takes, and the capacities that its lessons need;
//! - [`world`]: the robot's world, a home or a table;
//! - [`home`]: the home environment;
//! - [`table`]: robots of the caller's own: classes, objects, propositions and a step function or a table of steps;
//! - [`tasks`]: the kinds of tasks that a robot can be told;
//! - [`training`]: hear, plan, decide, feedback, learn;
//! - [`options`]: how it takes evidence and acts;
//! - [`asking`]: questions to the trainer;
//! - [`voice`]: praise, blame, "stop" and the like in words; [`talk`]: utterances other than commands;
//! - [`beliefs`]: the possible meanings of a command;
//! - [`words`]: the meanings of its words;
//! - [`model`]: saving and restoring a model;
//! - [`starter`]: everyday sentences to begin with;
//! - [`storage`]: a model in flash, safe from power cuts.

#![no_std]
#![deny(missing_docs)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::indexing_slicing))]

#[cfg(test)]
extern crate std;

pub mod arena;
#[cfg(feature = "asking")]
pub mod asking;
pub mod beliefs;
pub mod capacities;
#[cfg(feature = "home")]
pub mod home;
pub mod memory;
#[cfg(feature = "learning")]
pub mod model;
pub mod options;
pub mod parameters;
pub mod robot;
#[cfg(feature = "learning")]
pub mod starter;
pub mod status;
#[cfg(feature = "learning")]
pub mod storage;
#[cfg(feature = "table")]
pub mod table;
#[cfg(feature = "talk")]
pub mod talk;
pub mod tasks;
pub mod training;
pub mod version;
#[cfg(feature = "voice")]
pub mod voice;
pub mod words;
pub mod world;

#[cfg(not(any(feature = "home", feature = "table")))]
compile_error!("without the features home and table no robot can be made; choose one at least");

/// Never called: nothing here panics. The compiler asks for it all the same.
#[cfg(all(feature = "alone", not(test)))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
