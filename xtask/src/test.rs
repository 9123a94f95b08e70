//! `cargo xtask test`: all checks, one after the other.

use std::fmt;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use clap::Args;

use crate::programs::Missing;
use crate::steps::{self, Run, Step, Tally};

/// Which checks to run.
#[derive(Args)]
pub struct Options {
    /// Leaves out what takes long: the documentation, the page, the other targets, and the longest tests
    #[arg(long)]
    fast: bool,
    /// Runs this step only; can be given more than once
    #[arg(long, value_name = "STEP")]
    only: Vec<String>,
    /// Succeeds although a step was left out, because this machine has no program for it and none can be had
    #[arg(long)]
    allow_missing: bool,
    /// Lists the steps and runs none
    #[arg(long)]
    list: bool,
}

/// How a step ended.
#[derive(Clone, Debug, PartialEq, Eq)]
enum End {
    Passed(Duration),
    Failed(Duration),
    LeftOut(String),
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Passed(time) => write!(f, "passed {:>7.1} s", time.as_secs_f64()),
            Self::Failed(time) => write!(f, "FAILED {:>7.1} s", time.as_secs_f64()),
            Self::LeftOut(_) => f.write_str("LEFT OUT"),
        }
    }
}

/// Runs the steps that were asked for, up to the first that fails. One that cannot be done here is left out.
pub fn run(options: &Options) -> Result<ExitCode> {
    let mut run = Run { fast: options.fast, chosen: chosen(options)?, tally: Tally::default() };
    if options.list {
        for step in run.chosen {
            println!("{:16} {}", step.name, step.about);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let start = Instant::now();
    let mut ends = Vec::new();
    for step in run.chosen.clone() {
        println!("\n== {}: {}", step.name, step.about);
        let start = Instant::now();
        let end = match (step.run)(&mut run) {
            Ok(()) => End::Passed(start.elapsed()),
            Err(error) => match error.downcast::<Missing>() {
                Ok(Missing(what)) => End::LeftOut(what),
                Err(error) => {
                    println!("{error:#}");
                    End::Failed(start.elapsed())
                }
            },
        };
        println!("== {}: {end}", step.name);
        let failed = matches!(end, End::Failed(_));
        ends.push((step, end));
        if failed {
            break;
        }
    }
    summarise(&run.chosen, &ends, start.elapsed());
    let code = verdict(&ends, options.allow_missing);
    // Whoever counts tests reads the last line.
    if run.tally != Tally::default() {
        let Tally { passed, failed, skipped } = run.tally;
        println!("tests: {passed} passed, {failed} failed, {skipped} skipped");
    }
    Ok(code)
}

fn chosen(options: &Options) -> Result<Vec<&'static Step>> {
    let is_known = |name: &String| steps::ALL.iter().any(|step| step.name == name);
    if let Some(unknown) = options.only.iter().find(|name| !is_known(name)) {
        let known: Vec<_> = steps::ALL.iter().map(|step| step.name).collect();
        bail!("no step is called `{unknown}`; there are {}", known.join(", "));
    }
    let is_named = |step: &Step| options.only.is_empty() || options.only.iter().any(|name| name == step.name);
    Ok(steps::ALL.iter().filter(|step| is_named(step) && (step.fast || !options.fast)).collect())
}

fn summarise(chosen: &[&Step], ends: &[(&Step, End)], time: Duration) {
    println!("\n== summary, after {:.1} s", time.as_secs_f64());
    for step in chosen {
        let end = ends.iter().find(|(of, _)| of.name == step.name).map(|(_, end)| end);
        println!("{:17} {:12} {}", end.map_or("not reached".to_owned(), End::to_string), step.name, step.about);
    }
}

/// Says what to do next, and whether the whole run has failed: not by what was left out, where that is allowed.
fn verdict(ends: &[(&Step, End)], allow_missing: bool) -> ExitCode {
    let left_out: Vec<_> =
        ends.iter().filter_map(|(step, end)| if let End::LeftOut(why) = end { Some((step, why)) } else { None }).collect();
    if !left_out.is_empty() {
        println!("\n{} of {} steps were left out:", left_out.len(), ends.len());
        for (step, why) in &left_out {
            println!("  {:12} {}", step.name, why.lines().next().unwrap_or_default());
        }
    }
    if let Some((step, _)) = ends.iter().find(|(_, end)| matches!(end, End::Failed(_))) {
        println!("\nFAILED at {}. Next: {};\nthen `cargo xtask test --only {}`.", step.name, step.next, step.name);
        return ExitCode::FAILURE;
    }
    if !left_out.is_empty() && !allow_missing {
        println!("This is no success: install what is named, or say `--allow-missing`.");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(fast: bool, only: &[&str]) -> Result<Vec<&'static str>> {
        let only = only.iter().map(|name| (*name).to_owned()).collect();
        let chosen = chosen(&Options { fast, only, allow_missing: false, list: false })?;
        Ok(chosen.iter().map(|step| step.name).collect())
    }

    #[test]
    fn steps_are_chosen_by_speed_and_by_name() {
        assert_eq!(names(false, &[]).unwrap().len(), steps::ALL.len());
        let fast = names(true, &[]).unwrap();
        assert!(fast.contains(&"clippy") && !fast.contains(&"docs"));
        assert_eq!(names(false, &["style"]).unwrap(), ["style"]);
        assert!(names(false, &["stile"]).unwrap_err().to_string().contains("style"));
    }

    #[test]
    fn what_is_left_out_is_no_success_unless_that_is_allowed() {
        let (passed, left_out) = (End::Passed(Duration::ZERO), End::LeftOut("no browser".to_owned()));
        let ends = |end: &End| [(&steps::ALL[0], passed.clone()), (&steps::ALL[1], end.clone())];
        assert_eq!(verdict(&ends(&passed), false), ExitCode::SUCCESS);
        assert_eq!(verdict(&ends(&left_out), false), ExitCode::FAILURE);
        assert_eq!(verdict(&ends(&left_out), true), ExitCode::SUCCESS);
        assert_eq!(verdict(&ends(&End::Failed(Duration::ZERO)), true), ExitCode::FAILURE);
    }
}
