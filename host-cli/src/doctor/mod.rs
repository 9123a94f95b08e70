//! `goodbot doctor`: finds faults of the terminal, robots, files and programs, and says how to mend them.
//!
//! - [`robots`]: the robots that are kept by name; [`programs`]: the programs that tests use.

mod programs;
mod robots;

use crate::check;
use clap::{Args, ValueHint};
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::messages::counted;
use goodbot_console::outcome::Failure;
use goodbot_console::output;
use goodbot_console::printed::is_terminal;
use serde_json::json;
use std::io::{IsTerminal, Write, stdin};

/// The smallest screen for `goodbot teach`: columns and rows.
const LEAST_SCREEN: (u16, u16) = (24, 8);

/// Find faults of the terminal, your robots, files and programs, and how to mend them
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
It looks at the terminal, at the robots that goodbot teach keeps by name, at the files that are named, and for the programs that \
cargo xtask test uses. It changes nothing.

Exit codes: 0 nothing is wrong, 1 something is; a program that only tests use may be missing.

Example: goodbot doctor home.json words.goodbot")]
pub struct DoctorArgs {
    /// Files to look at too: models, homes, session logs
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<InputFile>,
    /// Print a line of JSON for each finding
    #[arg(long)]
    json: bool,
}

/// The state of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Fine,
    /// Missing, but needed by few.
    Missing,
    Wrong,
}

impl State {
    const fn name(self) -> &'static str {
        match self {
            Self::Fine => "ok",
            Self::Missing => "missing",
            Self::Wrong => "wrong",
        }
    }
}

/// The result of one check.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Finding {
    state: State,
    text: String,
}

impl Finding {
    fn new(state: State, text: impl Into<String>) -> Self {
        Self { state, text: text.into() }
    }
}

/// Runs the command.
///
/// # Errors
/// [`Failure::Result`] if anything is wrong.
pub fn run(args: &DoctorArgs) -> Result<(), Failure> {
    let mut sections =
        vec![("This program", vec![program()]), ("The terminal", terminal()), ("Robots that are kept by name", robots::kept())];
    if !args.files.is_empty() {
        sections.push(("Files", args.files.iter().map(look_at).collect()));
    }
    sections.push(("Programs that only cargo xtask test uses", programs::found()));
    let mut out = output::text(&[])?;
    for (section, findings) in &sections {
        if !args.json {
            writeln!(out, "{section}")?;
        }
        for Finding { state, text } in findings {
            if args.json {
                writeln!(out, "{}", json!({"type": state.name(), "of": section, "text": text}))?;
            } else {
                writeln!(out, "  {:8} {}", state.name(), text)?;
            }
        }
    }
    out.flush()?;
    let wrong = sections.iter().flat_map(|(_, findings)| findings).filter(|finding| finding.state == State::Wrong).count();
    if wrong > 0 { Err(Failure::Result(format!("{} wrong; see above what to do", counted(wrong, "thing")))) } else { Ok(()) }
}

fn program() -> Finding {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (version, system, machine) = (env!("CARGO_PKG_VERSION"), std::env::consts::OS, std::env::consts::ARCH);
    Finding::new(State::Fine, format!("goodbot {version} on {system}, {machine}, {}", counted(cores, "core")))
}

/// Checks whether `goodbot teach` can draw its screen here.
fn terminal() -> Vec<Finding> {
    if !stdin().is_terminal() || !is_terminal() {
        let text = "no terminal here: goodbot teach reads requests line by line (docs/teach.md)";
        return vec![Finding::new(State::Fine, text)];
    }
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let mut findings = Vec::new();
    findings.push(match crossterm::terminal::size() {
        Ok((columns, rows)) if columns < LEAST_SCREEN.0 || rows < LEAST_SCREEN.1 => {
            Finding::new(State::Wrong, format!("{columns} by {rows}: goodbot teach needs 24 columns and 8 rows; make the window larger"))
        }
        Ok((columns, rows)) => Finding::new(State::Fine, format!("{columns} columns, {rows} rows")),
        Err(error) => Finding::new(State::Wrong, format!("its size cannot be told ({error}); use goodbot teach --lines")),
    });
    if variable("TERM") == "dumb" {
        findings.push(Finding::new(State::Fine, "TERM is dumb: goodbot teach reads requests line by line"));
    }
    let language = ["LC_ALL", "LC_CTYPE", "LANG"].map(variable).into_iter().find(|value| !value.is_empty()).unwrap_or_default();
    if cfg!(unix) && !language.to_lowercase().replace('-', "").contains("utf8") {
        let text = format!("the locale {language:?} is not of UTF-8, so bars and arrows may look wrong; set LANG, for example to C.UTF-8");
        findings.push(Finding::new(State::Missing, text));
    }
    findings
}

/// Checks a named file.
fn look_at(file: &InputFile) -> Finding {
    match robots::is_model(file) {
        true => robots::model(file.as_ref()),
        false => match check::summary(file) {
            Ok(what) => Finding::new(State::Fine, format!("{}: {what}", input::name(file))),
            Err(fault) => Finding::new(State::Wrong, fault),
        },
    }
}
