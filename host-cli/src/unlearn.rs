//! `goodbot unlearn`: removes a session from a model.

use crate::words;
use clap::{Args, ValueHint};
use goodbot::snapshot::Contents;
use goodbot_console::load::kinds::{kept, with_kinds};
use goodbot_console::{Failure, Kind, Output, counted, read_model, restored, say};
use std::path::{Path, PathBuf};

/// Take one session out of a model
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
The words that no other session has go with it. Two traces stay: its evidence about the trainer, and its influence on later sessions, which were \
understood with its help. A log still has the session; goodbot learn --without ID leaves it out.

Examples:
  goodbot inspect robot.goodbot --sessions
  goodbot unlearn robot.goodbot 3 --out robot2.goodbot")]
pub struct UnlearnArgs {
    /// The model
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// The session: its number, as in goodbot inspect --sessions
    #[arg(value_name = "SESSION")]
    session: String,
    /// The model to write, without the session; - is standard output
    #[arg(long, short = 'o', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    out: PathBuf,
    /// Replace a file that is no model
    #[arg(long)]
    force: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(args: &UnlearnArgs) -> Result<(), Failure> {
    let target = Output::new(Kind::Model, &args.out, [&args.model], args.force)?;
    let mut agent = restored::model(&args.model)?;
    let file = read_model(&args.model)?;
    let kinds = kept(&args.model, &file)?;
    let vocabulary = Contents::read(&file)?.vocabulary;
    let commands = words::commands(&agent);
    let at = number(&args.model, &args.session, commands.len())?;
    let command = commands.get(at).cloned().unwrap_or_default();
    if !u16::try_from(at).is_ok_and(|at| agent.unlearn(at)) {
        return Err(Failure::of(&args.model, format_args!("has no session {}", at + 1)));
    }
    restored::learn_fully(&mut agent);
    let model = agent.saved_for(vocabulary)?;
    target.write(&match kinds {
        Some(kinds) => with_kinds(model, &kinds),
        None => model,
    })?;
    say!("{}: {} without \"{command}\"", target.name(), counted(commands.len() - 1, "session"));
    Ok(())
}

/// The position of a session with this number.
fn number(model: &Path, text: &str, count: usize) -> Result<usize, Failure> {
    let what = match text.parse::<usize>() {
        Ok(number) if (1..=count).contains(&number) => return Ok(number - 1),
        Ok(_) => format!("has {}", counted(count, "session")),
        Err(_) => format!("{text:?} is no number"),
    };
    Err(Failure::of(model, format_args!("{what}; goodbot inspect --sessions numbers them")))
}
