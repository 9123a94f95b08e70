//! `cargo xtask test`: all checks, one after another; those for other machines and for Python run in parallel with those of this one.

mod parallel;
pub mod step;
mod work;

use crate::process::described;
use crate::programs::Missing;
use crate::{capi, footprint, guide};
use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use parallel::ParallelSteps;
use std::path::PathBuf;
use std::time::Instant;
use step::{End, Outcome, Run, Step, Tally};

impl Step {
    /// The function of the step, and the advice for its failure. An error is the step's failure, or a [`Missing`] if it cannot be run here.
    fn work(self) -> (fn(&mut Run) -> Result<()>, &'static str) {
        match self {
            Self::Format => (|_| work::format(), "run `cargo fmt --all`"),
            Self::Style => (|_| work::style(), "mend the listed lines"),
            Self::Workflows => (|_| work::workflows(), "mend the lines of .github/workflows that are named"),
            Self::Trust => (
                |_| work::trust(),
                "deny.toml says what is allowed, docs/appendix/dependencies.md why; `cargo xtask api` writes the interface again",
            ),
            Self::Clippy => {
                (|_| work::clippy(), "mend the code that clippy names; where clippy is wrong, write `#[expect(…, reason = \"…\")]`")
            }
            Self::Tests => (work::tests, "run the failed test alone: `cargo test --workspace`, and the test's name after it"),
            Self::Docs => (|_| work::docs(), "mend the doc comments that rustdoc points at"),
            Self::Module => {
                (|_| crate::page::prepare(), "`cargo xtask page` makes the page; its module is in wasm, its builder in page/builder")
            }
            Self::Portable => (
                |run| work::portable(run),
                "`cargo check -p goodbot --no-default-features --features …` shows it; mark code for Unix alone with `#[cfg(unix)]`",
            ),
            Self::Python => (work::python, "the tests are in python/tests; `maturin develop` in python/ builds what `pytest` there tries"),
            Self::Page => (work::page, "see the test that failed in page/tests; the page is dist/goodbot.html"),
            Self::CHost => (|_| capi::on_host(), "the examples are in capi/examples; the sanitizer says where"),
            Self::CBoard => {
                (|run| capi::on_board(run.all_boards), "the examples are in capi/examples, what the board needs in capi/examples/board")
            }
            Self::Guide => (|_| guide::follow(), "mend docs/robot.md, or the code that it describes"),
            Self::Firmware => {
                (|run| work::course(run), "`cargo xtask footprint` shows what each binary costs; the firmware is in firmware/")
            }
            Self::Tick => (|run| work::tick(run), "`cargo xtask footprint` shows what each call costs; the firmware is in firmware/"),
            Self::Microbit => {
                (work::microbit, "the tests are in tests/tests/microbit, the firmware in firmware/microbit and firmware/embassy")
            }
            Self::SameBits => {
                (|run| work::same_bits(run), "look for code that is more than + - * / on f32, or depends on the width of usize")
            }
            Self::NoPanic => {
                (|run| work::no_panic(run), "`arm-none-eabi-objdump -dC` on the binary shows who calls the symbols that are listed")
            }
            Self::Footprint => {
                (|run| footprint::check(run.all_boards), "make it cheaper, or renew the tables on purpose: `cargo xtask footprint`")
            }
        }
    }
}

/// The checks to run.
#[derive(Args)]
pub struct Options {
    /// Leaves out what takes long: the documentation, the page, the other targets, and the longest tests
    #[arg(long)]
    fast: bool,
    /// Runs this step only; can be given more than once
    #[arg(long, value_name = "STEP")]
    only: Vec<Step>,
    /// Also runs what is much like the rest: three more emulated boards, the Raspberry Pi Pico, the ESP32-C3, embassy, and small C libraries
    #[arg(long)]
    all_boards: bool,
    /// Succeeds although a step was left out, because this machine has no program for it and none can be had
    #[arg(long)]
    allow_missing: bool,
    /// Writes the steps' outcomes into this file, and gives no verdict
    #[arg(long, value_name = "FILE", hide = true)]
    report: Option<PathBuf>,
}

fn shown((_, time, outcome): &End) -> String {
    let word = match outcome {
        Outcome::Passed => "passed",
        Outcome::Failed => "FAILED",
        Outcome::LeftOut(_) => "LEFT OUT",
    };
    format!("{word:8} {:>7.1} s", time.as_secs_f64())
}

/// Runs the chosen steps, up to the first that fails. One that cannot be run here is left out.
pub fn run(options: &Options) -> Result<()> {
    let chosen = chosen(options);
    ensure!(!chosen.is_empty(), "no step was chosen: --fast leaves out those that --only names");
    let start = Instant::now();
    let is_alone = std::thread::available_parallelism().map_or(1, std::num::NonZero::get) == 1;
    let mut lanes: [Vec<Step>; 3] = Default::default();
    for &step in &chosen {
        lanes[if is_alone { 0 } else { step.lane() }].push(step);
    }
    let lanes: Vec<_> = lanes.into_iter().filter(|steps| !steps.is_empty()).collect();
    let [here, there @ ..] = lanes.as_slice() else { return Ok(()) };
    let start_lane = |(lane, steps): (usize, &Vec<Step>)| ParallelSteps::start(lane, steps, options.all_boards);
    let mut parallel = there.iter().enumerate().map(start_lane).collect::<Result<Vec<_>>>()?;

    let mut run = Run { fast: options.fast, all_boards: options.all_boards, chosen: here.clone(), tally: Tally::default() };
    let mut ends: Vec<End> = Vec::new();
    let has_failed = |ends: &[End]| ends.iter().any(|(_, _, outcome)| *outcome == Outcome::Failed);
    for &step in here {
        ends.push(work(step, &mut run));
        if let Some(report) = &options.report {
            parallel::report(report, &ends, run.tally)?;
        }
        if has_failed(&ends) || parallel.iter_mut().any(ParallelSteps::has_failed) {
            break;
        }
    }
    if options.report.is_some() {
        return Ok(());
    }
    let is_over = has_failed(&ends) || parallel.iter_mut().any(ParallelSteps::has_failed);
    for parallel in parallel {
        let (more, tally) = parallel.end(is_over)?;
        ends.extend(more);
        run.tally.add(tally);
    }

    println!("\n== summary, after {:.1} s", start.elapsed().as_secs_f64());
    for step in chosen {
        let (name, about) = described(step);
        let end = ends.iter().find(|(ended, ..)| *ended == step);
        println!("{:18}  {name:12} {about}", end.map_or("not reached".to_owned(), shown));
    }
    let is_success = verdict(&ends, options.allow_missing);
    // Programs that count tests read the last line.
    if run.tally != Tally::default() {
        let Tally { passed, failed, skipped } = run.tally;
        println!("tests: {passed} passed, {failed} failed, {skipped} skipped");
    }
    std::process::exit(i32::from(!is_success));
}

fn work(step: Step, run: &mut Run) -> End {
    let ((name, about), start) = (described(step), Instant::now());
    println!("\n== {name}: {about}");
    let outcome = match (step.work().0)(run).map_err(anyhow::Error::downcast::<Missing>) {
        Ok(()) => Outcome::Passed,
        Err(Ok(Missing(what))) => Outcome::LeftOut(what.lines().next().unwrap_or_default().to_owned()),
        Err(Err(error)) => {
            println!("{error:#}");
            Outcome::Failed
        }
    };
    let end = (step, start.elapsed(), outcome);
    println!("== {name}: {}", shown(&end));
    end
}

fn chosen(options: &Options) -> Vec<Step> {
    let is_named = |step: &Step| options.only.is_empty() || options.only.contains(step);
    Step::value_variants().iter().copied().filter(|step| is_named(step) && (step.is_fast() || !options.fast)).collect()
}

/// Prints what to do next. Returns whether the whole run is a success; steps that were left out may be allowed.
fn verdict(ends: &[End], allow_missing: bool) -> bool {
    let (mut left_out, mut failed) = (0, false);
    for (step, _, outcome) in ends {
        let name = step.name();
        match outcome {
            Outcome::Passed => {}
            Outcome::Failed => {
                println!("\nFAILED at {name}. Next: {};\nthen `cargo xtask test --only {name}`.", step.work().1);
                failed = true;
            }
            Outcome::LeftOut(what) => {
                println!("left out: {name:12} {what}");
                left_out += 1;
            }
        }
    }
    let is_incomplete = left_out > 0 && !allow_missing;
    if is_incomplete && !failed {
        println!("{left_out} of {} steps were left out. This is no success: install what is named, or say `--allow-missing`.", ends.len());
    }
    !failed && !is_incomplete
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn steps_are_chosen_by_speed_and_by_name() {
        let chosen =
            |fast, only: &[Step]| chosen(&Options { fast, only: only.to_vec(), all_boards: false, allow_missing: false, report: None });
        assert_eq!(chosen(false, &[]), Step::value_variants());
        let fast = chosen(true, &[]);
        assert!(fast.contains(&Step::Clippy) && !fast.contains(&Step::Docs));
        assert_eq!(chosen(false, &[Step::Style]), [Step::Style]);
    }

    #[test]
    fn what_is_left_out_is_no_success_unless_that_is_allowed() {
        let verdict = |outcome, allow_missing| {
            verdict(&[(Step::Format, Duration::ZERO, Outcome::Passed), (Step::Page, Duration::ZERO, outcome)], allow_missing)
        };
        let left_out = || Outcome::LeftOut("no browser".to_owned());
        assert!(verdict(Outcome::Passed, false));
        assert!(!verdict(left_out(), false));
        assert!(verdict(left_out(), true));
        assert!(!verdict(Outcome::Failed, true));
    }
}
