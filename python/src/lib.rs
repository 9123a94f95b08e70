//! goodbot for Python: the module `goodbot._native`, one more shell around the core. The part in Python is in `python/package/goodbot`.
//!
//! - `home`: homes and their states;
//! - `robot`, `vocabulary`: a robot that a Python class describes; `world`: one that a file describes;
//! - `place`: one of these with a state, where a session takes place;
//! - `mind`: the robot's mind; `agent`: its calls for Python;
//! - `trainer`: a simulated trainer, who teaches;
//! - `course`: the paper's lessons and tests;
//! - `log`: recorded sessions;
//! - `worlds`: many homes at once, for reinforcement learning;
//! - `command`: the command line;
//! - `options`: what Python gives and gets: settings, kinds of tasks, actions and tasks by name, lists, numpy arrays, and random numbers that
//!   go on in a copy; `error`: exceptions.
//!
//! What Python may call is listed with its types in `python/package/goodbot/_native.pyi`.

#![forbid(unsafe_code)]

mod agent;
mod command;
mod course;
mod decision;
mod error;
mod home;
mod log;
mod mind;
mod options;
mod place;
mod robot;
mod trainer;
mod vocabulary;
mod world;
mod worlds;

use pyo3::prelude::*;

#[cfg(panic = "abort")]
compile_error!(
    "a panic would end the user's Python: build the wheel by the profile of pyproject.toml, which `maturin build --release` replaces"
);

/// The part that is written in Rust. Import from `goodbot` itself.
#[pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::agent::{Agent, words};
    #[pymodule_export]
    use crate::command::run_command;
    #[pymodule_export]
    use crate::course::{exercises, run_course};
    #[pymodule_export]
    use crate::decision::Decision;
    #[pymodule_export]
    use crate::error::{CapacityError, FormatError, InUseError, InternalError, ModelError, SessionError};
    #[pymodule_export]
    use crate::home::{Home, State};
    #[pymodule_export]
    use crate::log::{Session, parse_log};
    #[pymodule_export]
    use crate::options::capacities;
    #[pymodule_export]
    use crate::trainer::{Lesson, Trainer};
    #[pymodule_export]
    use crate::world::World;
    #[pymodule_export]
    use crate::worlds::Worlds;

    /// The version, as the workspace has it.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "as Python calls it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
