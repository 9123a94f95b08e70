//! `goodbot table`: prints the robot of a world file as source code for a controller.
//!
//! - [`source`]: the parts that both languages share; [`c`], [`rust`]: the text.

mod c;
mod rust;
mod source;

use crate::size::needs::{MOST_STATES_OF_WORLD, is_for_controllers, least_of_world};
use clap::{Args, ValueHint};
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::oomdp::check;
use goodbot::session::Lessons;
use goodbot_console::learner::Learner;
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::numbers::between;
use goodbot_console::outcome::Failure;
use goodbot_console::printed::Printed;
use goodbot_lesson::world::robot::{self, Robot, WorldFlaw};
use source::Source;
use std::io::Write;

/// Print the robot of a world as source for a controller
///
/// The description is checked in every state that the robot can reach. The capacities are the smallest with which every lesson is kept and
/// every plan is exact.
#[derive(Debug, Args)]
#[command(after_help = "\
In C it is a goodbot_table for the library's feature table, which has at most 8 classes, 8 propositions and 8 kinds of task. In Rust it is a module with \
a robot for Agent and memory for both. A state is a number: a comment gives the meaning of each digit.

Examples:
  goodbot table lift.json --c > lift.h
  goodbot table lift.json --rust --sessions 40 > lift.rs")]
pub struct TableOptions {
    /// The world, as JSON
    #[arg(value_name = "WORLD", value_hint = ValueHint::FilePath)]
    world: InputFile,
    /// Print C
    #[arg(long, required_unless_present = "rust", conflicts_with = "rust")]
    c: bool,
    /// Print Rust
    #[arg(long)]
    rust: bool,
    /// The number of sessions that it must keep, 1 to 65535
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = between(1, usize::from(u16::MAX)), allow_negative_numbers = true)]
    sessions: usize,
    /// The most words of one command, 1 to 64
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = between(1, WORDS_PER_COMMAND), allow_negative_numbers = true)]
    words: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the fault of the file or of the output.
pub fn run(options: &TableOptions) -> Result<(), Failure> {
    let name = input::name(&options.world);
    let file = input::world(&options.world)?;
    let file = file.ok_or_else(|| Failure::Input(format!("{name}: is no world; goodbot example world prints one")))?;
    let refused = |flaw: WorldFlaw| file.fault(&flaw.field, &flaw.message);
    let text = robot::with(&file.world, |robot, start| text(options, robot, start)).map_err(refused)?.map_err(refused)?;
    let mut out = Printed::stdout();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

fn text(options: &TableOptions, robot: &Robot<'_>, start: u64) -> Result<String, WorldFlaw> {
    // The kinds of task and the numbers of actions and states are checked before the states themselves, which take longer.
    let kinds = robot::tasks(robot.file(), robot)?;
    is_for_controllers(robot)?;
    check(robot, start, MOST_STATES_OF_WORLD).map_err(|error| WorldFlaw { field: "actions".to_owned(), message: error.to_string() })?;
    let capacities = least_of_world(robot, &Lessons::new(options.sessions, options.words), Learner::Roles.options())?;
    let source = Source::of(robot, start, kinds, capacities);
    if options.c { c::text(&source) } else { Ok(rust::text(&source)) }
}
