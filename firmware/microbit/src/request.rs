//! Requests on the serial line, one a line.

use goodbot::home::{Area, Cell};

/// A request.
#[derive(Clone, Copy, Debug)]
pub enum Request<'l> {
    /// The requests, in a few words.
    Help,
    /// A command in somebody's own words.
    Say(&'l str),
    /// One action now: the robot's choice, or the one of this name.
    Act(Option<&'l str>),
    /// The last action was good, as button B says.
    Good,
    /// The last action was bad, as button A says.
    Bad,
    /// The lesson is over, as both buttons say.
    Finish,
    /// The next command of the list, as a long press says.
    Next,
    /// What the robot takes the command to mean.
    Believe,
    /// How many milliseconds are between actions; with 0, it acts only when it is asked to.
    Pace(u32),
    /// Everything back to where it was at first.
    Again,
    /// The robot's own home.
    Home,
    /// Another home begins.
    Begin,
    /// A room of it.
    Room(&'l str, Area, &'l str),
    /// A door of it.
    Door(&'l str, Area),
    /// A block of it.
    Block(&'l str, Cell, &'l str, &'l str),
    /// The robot in it.
    Agent(&'l str, Cell),
    /// The other home is described.
    Build,
    /// Everything that was learned is forgotten.
    Forget,
    /// How much memory is used.
    Memory,
    /// The bytes of the learned model.
    Model,
}

/// The answer to `help`.
pub const HELP: [&str; 9] = [
    "say WORDS...: a command in your own words; next: the next one of the list",
    "good, bad: about the last action; finish: the lesson is over, learn from it",
    "believe: what the command may mean, and how probable that is",
    "act: one action now; act NAME: that action; pace MILLISECONDS: 0 for none by itself",
    "again: everything back to its place; forget: all that was learned",
    "home: the robot's own home; begin: another one, which these describe:",
    "room NAME LEFT BOTTOM RIGHT TOP COLOR; door NAME LEFT BOTTOM RIGHT TOP",
    "block NAME X Y COLOR SHAPE; agent NAME X Y; and then build",
    "memory: the bytes that are used; model: the learned model, in hexadecimal digits",
];

/// Reads a line.
///
/// # Errors
/// The text to answer with.
pub fn read(line: &str) -> Result<Request<'_>, &'static str> {
    let (name, rest) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
    let mut words = rest.split_ascii_whitespace();
    let request = match name {
        "help" => Request::Help,
        "say" => return Ok(Request::Say(rest)),
        "act" => Request::Act(words.next()),
        "good" => Request::Good,
        "bad" => Request::Bad,
        "finish" => Request::Finish,
        "next" => Request::Next,
        "believe" => Request::Believe,
        "pace" => Request::Pace(words.next().and_then(|number| number.parse().ok()).ok_or("pace needs a number of milliseconds")?),
        "again" => Request::Again,
        "home" => Request::Home,
        "begin" => Request::Begin,
        "room" => room(&mut words).ok_or("room needs NAME LEFT BOTTOM RIGHT TOP COLOR")?,
        "door" => door(&mut words).ok_or("door needs NAME LEFT BOTTOM RIGHT TOP")?,
        "block" => block(&mut words).ok_or("block needs NAME X Y COLOR SHAPE")?,
        "agent" => agent(&mut words).ok_or("agent needs NAME X Y")?,
        "build" => Request::Build,
        "forget" => Request::Forget,
        "memory" => Request::Memory,
        "model" => Request::Model,
        _ => return Err("there is no such request; say help"),
    };
    if words.next().is_some() { Err("there is more on the line than the request needs; say help") } else { Ok(request) }
}

fn number<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<i32> {
    words.next()?.parse().ok()
}

fn area<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Area> {
    Some(Area::new(number(words)?, number(words)?, number(words)?, number(words)?))
}

fn cell<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Cell> {
    Some(Cell::new(number(words)?, number(words)?))
}

fn room<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Request<'l>> {
    Some(Request::Room(words.next()?, area(words)?, words.next()?))
}

fn door<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Request<'l>> {
    Some(Request::Door(words.next()?, area(words)?))
}

fn block<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Request<'l>> {
    Some(Request::Block(words.next()?, cell(words)?, words.next()?, words.next()?))
}

fn agent<'l>(words: &mut impl Iterator<Item = &'l str>) -> Option<Request<'l>> {
    Some(Request::Agent(words.next()?, cell(words)?))
}
