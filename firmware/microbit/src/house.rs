//! The micro:bit's own home, as large as its lights, and the commands to teach it; or those that came with its file.

use crate::flash;

/// A red room above; a green and a blue one below, each behind a door; a yellow chair in the red one. Inside its walls it has five times
/// five cells. Each line is a request of the serial line.
const HOME: &str = "\
room room0 0 3 6 6 red
room room1 0 0 3 3 green
room room2 3 0 6 3 blue
door door0 2 3 2 3
door door1 4 3 4 3
block block0 3 4 yellow chair
agent agent0 1 5
";

/// The commands, in the order in which a long press chooses them. Who teaches the first three can ask for the fourth.
const COMMANDS: &str = "\
say go to the green room
say go to the blue room
say take the chair to the green room
say take the chair to the blue room
";

/// How a command begins.
const SAY: &str = "say ";

/// The lines of a text. `str::lines` would bring panicking code.
#[allow(clippy::manual_pattern_char_comparison, reason = "the search for a char is what can panic")]
fn lines(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.split(|letter| letter == '\n').filter(|line| !line.is_empty())
}

/// The requests that describe the home.
pub fn description() -> impl Iterator<Item = &'static str> {
    let is_part = |line: &&str| !line.starts_with(SAY);
    let chosen = flash::chosen().filter(|text| lines(text).any(|line| is_part(&line)));
    lines(chosen.unwrap_or(HOME)).filter(is_part)
}

/// The command at a position of the list, and the position of the next; after the last comes the first.
pub fn command(position: usize) -> (&'static str, usize) {
    let commands = |text: &'static str| lines(text).filter_map(|line| line.strip_prefix(SAY));
    let list = flash::chosen().filter(|text| commands(text).next().is_some()).unwrap_or(COMMANDS);
    match commands(list).nth(position) {
        Some(command) => (command, position + 1),
        None => (commands(list).next().unwrap_or_default(), 1),
    }
}
