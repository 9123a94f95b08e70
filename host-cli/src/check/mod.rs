//! `goodbot check`: every fault of an environment, a session log, recorded beliefs or a table of closed words, with its line and field, and
//! warnings.
//!
//! - [`doubts`]: warnings about entries that are allowed, but hardly intended.

mod doubts;

use clap::Args;
use goodbot::Options;
use goodbot::oomdp::{Domain, check as soundness};
use goodbot::talk::{Class, ClosedWords, ClosedWordsError};
use goodbot::task::LiftedTask;
use goodbot_console::load::input::{Content, HEAD};
use goodbot_console::messages::{summed, summed_by};
use goodbot_console::training_data::worlds;
use goodbot_console::whole_file::MOST_BYTES;
use goodbot_console::{Failure, InputFile, Limit, Printed, TaskKinds, counted, counting, input, messages, say};
use goodbot_formats::NOT_UTF8;
use goodbot_formats::environment::{self, EnvironmentFile};
use goodbot_formats::map;
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};
use goodbot_lesson::world::robot::{self, WorldFlaw};
use goodbot_lesson::{Fault, checked, home};
use serde_json::json;
use std::collections::{HashMap, HashSet};
use std::io::{BufRead, Read, Write};

/// From this many bytes on, checking a log may take a minute.
const LONG: u64 = 100_000_000;
/// The most different faults to report for one file.
const MOST_FAULTS: usize = 100;
/// The most faults to report for one file in total.
const MOST_IN_ALL: usize = 10_000;

/// Check homes, session logs, beliefs and tables of closed words: name every fault and every doubtful entry
///
/// The file type is detected from its contents. In a session log, each step must be possible where
/// it is taken, and so must each task that the log names.
#[derive(Debug, Args)]
#[command(
    after_help = "Warnings, not faults: rooms that overlap or cannot be reached, doors that lead nowhere, empty colours and shapes, \
ids that occur twice, probabilities that do not sum to 1, steps of a demonstration that move nothing, commands of more than 64 words.

Exit codes: 0 no fault, 2 at least one.

Example: goodbot check home.json lessons.jsonl"
)]
pub struct CheckArgs {
    /// Homes (JSON or drawn as text), session logs and beliefs (JSON Lines), tables of closed words; - is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<InputFile>,
    #[command(flatten)]
    kinds: TaskKinds,
    #[command(flatten)]
    limit: Limit,
    /// Print a line of JSON for each fault and each warning, and one for each file
    #[arg(long)]
    json: bool,
}

/// The faults and warnings of a file.
#[derive(Debug, Default)]
struct Findings {
    /// The kind and size of the file.
    what: String,
    faults: Vec<Fault>,
    warnings: Vec<Fault>,
    /// The distinct faults.
    said: HashSet<Mended>,
}

impl Findings {
    fn fault(&mut self, fault: Fault) {
        self.said.insert(mended(&fault));
        self.faults.push(fault);
    }

    /// Whether there are too many faults to continue.
    fn is_full(&self) -> bool {
        self.said.len() >= MOST_FAULTS || self.faults.len() >= MOST_IN_ALL
    }

    /// Adds the fault that the rest was not checked.
    fn cut(&mut self, file: &str) {
        let most =
            if self.faults.len() >= MOST_IN_ALL { format!("{MOST_IN_ALL} faults") } else { format!("{MOST_FAULTS} different faults") };
        self.faults.push(Fault::new(file, format!("has {most} or more, and the rest was not checked; mend these first")));
    }
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CheckArgs) -> Result<(), Failure> {
    let lifted = args.kinds.lifted()?;
    let mut sound = true;
    for file in &args.files {
        let found = check(file, &lifted, args.limit).unwrap_or_else(|fault| Findings { faults: vec![fault], ..Findings::default() });
        sound &= found.faults.is_empty();
        let told = if args.json { tell_json(input::name(file), &found) } else { tell(input::name(file), &found) };
        // If the reader stops early, the exit code still counts.
        if let Err(error) = told
            && error.kind() != std::io::ErrorKind::BrokenPipe
        {
            return Err(error.into());
        }
    }
    if sound { Ok(()) } else { Err(Failure::Told) }
}

fn tell(file: &str, found: &Findings) -> std::io::Result<()> {
    for fault in summed_by(&found.faults, mended) {
        messages::tell(&fault);
    }
    let doubtful = |warning: &Fault| Fault { message: format!("warning: {}", warning.message), ..warning.clone() };
    let doubts = summed(&found.warnings.iter().map(doubtful).collect::<Vec<_>>());
    for doubt in doubts.iter().take(MOST_FAULTS) {
        messages::tell(doubt);
    }
    if let Some(more) = doubts.len().checked_sub(MOST_FAULTS).filter(|&more| more > 0) {
        messages::tell(&format!("{file}: {} of other kinds left out; mend these first", counted(more, "warning")));
    }
    if !found.faults.is_empty() {
        return Ok(());
    }
    let warnings = if found.warnings.is_empty() { String::new() } else { format!(", {}", counted(found.warnings.len(), "warning")) };
    let mut out = Printed::stdout();
    writeln!(out, "{file}: {}, no fault{warnings}", found.what)?;
    out.flush()
}

/// The key of faults that one change mends: line, field and message. If an option mends the fault, the line does not count.
type Mended = (Option<usize>, Option<String>, String);

fn mended(fault: &Fault) -> Mended {
    (fault.line.filter(|_| !fault.message.contains("--task")), fault.field.clone(), fault.message.clone())
}

fn tell_json(file: &str, found: &Findings) -> std::io::Result<()> {
    let mut out = Printed::stdout();
    for (kind, finding) in found.faults.iter().map(|it| ("fault", it)).chain(found.warnings.iter().map(|it| ("warning", it))) {
        let line = json!({"type": kind, "file": finding.file, "line": finding.line, "field": finding.field, "message": finding.message});
        writeln!(out, "{line}")?;
    }
    let line = json!({"type": "file", "file": file, "content": found.what, "faults": found.faults.len(), "warnings": found.warnings.len()});
    writeln!(out, "{line}")?;
    out.flush()
}

/// The kind and size of a file, and its faults and warnings.
///
/// # Errors
/// The fault of a file that cannot be read.
fn check(file: &InputFile, lifted: &[LiftedTask], limit: Limit) -> Result<Findings, Fault> {
    let name = input::name(file);
    let mut opened = input::open(file)?;
    let content = Content::of(opened.fill_buf().map_err(input::unreadable(name))?);
    if matches!(content, Content::Log | Content::Worlds) && std::fs::metadata(file).is_ok_and(|it| it.len() > LONG) {
        say!("{name}: has more than {} MB, every line of which is checked; --limit N checks the first N sessions alone", LONG / 1_000_000);
    }
    if content == Content::Log {
        return Ok(check_log(name, opened, lifted, limit));
    }
    if content == Content::Worlds {
        return check_worlds(name, opened, limit);
    }
    if matches!(content, Content::Model | Content::Picture) {
        let message = format!("this is {}; check looks at homes, session logs, beliefs and tables of closed words", content.name());
        return Err(Fault::new(name, message));
    }
    let bytes = input::rest(name, opened)?;
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let valid = error.utf8_error().valid_up_to();
            let line = 1 + error.as_bytes().iter().take(valid).filter(|&&byte| byte == b'\n').count();
            return Err(Fault::on_line(name, line, NOT_UTF8));
        }
    };
    Ok(match content {
        Content::Beliefs => check_beliefs(name, &text),
        Content::Map => check_map(name, &text),
        Content::ClosedWords => check_closed_words(name, &text),
        _ => check_environment(name, &text),
    })
}

fn check_beliefs(file: &str, text: &str) -> Findings {
    let lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
    let faults = lines.clone().filter_map(|(line, number)| PosteriorLine::parse(line, number).err());
    let faults = faults.take(MOST_FAULTS).map(|error| Fault::from_format(file, error)).collect();
    Findings { what: counted(lines.count(), "belief"), faults, ..Findings::default() }
}

fn check_map(file: &str, text: &str) -> Findings {
    let mut found = Findings { what: "a home, drawn as text".to_owned(), ..Findings::default() };
    match map::parse(text) {
        Ok(environment) => look_at(file, &environment, |_| None, &mut found),
        Err(wrong) => found.faults.push(Fault::on_line(file, wrong.line, wrong.message)),
    }
    found
}

/// Checks each line alone, and then the whole table for conflicts between two lines.
fn check_closed_words(file: &str, text: &str) -> Findings {
    let in_line = |(line, number): (&str, usize)| Some(Fault::on_line(file, number, without_line(ClosedWords::new(line).err()?)));
    let mut faults: Vec<Fault> = text.lines().zip(1..).filter_map(in_line).take(MOST_FAULTS).collect();
    let mut count = 0;
    match ClosedWords::new(text) {
        Ok(table) => count = Class::ALL.iter().map(|&class| table.count(class)).sum(),
        Err(error @ ClosedWordsError::Opposites { line, .. }) => faults.push(Fault::on_line(file, line, without_line(error))),
        Err(_) => {}
    }
    Findings { what: format!("a table of {}", counted(count, "closed word")), faults, ..Findings::default() }
}

/// The error of a text of one line, without the line's number.
fn without_line(error: ClosedWordsError<'_>) -> String {
    let text = error.to_string();
    text.split_once(": ").filter(|(line, _)| line.starts_with("line ")).map_or_else(|| text.clone(), |(_, said)| said.to_owned())
}

fn check_environment(file: &str, text: &str) -> Findings {
    let mut found = Findings { what: "a home".to_owned(), ..Findings::default() };
    match EnvironmentFile::parse(text) {
        Ok(environment) => {
            let line = |object: Option<usize>| object.map_or(Some(1), |object| environment::object_line(text, object));
            look_at(file, &environment, line, &mut found);
        }
        Err(error) => found.faults.push(Fault::from_format(file, error)),
    }
    found
}

/// Finds the faults of a home or, without faults, its warnings. `line` gives the line of an object or of the whole.
fn look_at(file: &str, environment: &EnvironmentFile, line: impl Fn(Option<usize>) -> Option<usize>, found: &mut Findings) {
    let fault =
        |flaw: home::HomeFlaw| Fault { line: line(flaw.object), ..Fault::new(file, flaw.message(environment)) }.in_field(flaw.field());
    found.faults.extend(home::flaws(environment).into_iter().map(fault));
    if found.faults.is_empty() {
        let warning = |(object, message): doubts::Warning| warned(file, environment, line(object), "", object, &message);
        found.warnings.extend(doubts::of_home(environment).into_iter().map(warning));
    }
}

/// A warning about an object of a home.
fn warned(file: &str, environment: &EnvironmentFile, line: Option<usize>, way: &str, object: Option<usize>, message: &str) -> Fault {
    let named = object.and_then(|object| environment.objects.get(object)).map_or("", |object| object.name());
    let field = object.map_or_else(|| format!("{way}objects"), |object| format!("{way}objects[{object}]"));
    Fault { line, ..Fault::new(file, format!("{named}: {message}")) }.in_field(field)
}

fn check_log(file: &str, log: impl BufRead, lifted: &[LiftedTask], limit: Limit) -> Findings {
    let mut found = Findings::default();
    let (mut sessions, mut steps) = (0_usize, 0_usize);
    let mut ids: HashMap<String, usize> = HashMap::new();
    // Most sessions of a log share a home.
    let mut homes: Vec<EnvironmentFile> = Vec::new();
    let progress = counting("sessions checked");
    let mut left = limit.count();
    for recorded in SessionReader::new(log).take(left) {
        progress.inc(1);
        left -= 1;
        match recorded {
            Ok(recorded) => {
                sessions += 1;
                steps += recorded.steps.len();
                let faults = check_session(file, &recorded, lifted, &mut found.warnings);
                if faults.is_empty() {
                    found.warnings.extend(doubtful(file, &recorded, &mut ids, &mut homes));
                }
                faults.into_iter().for_each(|fault| found.fault(fault));
            }
            Err(error) => found.fault(Fault::from_format(file, error)),
        }
        if found.is_full() {
            found.cut(file);
            break;
        }
    }
    progress.finish_and_clear();
    found.what = format!("{} of {}{}", counted(sessions, "session"), counted(steps, "step"), as_far(left));
    found
}

/// The remark that the limit of a log was reached.
const fn as_far(left: usize) -> &'static str {
    if left == 0 { ", as far as --limit" } else { "" }
}

/// The most states of a robot to visit.
const MOST_STATES: usize = 1_000_000;

/// Checks the robot of a world and its reachable states.
fn check_robot(read: &input::WorldInFile, found: &mut Findings) -> Result<(), WorldFlaw> {
    let world = &read.world;
    robot::with(world, |robot, start| {
        robot::tasks(world, robot)?;
        let actions = counted(robot.actions().len(), "action");
        match soundness(robot, start, MOST_STATES) {
            Ok(checked) => {
                let and_more = if checked.all { "" } else { " or more" };
                found.what.push_str(&format!(", with a robot of {actions} and {}{and_more}", counted(checked.states, "state")));
                if let Some(never) = checked.never_held.filter(|_| checked.all) {
                    let name = robot.world().schema.proposition_name(never);
                    let warning = "never holds, whatever the robot does; leave it out, or correct the facts and effects";
                    found.warnings.push(read.fault(&format!("propositions.{name}"), warning));
                }
                let doubts = doubts::of_actions(robot, start, checked.all);
                found.warnings.extend(doubts.iter().map(|(field, message)| read.fault(field, message)));
            }
            Err(error) => found.faults.push(read.fault("actions", &error.to_string())),
        }
        Ok(())
    })?
}

/// Checks a world, on one line or on several, or a log of worlds.
fn check_worlds(file: &str, mut opened: impl BufRead, limit: Limit) -> Result<Findings, Fault> {
    let (head, is_more) = first_line(file, &mut opened)?;
    if is_world(&head, is_more) {
        return check_world(&input::WorldInFile::parse(file, input::rest(file, head.chain(opened))?)?);
    }
    Ok(check_log_of_worlds(file, head.chain(opened), limit))
}

/// Everything up to the end of the first line that is not blank, and whether more follows.
fn first_line(file: &str, opened: &mut impl BufRead) -> Result<(Vec<u8>, bool), Fault> {
    let mut head = Vec::new();
    while head.trim_ascii().is_empty()
        && opened.by_ref().take(MOST_BYTES).read_until(b'\n', &mut head).map_err(input::unreadable(file))? > 0
    {}
    while (head.len() as u64) < MOST_BYTES {
        let rest = opened.fill_buf().map_err(input::unreadable(file))?;
        if rest.is_empty() {
            return Ok((head, false));
        }
        if !rest.trim_ascii().is_empty() {
            break;
        }
        // Blank lines count in the line numbers of faults.
        head.extend_from_slice(rest);
        let length = rest.len();
        opened.consume(length);
    }
    Ok((head, true))
}

/// Whether a file that begins like this is a single world, and no log.
fn is_world(head: &[u8], is_more: bool) -> bool {
    let first = head.trim_ascii();
    if is_more {
        // A world on several lines begins with a short, incomplete line.
        return !first.ends_with(b"}") && first.len() <= 1_000;
    }
    // A single command is a log without its world. No command is as long as this, and only a world is.
    if first.len() > HEAD {
        return true;
    }
    let kind = serde_json::from_slice::<serde_json::Value>(first.strip_prefix(b"\xef\xbb\xbf").unwrap_or(first));
    kind.map_or(true, |it| it.get("type").is_none_or(|kind| kind == "world"))
}

fn check_world(read: &input::WorldInFile) -> Result<Findings, Fault> {
    let mut found = Findings::default();
    let world = &read.world;
    let tasks = goodbot_lesson::world::count_tasks(world).map_err(|error| read.fault("task_kinds", &error.to_string()))?;
    found.what = format!("a world of {} and {}", counted(world.objects.len(), "object"), counted(tasks, "task"));
    if !world.actions.is_empty() {
        check_robot(read, &mut found).map_err(|flaw| read.fault(&flaw.field, &flaw.message))?;
    }
    Ok(found)
}

fn check_log_of_worlds(file: &str, opened: impl BufRead, limit: Limit) -> Findings {
    let mut found = Findings::default();
    let (mut sessions, mut commands, mut no_task) = (0_usize, 0_usize, 0_usize);
    let mut left = limit.count();
    let progress = counting("sessions checked");
    let read = worlds::read(file, opened, Options::DEFAULT, None, &mut left, |lesson| {
        progress.inc(1);
        match lesson {
            Ok(Some(lesson)) if lesson.header.kind != Kind::Labelled => {
                sessions += 1;
                found.warnings.extend(lesson.remarks.into_iter().chain(lesson.long));
            }
            Ok(lesson) => {
                (commands, no_task) = (commands + 1, no_task + usize::from(lesson.is_none()));
                found.warnings.extend(lesson.and_then(|lesson| lesson.long));
            }
            Err(fault) => found.fault(fault),
        }
        if found.is_full() { Err(()) } else { Ok(()) }
    });
    progress.finish_and_clear();
    if read.is_err() {
        found.cut(file);
    }
    if no_task > 0 {
        let message = format!(
            "the task of {} is of no kind of this world, or holds already; nothing is learned from it",
            counted(no_task, "command")
        );
        found.warnings.push(Fault::new(file, message));
    }
    let told =
        [(sessions, "session"), (commands, "command")].into_iter().filter(|&(count, what)| count > 0 || what == "command" && sessions == 0);
    let told: Vec<String> = told.map(|(count, what)| counted(count, what)).collect();
    found.what = format!("a log of worlds with {}{}", told.join(" and "), as_far(left));
    found
}

fn check_session(file: &str, recorded: &RecordedSession, lifted: &[LiftedTask], warnings: &mut Vec<Fault>) -> Vec<Fault> {
    let mut memory = home::memory();
    let session = match checked::check(file, recorded, lifted, &mut memory) {
        Ok(session) => session,
        Err(faults) => return faults,
    };
    warnings.extend(session.long.map(|long| Fault::on_line(file, recorded.header_line, long).in_field("command")));
    if recorded.header.kind == Kind::Demonstration {
        for step in session.walk.steps.iter().filter(|step| step.bump) {
            let cell = session.walk.home.agent_cell(&step.before);
            let message = format!(
                "the demonstration walks into a wall or a held block: the agent stays at {}, {}; remove the step, or correct the \
                 steps before it",
                cell.x, cell.y
            );
            warnings.push(Fault::on_line(file, step.line, message).in_field("action"));
        }
    }
    vec![]
}

/// The warnings for a session without faults.
fn doubtful(file: &str, recorded: &RecordedSession, ids: &mut HashMap<String, usize>, homes: &mut Vec<EnvironmentFile>) -> Vec<Fault> {
    const MOST_HOMES: usize = 1_000;
    let header = &recorded.header;
    let at = |field: &str, message: String| Fault::on_line(file, recorded.header_line, message).in_field(field);
    let mut warnings: Vec<Fault> = doubts::of_header(header).into_iter().map(|(field, message)| at(field, message)).collect();
    if let Some(id) = header.id.as_ref().filter(|_| !header.continues) {
        if let Some(line) = ids.get(id) {
            warnings.push(at("id", format!("is on line {line} already; give each session an id of its own")));
        } else {
            ids.insert(id.clone(), recorded.header_line);
        }
    }
    if !homes.contains(&header.environment) && homes.len() < MOST_HOMES {
        let doubts = doubts::of_home(&header.environment).into_iter();
        let line = Some(recorded.header_line);
        warnings.extend(doubts.map(|(object, message)| warned(file, &header.environment, line, "environment.", object, &message)));
        homes.push(header.environment.clone());
    }
    warnings
}
