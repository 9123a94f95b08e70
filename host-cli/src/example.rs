//! `goodbot example`: a home and a session log to begin with.

use crate::outcome::Failure;
use clap::ValueEnum;
use std::io::Write;

/// What can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Example {
    /// A home, as JSON
    Home,
    /// The same kind of home, drawn as text
    Map,
    /// A session log: what was said, done and judged
    Log,
}

/// Three rooms with a legend.
const MAP: &str = "\
#########
#rrr#ggg#
#rrr+ggg#
#rrr#ggg#
##+######
#bbbbbbb#
#bC@bbbb#
#bbbbbbb#
#########
r: red
g: green
b: blue
C: yellow chair
";

/// Prints an example.
///
/// # Errors
/// [`Failure::Output`].
pub fn run(what: Example) -> Result<(), Failure> {
    let text = match what {
        Example::Home => include_str!("example/home.json"),
        Example::Map => MAP,
        Example::Log => include_str!("example/sessions.jsonl"),
    };
    Ok(std::io::stdout().lock().write_all(text.as_bytes())?)
}
