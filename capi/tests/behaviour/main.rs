//! What a C program may rely on.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

mod already;
mod robots;

mod explained;
mod hypotheses;
mod memory;
mod options;
mod recorded;
mod sensing;
mod starter;
mod statuses;
mod storage;
mod trainers;
mod vacuum;
mod words;
