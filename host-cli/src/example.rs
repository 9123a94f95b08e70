//! `goodbot example`: prints a home, a session log, a world or a table of words to begin with.

use clap::ValueEnum;
use goodbot_console::Failure;
use goodbot_console::printed::data;
use goodbot_lesson::closed_words::CLOSED_WORDS;

/// The examples.
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
    /// The words of five languages that speak about commands: "not", "and", "please"
    ClosedWords,
}

/// The end of the table of closed words. Words after it are heard whatever the language of the lessons.
const WORDS_OF_ALL: &str = "# Words of your own: they are heard whatever the language of the lessons is.\nlanguage:\n";

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
        Example::ClosedWords => return Ok(data(format!("{CLOSED_WORDS}{WORDS_OF_ALL}").as_bytes())?),
    };
    Ok(data(text.as_bytes())?)
}
