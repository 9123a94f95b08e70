//! goodbot's file formats.
//!
//! goodbot is a robot that learns what words mean from reward and punishment. This crate has the formats of its programs: plain data types,
//! with their readers and writers. It knows nothing of planning or learning, and opens no file.
//!
//! | module | contents |
//! |---|---|
//! | [`environment`] | a home: rooms, doors, the agent, blocks |
//! | [`map`] | a home drawn as text |
//! | [`microbit`] | the file for a BBC micro:bit, with a robot's memory |
//! | [`session`] | a log of training sessions: commands, steps, feedback |
//! | [`posterior`] | the robot's belief after each step |
//! | [`task_text`] | a task as a text, `agentInRoom(agent0,room1)` |
//! | [`world`] | worlds of any kind, and commands in them |
//!
//! Every format but maps is JSON in UTF-8, version 1. Readers are strict: a field that is unknown, missing or given twice is an
//! error. A [`FormatError`] names the field, the line, the fault and the remedy. Writers keep the order and the exact values. Those of logs
//! and posteriors refuse to write a record that they could not read again.

#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod environment;
mod error;
mod json;
pub mod lines;
pub mod map;
pub mod microbit;
pub mod posterior;
pub mod session;
pub mod task_text;
mod weights;
pub mod world;

pub use error::{FormatError, KNOWN_VERSIONS, NOT_UTF8, quoted};
