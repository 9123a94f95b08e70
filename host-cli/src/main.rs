//! The goodbot command line.
//!
//! Exit codes: 0 all well, 1 a result that failed, 2 bad use or bad input. Data goes to standard output, progress and messages to
//! standard error.

#![forbid(unsafe_code)]

mod ask;
mod check;
mod cli;
mod evaluate;
mod inspect;
mod learn;
mod lessons;
mod load;
mod merge;
mod model;
mod outcome;
mod paper;
mod replay;
mod teach;
mod whole_file;

use clap::{CommandFactory, Parser};
use cli::{Cli, Command};
use outcome::Failure;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let done = match cli.command.unwrap_or(Command::Paper(cli.paper)) {
        Command::Paper(options) => paper::run(&options),
        Command::Teach(options) => teach::run(&options),
        Command::Learn(options) => learn::run(&options),
        Command::Ask(options) => ask::run(&options),
        Command::Inspect(options) => inspect::run(&options),
        Command::Replay(args) => return replay::run(&args),
        Command::Check(args) => return check::run(&args),
        Command::Merge(options) => merge::run(&options),
        Command::Evaluate(options) => evaluate::run(&options),
        Command::Completions { shell } => completions(shell),
    };
    outcome::exit_code(done)
}

fn completions(shell: clap_complete::Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "goodbot", &mut script);
    Ok(std::io::stdout().lock().write_all(&script)?)
}
