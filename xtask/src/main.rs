//! goodbot's development commands: `cargo xtask --help`.

mod capi;
mod firmware;
mod footprint;
mod process;
mod project;
mod steps;
mod test;
mod toolchain;

use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

/// goodbot's development commands.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Makes sure that goodbot can be built for microcontrollers and for the browser.
    Setup,
    /// Runs every check and every test; stops at the first that fails.
    Test(test::Options),
    /// Measures what the robot costs on each emulated board, and writes docs/footprint.md.
    Footprint(footprint::Options),
    /// Writes the C header capi/include/goodbot.h.
    Capi,
}

fn main() -> ExitCode {
    run().unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        ExitCode::FAILURE
    })
}

fn run() -> Result<ExitCode> {
    match Arguments::parse().command {
        Task::Setup => toolchain::setup()?,
        Task::Capi => capi::header::write()?,
        Task::Test(options) => return test::run(&options),
        Task::Footprint(options) => return footprint::run(&options),
    }
    Ok(ExitCode::SUCCESS)
}
