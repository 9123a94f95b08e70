//! `goodbot example`: a home, a session log, a world and a table of synonyms to begin with.

use clap::ValueEnum;
use goodbot_console::outcome::Failure;
use std::io::Write;

/// What can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Example {
    /// A home, as JSON
    Home,
    /// The same kind of home, drawn as text
    Map,
    /// A session log: commands, steps and feedback
    Log,
    /// A world of another kind: a lift, with its actions
    World,
    /// A table of synonyms
    Synonyms,
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
        Example::World => include_str!("example/world.json"),
        Example::Synonyms => include_str!("example/synonyms.txt"),
    };
    Ok(std::io::stdout().lock().write_all(text.as_bytes())?)
}
