//! `goodbot ways`: commands that say how, learned from reward and punishment alone.
//!
//! - [`exercise`]: homes of three storeys, and what is said in them;
//! - [`simulation`]: one robot's lessons and tests.

mod exercise;
mod simulation;

use crate::evaluate::report::wilson;
use crate::messages::bar;
use crate::outcome::Failure;
use crate::output;
use clap::Args;
use goodbot::asking::Asking;
use goodbot::home::{AGENT_IN_ROOM, SCHEMA, with_routes};
use goodbot::task::LiftedTask;
use goodbot::{Capacities, HeapMemory};
use rayon::prelude::*;
use serde_json::json;
use simulation::{Learned, Setting, simulate};
use std::io::Write;

/// The options of `goodbot ways`.
#[derive(Debug, Args)]
#[command(after_help = "\
A robot that knows no word is told to go somewhere, through a room, through one of two, or without entering one. Each lesson has a new home of \
three storeys, and the paper's balanced trainer, who is silent seven times out of ten. A test has commands in homes of its own, without any \
feedback; a command is right where the most likely of about 40 tasks is the one meant. The second row is a robot that asks.

Example:
  goodbot ways --runs 200 --lessons 30")]
pub struct WaysOptions {
    /// How many robots, 1 to 100000, each with a seed of its own, counted up from --seed
    #[arg(long, short = 'n', value_name = "N", default_value = "20", value_parser = runs, allow_negative_numbers = true)]
    runs: u32,
    /// Seed of the first robot
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = crate::numbers::seed, allow_negative_numbers = true)]
    seed: u64,
    /// How many lessons each has, 1 to 500
    #[arg(long, value_name = "N", default_value = "30", value_parser = lessons, allow_negative_numbers = true)]
    lessons: usize,
    /// Test after so many lessons, again and again
    #[arg(long, value_name = "N", default_value = "10", value_parser = lessons, allow_negative_numbers = true)]
    every: usize,
    /// How many commands a test has, 1 to 1000
    #[arg(long, value_name = "N", default_value = "20", value_parser = tests, allow_negative_numbers = true)]
    tests: usize,
    /// What a question costs the robot that asks, in steps
    #[arg(long, value_name = "STEPS", default_value = "4")]
    kappa: f32,
    /// Print a line of JSON for each test
    #[arg(long)]
    json: bool,
}

fn runs(text: &str) -> Result<u32, String> {
    crate::numbers::between(text, 1, 100_000).map(|runs| runs as u32)
}

fn lessons(text: &str) -> Result<usize, String> {
    crate::numbers::between(text, 1, 500)
}

fn tests(text: &str) -> Result<usize, String> {
    crate::numbers::between(text, 1, 1_000)
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &WaysOptions) -> Result<(), Failure> {
    let asking = Asking { kappa: options.kappa, ..Asking::DEFAULT };
    asking.check().map_err(|error| Failure::Input(error.to_string()))?;
    let task = LiftedTask::single(AGENT_IN_ROOM, &SCHEMA).map_err(|error| Failure::Result(error.to_string()))?;
    let lifted = with_routes(&[task]).map_err(|error| Failure::Result(error.to_string()))?.to_vec();
    let progress = bar(2 * options.runs as usize, "simulating robots");
    let mut out = output::text(&[])?;
    if !options.json {
        writeln!(out, "questions  lessons  right of {} commands, 95 %      robots with 9 of 10 right", options.tests)?;
    }
    for (name, asking) in [("none", Asking::NEVER), ("asked", asking)] {
        let setting = Setting { lifted: lifted.clone(), asking, lessons: options.lessons, every: options.every, tests: options.tests };
        let learned: Vec<Learned> = (0..options.runs)
            .into_par_iter()
            .map_init(
                || HeapMemory::new(&Capacities { states: 4_096, hashed_states: 0, ..Capacities::STANDARD }),
                |memory, run| {
                    progress.inc(1);
                    simulate(memory, &setting, options.seed.wrapping_add(u64::from(run)))
                },
            )
            .collect::<Result<_, Failure>>()?;
        let mean = |of: fn(&Learned) -> usize| {
            let all: usize = learned.iter().map(of).sum();
            all as f64 / learned.len().max(1) as f64 / options.lessons.max(1) as f64
        };
        let tests = learned.first().map_or(0, |first| first.right.len());
        for test in 0..tests {
            let after = (test * options.every).min(options.lessons);
            let right: Vec<usize> = learned.iter().filter_map(|robot| robot.right.get(test).copied()).collect();
            let (sum, asked) = (right.iter().sum::<usize>(), right.len() * options.tests);
            let (share, wide) = spread(&right, options.tests);
            let nine_of_ten = right.iter().filter(|&&right| 10 * right >= 9 * options.tests).count();
            if options.json {
                let line = json!({
                    "type": "test", "questions": name, "kappa": asking.kappa.is_finite().then_some(asking.kappa), "lessons": after,
                    "robots": right.len(), "seed": options.seed, "right": sum, "asked": asked, "accuracy": share,
                    "interval": [share - wide, share + wide], "robots_with_nine_of_ten": nine_of_ten,
                });
                writeln!(out, "{line}")?;
            } else {
                let (low, high) = wilson(nine_of_ten, right.len());
                writeln!(
                    out,
                    "{name:9}  {after:7}  {:6.1} % ± {:3.1}  {sum:5} of {asked:5}    {:5.1} %  ({:.0} to {:.0})",
                    100.0 * share,
                    100.0 * wide,
                    100.0 * nine_of_ten as f64 / right.len().max(1) as f64,
                    100.0 * low,
                    100.0 * high
                )?;
            }
        }
        let (steps, words, questions) = (mean(|it| it.steps), mean(|it| it.words), mean(|it| it.questions));
        if options.json {
            let line = json!({"type": "lessons", "questions": name, "steps": steps, "words": words, "questions_asked": questions});
            writeln!(out, "{line}")?;
        } else {
            writeln!(out, "{:9}  a lesson took {steps:.1} steps, {words:.1} words of feedback, {questions:.2} questions", "")?;
        }
    }
    progress.finish_and_clear();
    Ok(out.flush()?)
}

/// The mean share of right answers, and how far its 95 % interval goes to each side. Robots differ, so they are what is counted, not commands.
fn spread(right: &[usize], tests: usize) -> (f64, f64) {
    let count = right.len().max(1) as f64;
    let share = |right: usize| right as f64 / tests.max(1) as f64;
    let mean = right.iter().map(|&right| share(right)).sum::<f64>() / count;
    let variance = right.iter().map(|&right| (share(right) - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
    (mean, 1.96 * (variance / count).sqrt())
}
