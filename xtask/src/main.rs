//! goodbot's development commands: `cargo xtask --help`.

mod bench_wasm;
mod capi;
mod compare;
mod firmware;
mod footprint;
mod fuzz;
mod guide;
mod instructions;
mod page;
mod process;
mod programs;
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
    /// Finds or fetches every program that the commands need, and says where it is.
    Programs,
    /// Writes the trainer page, `dist/goodbot.html`.
    Page,
    /// Runs every check and every test; stops at the first that fails, and names what cannot be done here.
    Test(test::Options),
    /// Measures goodbot beside other programs on the same work; those that cannot be installed are left out.
    Compare,
    /// Runs the fuzz targets, and says how many inputs each had.
    Fuzz(fuzz::Options),
    /// Times each benchmark here and in WebAssembly, run by node.
    BenchWasm,
    /// Counts the instructions of each benchmark, by valgrind.
    Instructions {
        /// Only works with this in their name.
        #[arg(default_value = "")]
        filter: String,
    },
    /// Draws what a plan costs against states and tasks, as docs/planning-cost.svg.
    Plot,
    /// Measures what the robot costs on each emulated board, and writes docs/footprint.md.
    Footprint(footprint::Options),
    /// Writes the C header capi/include/goodbot.h.
    Capi,
    /// Writes the file to drag onto a BBC micro:bit, `dist/goodbot.hex`.
    Microbit,
    /// Builds the C library, and puts it with its header into dist/c.
    Library {
        /// For this processor, such as thumbv7em-none-eabihf, instead of this machine.
        #[arg(long)]
        target: Option<toolchain::Target>,
        /// What it is to have; what is left out takes no flash
        #[arg(long, value_delimiter = ',', value_name = "LIST", default_values = capi::library::FEATURES)]
        features: Vec<String>,
    },
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
        Task::Programs => programs::list()?,
        Task::Page => drop(page::build()?),
        Task::Test(options) => return test::run(&options),
        Task::Compare => compare::run()?,
        Task::Fuzz(options) => fuzz::run(&options)?,
        Task::BenchWasm => bench_wasm::run()?,
        Task::Instructions { filter } => instructions::run(&filter)?,
        Task::Plot => process::run(project::cargo().args([
            "run",
            "--release",
            "--quiet",
            "--package",
            "goodbot-benches",
            "--bin",
            "plot",
            "--",
            "docs/planning-cost.svg",
        ]))?,
        Task::Capi => capi::header::write()?,
        Task::Microbit => drop(firmware::microbit::deliver()?),
        Task::Library { target, features } => capi::library::deliver(target, &features)?,
        Task::Footprint(options) => return footprint::run(&options),
    }
    Ok(ExitCode::SUCCESS)
}
