//! Programs that are no course: a robot of one's own, plans for tasks with ways, and C.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Result;

use crate::capi::example::Program;
use crate::firmware::Alone;
use crate::firmware::image::{flash, statics};
use crate::firmware::trial::Report;

/// Programs in C, all for the Cortex-M4F: what stands in the table, the program, and whether it takes a library of its own to build, which is
/// too long for a check.
const IN_C: [(&str, Program, bool); 4] = [
    ("C, every function, all features", Program::EVERY_FUNCTION, false),
    ("C, a robot in homes (capi/examples/home.c), all features", Program::HOME, false),
    ("C, a table robot (capi/examples/lift.c), all features", Program::LIFT, false),
    ("C, a table robot (capi/examples/lift.c), `--features table`", Program::LIFT_ALONE, true),
];

/// Programs in Rust, all for the Cortex-M4F.
const IN_RUST: [(&str, Alone); 2] = [
    ("Rust, an arm of one's own (firmware/src/arm.rs)", Alone::Arm),
    ("Rust, three storeys with ways (firmware/src/ways.rs)", Alone::Ways),
];

/// Builds and runs all of them, or those that a check has time for.
pub fn measure(is_check: bool) -> Result<BTreeMap<String, BTreeMap<String, u64>>> {
    let mut programs = BTreeMap::new();
    for (name, alone) in IN_RUST {
        programs.insert(name.to_owned(), row(&alone.build()?, &alone.run()?)?);
    }
    for (name, program, takes_long) in IN_C {
        if !(is_check && takes_long) {
            programs.insert(name.to_owned(), row(&program.build()?, &program.run()?)?);
        }
    }
    Ok(programs)
}

/// A program's numbers: what it is, and what it says of itself.
fn row(binary: &Path, report: &Report) -> Result<BTreeMap<String, u64>> {
    let mut row = BTreeMap::from([("flash".to_owned(), flash(binary)?), ("statics".to_owned(), statics(binary)?)]);
    for name in ["stack", "instructions", "tasks", "hear", "first-plan"] {
        row.extend(report.all(name).first().map(|&number| (name.to_owned(), number)));
    }
    Ok(row)
}
