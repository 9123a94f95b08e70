//! goodbot's laboratory: the commands that measure.
//!
//! | module | its command |
//! |---|---|
//! | [`evaluate`] | trains on recorded sessions, asks for those left out, and counts right answers |
//! | [`study`] | robots that learn from reward and punishment, beside each other, with many kinds of trainers |
//! | [`fit_trainers`] | finds what trainers to expect, from what real ones said |
//! | [`questions`] | simulates sessions with questions and without |
//! | [`ways`] | simulates how the robot learns commands with a way |
//!
//! They share [`recorded`] for what real trainers saw and said, [`mean`] and [`calibration`] for figures, and [`canvas`] for pictures.

#![forbid(unsafe_code)]
// Each command lists its own rooms, for who reads the source.
#![allow(rustdoc::private_intra_doc_links)]
#![deny(missing_docs)]

pub mod calibration;
pub mod canvas;
pub mod evaluate;
pub mod fit_trainers;
pub mod mean;
pub mod questions;
pub mod recorded;
pub mod study;
pub mod ways;
