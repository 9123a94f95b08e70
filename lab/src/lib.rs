//! goodbot's laboratory: the commands that measure.
//!
//! | module | command |
//! |---|---|
//! | [`evaluate`] | trains on recorded sessions, asks for those left out, and counts right answers |
//! | [`study`] | compares robots that learn from reward and punishment, with many kinds of trainers |
//! | [`fit_trainers`] | fits the trainers to expect to the feedback of real ones |
//! | [`acts`] | trains the model that decides whether a robot acts on what was said |
//!
//! They share [`recorded`] for real trainers' sessions, [`calibration`] for figures, and [`canvas`] for pictures.

#![forbid(unsafe_code)]
// Each command's documentation lists its private modules, for readers of the source.
#![allow(rustdoc::private_intra_doc_links)]
#![deny(missing_docs)]
#![deny(clippy::print_stdout, clippy::print_stderr)]

pub mod acts;
pub mod calibration;
pub mod canvas;
pub mod evaluate;
pub mod fit_trainers;
pub mod recorded;
pub mod study;
