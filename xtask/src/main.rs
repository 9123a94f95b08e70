//! goodbot's development commands: `cargo xtask --help`.

mod api;
mod benches;
mod capi;
mod checks;
#[cfg(test)]
mod dependencies;
mod firmware;
mod footprint;
mod fuzz;
mod guide;
mod page;
mod process;
mod programs;
mod release;
mod toolchain;
mod worst;

use anyhow::Result;
use clap::Parser;

/// goodbot's development commands.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
enum Task {
    /// Finds or fetches the programs that the commands need, and prints their paths.
    Programs,
    /// Writes the trainer page, `dist/goodbot.html`.
    Page,
    /// Runs every check and every test; stops at the first that fails, and names those that cannot be run here.
    Test(checks::Options),
    /// Compares goodbot with other programs on the same work; those that cannot be installed are left out.
    Compare,
    /// Runs the fuzz targets, and prints how many inputs each had.
    Fuzz(fuzz::Options),
    /// Times each benchmark natively and in WebAssembly, run by node.
    BenchWasm,
    /// Draws the cost of a plan against states, tasks and blocks, as docs/planning-cost.svg.
    Plot,
    /// Measures the robot's memory and instructions on each emulated board, and writes docs/footprint.md.
    Footprint(footprint::Options),
    /// Searches for the input that takes the most instructions of each call in C, and writes it into docs/footprint.md.
    Worst(worst::Options),
    /// Writes the C header capi/include/goodbot.h.
    Capi,
    /// Writes the file to drag onto a BBC micro:bit, `dist/goodbot.hex`.
    Microbit,
    /// Writes the file to drag onto a Raspberry Pi Pico, `dist/goodbot.uf2`.
    Pico,
    /// Builds the C library, and puts it with its header into dist/c.
    Library(capi::Library),
    /// Lists the core's public interface in core/public-api.txt.
    Api(api::Options),
    /// Makes the packages of a release, with their checksums, in `dist/release`.
    Release(release::Options),
}

fn main() {
    if let Err(error) = toolchain::as_compiler().unwrap_or_else(|| run(Task::parse())) {
        eprintln!("error: {error:#}");
        std::process::exit(1);
    }
}

fn run(task: Task) -> Result<()> {
    match task {
        Task::Programs => programs::list().and_then(|()| toolchain::list()),
        Task::Page => page::build(),
        Task::Test(options) => checks::run(&options),
        Task::Compare => benches::compare(),
        Task::Fuzz(options) => fuzz::run(&options),
        Task::BenchWasm => benches::wasm(),
        Task::Plot => benches::plot(),
        Task::Footprint(options) => footprint::run(&options),
        Task::Worst(options) => worst::run(&options),
        Task::Capi => capi::header(),
        Task::Microbit => firmware::deliver().map(drop),
        Task::Pico => firmware::deliver_pico().map(drop),
        Task::Library(options) => capi::deliver(&options),
        Task::Api(options) => api::run(&options),
        Task::Release(options) => release::run(&options),
    }
}
