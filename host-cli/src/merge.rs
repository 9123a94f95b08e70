//! `goodbot merge`: what two robots learned, in one model.

use crate::outcome::Failure;
use crate::whole_file::write_whole;
use clap::{Args, ValueHint};
use goodbot::home::paper_tasks;
use goodbot::snapshot::RestoreError;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use std::fs;
use std::path::{Path, PathBuf};

/// Join what two robots learned
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct MergeArgs {
    /// The first model: its sessions come first, and its settings stay
    #[arg(value_name = "A", value_hint = ValueHint::FilePath)]
    pub first: PathBuf,
    /// The second model: its sessions follow
    #[arg(value_name = "B", value_hint = ValueHint::FilePath)]
    pub second: PathBuf,
    /// Where the merged model goes
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: PathBuf,
}

const EXAMPLES: &str = "\
Words and machine tokens are matched by their text. Sessions at the beginning that both models have, from a
common past, are kept once. What is believed of the trainers is that of A.

Example:
  goodbot merge kitchen.model garden.model --out both.model";

/// Joins two models.
///
/// # Errors
/// [`Failure`] names the file and what is wrong with it.
pub fn run(options: &MergeArgs) -> Result<(), Failure> {
    let (first, second) = (read(&options.first)?, read(&options.second)?);
    let refused = |path: &Path, error: RestoreError| Failure::Input(format!("{}: {error}", path.display()));
    let tasks = paper_tasks().map_err(|error| Failure::Input(error.to_string()))?;
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut agent = Agent::new(memory.split().agent, &tasks, Options::PAPER).map_err(|error| Failure::Input(error.to_string()))?;
    agent.restore(&first).map_err(|error| refused(&options.first, error))?;
    let added = agent.join(&second).map_err(|error| refused(&options.second, error))?;
    let size = agent.saved_bytes().map_err(|error| Failure::Input(error.to_string()))?;
    let mut bytes = vec![0; size];
    agent.save(&mut bytes).map_err(|error| Failure::Input(error.to_string()))?;
    write_whole(&options.out, &bytes).map_err(|error| Failure::Input(format!("{}: {error}", options.out.display())))?;
    let (words, sessions) = (agent.language().words().len(), agent.language().bitext().sessions());
    eprintln!("{}: {sessions} sessions, {added} of them added; {words} words", options.out.display());
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|error| Failure::Input(format!("{}: {error}", path.display())))
}
