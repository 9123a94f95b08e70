//! `goodbot size`: the memory that a robot needs, as source code for a controller.
//!
//! - [`needs`]: capacities for homes and lessons, and their memory;
//! - [`source`]: the same as Rust and as C.

pub mod needs;
pub mod source;

use clap::{Args, ValueHint};
use goodbot::capacity::{Capacity, WORDS_PER_COMMAND};
use goodbot_console::learner::Learner;
use goodbot_console::load::input::InputFile;
use goodbot_console::load::kinds::TaskKinds;
use goodbot_console::messages::counted;
use goodbot_console::numbers::between;
use goodbot_console::outcome::Failure;
use goodbot_console::printed::Printed;
use needs::Needs;
use serde_json::json;
use std::io::Write;

/// The options of `goodbot size`.
#[derive(Debug, Args)]
#[command(after_help = "\
With these capacities nothing is refused and no lesson gives way, in any of the homes, from any state. The homes of a log count too.

That is the worst case. With a log, words and machine commands are counted as the log has them, which takes much less, and a robot is trained on \
it in that memory: it tells how many sessions it kept. Without a log, every word of every command counts as a new word of 12 letters.

Examples:
  goodbot size home.json --log log.jsonl
  goodbot size home.json --sessions 20 --words 6
  goodbot size lift.json --log lift.jsonl
  goodbot size --log log.jsonl --sessions 100 --json")]
pub struct SizeOptions {
    /// The robot's homes, as JSON or drawn as text, or the world of another robot; - is standard input
    #[arg(value_name = "PLACE", value_hint = ValueHint::FilePath, required_unless_present = "log")]
    places: Vec<InputFile>,
    /// Sessions that it is to keep, with their homes; may be given several times
    #[arg(long, short = 'l', value_name = "LOG", value_hint = ValueHint::FilePath)]
    log: Vec<InputFile>,
    /// The number of sessions that it must keep, 1 to 65535 [default: those of the log, or 16]
    #[arg(long, value_name = "N", value_parser = between(1, usize::from(u16::MAX)), allow_negative_numbers = true)]
    sessions: Option<usize>,
    /// The most words of one command, 1 to 64 [default: those of the log, or 8]
    #[arg(long, value_name = "N", value_parser = between(1, WORDS_PER_COMMAND), allow_negative_numbers = true)]
    words: Option<usize>,
    #[command(flatten)]
    kinds: TaskKinds,
    /// The learner. A controller has no layer: the default needs as much there as roles
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Learner::Roles)]
    learner: Learner,
    /// Print a line of JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &SizeOptions) -> Result<(), Failure> {
    let needs = Needs::find(options)?;
    let mut out = Printed::stdout();
    if options.json {
        writeln!(out, "{}", to_json(&needs))?;
    } else {
        print(&mut out, &needs)?;
    }
    Ok(out.flush()?)
}

fn to_json(needs: &Needs) -> serde_json::Value {
    let capacities: serde_json::Map<_, _> =
        Capacity::ALL.iter().map(|&capacity| (capacity.name().to_owned(), json!(needs.capacities.get(capacity)))).collect();
    let lessons = &needs.lessons;
    json!({
        "type": "size", "homes": needs.homes, "world": needs.world, "sessions": lessons.sessions, "words": lessons.words,
        "different_words": lessons.different_words, "word_bytes": lessons.word_bytes, "capacities": capacities,
        "exact_states": needs.exact_states, "ram": { "controller": needs.ram(), "stack": needs::STACK },
        "flash": { "model": needs.model_bytes(), "slot": needs.slot_bytes() }, "kept": needs.kept,
    })
}

fn print(out: &mut impl Write, needs: &Needs) -> Result<(), Failure> {
    let lessons = &needs.lessons;
    let [homes, sessions] = [(needs.homes, "home"), (lessons.sessions, "session")].map(|(n, it)| counted(n, it));
    let place = needs.world.as_ref().map_or(homes, |world| format!("the world {}", world));
    writeln!(
        out,
        "A robot in {place} that keeps {sessions} of at most {}, {} different:",
        counted(lessons.words, "word"),
        lessons.different_words
    )?;
    writeln!(out)?;
    writeln!(
        out,
        "  RAM    {:>7} bytes on a 32-bit controller, and a stack of {} bytes, as docs/footprint.md says of the course",
        needs.ram(),
        needs::STACK
    )?;
    writeln!(
        out,
        "  flash  {:>7} bytes at most for the model; two slots of {} outlive power cuts",
        needs.model_bytes(),
        needs.slot_bytes()
    )?;
    writeln!(out, "                 for the program: see docs/footprint.md")?;
    if let Some(kept) = needs.kept {
        writeln!(out, "  tried  {kept:>7} of {} sessions of the log were kept in that memory", needs.taught)?;
    }
    if needs.exact_states != Some(needs.capacities.states) {
        let exact = needs.exact_states.map_or("more than can be counted".to_owned(), |states| states.to_string());
        writeln!(
            out,
            "\nThe states are limited to {}; exact plans need {exact}. Plans for far goals are approximate.",
            needs.capacities.states
        )?;
    }
    writeln!(out, "\nIn Rust:\n\n{}", source::rust(&needs.capacities))?;
    writeln!(out, "In C:\n\n{}", source::c(&needs.capacities, needs.ram(), needs.world.is_some()))?;
    Ok(())
}
