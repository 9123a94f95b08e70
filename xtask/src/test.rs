//! `cargo xtask test`: all checks, one after the other.

use std::io::{BufRead, BufReader};
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use xshell::Cmd;

use crate::programs::Missing;
use crate::{capi, footprint, guide, steps};

/// One thing that is checked, in the order they run: what fails soonest comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Step {
    /// files are as rustfmt writes them
    Format,
    /// no file names a place on one machine, or a package's server
    Style,
    /// clippy has nothing to say
    Clippy,
    /// the tests of all crates
    Tests,
    /// the documentation is built without a warning
    Docs,
    /// the Python package's tests, types and stubs, of a wheel in an environment of its own
    Python,
    /// the trainer page works in a browser, from a file
    Page,
    /// the C header is what the C interface says
    CHeader,
    /// the C examples run under AddressSanitizer and UBSan
    CHost,
    /// the C examples run on an emulated Cortex-M4F, and have nothing in them that panics
    CBoard,
    /// the programs of docs/robot.md are built in an empty folder and say what it promises
    Guide,
    /// the paper's course passes on emulated Cortex-M4F, M3 and M0, in its bounds
    Firmware,
    /// a control loop with a fixed tick misses none while the robot learns
    Tick,
    /// the micro:bit's file learns by serial line and buttons on an emulated board, and outlives a torn store; so among embassy's tasks
    Microbit,
    /// this machine, WebAssembly and every board come to the same posteriors, bit for bit
    SameBits,
    /// the linked firmware has nothing in it that panics
    NoPanic,
    /// nothing costs more than docs/footprint.md says
    Footprint,
}

impl Step {
    fn name(self) -> String {
        self.to_possible_value().map(|step| step.get_name().to_owned()).unwrap_or_default()
    }

    fn about(self) -> String {
        self.to_possible_value().and_then(|step| step.get_help().map(ToString::to_string)).unwrap_or_default()
    }

    /// Whether it is quick enough for `--fast`.
    const fn is_fast(self) -> bool {
        matches!(self, Self::Format | Self::Style | Self::Clippy | Self::Tests)
    }

    /// Does it; an error is the step's failure, or says by a [`Missing`] that it cannot be done here.
    fn run(self, run: &mut Run) -> Result<()> {
        match self {
            Self::Format => steps::format(),
            Self::Style => steps::style(),
            Self::Clippy => steps::clippy(),
            Self::Tests => steps::tests(run),
            Self::Docs => steps::docs(),
            Self::Python => steps::python(run),
            Self::Page => steps::page(run),
            Self::CHeader => capi::header(true),
            Self::CHost => capi::on_host(),
            Self::CBoard => capi::on_board(),
            Self::Guide => guide::follow(),
            Self::Firmware => steps::course(),
            Self::Tick => steps::tick(),
            Self::Microbit => steps::microbit(run),
            Self::SameBits => steps::same_bits(),
            Self::NoPanic => steps::no_panic(),
            Self::Footprint => footprint::check(),
        }
    }

    /// What to do when it has failed.
    const fn next(self) -> &'static str {
        match self {
            Self::Format => "run `cargo fmt --all`",
            Self::Style => "mend the lines that are listed",
            Self::Clippy => "mend what clippy points at; an `#[expect(…, reason = \"…\")]` is for where it is wrong",
            Self::Tests => "run the failed test alone: `cargo test --workspace`, and the test's name after it",
            Self::Docs => "mend the doc comments that rustdoc points at",
            Self::Python => "the tests are in python/tests; `maturin develop` in python/ builds what `pytest` there tries",
            Self::Page => "see the test that failed in page/tests; the page is dist/goodbot.html",
            Self::CHeader => "where a program that was compiled before would go wrong, raise GOODBOT_API_VERSION",
            Self::CHost => "the examples are in capi/examples; the sanitizer says where",
            Self::CBoard => "the examples are in capi/examples, what the board needs in capi/examples/board",
            Self::Guide => "mend docs/robot.md, or what it speaks of",
            Self::Firmware | Self::Tick => "`cargo xtask footprint` shows what each binary costs; the firmware is in firmware/",
            Self::Microbit => "the tests are in tests/tests/microbit, the firmware in firmware/microbit and firmware/embassy",
            Self::SameBits => "look for what is not + - * / on f32, or depends on the width of usize",
            Self::NoPanic => "`arm-none-eabi-objdump -dC` on the binary shows who calls the symbols that are listed",
            Self::Footprint => "make it cheaper, or renew the table on purpose: `cargo xtask footprint`",
        }
    }
}

/// Which checks to run.
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
    /// Lists the steps and runs none
    #[arg(long)]
    list: bool,
}

/// The steps that were chosen, and how many tests they have counted so far.
#[derive(Default)]
pub struct Run {
    /// Whether to leave out what takes long.
    pub fast: bool,
    pub chosen: Vec<Step>,
    pub tally: Tally,
}

/// How a step ended.
#[derive(Clone, Debug, PartialEq, Eq)]
enum End {
    Passed(Duration),
    Failed(Duration),
    LeftOut(String),
    NotReached,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Passed(time) => write!(f, "passed {:>7.1} s", time.as_secs_f64()),
            Self::Failed(time) => write!(f, "FAILED {:>7.1} s", time.as_secs_f64()),
            Self::LeftOut(_) => f.write_str("LEFT OUT"),
            Self::NotReached => f.write_str("not reached"),
        }
    }
}

/// Runs the steps that were asked for, up to the first that fails. One that cannot be done here is left out.
pub fn run(options: &Options) -> Result<()> {
    let mut run = Run { fast: options.fast, chosen: chosen(options), tally: Tally::default() };
    if options.list {
        run.chosen.iter().for_each(|step| println!("{:16} {}", step.name(), step.about()));
        return Ok(());
    }
    let start = Instant::now();
    let mut ends = Vec::new();
    for step in run.chosen.clone() {
        if matches!(ends.last(), Some((_, End::Failed(_) | End::NotReached))) {
            ends.push((step, End::NotReached));
            continue;
        }
        println!("\n== {}: {}", step.name(), step.about());
        let start = Instant::now();
        let end = match step.run(&mut run).map_err(|error| error.downcast::<Missing>()) {
            Ok(()) => End::Passed(start.elapsed()),
            Err(Ok(Missing(what))) => End::LeftOut(what),
            Err(Err(error)) => {
                println!("{error:#}");
                End::Failed(start.elapsed())
            }
        };
        println!("== {}: {end}", step.name());
        ends.push((step, end));
    }
    println!("\n== summary, after {:.1} s", start.elapsed().as_secs_f64());
    ends.iter().for_each(|(step, end)| println!("{:17} {:12} {}", end.to_string(), step.name(), step.about()));
    let is_success = verdict(&ends, options.allow_missing);
    // Whoever counts tests reads the last line.
    if run.tally != Tally::default() {
        let Tally { passed, failed, skipped } = run.tally;
        println!("tests: {passed} passed, {failed} failed, {skipped} skipped");
    }
    std::process::exit(i32::from(!is_success));
}

fn chosen(options: &Options) -> Vec<Step> {
    let is_named = |step: &Step| options.only.is_empty() || options.only.contains(step);
    Step::value_variants().iter().copied().filter(|step| is_named(step) && (step.is_fast() || !options.fast)).collect()
}

/// Says what to do next, and whether the whole run is a success: also with what was left out, where that is allowed.
fn verdict(ends: &[(Step, End)], allow_missing: bool) -> bool {
    let left_out = ends.iter().filter_map(|(step, end)| if let End::LeftOut(why) = end { Some((step.name(), why)) } else { None });
    let left_out: Vec<_> = left_out.map(|(name, why)| format!("  {name:12} {}", why.lines().next().unwrap_or_default())).collect();
    if !left_out.is_empty() {
        println!("\n{} of {} steps were left out:\n{}", left_out.len(), ends.len(), left_out.join("\n"));
    }
    let failed = ends.iter().find(|(_, end)| matches!(end, End::Failed(_)));
    if let Some((step, _)) = failed {
        println!("\nFAILED at {0}. Next: {1};\nthen `cargo xtask test --only {0}`.", step.name(), step.next());
    } else if !left_out.is_empty() && !allow_missing {
        println!("This is no success: install what is named, or say `--allow-missing`.");
    }
    failed.is_none() && (left_out.is_empty() || allow_missing)
}

/// How many tests ran, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub passed: u64,
    failed: u64,
    skipped: u64,
}

impl Tally {
    /// Adds what a line says, if it is one that sums up: of cargo's, of nextest's, of node's or of pytest's.
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
            // Node says the number after its name, the others before it.
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
    /// Runs a program, shows its output, and counts the tests that it says it ran.
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
        let chosen = |fast, only: &[Step]| chosen(&Options { fast, only: only.to_vec(), allow_missing: false, list: false });
        assert_eq!(chosen(false, &[]), Step::value_variants());
        let fast = chosen(true, &[]);
        assert!(fast.contains(&Step::Clippy) && !fast.contains(&Step::Docs));
        assert_eq!(chosen(false, &[Step::Style]), [Step::Style]);
    }

    #[test]
    fn what_is_left_out_is_no_success_unless_that_is_allowed() {
        let (passed, left_out) = (End::Passed(Duration::ZERO), End::LeftOut("no browser".to_owned()));
        let verdict = |end: &End, allow_missing| verdict(&[(Step::Format, passed.clone()), (Step::Page, end.clone())], allow_missing);
        assert!(verdict(&passed, false));
        assert!(!verdict(&left_out, false));
        assert!(verdict(&left_out, true));
        assert!(!verdict(&End::Failed(Duration::ZERO), true));
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
