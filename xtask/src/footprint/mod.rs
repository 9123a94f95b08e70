//! `cargo xtask footprint`: what the robot costs on each board, as a table that is checked in.
//!
//! - [`measures`]: the numbers of each row, and the file that keeps them for the check;
//! - [`programs`]: programs that are no course: a robot of one's own, plans for tasks with ways, and C;
//! - [`table`]: the same numbers for people.

mod measures;
mod programs;
mod table;

use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::firmware::{Trial, trials};
use crate::project;
use measures::{Footprint, Kept};

/// Where the numbers are kept, for the check and for people.
const NUMBERS: &str = "docs/footprint.json";
const TABLE: &str = "docs/footprint.md";
/// Where a short table is for everyone, and between which lines.
const README: &str = "README.md";
const MARKS: [&str; 2] = ["<!-- footprint -->\n", "<!-- /footprint -->"];

/// What to do with the table.
#[derive(Args)]
pub struct Options {
    /// Compares with the table that is checked in and writes nothing
    #[arg(long)]
    check: bool,
    /// Writes the tables again from the numbers that are checked in, and measures nothing
    #[arg(long, conflicts_with = "check")]
    kept: bool,
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
    let mut kept = if options.kept { kept()? } else { kept().unwrap_or_default() };
    if !options.kept {
        kept.renew(&measures::compiler()?, Footprint::measure(trials()?, false)?);
    }
    let root = project::root();
    std::fs::write(root.join(NUMBERS), kept.to_json()?).with_context(|| format!("{NUMBERS} cannot be written"))?;
    std::fs::write(root.join(TABLE), table::markdown(&kept)).with_context(|| format!("{TABLE} cannot be written"))?;
    let readme = read(README)?;
    std::fs::write(root.join(README), with_table(&readme, &table::brief(&kept))?).with_context(|| format!("{README} cannot be written"))?;
    eprintln!("written: {NUMBERS}, {TABLE} and a table in {README}");
    Ok(ExitCode::SUCCESS)
}

/// Compares with the numbers that are checked in.
pub fn check() -> Result<()> {
    let kept = kept()?;
    let readme = read(README)?;
    for (file, is_stale) in
        [(TABLE, read(TABLE)? != table::markdown(&kept)), (README, readme != with_table(&readme, &table::brief(&kept))?)]
    {
        if is_stale {
            bail!("{file} does not say what {NUMBERS} says: write both again with `cargo xtask footprint`");
        }
    }
    let complaints = kept.against(&measures::compiler()?, &Footprint::measure(trials()?, true)?);
    if complaints.is_empty() {
        println!("every row is within what {TABLE} says");
        return Ok(());
    }
    for complaint in &complaints {
        println!("{complaint}");
    }
    bail!("{} numbers are higher than {TABLE} says", complaints.len())
}

fn kept() -> Result<Kept> {
    Kept::from_json(&read(NUMBERS)?).with_context(|| format!("{NUMBERS} is not what `cargo xtask footprint` writes"))
}

fn read(file: &str) -> Result<String> {
    std::fs::read_to_string(project::root().join(file)).with_context(|| format!("{file} cannot be read"))
}

/// The README with this table between its marks.
fn with_table(readme: &str, table: &str) -> Result<String> {
    let [begin, end] = MARKS;
    let (before, rest) = readme.split_once(begin).with_context(|| format!("{README} has no line `{}`", begin.trim()))?;
    let (_, after) = rest.split_once(end).with_context(|| format!("{README} has no line `{end}`"))?;
    Ok(format!("{before}{begin}{table}{end}{after}"))
}

/// Bytes of RAM that the course takes: what is static and the deepest stack.
pub fn ram(trial: &Trial) -> Result<u64> {
    Ok(trial.course.number("statics")? + trial.course.number("stack")?)
}

#[cfg(test)]
mod tests {
    use super::with_table;

    #[test]
    fn the_table_takes_the_place_of_the_old_one_alone() {
        let readme = "# Title\n<!-- footprint -->\n| old |\n<!-- /footprint -->\nThe end.\n";
        assert_eq!(with_table(readme, "| new |\n").unwrap(), readme.replace("old", "new"));
        assert!(with_table("# Title\n", "").is_err());
    }
}
