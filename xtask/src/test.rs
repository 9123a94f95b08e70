//! `cargo xtask test`: all checks, one after the other.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use clap::Args;

use crate::project;
use crate::steps::{self, Step, Tally};

/// Which checks to run.
#[derive(Args)]
pub struct Options {
    /// Leaves out what takes long: the documentation and the other targets
    #[arg(long)]
    fast: bool,
    /// Runs this step only; can be given more than once
    #[arg(long, value_name = "STEP")]
    only: Vec<String>,
    /// Lists the steps and runs none
    #[arg(long)]
    list: bool,
}

impl Options {
    /// Whether a step is among those named, or none is.
    fn names(&self, step: &Step) -> bool {
        self.only.is_empty() || self.only.iter().any(|name| name == step.name)
    }
}

/// How a step ended.
struct Done {
    step: &'static Step,
    time: Duration,
    passed: bool,
}

/// Runs the steps that were asked for, up to the first that fails.
pub fn run(options: &Options) -> Result<ExitCode> {
    let chosen = chosen(options)?;
    if options.list {
        for step in chosen {
            println!("{:16} {}", step.name, step.about);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let start = Instant::now();
    let mut tally = Tally::default();
    let mut done = Vec::new();
    for step in &chosen {
        println!("\n== {}: {}", step.name, step.about);
        let start = Instant::now();
        let result = (step.run)(&mut tally);
        let time = start.elapsed();
        let passed = result.is_ok();
        done.push(Done { step, time, passed });
        if let Err(error) = result {
            println!("== {} FAILED after {}: {error:#}", step.name, seconds(time));
            break;
        }
        println!("== {} passed in {}", step.name, seconds(time));
    }
    summarise(options, &done, start.elapsed(), tally);
    Ok(match done.iter().find(|done| !done.passed) {
        Some(failed) => {
            println!("\nFAILED at {}. Next: {};", failed.step.name, failed.step.next);
            println!("then `cargo xtask test --only {}`.", failed.step.name);
            ExitCode::FAILURE
        }
        None => ExitCode::SUCCESS,
    })
}

fn chosen(options: &Options) -> Result<Vec<&'static Step>> {
    let is_known = |name: &String| steps::ALL.iter().any(|step| step.name == name);
    if let Some(unknown) = options.only.iter().find(|name| !is_known(name)) {
        let known: Vec<_> = steps::ALL.iter().map(|step| step.name).collect();
        bail!("no step is called `{unknown}`; there are {}", known.join(", "));
    }
    Ok(steps::ALL.iter().filter(|step| options.names(step) && (step.fast || !options.fast)).collect())
}

fn summarise(options: &Options, done: &[Done], time: Duration, tally: Tally) {
    println!("\n== summary, after {}", seconds(time));
    for step in steps::ALL.iter().filter(|step| options.names(step)) {
        let ended = done.iter().find(|done| done.step.name == step.name);
        let state = match ended {
            Some(done) if done.passed => format!("passed {:>9}", seconds(done.time)),
            Some(done) => format!("FAILED {:>9}", seconds(done.time)),
            None if options.fast && !step.fast => "left out".to_owned(),
            None => "not reached".to_owned(),
        };
        println!("{state:16}  {:16} {}", step.name, step.about);
    }
    if tally != Tally::default() {
        if project::external_data().is_none() {
            println!("note: beside the project there is no folder `shared`: tests on its data");
            println!("      said that they skip, and count as passed");
        }
        let Tally { passed, failed, skipped } = tally;
        println!("tests: {passed} passed, {failed} failed, {skipped} skipped");
    }
}

fn seconds(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(fast: bool, only: &[&str]) -> Result<Vec<&'static str>> {
        let only = only.iter().map(|name| (*name).to_owned()).collect();
        let list = false;
        let chosen = chosen(&Options { fast, only, list })?;
        Ok(chosen.iter().map(|step| step.name).collect())
    }

    #[test]
    fn all_steps_run_if_nothing_else_is_said() {
        assert_eq!(names(false, &[]).unwrap().len(), steps::ALL.len());
    }

    #[test]
    fn the_slow_steps_can_be_left_out() {
        let fast = names(true, &[]).unwrap();
        assert!(fast.contains(&"clippy"));
        assert!(!fast.contains(&"docs") && !fast.contains(&"microcontroller"));
    }

    #[test]
    fn one_step_can_be_chosen_if_there_is_such_a_one() {
        assert_eq!(names(false, &["style"]).unwrap(), ["style"]);
        let error = names(false, &["stile"]).unwrap_err().to_string();
        assert!(error.contains("style"), "{error}");
    }
}
