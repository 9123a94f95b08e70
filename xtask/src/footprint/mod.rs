//! `cargo xtask footprint`: what the robot costs on each board, as a table that is checked in.
//!
//! - [`measures`]: the numbers of each row, and the file that keeps them for the check;
//! - [`table`]: the same numbers for people.

mod measures;
mod table;

use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::firmware::{Trial, trials};
use crate::project;
use measures::Footprint;

/// Where the numbers are kept, for the check and for people.
const NUMBERS: &str = "docs/footprint.json";
const TABLE: &str = "docs/footprint.md";

/// What to do with the table.
#[derive(Args)]
pub struct Options {
    /// Compares with the table that is checked in and writes nothing
    #[arg(long)]
    check: bool,
}

/// Measures, and writes the table or compares with it.
pub fn run(options: &Options) -> Result<ExitCode> {
    if options.check {
        return Ok(match check() {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("{error:#}");
                ExitCode::FAILURE
            }
        });
    }
    let footprint = Footprint::measure(trials()?)?;
    let root = project::root();
    std::fs::write(root.join(NUMBERS), footprint.to_json()?).with_context(|| format!("{NUMBERS} cannot be written"))?;
    std::fs::write(root.join(TABLE), table::markdown(&footprint)).with_context(|| format!("{TABLE} cannot be written"))?;
    eprintln!("written: {NUMBERS} and {TABLE}");
    Ok(ExitCode::SUCCESS)
}

/// Compares with the numbers that are checked in.
pub fn check() -> Result<()> {
    let text = std::fs::read_to_string(project::root().join(NUMBERS)).with_context(|| format!("{NUMBERS} cannot be read"))?;
    let kept = Footprint::from_json(&text).with_context(|| format!("{NUMBERS} is not what `cargo xtask footprint` writes"))?;
    let table = std::fs::read_to_string(project::root().join(TABLE)).with_context(|| format!("{TABLE} cannot be read"))?;
    if table != table::markdown(&kept) {
        bail!("{TABLE} does not say what {NUMBERS} says: write both again with `cargo xtask footprint`");
    }
    let complaints = Footprint::measure(trials()?)?.against(&kept);
    if complaints.is_empty() {
        println!("every row is within what {TABLE} says");
        return Ok(());
    }
    for complaint in &complaints {
        println!("{complaint}");
    }
    bail!("{} numbers are higher than {TABLE} says", complaints.len())
}

/// Bytes of RAM that the course takes: what is static and the deepest stack.
pub fn ram(trial: &Trial) -> Result<u64> {
    Ok(trial.course.number("statics")? + trial.course.number("stack")?)
}
