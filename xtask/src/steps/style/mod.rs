//! Rules of this project that no other tool checks.
//!
//! A new rule is a file here with a function in it and a line in [`RULES`].

mod lengths;
mod locks;
mod panics;
mod paths;

use std::path::Path;

use anyhow::{Result, bail};

use super::{Step, Tally};
use crate::project;

pub const STEP: Step = Step {
    name: "style",
    about: "the project's own rules are kept",
    fast: true,
    run,
    next: "mend the lines that are listed; the rules are in xtask/src/steps/style",
};

/// What a rule looks at: one of the project's text files.
struct Source<'a> {
    /// Relative to the project's top folder, with `/` between its parts.
    path: &'a str,
    text: &'a str,
}

/// Where a rule is broken (lines from 1; 0 is the file as a whole), and how.
#[derive(Debug, PartialEq, Eq)]
struct Breach {
    line: usize,
    what: String,
}

type Rule = fn(&Source) -> Vec<Breach>;

const RULES: &[Rule] = &[lengths::rule, locks::rule, panics::rule, paths::rule];

fn run(_: &mut Tally) -> Result<()> {
    let root = project::root();
    let mut files = 0_usize;
    let mut breaches = 0_usize;
    for file in project::files()? {
        // What is not text is nothing for these rules.
        let Ok(text) = std::fs::read_to_string(root.join(&file)) else {
            continue;
        };
        files += 1;
        let source = Source { path: &slashed(&file), text: &text };
        for breach in RULES.iter().flat_map(|rule| rule(&source)) {
            println!("{}:{}: {}", source.path, breach.line, breach.what);
            breaches += 1;
        }
    }
    if breaches > 0 {
        bail!("{breaches} places break the project's rules");
    }
    println!("{files} text files keep the project's rules");
    Ok(())
}

fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

/// Numbered lines, from 1.
fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines())
}
