//! `goodbot doctor`: finds faults of the terminal, of robots that are kept by name, of files, and of the programs that tests use; and says how
//! to mend them.

use crate::check;
use crate::teach::kept::RobotFiles;
use clap::{Args, ValueHint};
use goodbot::snapshot::Contents;
use goodbot_console::load::input::Content;
use goodbot_console::printed::is_terminal;
use goodbot_console::whole_file::is_unfinished;
use goodbot_console::{Failure, InputFile, counted, input, output, read_model};
use serde_json::json;
use std::fs::File;
use std::io::{BufReader, IsTerminal, Read, Write, stdin};
use std::path::{Path, PathBuf};

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
    let mut sections = vec![("This program", vec![program()]), ("The terminal", terminal()), ("Robots that are kept by name", kept())];
    if !args.files.is_empty() {
        sections.push(("Files", args.files.iter().map(look_at).collect()));
    }
    sections.push(("Programs that only cargo xtask test uses", found()));
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
    match is_model(file) {
        true => model(file.as_ref()),
        false => match check::summary(file) {
            Ok(what) => Finding::new(State::Fine, format!("{}: {what}", input::name(file))),
            Err(fault) => Finding::new(State::Wrong, fault),
        },
    }
}

/// Each program, and its use.
const PROGRAMS: [(&str, &str); 12] = [
    ("git", "style checks"),
    ("gcc", "the C interface"),
    ("g++", "the C interface from C++"),
    ("node", "the page"),
    ("npm", "the page"),
    ("python3", "the package for Python"),
    ("qemu-system-arm", "the firmware"),
    ("qemu-system-riscv32", "the firmware on RISC-V"),
    ("arm-none-eabi-gcc", "C on controllers"),
    ("clang", "the C header's layout"),
    ("chromium-headless-shell", "the page"),
    ("firefox-esr", "the page"),
];

/// The place of each program.
fn found() -> Vec<Finding> {
    let fetched_into = std::env::var_os("GOODBOT_PROGRAMS").unwrap_or_else(|| "target/programs".into());
    let mut folders: Vec<_> = std::env::var_os("PATH").map(|path| std::env::split_paths(&path).collect()).unwrap_or_default();
    folders.extend(launchers(fetched_into.as_ref()));
    let mut findings: Vec<Finding> = PROGRAMS.iter().map(|(name, why)| look_for(name, why, &folders)).collect();
    if findings.iter().any(|finding| finding.state == State::Missing) {
        findings.push(Finding::new(State::Fine, "cargo xtask programs fetches those that it can, and names the others"));
    }
    findings
}

/// The folders of the launchers of fetched programs.
fn launchers(fetched_into: &Path) -> impl Iterator<Item = PathBuf> {
    std::fs::read_dir(fetched_into).into_iter().flatten().flatten().map(|program| program.path().join("launch"))
}

fn look_for(name: &str, why: &str, folders: &[impl AsRef<Path>]) -> Finding {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    match folders.iter().map(|folder| folder.as_ref().join(&file)).find(|path| path.is_file()) {
        Some(path) => Finding::new(State::Fine, format!("{name}: {}", path.display())),
        None => Finding::new(State::Missing, format!("{name}, for {why}")),
    }
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

/// Whether a file begins like a model.
fn is_model(file: impl AsRef<Path>) -> bool {
    let mut head = Vec::new();
    File::open(file).and_then(|file| file.take(64).read_to_end(&mut head)).is_ok() && Content::of(&head) == Content::Model
}

/// Checks a single model.
fn model(path: &Path) -> Finding {
    match sessions(path) {
        Ok(sessions) => Finding::new(State::Fine, format!("{}: a model of {}", path.display(), counted(sessions, "session"))),
        Err(message) => Finding::new(State::Wrong, message),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_program_that_the_tests_fetch_is_looked_for() {
        let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../CONTRIBUTING.md")).unwrap();
        let (_, fetched) = page.split_once(" GB unpacked: ").unwrap();
        let (fetched, _) = fetched.split_once("and Rust's targets").unwrap();
        let named: Vec<&str> = fetched.split('`').skip(1).step_by(2).collect();
        assert!(named.contains(&"qemu-system-arm"), "{named:?}");
        for name in named {
            assert!(PROGRAMS.iter().any(|(known, _)| *known == name), "{name}");
        }
    }

    #[test]
    fn a_program_is_found_in_a_folder_of_the_path_or_told_with_what_it_is_for() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(format!("node{}", std::env::consts::EXE_SUFFIX));
        std::fs::write(&file, "").unwrap();
        assert_eq!(look_for("node", "the page", &[folder.path()]).state, State::Fine);
        assert_eq!(look_for("npm", "the page", &[folder.path()]), Finding::new(State::Missing, "npm, for the page"));
    }

    #[test]
    fn a_program_that_was_fetched_is_found_by_its_launcher() {
        let folder = tempfile::tempdir().unwrap();
        let launch = folder.path().join("qemu-system-misc/launch");
        std::fs::create_dir_all(&launch).unwrap();
        std::fs::write(launch.join(format!("qemu-system-riscv32{}", std::env::consts::EXE_SUFFIX)), "").unwrap();
        let folders: Vec<_> = launchers(folder.path()).collect();
        assert_eq!(look_for("qemu-system-riscv32", "the firmware", &folders).state, State::Fine);
        assert_eq!(launchers(&launch.join("missing")).count(), 0);
    }
}
