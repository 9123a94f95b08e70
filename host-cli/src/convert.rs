//! `goodbot convert`: a world from PDDL.

use clap::{Args, ValueHint};
use goodbot_console::messages::tell;
use goodbot_console::{Failure, InputFile, Printed, counting, input, working};
use goodbot_lesson::Fault;
use goodbot_lesson::world::pddl::{self, PddlError, Text};
use goodbot_lesson::world::robot::{self, Tables, WorldFlaw};
use std::io::Write;
use std::sync::Arc;

/// Print the world of a PDDL domain and problem
///
/// Typing, STRIPS, negative preconditions, equality and action costs of 1 to 255 are understood. The problem must be small: a robot has at
/// most 256 tasks, and at most 255 actions with their objects. Parameters that others determine do not count.
#[derive(Debug, Args)]
#[command(after_help = "\
Each object's name is an attribute that words can mean; add others, such as a colour, to the file.

Example:
  goodbot convert domain.pddl problem.pddl > world.json && goodbot teach world.json")]
pub struct ConvertArgs {
    /// The domain
    #[arg(value_name = "DOMAIN", value_hint = ValueHint::FilePath)]
    domain: InputFile,
    /// The problem
    #[arg(value_name = "PROBLEM", value_hint = ValueHint::FilePath)]
    problem: InputFile,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: a fault of the files, or a part that a world cannot express.
pub fn run(args: &ConvertArgs) -> Result<(), Failure> {
    let [domain, problem] = [input::text(&args.domain)?, input::text(&args.problem)?];
    let file = |text| input::name(if text == Text::Domain { &args.domain } else { &args.problem });
    let refused = |flaw: WorldFlaw| Failure::Input(format!("{}: {flaw}", file(Text::Problem)));
    let progress = counting("states visited");
    let converted = pddl::convert_in_steps(&domain, &problem, |states| progress.set_position(states as u64));
    progress.finish_and_clear();
    let pddl::Converted { world, warnings } =
        converted.map_err(|PddlError { text, line, message }| Failure::from(Fault::on_line(file(text), line, message)))?;
    for warning in warnings {
        tell(&format!("{}: warning: {warning}", file(Text::Problem)));
    }
    let progress = working("checking the world");
    // A world in which no robot can act is refused here, before it is used.
    let tables = Tables::of(Arc::new(world)).map_err(refused)?;
    tables.lend(|robot| robot::tasks(tables.file(), robot)).map_err(refused)?;
    progress.finish_and_clear();
    let mut out = Printed::stdout();
    serde_json::to_writer_pretty(&mut out, tables.file().as_ref()).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(out.flush()?)
}
