//! `goodbot ask`: the meaning of a command in a home or world.
//!
//! - [`meanings`]: the possible meanings, including tasks that are done already;
//! - [`following`]: several tasks in order, and prohibitions;
//! - [`plan`]: the actions that lead to a goal;
//! - [`why`]: the evidence of each word for a task;
//! - [`drawing`]: the home as text;
//! - [`in_world`]: commands in a world from a file, which has no home to draw.

mod drawing;
mod following;
mod in_world;
pub mod meanings;
mod plan;
mod why;

use clap::{Args, ValueHint};
use following::{Followed, Step};
use goodbot::Agent;
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::home::Map;
use goodbot::home::{Home, HomeState, Moves};
use goodbot::language::{Synonyms, first_words};
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::talk::{ClosedWords, Hypothesis, Listened, Verdict};
use goodbot_console::load::closed_words::ClosedWordOptions;
use goodbot_console::load::input;
use goodbot_console::load::kinds::TaskKinds;
use goodbot_console::load::synonyms::{SynonymOptions, said_in_known_words};
use goodbot_console::messages::{counted, tell};
use goodbot_console::outcome::Failure;
use goodbot_console::printed::Printed;
use goodbot_console::restored;
use goodbot_console::starter::StarterOptions;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::SessionReader;
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_lesson::checked::moves;
use goodbot_lesson::name::{in_words, task_name};
use goodbot_lesson::{Fault, home};
use meanings::{Interpretation, Meaning};
use plan::{Plan, plan};
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;
use why::Word;

/// The name of a plain command among the kinds of utterance.
const COMMAND: &str = "a command";
/// The belief from which on a robot with few lessons is sure.
pub const SURE: f32 = 0.5;

/// The options of `goodbot ask`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct AskOptions {
    /// A model that `goodbot learn` wrote
    #[arg(long, short = 'w', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    with: PathBuf,
    /// A home, as JSON or drawn as text, or a world from a file; - is standard input
    #[arg(long, short = 'e', value_name = "HOME", value_hint = ValueHint::FilePath, required_unless_present = "log")]
    environment: Option<String>,
    /// The command, in as many words as you like; - asks each line of standard input
    #[arg(value_name = "COMMAND", required_unless_present = "log")]
    command: Vec<String>,
    /// Ask the commands of a session log, each in its own home, and compare with the intended tasks
    #[arg(long, short = 'l', value_name = "LOG", value_hint = ValueHint::FilePath, conflicts_with_all = ["environment", "command", "pull"])]
    log: Option<String>,
    /// Ask the session of this id alone
    #[arg(long, value_name = "ID", requires = "log")]
    session: Option<String>,
    /// Show word by word what supports the answer
    #[arg(long)]
    why: bool,
    /// The intended task, such as "agentInRoom(agent0,room1)": shows word by word what supports it, and what supports the answer
    #[arg(long, value_name = "TASK", value_parser = expected)]
    expected: Option<GroundTaskText>,
    /// Below this probability the answer is "unsure"; by default 0.5, and after 20 lessons by the number of lessons
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
Tasks that are done already are possible meanings too; the plan is for the most likely task that is not done. After 20 lessons the robot also \
tells the kind of sentence: a command, nothing that it can do, a thing that is not here, several commands, a prohibition, talk. With fewer \
lessons, each unknown word makes the answer less sure.

Refused commands are reported on standard error; the others are asked.

With --json, \"tasks\" are the robot's beliefs about the tasks that are still to do; \"meanings\" are the table that is shown without --json. A \
command that is refused has a line of the type \"error\".

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
    environment: EnvironmentFile,
    moves: Moves,
    command: String,
    expected: Option<GroundTaskText>,
}

/// The answer to a question.
struct Answer {
    /// The command with unknown words replaced by known synonyms.
    heard: String,
    /// The robot's belief about tasks that are still to do, in order.
    tasks: Vec<(String, f32)>,
    /// The position of the most likely one.
    best: usize,
    meanings: Vec<Meaning>,
    /// The kind of utterance; `None` if the robot has too few lessons to tell.
    listened: Option<Listened>,
    /// The tasks and the plan, if it is no plain command.
    followed: Option<Followed>,
    words: Vec<Word>,
    /// The intended task, its words, and how it explains the command's words.
    expected: Option<(GroundTaskText, String, Vec<Word>)>,
    plan: Option<Plan>,
    /// The most likely tasks, each with the state in which it begins, and the state in which they end.
    steps: Vec<Step>,
    end: HomeState,
    /// How many words were not read.
    unread: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &AskOptions) -> Result<(), Failure> {
    if let Some(questions) = in_world::questions(options)? {
        return in_world::ask(options, &questions);
    }
    let lifted = options.kinds.of_model(&options.with)?;
    let starter = options.starter.of_model(&options.with, &lifted)?;
    let mut agent = restored::agent_beside(&options.with, &lifted, &starter)?;
    let (synonyms, closed) = (options.synonyms.read()?, options.closed_words.read()?);
    let mut out = Printed::stdout();
    let mut state = None;
    let questions = questions(options)?;
    let mut refused = 0_usize;
    for (number, question) in questions.iter().enumerate() {
        let mut memory = home::memory();
        let (home, start) = home::build(&question.environment, question.moves, &mut memory).map_err(|flaw| {
            Failure::Input(format!("{}: field \"{}\": {}", question.source, flaw.field(), flaw.message(&question.environment)))
        })?;
        let start = state.unwrap_or(start);
        let answer = match answer(&mut agent, &home, &start, question, synonyms, closed) {
            // The other commands are still asked.
            Err(Failure::Input(message)) if questions.len() > 1 => {
                refused += 1;
                tell_refused(&mut out, options, &question.command, &message)?;
                continue;
            }
            answer => answer?,
        };
        if options.conversation && ["sure", "done"].contains(&answer.verdict(options.threshold)) {
            answer.steps.iter().for_each(|(task, before)| agent.remember(&home, before, task));
            state = Some(answer.end);
        }
        if options.json {
            writeln!(out, "{}", to_json(&answer, question, options.threshold))?;
            continue;
        }
        if number > 0 {
            writeln!(out)?;
        }
        print(&mut out, options, question, &answer, &Map::new(&home, &start))?;
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

fn questions(options: &AskOptions) -> Result<Vec<Question>, Failure> {
    if let Some(log) = &options.log {
        return sessions(options, log);
    }
    let Some(file) = &options.environment else { return Ok(vec![]) };
    let commands = match options.command.as_slice() {
        [only] if only == "-" && file == "-" => {
            let message = "the home and the commands cannot both come from standard input; name a file for the home";
            return Err(Failure::Input(message.to_owned()));
        }
        [only] if only == "-" => lines()?,
        words => vec![words.join(" ")],
    };
    let environment = input::home(file)?;
    let moves = if options.pull { Moves::PushAndPull } else { Moves::Push };
    let question = |command| Question {
        session: None,
        source: input::name(file).to_owned(),
        environment: environment.clone(),
        moves,
        command,
        expected: options.expected.clone(),
    };
    Ok(commands.into_iter().map(question).collect())
}

/// The commands of standard input, one on each line.
fn lines() -> Result<Vec<String>, Failure> {
    const MOST: usize = 100_000;
    let mut commands = Vec::new();
    for line in input::text("-")?.lines() {
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

fn sessions(options: &AskOptions, log: &str) -> Result<Vec<Question>, Failure> {
    let name = input::name(log);
    let mut questions = Vec::new();
    for recorded in SessionReader::new(input::log(log)?) {
        let recorded = recorded.map_err(|error| Fault::from_format(name, error))?;
        let header = recorded.header;
        if options.session.is_some() && header.id != options.session {
            continue;
        }
        let intended = header.meant().and_then(Result::ok);
        questions.push(Question {
            source: format!("{name}:{}", recorded.header_line),
            moves: moves(header.action_names()).unwrap_or(Moves::Push),
            session: header.id,
            environment: header.environment,
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
    home: &Home<impl HomeMemory>,
    start: &HomeState,
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
    let Interpretation { listened, followed, steps, meanings } = meanings::meanings(agent, home, start, &heard, closed)?;
    let mut tasks = Vec::new();
    for (position, task) in agent.tasks().iter().enumerate() {
        let Some(kind) = agent.lifted().get(usize::from(task.lifted)) else { continue };
        let text = task_name(home, kind, task).map_err(|error| Failure::Input(error.to_string()))?;
        tasks.push((text, agent.belief().probability(position)));
    }
    let to_do = meanings.iter().find(|meaning| !meaning.done).filter(|_| listened.is_some());
    let position = to_do.and_then(|meaning| tasks.iter().position(|(name, _)| name.to_string() == meaning.name));
    let best = position.or_else(|| agent.most_likely()).unwrap_or(0);
    let expected = match &question.expected {
        None => None,
        Some(task) => {
            let position = tasks.iter().position(|(name, _)| name.is_same(task));
            let grounded = position.and_then(|position| agent.tasks().get(position));
            let kind = grounded.and_then(|grounded| agent.lifted().get(usize::from(grounded.lifted)));
            let done = meanings.iter().find(|it| it.done && it.name.parse().is_ok_and(|name: GroundTaskText| name.is_same(task)));
            match (grounded.zip(kind), position, done) {
                (Some((grounded, kind)), Some(position), _) => {
                    let text = in_words(home, kind, grounded);
                    let words = why::words(agent, home, start, read, position)?;
                    Some((task.clone(), text, words))
                }
                (_, _, Some(done)) => Some((task.clone(), done.words.clone(), vec![])),
                _ if is_of_parts(task) => Some((task.clone(), "several parts".to_owned(), vec![])),
                _ => {
                    let known: Vec<&str> = meanings.iter().map(|meaning| meaning.name.as_str()).collect();
                    let message = format!("{}: {task} is no task here; tasks are {}", question.source, known.join(", "));
                    return Err(Failure::Input(message));
                }
            }
        }
    };
    let words = why::words(agent, home, start, read, best)?;
    let is_to_do = listened.is_none_or(|listened| listened.hypothesis == Hypothesis::Command && listened.verdict != Verdict::Done);
    let (plan, end) = match &followed {
        Some(followed) => (followed.plan.clone().filter(|_| followed.verdict == Verdict::Sure), followed.end),
        None if tasks.is_empty() || !is_to_do => (None, *start),
        None => plan(agent, home, *start, best)?.map_or((None, *start), |(plan, end)| (Some(plan), end)),
    };
    let tasks = tasks.into_iter().map(|(name, probability)| (name.to_string(), probability)).collect();
    let unread = if followed.is_some() { 0 } else { unread };
    Ok(Answer { heard, tasks, best, meanings, listened, followed, words, expected, plan, steps, end, unread })
}

/// Whether a task is a prohibition, or several tasks in order.
fn is_of_parts(task: &GroundTaskText) -> bool {
    !task.way().before.is_empty() || task.atoms().iter().any(GroundAtomText::is_negated)
}

impl Answer {
    fn tied(&self) -> usize {
        let likeliest = self.tasks.get(self.best).map_or(0.0, |(_, share)| *share);
        self.tasks.iter().filter(|&&(_, share)| share >= likeliest).count()
    }

    /// The purpose of the plan, if the likeliest meaning is done already and the plan is for another.
    fn purpose(&self) -> String {
        let planned = self.tasks.get(self.best).map(|(name, _)| name);
        match (self.meanings.first(), self.meanings.iter().find(|meaning| Some(&meaning.name) == planned)) {
            (Some(first), Some(planned)) if first.done => format!(" to {}, which is still to do", planned.words),
            _ => String::new(),
        }
    }

    /// The kind of utterance.
    fn taken_for(&self) -> String {
        self.listened.map_or_else(|| COMMAND.to_owned(), |listened| listened.hypothesis.to_string())
    }

    /// The most likely task. It is one that is still to do, unless a robot that listens answers that the task is done.
    fn task(&self) -> Option<&String> {
        match (&self.listened, self.meanings.first()) {
            (_, Some(first)) if self.followed.is_some() => Some(&first.name),
            (Some(listened), Some(first)) if listened.verdict == Verdict::Done => Some(&first.name),
            _ => self.tasks.get(self.best).map(|(name, _)| name),
        }
    }

    /// `sure`, `unsure`, `done` or `none`.
    fn verdict(&self, threshold: Option<f32>) -> &'static str {
        let first = self.meanings.first();
        let is_sure = match (&self.listened, threshold) {
            (Some(listened), None) => {
                let verdict = self.followed.as_ref().map_or(listened.verdict, |followed| followed.verdict);
                matches!(verdict, Verdict::Sure | Verdict::Done)
            }
            (_, threshold) => first.is_some_and(|first| first.probability >= threshold.unwrap_or(SURE)),
        };
        match (is_sure, first) {
            (true, Some(Meaning { done: true, .. })) => "done",
            (true, _) => "sure",
            _ if self.listened.is_some_and(|listened| listened.verdict == Verdict::None) => "none",
            _ => "unsure",
        }
    }
}

fn to_json(answer: &Answer, question: &Question, threshold: Option<f32>) -> serde_json::Value {
    let tasks: serde_json::Map<_, _> = answer.tasks.iter().map(|(name, share)| (name.clone(), json!(share))).collect();
    let word = |it: &Word| json!({"word": it.word, "token": it.token, "share": it.share, "probability": it.probability});
    let meaning = |it: &Meaning| json!({"task": it.name, "words": it.words, "probability": it.probability, "done": it.done});
    let mut line = json!({
        "type": "answer", "command": question.command, "task": answer.task(), "tied": answer.tied(),
        "tasks": tasks, "plan": answer.plan.as_ref().map(|plan| &plan.actions), "exact": answer.plan.as_ref().map(|plan| plan.is_exact), "words": answer.words.iter().map(word).collect::<Vec<_>>(),
        "taken_for": answer.taken_for(), "verdict": answer.verdict(threshold), "meanings": answer.meanings.iter().map(meaning).collect::<Vec<_>>(),
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

fn print(
    out: &mut Printed,
    options: &AskOptions,
    question: &Question,
    answer: &Answer,
    map: &Map<'_, impl HomeMemory>,
) -> Result<(), Failure> {
    drawing::draw(out, map)?;
    let session = question.session.as_ref().map_or_else(String::new, |id| format!("{}: ", id.escape_debug()));
    writeln!(out, "\n{session}\"{}\"", question.command.escape_debug())?;
    if answer.heard != question.command {
        writeln!(out, "heard as \"{}\"", answer.heard.escape_debug())?;
    }
    for meaning in &answer.meanings {
        let done = if meaning.done { "  (already done here)" } else { "" };
        writeln!(out, "  {:6.3}  {:44} {}{done}", meaning.probability, meaning.words, meaning.name)?;
    }
    let unheard: Vec<String> =
        answer.words.iter().filter(|word| word.probability.is_none()).map(|word| format!("{:?}", word.word)).collect();
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
    let purpose = if answer.followed.is_some() { String::new() } else { answer.purpose() };
    match &answer.plan {
        Some(plan) if plan.actions.is_empty() => writeln!(out, "plan{purpose}: nothing to do")?,
        Some(plan) if plan.is_exact => writeln!(out, "plan{purpose}: {}", plan.actions.join(" "))?,
        Some(plan) => writeln!(out, "plan{purpose}: {} (approximate: a shorter way may exist)", plan.actions.join(" "))?,
        None if answer.verdict(options.threshold) == "done" => writeln!(out, "no plan: it is done already")?,
        None if answer.taken_for() != COMMAND => writeln!(out, "no plan: I do nothing that I was not told")?,
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
    match (answer.verdict(threshold), answer.meanings.as_slice()) {
        ("done", [first, ..]) => writeln!(out, "\nanswer: already done here: {}", percent(first)),
        ("sure", [first, ..]) => writeln!(out, "\nanswer: {}", percent(first)),
        ("none", _) => writeln!(out, "\nanswer: none of what I can do here; I take it for {}", answer.taken_for()),
        (_, [first, second, ..]) if answer.taken_for() == COMMAND => {
            writeln!(out, "\nanswer: unsure: {}, or {}", percent(first), percent(second))
        }
        (_, [_, _, ..]) => writeln!(out, "\nanswer: unsure: I take it for {}", answer.taken_for()),
        (_, [first]) if answer.taken_for() != COMMAND => {
            writeln!(out, "\nanswer: unsure: I take it for {}: {}", answer.taken_for(), percent(first))
        }
        (_, [first]) => writeln!(out, "\nanswer: unsure: {}", percent(first)),
        (_, []) => writeln!(out, "\nanswer: there is nothing to do"),
    }
}

/// Prints the evidence of each word for the answer and for the expected task.
fn words(out: &mut impl Write, answer: &Answer) -> std::io::Result<()> {
    let expected = answer.expected.as_ref().map(|(_, _, words)| words.as_slice()).filter(|words| !words.is_empty());
    let width = |texts: &mut dyn Iterator<Item = &String>| texts.map(|text| text.chars().count()).max().unwrap_or(0).max(14);
    let said = width(&mut answer.words.iter().map(|word| &word.word));
    let token = width(&mut answer.words.iter().chain(expected.unwrap_or(&[])).map(|word| &word.token));
    match expected {
        None => writeln!(out, "\n{:said$}    {:token$}  share of it", "word", "explained by")?,
        Some(_) => {
            writeln!(out, "\n{:said$}    {:token$}  {:token$}  how much more for the prediction", "word", "predicted by", "expected by")?
        }
    }
    for (position, word) in answer.words.iter().enumerate() {
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
