//! Instructions that each work takes, by valgrind: the same whatever else the machine does.

use std::process::Command;

use anyhow::{Context, Result};

use crate::programs::VALGRIND;
use crate::{process, project};

/// Prints one line a work whose name has `filter` in it.
pub fn run(filter: &str) -> Result<()> {
    VALGRIND.path()?;
    process::run(project::cargo().args(["build", "--release", "--quiet", "--package", "goodbot-benches", "--bin", "measure"]))?;
    let measure = project::target_dir().join("release").join(format!("measure{}", std::env::consts::EXE_SUFFIX));
    let names = process::capture(&mut Command::new(&measure))?;
    println!("| work | instructions |\n|---|---|");
    for name in names.lines().filter(|name| name.contains(filter)) {
        // What comes before the work is in both counts.
        let (once, twice) = (count(&measure, name, 1)?, count(&measure, name, 2)?);
        println!("| {name} | {} |", twice.saturating_sub(once));
    }
    Ok(())
}

fn count(measure: &std::path::Path, name: &str, times: u32) -> Result<u64> {
    let file = project::target_dir().join(format!("callgrind.{}", std::process::id()));
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--tool=callgrind"]).arg(format!("--callgrind-out-file={}", file.display()));
    process::capture(command.arg(measure).args([name, &times.to_string()]))?;
    let counts = std::fs::read_to_string(&file).with_context(|| format!("{} cannot be read", file.display()))?;
    std::fs::remove_file(&file)?;
    total(&counts).context("callgrind gave no total")
}

/// The total of a file that callgrind wrote.
fn total(counts: &str) -> Option<u64> {
    let line = counts.lines().find_map(|line| line.strip_prefix("summary:").or(line.strip_prefix("totals:")))?;
    line.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_total_is_read() {
        assert_eq!(total("version: 1\nevents: Ir\nsummary: 1234\nfn=(1)\n5 6\n"), Some(1234));
        assert_eq!(total("version: 1\n"), None);
    }
}
