//! `goodbot check`: every fault of an environment, a session log or recorded beliefs, with its line and field.

use crate::load::fault::tell;
use crate::load::kinds::TaskKinds;
use crate::load::{Fault, home, input, session};
use clap::Args;
use goodbot::oomdp::Domain;
use goodbot::task::LiftedTask;
use goodbot_formats::Problem;
use goodbot_formats::environment::{self, EnvironmentFile};
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};
use std::io::Write;
use std::process::ExitCode;

/// Check environments, session logs and beliefs, and name every fault
///
/// What a file is is seen from what is in it. Of an environment it is asked whether the home makes
/// sense; of a session log also whether each step can be done where it is done, and whether the
/// tasks it names are possible there.
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 no fault, 2 at least one.

Example: goodbot check home.json lessons.jsonl")]
pub struct CheckArgs {
    /// Environments (JSON), session logs and beliefs (JSON Lines); - is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    #[command(flatten)]
    kinds: TaskKinds,
}

/// Runs the command.
pub fn run(args: &CheckArgs) -> ExitCode {
    let lifted = match args.kinds.lifted() {
        Ok(lifted) => lifted,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(2);
        }
    };
    let mut sound = true;
    for file in &args.files {
        let checked = input::bytes(file).map_err(|fault| vec![fault]).and_then(|bytes| check(input::name(file), &bytes, &lifted));
        match checked {
            Ok(found) => {
                // The exit code says the same, should no one read the output to its end.
                let _ = writeln!(std::io::stdout(), "{}: {found}, no fault", input::name(file));
            }
            Err(faults) => {
                sound = false;
                tell(&faults);
            }
        }
    }
    ExitCode::from(if sound { 0 } else { 2 })
}

/// What a file is, seen from its first line.
enum Content {
    Environment,
    Log,
    Beliefs,
}

impl Content {
    fn of(text: &str) -> Self {
        let first = text.trim_start_matches('\u{feff}').lines().find(|line| !line.trim().is_empty()).unwrap_or("");
        match serde_json::from_str::<serde_json::Value>(first) {
            Ok(line) if line.get("objects").is_some() => Self::Environment,
            Ok(line) if line.get("type").is_some() => Self::Log,
            Ok(line) if line.get("session").is_some() && line.get("step").is_some() => Self::Beliefs,
            Ok(_) => Self::Environment,
            // A session line may be broken itself.
            Err(_) if first.contains("\"type\"") && first.contains("\"session\"") => Self::Log,
            Err(_) => Self::Environment,
        }
    }
}

/// What a file is.
///
/// # Errors
/// Its faults.
fn check(file: &str, bytes: &[u8], lifted: &[LiftedTask]) -> Result<String, Vec<Fault>> {
    let (found, faults) = match (Content::of(&String::from_utf8_lossy(bytes)), std::str::from_utf8(bytes)) {
        (Content::Log, _) => check_log(file, bytes, lifted),
        (Content::Environment, Ok(text)) => ("an environment".to_owned(), check_environment(file, text)),
        (Content::Beliefs, Ok(text)) => check_beliefs(file, text),
        (_, Err(error)) => {
            let line = 1 + bytes.iter().take(error.valid_up_to()).filter(|&&byte| byte == b'\n').count();
            (String::new(), vec![Fault::on_line(file, line, Problem::NotUtf8)])
        }
    };
    if faults.is_empty() { Ok(found) } else { Err(faults) }
}

fn check_beliefs(file: &str, text: &str) -> (String, Vec<Fault>) {
    let lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
    let faults = lines.clone().filter_map(|(line, number)| PosteriorLine::parse(line, number).err());
    (format!("{} beliefs", lines.clone().count()), faults.map(|error| Fault::from_format(file, error)).collect())
}

fn check_environment(file: &str, text: &str) -> Vec<Fault> {
    let environment = match EnvironmentFile::parse(text) {
        Ok(environment) => environment,
        Err(error) => return vec![Fault::from_format(file, error)],
    };
    let fault = |flaw: home::Flaw| {
        let line = flaw.object.map_or(Some(1), |object| environment::object_line(text, object));
        Fault { line, ..Fault::new(file, flaw.message(&environment)) }.in_field(flaw.field())
    };
    home::flaws(&environment).into_iter().map(fault).collect()
}

fn check_log(file: &str, bytes: &[u8], lifted: &[LiftedTask]) -> (String, Vec<Fault>) {
    let mut faults = Vec::new();
    let (mut sessions, mut steps) = (0_usize, 0_usize);
    for recorded in SessionReader::new(bytes) {
        match recorded {
            Ok(recorded) => {
                sessions += 1;
                steps += recorded.steps.len();
                faults.extend(check_session(file, &recorded, lifted));
            }
            Err(error) => faults.push(Fault::from_format(file, error)),
        }
    }
    (format!("{sessions} sessions of {steps} steps"), faults)
}

fn check_session(file: &str, recorded: &RecordedSession, lifted: &[LiftedTask]) -> Vec<Fault> {
    let mut memory = home::memory();
    let session = match session::load(file, recorded, lifted, &mut memory) {
        Ok(session) => session,
        Err(faults) => return faults,
    };
    let mut faults = Vec::new();
    let intended = recorded.header.intended.iter().flatten();
    let mut atoms = intended.map(|atom| session::known_atom(&session.home, atom)).peekable();
    if atoms.peek().is_some() && atoms.all(|atom| atom.is_ok_and(|atom| session.home.holds(&atom, &session.start))) {
        let message = "holds where the session begins already, so there is nothing to do; correct it or the environment";
        faults.push(Fault::on_line(file, recorded.header_line, message).in_field("intended"));
    }
    if recorded.header.kind == Kind::Demonstration {
        for step in session.steps.iter().filter(|step| step.bump) {
            let cell = session.home.agent_cell(&step.before);
            let message = format!(
                "the demonstration goes against a wall or a block that is held: the agent stays at {}, {}; remove the step, or correct the \
                 steps before it",
                cell.x, cell.y
            );
            faults.push(Fault::on_line(file, step.line, message).in_field("action"));
        }
    }
    faults
}
