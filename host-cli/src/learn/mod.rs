//! `goodbot learn`: a model from recorded sessions.

use crate::lessons::{self, training};
use crate::load::kinds::TaskKinds;
use crate::model::Model;
use crate::outcome::Failure;
use crate::whole_file::{new_file, write_whole};
use clap::{Args, ValueHint};
use goodbot::snapshot::most_bytes;
use goodbot::memory::AgentHeap;
use goodbot::{Agent, Capacities};
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// The options of `goodbot learn`.
#[derive(Debug, Args)]
#[command(after_help = "\
All sessions are learned from at once, in no order: each by what its steps show of the task that was meant, without any word.
Sessions that say that they are not to be learned from are walked through and left out.

Example:
  goodbot learn turk-simplified.jsonl --out words.goodbot")]
pub struct LearnOptions {
    /// Session logs (JSON Lines), feedback or demonstrations; - is standard input
    #[arg(required = true, value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<String>,
    /// Where the model goes
    #[arg(long, value_name = "MODEL", value_hint = ValueHint::FilePath, value_parser = new_file)]
    out: PathBuf,
    /// A kind of task beside the paper's two; may be given several times
    #[arg(long = "lifted", alias = "task", value_name = "TASK", value_parser = TaskKinds::parse)]
    lifted: Vec<goodbot::task::LiftedTask>,
    /// The settings of the model
    #[arg(long, value_enum, default_value_t)]
    model: Model,
    /// Pass over sessions that are at fault, and count them
    #[arg(long)]
    keep_going: bool,
    /// Print what was learned from as a line of JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(options: &LearnOptions) -> Result<(), Failure> {
    let lifted = TaskKinds::and(&options.lifted).map_err(|error| Failure::Input(error.to_string()))?;
    let (lessons, skipped) = lessons::read(&options.files, &lifted, options.model.options(), false, options.keep_going)?;
    let learned = lessons.iter().filter(|lesson| lesson.learn).count();
    if learned == 0 {
        return Err(Failure::Input("no session is to be learned from; set \"learn\" to true at the end of one".to_owned()));
    }
    let fault = |error: &dyn std::fmt::Display| Failure::Input(error.to_string());
    let capacities = training::capacities(&lessons, Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD });
    let mut memory = AgentHeap::new(&capacities);
    let model = training::train(&mut memory, lessons.iter(), options.model.options().language).map_err(|error| fault(&error))?;
    let mut buffer = vec![0; most_bytes(&capacities)];
    let length = model.save(&mut buffer).map_err(|error| fault(&error))?;
    // The robot's whole mind: the same training data, with its trainer strategies and the vocabulary of its tasks.
    let mut agent = Agent::new(AgentHeap::new(&capacities), &lifted, options.model.options()).map_err(|error| fault(&error))?;
    agent.restore(buffer.get(..length).unwrap_or(&[])).map_err(|error| fault(&error))?;
    let length = agent.save(&mut buffer).map_err(|error| fault(&error))?;
    write_whole(&options.out, buffer.get(..length).unwrap_or(&[]))
        .map_err(|error| Failure::Input(format!("{} cannot be written: {error}", options.out.display())))?;
    let (words, tokens, pairs) = (model.tables().words(), model.tables().tokens(), model.bitext().pairs().len());
    let mut out = std::io::stdout().lock();
    if options.json {
        let line = json!({
            "type": "model", "sessions": learned, "skipped": skipped, "words": words, "tokens": tokens, "pairs": pairs, "bytes": length,
        });
        writeln!(out, "{line}")?;
    } else {
        writeln!(out, "{learned} sessions, {words} words, {tokens} machine tokens: {length} bytes in {}", options.out.display())?;
    }
    Ok(())
}
