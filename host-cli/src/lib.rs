//! The goodbot command line, as the program `goodbot` and as Python's `python -m goodbot`.
//!
//! Exit codes: 0 all well, 1 a result that failed, 2 bad use or bad input. Data goes to standard output, progress and messages to standard
//! error.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::print_stdout, clippy::print_stderr)]

mod ask;
mod check;
mod cli;
mod convert;
mod diff;
mod doctor;
mod example;
mod inspect;
mod learn;
mod merge;
mod microbit;
mod migrate;
mod paper;
mod parameters;
mod replay;
mod size;
mod table;
mod teach;
mod unlearn;
mod words;

use clap::{CommandFactory, FromArgMatches};
use cli::{Cli, Color, Command};
use goodbot_console::{Failure, messages, outcome, printed};
use goodbot_lab::{acts, evaluate, fit_trainers, study};
use std::ffi::OsString;
use std::io::Write;

/// Runs the command that was typed, beginning with the program's name, and returns the exit code.
///
/// ```
/// assert_eq!(goodbot_cli::run(&["goodbot".into(), "--version".into()]), 0);
/// assert_eq!(goodbot_cli::run(&["goodbot".into(), "no-such-command".into()]), 2);
/// ```
pub fn run(typed: &[OsString]) -> u8 {
    let matches = cli::arguments().try_get_matches_from(typed);
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => return cli::tell(&error, typed),
    };
    if cli.quiet {
        messages::be_quiet();
    }
    messages::set_colored(match cli.color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => printed::is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|set| set.is_empty()),
    });
    let done = match cli.command.unwrap_or(Command::Paper(cli.paper)) {
        Command::Paper(options) => paper::run(&options),
        Command::Teach(options) => teach::run(&options),
        Command::Learn(options) => learn::run(&options),
        Command::Ask(options) => ask::run(&options),
        Command::Inspect(options) => inspect::run(&options),
        Command::Acts(options) => acts::run(&options),
        Command::FitTrainers(options) => fit_trainers::run(&options),
        Command::Replay(args) => replay::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Size(options) => size::run(&options),
        Command::Table(options) => table::run(&options),
        Command::Convert(args) => convert::run(&args),
        Command::Microbit(options) => microbit::run(&options),
        Command::Parameters(options) => parameters::run(&options),
        Command::Merge(options) => merge::run(&options),
        Command::Diff(args) => diff::run(&args),
        Command::Migrate(args) => migrate::run(&args),
        Command::Unlearn(args) => unlearn::run(&args),
        Command::Doctor => doctor::run(),
        Command::Evaluate(options) => evaluate::run(&options),
        Command::Study(options) => study::run(&options),
        Command::Example { what } => example::run(what),
        Command::Completions { shell } => completions(shell),
        Command::Man => manual(),
    };
    outcome::exit_code(done)
}

fn completions(shell: clap_complete::Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "goodbot", &mut script);
    Ok(printed::data(&script)?)
}

/// One manual page for all commands: the pages of clap_mangen, one after another.
fn manual() -> Result<(), Failure> {
    let mut page = Vec::new();
    let mut cli = Cli::command();
    cli.build();
    clap_mangen::Man::new(cli.clone()).render(&mut page)?;
    for command in cli.get_subcommands().filter(|command| command.get_name() != "help") {
        let man = clap_mangen::Man::new(command.clone());
        let mut part = Vec::new();
        man.render_description_section(&mut part)?;
        man.render_options_section(&mut part)?;
        man.render_extra_section(&mut part)?;
        writeln!(page, ".SH \"GOODBOT {}\"", command.get_name().to_uppercase())?;
        page.extend_from_slice(String::from_utf8_lossy(&part).replace(".SH ", ".SS ").as_bytes());
    }
    Ok(printed::data(&page)?)
}
