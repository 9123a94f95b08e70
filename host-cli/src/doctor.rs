//! `goodbot doctor`: finds faults of the terminal and of robots that are kept by name, and says how to mend them.

use crate::teach::kept::RobotFiles;
use goodbot::snapshot::Contents;
use goodbot_console::printed::is_terminal;
use goodbot_console::whole_file::is_unfinished;
use goodbot_console::{Failure, counted, input, output, read_model};
use std::fs::File;
use std::io::{BufReader, IsTerminal, Write, stdin};
use std::path::{Path, PathBuf};

/// The smallest screen for `goodbot teach`: columns and rows.
const LEAST_SCREEN: (u16, u16) = (24, 8);

/// The state of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Fine,
    /// Something is missing, and the program works without it.
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
pub fn run() -> Result<(), Failure> {
    let sections = [("This program", vec![program()]), ("The terminal", terminal()), ("Robots that are kept by name", kept())];
    let mut out = output::text(&[])?;
    for (section, findings) in &sections {
        writeln!(out, "{section}")?;
        findings.iter().try_for_each(|Finding { state, text }| writeln!(out, "  {:8} {text}", state.name()))?;
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

/// Checks all robots that are kept.
fn kept() -> Vec<Finding> {
    let folder = match RobotFiles::folder() {
        Ok(folder) => folder,
        Err(failure) => return vec![Finding::new(State::Wrong, failure.to_string())],
    };
    let mut files: Vec<PathBuf> = match std::fs::read_dir(&folder) {
        Ok(entries) => entries.flatten().map(|entry| entry.path()).collect(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(error) => {
            let text = format!("{} cannot be read ({error}); check that you may, or name files with --model", folder.display());
            return vec![Finding::new(State::Wrong, text)];
        }
    };
    files.sort();
    let mut findings: Vec<Finding> =
        files.iter().filter(|file| file.extension().is_some_and(|end| end == "goodbot")).map(|file| robot(file)).collect();
    for file in files.iter().filter(|file| is_unfinished(file)) {
        let text = format!("{}: a program was stopped while it wrote this; it can be removed", file.display());
        findings.push(Finding::new(State::Missing, text));
    }
    if findings.is_empty() {
        findings.push(Finding::new(State::Fine, format!("none yet in {}; goodbot teach makes one", folder.display())));
    }
    findings
}

/// The number of sessions of a model, or its fault.
fn sessions(path: &Path) -> Result<usize, String> {
    let bytes = read_model(path).map_err(|failure| failure.to_string())?;
    let contents =
        Contents::read(&bytes).map_err(|error| format!("{}: {error}; goodbot learn makes a new one from its log", path.display()))?;
    Ok(contents.sessions.len())
}

/// Checks a model and the log beside it.
fn robot(path: &Path) -> Finding {
    let known = match sessions(path) {
        Ok(known) => known,
        Err(message) => return Finding::new(State::Wrong, message),
    };
    let log = path.with_extension("jsonl");
    let Ok(file) = File::open(&log) else {
        return Finding::new(State::Fine, format!("{}: {}, and no log", path.display(), counted(known, "session")));
    };
    let mut taught = 0;
    for session in input::sessions(BufReader::new(file)) {
        match session {
            Ok(session) => taught += usize::from(session.learn),
            Err(_) => {
                let text =
                    format!("{}: is no complete log, so goodbot teach refuses the robot; goodbot check names the faults", log.display());
                return Finding::new(State::Wrong, text);
            }
        }
    }
    if known < taught {
        let text = format!(
            "{}: knows {}, and its log has {taught}: older ones gave way, or a program was stopped; goodbot learn {} --out NEW learns from all",
            path.display(),
            counted(known, "session"),
            log.display()
        );
        return Finding::new(State::Missing, text);
    }
    Finding::new(State::Fine, format!("{}: {}", path.display(), counted(known, "session")))
}
