//! goodbot's file formats.
//!
//! goodbot is a robot that learns what words mean from reward and punishment. This crate is what
//! its programs read and write: plain data types, and texts to and from them. It knows nothing of
//! planning or learning, and it opens no file.
//!
//! | module | what |
//! |---|---|
//! | [`environment`] | a home: rooms, doors, the agent, blocks |
//! | [`map`] | a home drawn as text |
//! | [`microbit`] | the file for a BBC micro:bit, with what a robot knows |
//! | [`pddl`] | planning problems in PDDL |
//! | [`session`] | a log of training sessions: commands, steps, feedback |
//! | [`posterior`] | what the robot believed after each step |
//! | [`task_text`] | a task as a text, `agentInRoom(agent0,room1)` |
//! | [`world`] | worlds of any kind, and commands in them |
//!
//! Every format but maps and PDDL is JSON in UTF-8, version 1. Readers are strict: a field that is unknown, missing
//! or given twice is an error, and a [`FormatError`] names the field, the line, what is wrong and
//! what to do. Writers keep the order and the exact values of what they are given; those of logs and
//! posteriors refuse to write what could not be read again.

#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod environment;
mod error;
mod json;
mod lines;
pub mod map;
pub mod microbit;
pub mod pddl;
pub mod posterior;
pub mod session;
pub mod task_text;
mod weights;
pub mod world;

pub use error::{FormatError, KNOWN_VERSIONS, Problem, quoted};
