//! The command line, which the package has too.

use crate::options::Items;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs a command line, the program's name first, and returns the exit code.
#[pyfunction]
pub fn run_command(py: Python<'_>, typed: Items<OsString>) -> u8 {
    py.detach(|| goodbot_cli::run(&typed.0))
}
