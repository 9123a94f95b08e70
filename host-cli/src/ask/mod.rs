//! `goodbot ask`: the meaning of a command in a home or world.
//!
//! The robot listens to the command once, as `goodbot teach` does: in homes and in worlds from files, from the first lesson on.
//!
//! - [`place`]: the place of a question, and the robot there;
//! - [`meanings`]: what the robot hears, with the possible meanings;
//! - [`following`]: several tasks in order, and prohibitions;
//! - [`plan`]: the actions that lead to a goal;
//! - [`why`]: the evidence of each word for a task;
//! - [`drawing`]: the home as text;
//! - [`told`]: commands in worlds without actions, where no robot listens.

mod drawing;
mod following;
mod meanings;
mod place;
mod plan;
mod told;
mod why;

use crate::teach::site::{Setting, Site, SiteState};
use clap::{Args, ValueHint};
use goodbot::Agent;
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::home::{Map, Moves};
use goodbot::language::{Synonyms, first_words};
use goodbot::memory::AgentMemory;
use goodbot::talk::{ClosedWords, Hypothesis, Verdict};
use goodbot_console::load::closed_words::ClosedWordOptions;
use goodbot_console::load::content::Content;
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::load::kinds::TaskKinds;
use goodbot_console::load::synonyms::{SynonymOptions, said_in_known_words};
use goodbot_console::messages::{counted, tell};
use goodbot_console::outcome::Failure;
use goodbot_console::printed::Printed;
use goodbot_console::starter::StarterOptions;
use goodbot_console::training_data::worlds;
use goodbot_console::whole_file::options_of_model;
use goodbot_formats::session::SessionReader;
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::{Line, SessionInWorld, WorldReader};
use goodbot_lesson::Fault;
use goodbot_lesson::checked::moves;
use meanings::{Interpretation, Meaning};
use place::Robots;
use plan::{Plan, plan};
use serde_json::json;
use std::collections::{BTreeSet, HashMap};
use std::io::{BufRead, Write};
use std::path::PathBuf;
use std::sync::Arc;
use told::Told;
use why::Word;

/// The most sessions of a log to ask at once.
const MOST_SESSIONS: usize = 10_000;

/// The options of `goodbot ask`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct AskOptions {
    /// A model that `goodbot learn` wrote
    #[arg(long, short = 'w', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    with: PathBuf,
    /// A home, as JSON or drawn as text, or a world from a file; - is standard input
    #[arg(long, short = 'e', value_name = "HOME", value_hint = ValueHint::FilePath, required_unless_present = "log")]
    environment: Option<InputFile>,
    /// The command, in as many words as you like; - asks each line of standard input
    #[arg(value_name = "COMMAND", required_unless_present = "log")]
    command: Vec<String>,
    /// Ask the commands of a session log, each in its own home, and compare with the intended tasks
    #[arg(long, short = 'l', value_name = "LOG", value_hint = ValueHint::FilePath, conflicts_with_all = ["environment", "command", "pull"])]
    log: Option<InputFile>,
    /// Ask the session of this id alone
    #[arg(long, value_name = "ID", requires = "log")]
    session: Option<String>,
    /// Show word by word what supports the answer
    #[arg(long)]
    why: bool,
    /// The intended task, such as "agentInRoom(agent0,room1)": shows word by word what supports it, and what supports the answer
    #[arg(long, value_name = "TASK", value_parser = expected)]
    expected: Option<GroundTaskText>,
    /// Below this probability the answer is "unsure"; by default the robot decides
    #[arg(long, value_name = "P", value_parser = probability, allow_negative_numbers = true)]
    threshold: Option<f32>,
    #[command(flatten)]
    synonyms: SynonymOptions,
    #[command(flatten)]
    closed_words: ClosedWordOptions,
    #[command(flatten)]
    kinds: TaskKinds,
    #[command(flatten)]
    starter: StarterOptions,
    /// The robot can pull blocks too
    #[arg(long)]
    pull: bool,
    /// Each command begins where the one before ends, and may refer to it: "put it back", "go there", "again"
    #[arg(long, conflicts_with = "log")]
    conversation: bool,
    /// Print a line of JSON for each command
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Tasks that are done already are possible meanings too; the plan is for the most likely task that is not done. The robot also tells the kind of \
sentence: a command, nothing that it can do, a thing that is not here, several commands, a prohibition, talk. In a world without actions no robot \
listens: without --threshold every answer is \"unsure\".

Refused commands are reported on standard error; the others are asked.

With --json, \"tasks\" are the probabilities of the tasks if the sentence is a command, or its first command; \"meanings\" are the table that is \
shown without --json. A command that is refused has a line of the type \"error\".

Examples:
  goodbot ask --with words.goodbot --environment home.json go to the orange room
  goodbot ask --with words.goodbot --environment home.json --why take the bag to the blue room
  goodbot ask --with words.goodbot --log log.jsonl --session w01-3 --why
  goodbot ask --with words.goodbot --environment home.json --synonyms words.txt go to the crimson room
  printf 'go to the red room\\nthen go back\\n' | goodbot ask --with words.goodbot --environment home.json --conversation -
  echo \"go to the red room\" | goodbot ask --with words.goodbot --environment home.json -";

fn expected(text: &str) -> Result<GroundTaskText, String> {
    text.parse().map_err(|error: goodbot_formats::task_text::TaskTextError| error.to_string())
}

fn probability(text: &str) -> Result<f32, String> {
    let number: Option<f32> = text.trim().parse().ok();
    number.filter(|number| (0.0..=1.0).contains(number)).ok_or_else(|| "give a number from 0 to 1".to_owned())
}

/// A command, and its place.
struct Question {
    /// The id of its session, if it has one.
    session: Option<String>,
    /// Its file and line, for messages.
    source: String,
    setting: Setting,
    /// The facts of a world from a file at the time of the command, if they differ from the file's.
    facts: Option<Vec<GroundAtomText>>,
    moves: Moves,
    command: String,
    expected: Option<GroundTaskText>,
}

/// The answer to a question.
struct Answer {
    /// The command with unknown words replaced by known synonyms.
    heard: String,
    understood: Interpretation,
    /// The intended task, its words, and how it explains the command's words.
    expected: Option<(GroundTaskText, String, Vec<Word>)>,
    plan: Option<Plan>,
    /// The state in which the most likely tasks end.
    end: SiteState,
    /// How many words were not read.
    unread: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &AskOptions) -> Result<(), Failure> {
    let questions = match questions(options)? {
        Questions::Heard(questions) => questions,
        Questions::Told(commands) => return told::ask(options, &commands),
    };
    let mut robots = Robots::new(options);
    let (synonyms, closed) = (options.synonyms.read()?, options.closed_words.read()?);
    let mut out = Printed::stdout();
    let mut state = None;
    let mut refused = 0_usize;
    for (number, question) in questions.iter().enumerate() {
        let (agent, site, start) = robots.at(question)?;
        let start = state.unwrap_or(start);
        let answer = match answer(agent, &site, &start, question, synonyms, closed) {
            // The other commands are still asked.
            Err(Failure::Input(message)) if questions.len() > 1 => {
                refused += 1;
                tell_refused(&mut out, options, &question.command, &message)?;
                continue;
            }
            answer => answer?,
        };
        if options.conversation && ["sure", "done"].contains(&answer.verdict(options.threshold)) {
            answer.understood.steps.iter().for_each(|(task, before)| agent.remember(&site, before, task));
            state = Some(answer.end);
        }
        if options.json {
            writeln!(out, "{}", to_json(&answer, question, options.threshold))?;
            continue;
        }
        if number > 0 {
            writeln!(out)?;
        }
        if let (Site::Floor(home), SiteState::Floor(start)) = (&site, &start) {
            drawing::draw(&mut out, &Map::new(home, start))?;
            writeln!(out)?;
        }
        print(&mut out, options, question, &answer)?;
    }
    out.flush()?;
    end(refused, questions.len())
}

/// Reports why a command was refused.
fn tell_refused(out: &mut impl Write, options: &AskOptions, command: &str, message: &str) -> std::io::Result<()> {
    tell(&format!("{command:?}: {message}"));
    if options.json {
        writeln!(out, "{}", json!({"type": "error", "command": command, "message": message}))?;
    }
    Ok(())
}

/// The remark that only the first words were read.
fn unread_words() -> String {
    format!("the words after the first {WORDS_PER_COMMAND} were not read: say it in parts")
}

/// The end of a run: a failure if commands were refused.
fn end(refused: usize, commands: usize) -> Result<(), Failure> {
    match refused {
        0 => Ok(()),
        _ => Err(Failure::Input(format!("{refused} of {} were refused", counted(commands, "command")))),
    }
}

/// The questions: to a robot that listens, or commands in worlds where none does.
enum Questions {
    Heard(Vec<Question>),
    Told(Vec<Told>),
}

fn questions(options: &AskOptions) -> Result<Questions, Failure> {
    let Some(file) = options.log.as_ref().or(options.environment.as_ref()) else { return Ok(Questions::Heard(vec![])) };
    // Standard input is read once, for a home.
    if !file.is_standard() {
        let mut opened = input::open(file)?;
        // A file that cannot be read is refused later, when it is read.
        if opened.fill_buf().map(Content::of).ok() == Some(Content::Worlds) {
            if options.pull || options.starter.is_given() {
                return Err(Failure::Input("--pull and --starter are for homes; leave them out in a world from a file".to_owned()));
            }
            return if options.log.is_some() { in_log_of_worlds(options, file, opened) } else { in_world(options, file, opened) };
        }
    }
    if let Some(log) = &options.log {
        return sessions(options, log).map(Questions::Heard);
    }
    let commands = commands(options, file)?;
    let setting = Setting::Floor(input::home(file)?);
    Ok(Questions::Heard(asked(options, file, &setting, commands)))
}

/// The commands of the options, in one place.
fn asked(options: &AskOptions, file: &InputFile, setting: &Setting, commands: Vec<String>) -> Vec<Question> {
    let moves = if options.pull { Moves::PushAndPull } else { Moves::Push };
    let question = |command| Question {
        session: None,
        source: input::name(file).to_owned(),
        setting: setting.clone(),
        facts: None,
        moves,
        command,
        expected: options.expected.clone(),
    };
    commands.into_iter().map(question).collect()
}

/// The commands of the options, or those of standard input if it is not the place.
fn commands(options: &AskOptions, file: &InputFile) -> Result<Vec<String>, Failure> {
    match options.command.as_slice() {
        [only] if only == "-" && file.is_standard() => {
            let message = "the home and the commands cannot both come from standard input; name a file for the home";
            Err(Failure::Input(message.to_owned()))
        }
        [only] if only == "-" => lines(),
        words => Ok(vec![words.join(" ")]),
    }
}

/// The questions in a world from a file.
fn in_world(options: &AskOptions, file: &InputFile, opened: impl BufRead) -> Result<Questions, Failure> {
    let name = input::name(file);
    let world = input::WorldInFile::parse(name, input::rest(name, opened)?)?.world;
    let commands = commands(options, file)?;
    if !world.actions.is_empty() {
        return Ok(Questions::Heard(asked(options, file, &Setting::Other(Arc::new(world)), commands)));
    }
    refuse_why(options)?;
    let model = options_of_model(&options.with)?;
    let question = |command: &String| match worlds::question(name, &world, command, model) {
        // The other commands are still asked.
        Err(refused) if commands.len() > 1 && refused.field.as_deref() == Some("command") => Ok(Err((command.clone(), refused.message))),
        question => Ok(Ok(question?)),
    };
    commands.iter().map(question).collect::<Result<_, Failure>>().map(Questions::Told)
}

/// In worlds without actions, no robot listens and tells why.
fn refuse_why(options: &AskOptions) -> Result<(), Failure> {
    if options.why || options.expected.is_some() || options.conversation {
        let message = "--why, --expected and --conversation are for homes, and for worlds with actions; leave them out here";
        return Err(Failure::Input(message.to_owned()));
    }
    Ok(())
}

/// The questions of a log of worlds.
fn in_log_of_worlds(options: &AskOptions, file: &InputFile, opened: impl BufRead) -> Result<Questions, Failure> {
    let name = input::name(file);
    let is_wanted = |id: &Option<String>| options.session.is_none() || *id == options.session;
    let (mut questions, mut known, mut acting) = (Vec::new(), HashMap::new(), BTreeSet::new());
    for line in WorldReader::new(opened) {
        if questions.len() > MOST_SESSIONS {
            questions.retain(|question: &Question| is_wanted(&question.session));
            has_few_sessions(name, questions.len())?;
        }
        match line.map_err(|error| Fault::from_format(name, error))? {
            Line::World(world) => {
                acting.insert(!world.actions.is_empty());
                known.insert(world.name.clone(), world);
            }
            Line::Session(recorded) => {
                let SessionInWorld { world, facts, session } = *recorded;
                let intended = session.header.meant().and_then(Result::ok);
                questions.push(Question {
                    source: format!("{name}:{}", session.header_line),
                    session: session.header.id,
                    setting: Setting::Other(world),
                    facts: Some(facts),
                    moves: Moves::Push,
                    command: session.header.command,
                    expected: options.expected.clone().or(intended),
                });
            }
            // A command that also ends a proposition has no task.
            Line::Command(command) => {
                let Some(world) = known.get(&command.world).filter(|_| command.ended.is_empty()) else { continue };
                questions.push(Question {
                    source: format!("{name}:{}", command.line),
                    session: command.id,
                    setting: Setting::Other(Arc::clone(world)),
                    facts: command.facts,
                    moves: Moves::Push,
                    command: command.command,
                    expected: options.expected.clone().or(GroundTaskText::new(command.intended).ok()),
                });
            }
        }
    }
    questions.retain(|question| is_wanted(&question.session));
    match (acting.contains(&true), acting.contains(&false)) {
        (true, true) => Err(Failure::Input(format!("{name}: has worlds with actions and worlds without; ask each in a log of its own"))),
        (true, false) if questions.is_empty() => Err(no_such_command(name)),
        (true, false) => Ok(Questions::Heard(questions)),
        (false, _) => {
            refuse_why(options)?;
            let (mut lessons, mut left) = (Vec::new(), usize::MAX);
            worlds::read(name, input::open(file)?, options_of_model(&options.with)?, None, false, &mut left, |lesson| {
                lessons.extend(lesson?);
                Ok::<(), Failure>(())
            })?;
            lessons.retain(|lesson| is_wanted(&lesson.header.id));
            if lessons.is_empty() { Err(no_such_command(name)) } else { Ok(Questions::Told(lessons.into_iter().map(Ok).collect())) }
        }
    }
}

/// Refuses a log of which too many sessions are wanted.
fn has_few_sessions(name: &str, wanted: usize) -> Result<(), Failure> {
    if wanted <= MOST_SESSIONS {
        return Ok(());
    }
    Err(Failure::Input(format!(
        "{name}: has more than {MOST_SESSIONS} sessions, and each takes a plan; name one with --session, ask the log in parts, or count right answers \
         with goodbot evaluate --with"
    )))
}

fn no_such_command(name: &str) -> Failure {
    Failure::Input(format!("{name}: has no such command; check its id"))
}

/// The commands of standard input, one on each line.
fn lines() -> Result<Vec<String>, Failure> {
    const MOST: usize = 100_000;
    let mut commands = Vec::new();
    for line in input::text(&InputFile::standard())?.lines() {
        if !line.trim().is_empty() {
            commands.push(line.trim().to_owned());
        }
        if commands.len() > MOST {
            return Err(Failure::Input(format!("standard input: has more than {MOST} commands; ask fewer at once")));
        }
    }
    if commands.is_empty() {
        return Err(Failure::Input("standard input: has no command; write one on each line".to_owned()));
    }
    Ok(commands)
}

fn sessions(options: &AskOptions, log: &InputFile) -> Result<Vec<Question>, Failure> {
    let name = input::name(log);
    let mut questions = Vec::new();
    for recorded in SessionReader::new(input::log(log)?) {
        let recorded = recorded.map_err(|error| Fault::from_format(name, error))?;
        let header = recorded.header;
        if options.session.is_some() && header.id != options.session {
            continue;
        }
        has_few_sessions(name, questions.len() + 1)?;
        let intended = header.meant().and_then(Result::ok);
        questions.push(Question {
            source: format!("{name}:{}", recorded.header_line),
            moves: moves(header.action_names()).unwrap_or(Moves::Push),
            session: header.id,
            setting: Setting::Floor(header.environment),
            facts: None,
            command: header.command,
            expected: options.expected.clone().or(intended),
        });
    }
    if questions.is_empty() {
        let message = match &options.session {
            Some(id) => format!("{name}: has no session {id:?}; check its id"),
            None => format!("{name}: has no session; name a log that has one"),
        };
        return Err(Failure::Input(message));
    }
    Ok(questions)
}

fn answer(
    agent: &mut Agent<impl AgentMemory>,
    site: &Site,
    start: &SiteState,
    question: &Question,
    synonyms: Synonyms<'_>,
    closed: ClosedWords<'_>,
) -> Result<Answer, Failure> {
    let first = first_words(&question.command);
    // The blank between belongs to the rest.
    let first = first.trim_end();
    let unheard = question.command.get(first.len()..).unwrap_or("");
    // Commas separate commands, and a question mark shows a question, so both are kept.
    let heard = said_in_known_words(synonyms, agent.language(), first)?.into_owned() + unheard;
    let read = first_words(&heard);
    let unread = heard.get(read.len()..).map_or(0, |rest| rest.split_whitespace().count());
    let is_expected = |name: &str| question.expected.as_ref().is_some_and(|task| is_named(name, task));
    let understood = meanings::meanings(agent, site, start, (&heard, read), closed, is_expected)?;
    let expected = match (&question.expected, &understood.for_expected) {
        (None, _) => None,
        (Some(task), Some((at, words))) => {
            let text = understood.tasks.get(*at).map_or_else(String::new, |task| task.words.clone());
            Some((task.clone(), text, words.clone()))
        }
        (Some(task), None) if is_of_parts(task) => Some((task.clone(), "several parts".to_owned(), vec![])),
        (Some(task), None) => {
            let known: Vec<&str> = understood.tasks.iter().map(|task| task.name.as_str()).collect();
            let message = format!("{}: {task} is no task here; tasks are {}", question.source, known.join(", "));
            return Err(Failure::Input(message));
        }
    };
    let listened = &understood.listened;
    let is_to_do = listened.hypothesis == Hypothesis::Command && listened.verdict != Verdict::Done;
    let (plan, end) = match (&understood.followed, understood.best) {
        (Some(followed), _) => (followed.plan.clone().filter(|_| followed.verdict == Verdict::Sure), followed.end),
        (None, Some(best)) if is_to_do => plan(agent, site, *start, best)?.map_or((None, *start), |(plan, end)| (Some(plan), end)),
        (None, _) => (None, *start),
    };
    let unread = if understood.followed.is_some() { 0 } else { unread };
    Ok(Answer { heard, understood, expected, plan, end, unread })
}

fn is_named(name: &str, task: &GroundTaskText) -> bool {
    name.parse().is_ok_and(|name: GroundTaskText| name.is_same(task))
}

/// Whether a task is a prohibition, or several tasks in order.
fn is_of_parts(task: &GroundTaskText) -> bool {
    !task.way().before.is_empty() || task.atoms().iter().any(GroundAtomText::is_negated)
}

impl Answer {
    /// How many tasks that are still to do are as likely as the likeliest of them.
    fn tied(&self) -> usize {
        let to_do = || self.understood.tasks.iter().filter(|task| !task.done);
        let likeliest = self.to_do().map_or(0.0, |task| task.probability);
        to_do().filter(|task| task.probability >= likeliest).count()
    }

    /// The likeliest task that is still to do.
    fn to_do(&self) -> Option<&Meaning> {
        self.understood.tasks.get(self.understood.best?)
    }

    /// The purpose of the plan, if the likeliest meaning is done already and the plan is for another.
    fn purpose(&self) -> String {
        match (self.understood.meanings.first(), self.to_do()) {
            (Some(first), Some(planned)) if first.done && self.understood.followed.is_none() => {
                format!(" to {}, which is still to do", planned.words)
            }
            _ => String::new(),
        }
    }

    /// The most likely task. It is one that is still to do, unless the robot answers that the task is done.
    fn task(&self) -> Option<&String> {
        match self.understood.meanings.first() {
            Some(first) if self.understood.followed.is_some() || self.understood.listened.verdict == Verdict::Done => Some(&first.name),
            _ => self.to_do().map(|task| &task.name),
        }
    }

    /// `sure`, `unsure`, `done` or `none`.
    fn verdict(&self, threshold: Option<f32>) -> &'static str {
        let Interpretation { listened, followed, meanings, .. } = &self.understood;
        let is_sure = match threshold {
            None => matches!(followed.as_ref().map_or(listened.verdict, |followed| followed.verdict), Verdict::Sure | Verdict::Done),
            Some(threshold) => meanings.first().is_some_and(|first| first.probability >= threshold),
        };
        match (is_sure, meanings.first()) {
            (true, Some(Meaning { done: true, .. })) => "done",
            (true, _) => "sure",
            _ if listened.verdict == Verdict::None => "none",
            _ => "unsure",
        }
    }
}

fn to_json(answer: &Answer, question: &Question, threshold: Option<f32>) -> serde_json::Value {
    let Interpretation { tasks, words, meanings, listened, .. } = &answer.understood;
    let tasks: serde_json::Map<_, _> = tasks.iter().map(|task| (task.name.clone(), json!(task.probability))).collect();
    let word = |it: &Word| json!({"word": it.word, "token": it.token, "share": it.share, "probability": it.probability});
    let meaning = |it: &Meaning| json!({"task": it.name, "words": it.words, "probability": it.probability, "done": it.done});
    let mut line = json!({
        "type": "answer", "command": question.command, "task": answer.task(), "tied": answer.tied(),
        "tasks": tasks, "plan": answer.plan.as_ref().map(|plan| &plan.actions), "exact": answer.plan.as_ref().map(|plan| plan.is_exact), "words": words.iter().map(word).collect::<Vec<_>>(),
        "taken_for": listened.hypothesis.to_string(), "verdict": answer.verdict(threshold), "meanings": meanings.iter().map(meaning).collect::<Vec<_>>(),
    });
    if answer.heard != question.command {
        line["heard"] = answer.heard.as_str().into();
    }
    if answer.unread > 0 {
        line["unread"] = answer.unread.into();
    }
    if let Some(session) = &question.session {
        line["session"] = session.as_str().into();
    }
    if let Some((task, _, words)) = &answer.expected {
        line["expected"] = task.to_string().into();
        line["words_for_expected"] = words.iter().map(word).collect();
    }
    line
}

fn print(out: &mut Printed, options: &AskOptions, question: &Question, answer: &Answer) -> Result<(), Failure> {
    let session = question.session.as_ref().map_or_else(String::new, |id| format!("{}: ", id.escape_debug()));
    writeln!(out, "{session}\"{}\"", question.command.escape_debug())?;
    if answer.heard != question.command {
        writeln!(out, "heard as \"{}\"", answer.heard.escape_debug())?;
    }
    for meaning in &answer.understood.meanings {
        let done = if meaning.done { "  (already done here)" } else { "" };
        writeln!(out, "  {:6.3}  {:44} {}{done}", meaning.probability, meaning.words, meaning.name)?;
    }
    let unheard: Vec<String> =
        answer.understood.words.iter().filter(|word| word.is_never_heard()).map(|word| format!("{:?}", word.word)).collect();
    if !unheard.is_empty() {
        writeln!(out, "\nnever heard: {}", unheard.join(", "))?;
    }
    if answer.unread > 0 {
        writeln!(out, "\n{}", unread_words())?;
    }
    verdict(out, options.threshold, answer)?;
    if answer.tied() > 1 {
        writeln!(out, "the plan is for one of {} equally likely", answer.tied())?;
    }
    let purpose = answer.purpose();
    match &answer.plan {
        Some(plan) if plan.actions.is_empty() => writeln!(out, "plan{purpose}: nothing to do")?,
        Some(plan) if plan.is_exact => writeln!(out, "plan{purpose}: {}", plan.actions.join(" "))?,
        Some(plan) => writeln!(out, "plan{purpose}: {} (approximate: a shorter way may exist)", plan.actions.join(" "))?,
        None if answer.verdict(options.threshold) == "done" => writeln!(out, "no plan: it is done already")?,
        None if answer.understood.listened.hypothesis != Hypothesis::Command => writeln!(out, "no plan: I do nothing that I was not told")?,
        None => writeln!(out, "plan{purpose}: none was found")?,
    }
    if let Some((task, words, _)) = &answer.expected {
        let right = answer.task().is_some_and(|name| name.parse().is_ok_and(|it: GroundTaskText| it.is_same(task)));
        writeln!(out, "expected: {words}, {task}{}", if right { "  (right)" } else { "" })?;
    }
    if options.why || options.expected.is_some() {
        words(out, answer)?;
    }
    Ok(())
}

fn verdict(out: &mut impl Write, threshold: Option<f32>, answer: &Answer) -> std::io::Result<()> {
    let percent = |meaning: &Meaning| format!("{} ({:.0} % sure)", meaning.words, 100.0 * meaning.probability);
    let taken_for = answer.understood.listened.hypothesis;
    match (answer.verdict(threshold), answer.understood.meanings.as_slice()) {
        ("done", [first, ..]) => writeln!(out, "\nanswer: already done here: {}", percent(first)),
        ("sure", [first, ..]) => writeln!(out, "\nanswer: {}", percent(first)),
        ("none", _) => writeln!(out, "\nanswer: none of what I can do here; I take it for {taken_for}"),
        (_, [first, second, ..]) if taken_for == Hypothesis::Command => {
            writeln!(out, "\nanswer: unsure: {}, or {}", percent(first), percent(second))
        }
        (_, [_, _, ..]) => writeln!(out, "\nanswer: unsure: I take it for {taken_for}"),
        (_, [first]) if taken_for != Hypothesis::Command => {
            writeln!(out, "\nanswer: unsure: I take it for {taken_for}: {}", percent(first))
        }
        (_, [first]) => writeln!(out, "\nanswer: unsure: {}", percent(first)),
        (_, []) => writeln!(out, "\nanswer: there is nothing to do"),
    }
}

/// Prints the evidence of each word for the answer and for the expected task.
fn words(out: &mut impl Write, answer: &Answer) -> std::io::Result<()> {
    let expected = answer.expected.as_ref().map(|(_, _, words)| words.as_slice()).filter(|words| !words.is_empty());
    let width = |texts: &mut dyn Iterator<Item = &String>| texts.map(|text| text.chars().count()).max().unwrap_or(0).max(14);
    let said = width(&mut answer.understood.words.iter().map(|word| &word.word));
    let token = width(&mut answer.understood.words.iter().chain(expected.unwrap_or(&[])).map(|word| &word.token));
    match expected {
        None => writeln!(out, "\n{:said$}    {:token$}  share of it", "word", "explained by")?,
        Some(_) => {
            writeln!(out, "\n{:said$}    {:token$}  {:token$}  how much more for the prediction", "word", "predicted by", "expected by")?
        }
    }
    for (position, word) in answer.understood.words.iter().enumerate() {
        match expected.and_then(|words| words.get(position)) {
            None => writeln!(out, "  {:said$}  {:token$}  {:6.2}", word.word, word.token, word.share)?,
            Some(other) => {
                let times = word.probability.zip(other.probability).map_or_else(String::new, |(a, b)| format!("{:6.2} times", a / b));
                writeln!(out, "  {:said$}  {:token$}  {:token$}  {times}", word.word, word.token, other.token)?;
            }
        }
    }
    Ok(())
}
