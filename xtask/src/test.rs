//! `cargo xtask test`: all checks, one after another; those for other machines run in parallel with those of this one.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use xshell::Cmd;

use crate::parallel::ParallelSteps;
use crate::programs::Missing;
use crate::{capi, footprint, guide, release, steps};

/// One check. They run in this order: those that fail soonest come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Step {
    /// files are as rustfmt writes them
    Format,
    /// no file names a place on one machine, or a package's server
    Style,
    /// actionlint finds no fault in the workflows of GitHub Actions
    Workflows,
    /// clippy finds no fault
    Clippy,
    /// the tests of all crates
    Tests,
    /// locked crates, licences, sources and the public interface are as written down, where cargo-deny and cargo-public-api are installed
    Trust,
    /// the documentation is built without a warning
    Docs,
    /// the command line compiles for Windows, and a robot on pins for Cortex-M4F
    Portable,
    /// the Python package's tests, types and stubs, of a wheel in an environment of its own
    Python,
    /// the trainer page works in a browser, from a file
    Page,
    /// the C examples run under AddressSanitizer and UBSan
    CHost,
    /// the C examples run on an emulated Cortex-M4F and contain no panic
    CBoard,
    /// CMake, pkg-config, PlatformIO and Arduino find the C library in its packages, and C++ takes it
    Packages,
    /// the programs of docs/robot.md, built in an empty folder, print what it promises
    Guide,
    /// the paper's course passes on six emulated boards, Cortex-M0 to M33 and RISC-V, in its bounds
    Firmware,
    /// a control loop with a fixed tick misses none while the robot learns
    Tick,
    /// the micro:bit's file learns by serial line and buttons on emulated boards, and outlives a torn store; so among embassy's tasks
    Microbit,
    /// this machine, WebAssembly, every board and the Raspberry Pi Pico's file come to the same posteriors, bit for bit
    SameBits,
    /// the linked firmware contains no panic
    NoPanic,
    /// nothing costs more than docs/footprint.md says
    Footprint,
}

impl Step {
    /// Whether it builds for other machines, or the library for other programs. It runs in parallel with the other steps, because most of
    /// the time it uses only one processor, to link one program.
    const fn is_parallel(self) -> bool {
        use Step::{CBoard, CHost, Firmware, Footprint, Guide, Microbit, NoPanic, Packages, Portable, SameBits, Tick};
        matches!(self, Portable | CHost | CBoard | Packages | Guide | Firmware | Tick | Microbit | SameBits | NoPanic | Footprint)
    }

    /// Its name.
    pub fn name(self) -> String {
        self.described().0
    }

    /// Its name, and a description of its check.
    fn described(self) -> (String, String) {
        let value = self.to_possible_value();
        let (name, about) = value.map(|value| (value.get_name().to_owned(), value.get_help().map(ToString::to_string))).unzip();
        (name.unwrap_or_default(), about.flatten().unwrap_or_default())
    }

    /// Whether it is quick enough for `--fast`.
    const fn is_fast(self) -> bool {
        matches!(self, Self::Format | Self::Style | Self::Workflows | Self::Clippy | Self::Tests)
    }

    /// The function of the step, and the advice for its failure. An error is the step's failure, or a [`Missing`] if it cannot be run here.
    fn work(self) -> (fn(&mut Run) -> Result<()>, &'static str) {
        match self {
            Self::Format => (|_| steps::format(), "run `cargo fmt --all`"),
            Self::Style => (|_| steps::style(), "mend the listed lines"),
            Self::Workflows => (|_| steps::workflows(), "mend the lines of .github/workflows that are named"),
            Self::Trust => (
                |_| steps::trust(),
                "deny.toml says what is allowed, docs/dependencies.md why; `cargo xtask api` writes the interface again",
            ),
            Self::Clippy => {
                (|_| steps::clippy(), "mend the code that clippy names; where clippy is wrong, write `#[expect(…, reason = \"…\")]`")
            }
            Self::Tests => (steps::tests, "run the failed test alone: `cargo test --workspace`, and the test's name after it"),
            Self::Docs => (|_| steps::docs(), "mend the doc comments that rustdoc points at"),
            Self::Portable => (|_| steps::portable(), "mark code for Unix alone with `#[cfg(unix)]`"),
            Self::Python => (steps::python, "the tests are in python/tests; `maturin develop` in python/ builds what `pytest` there tries"),
            Self::Page => (steps::page, "see the test that failed in page/tests; the page is dist/goodbot.html"),
            Self::CHost => (|_| capi::on_host(), "the examples are in capi/examples; the sanitizer says where"),
            Self::CBoard => (|_| capi::on_board(), "the examples are in capi/examples, what the board needs in capi/examples/board"),
            Self::Packages => (
                |_| release::check(),
                "the packages are made by xtask/src/release, from capi/packages; their users are in capi/tests/packages",
            ),
            Self::Guide => (|_| guide::follow(), "mend docs/robot.md, or the code that it describes"),
            Self::Firmware => (|_| steps::course(), "`cargo xtask footprint` shows what each binary costs; the firmware is in firmware/"),
            Self::Tick => (|_| steps::tick(), "`cargo xtask footprint` shows what each call costs; the firmware is in firmware/"),
            Self::Microbit => {
                (steps::microbit, "the tests are in tests/tests/microbit, the firmware in firmware/microbit and firmware/embassy")
            }
            Self::SameBits => (|_| steps::same_bits(), "look for code that is more than + - * / on f32, or depends on the width of usize"),
            Self::NoPanic => {
                (|_| steps::no_panic(), "`arm-none-eabi-objdump -dC` on the binary shows who calls the symbols that are listed")
            }
            Self::Footprint => (|_| footprint::check(), "make it cheaper, or renew the tables on purpose: `cargo xtask footprint`"),
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
    /// Succeeds although a step was left out, because this machine has no program for it and none can be had
    #[arg(long)]
    allow_missing: bool,
    /// Writes the steps' outcomes into this file, and gives no verdict
    #[arg(long, value_name = "FILE", hide = true)]
    report: Option<PathBuf>,
}

/// The chosen steps, and the tests that they have counted so far.
#[derive(Default)]
pub struct Run {
    /// Whether to leave out the longest tests.
    pub fast: bool,
    pub chosen: Vec<Step>,
    pub tally: Tally,
}

/// The outcome of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    Passed,
    Failed,
    /// It cannot be run here, for this reason.
    LeftOut(String),
}

/// A step that was run, the time that it took, and its outcome.
pub type End = (Step, Duration, Outcome);

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
    let (there, here): (Vec<_>, Vec<_>) = chosen.iter().partition(|step| step.is_parallel());
    let has_both =
        !there.is_empty() && !here.is_empty() && std::thread::available_parallelism().is_ok_and(|processors| processors.get() > 1);
    let (mut parallel, here) = if has_both { (Some(ParallelSteps::start(&there)?), here) } else { (None, chosen.clone()) };

    let mut run = Run { fast: options.fast, chosen: here.clone(), tally: Tally::default() };
    let mut ends: Vec<End> = Vec::new();
    let has_failed = |ends: &[End]| ends.iter().any(|(_, _, outcome)| *outcome == Outcome::Failed);
    for step in here {
        ends.push(work(step, &mut run));
        if let Some(report) = &options.report {
            crate::parallel::report(report, &ends, run.tally)?;
        }
        if has_failed(&ends) || parallel.as_mut().is_some_and(ParallelSteps::has_failed) {
            break;
        }
    }
    if options.report.is_some() {
        return Ok(());
    }
    if let Some(parallel) = parallel {
        let (more, tally) = parallel.end(has_failed(&ends))?;
        ends.extend(more);
        run.tally.add(tally);
    }

    println!("\n== summary, after {:.1} s", start.elapsed().as_secs_f64());
    for step in chosen {
        let (name, about) = step.described();
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
    let ((name, about), start) = (step.described(), Instant::now());
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

/// The number of tests, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub passed: u64,
    pub failed: u64,
    pub skipped: u64,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }

    /// Adds the numbers of a summary line of cargo, nextest, node or pytest. Other lines add nothing.
    fn read(&mut self, line: &str) {
        let words: Vec<&str> = line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let is_number = |word: &&str| word.bytes().all(|c| c.is_ascii_digit());
        let of_cargo = line.starts_with("test result: ") || line.trim_start().starts_with("Summary [");
        let of_pytest = line.ends_with('s') && words.contains(&"in") && words.first().is_some_and(is_number);
        let of_node = line.starts_with(['ℹ', '#']) && words.len() == 2;
        if !of_cargo && !of_pytest && !of_node {
            return;
        }
        for pair in words.windows(2) {
            // Node prints the number after its name, the others before it.
            let (name, number) = if of_node { (pair[0], pair[1]) } else { (pair[1], pair[0]) };
            let number = number.parse().unwrap_or(0);
            match name {
                "passed" | "pass" => self.passed += number,
                "failed" | "fail" | "timed" | "error" | "errors" | "cancelled" => self.failed += number,
                "skipped" | "skip" | "ignored" | "todo" => self.skipped += number,
                _ => {}
            }
        }
    }
}

impl Run {
    /// Runs a program, shows its output, and adds up its test summaries.
    pub fn count(&mut self, command: Cmd) -> Result<()> {
        let shown = command.to_string();
        println!("$ {shown}");
        let (reader, writer) = std::io::pipe()?;
        let child = Command::from(command).stdout(writer.try_clone()?).stderr(writer).spawn();
        let mut child = child.with_context(|| format!("`{shown}` could not be started"))?;
        for line in BufReader::new(reader).split(b'\n') {
            let line = line?;
            let line = String::from_utf8_lossy(&line);
            println!("{line}");
            self.tally.read(&line);
        }
        let status = child.wait()?;
        ensure!(status.success(), "`{shown}` failed ({status})");
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_chosen_by_speed_and_by_name() {
        let chosen = |fast, only: &[Step]| chosen(&Options { fast, only: only.to_vec(), allow_missing: false, report: None });
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

    #[test]
    fn results_of_tests_are_added_up() {
        let lines = [
            "running 4 tests",
            "    test result: FAILED. 0 passed; 1 failed; as nextest shows it once more",
            "test result: ok. 4 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out",
            "test result: FAILED. 2 passed; 3 failed; 0 ignored; finished in 0.00s",
            "     Summary [   1.234s] 12 tests run: 10 passed (1 slow), 1 failed, 1 timed out, 5 skipped",
            "ℹ tests 7",
            "ℹ pass 6",
            "ℹ fail 0",
            "ℹ skipped 1",
            "1 failed, 4 passed, 2 skipped in 3.21s",
            "3 passed the bread in time",
        ];
        let mut tally = Tally::default();
        lines.into_iter().for_each(|line| tally.read(line));
        assert_eq!(tally, Tally { passed: 26, failed: 6, skipped: 9 });
    }
}
