//! The C interface: its header, and its example built and run.
//!
//! - [`library`]: the static library;
//! - [`header`]: `capi/include/goodbot.h`, as cbindgen writes it;
//! - [`example`]: the C examples on this machine and on an emulated board.

pub mod example;
pub mod header;
pub mod library;
