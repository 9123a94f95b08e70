//! goodbot's development commands: `cargo xtask --help`.

mod page;
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
    /// Writes the trainer page, `dist/goodbot.html`.
    Page,
    /// Runs every check and every test; stops at the first that fails.
    Test(test::Options),
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
        Task::Page => page::build()?,
        Task::Test(options) => return test::run(&options),
    }
    Ok(ExitCode::SUCCESS)
}
