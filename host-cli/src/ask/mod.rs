//! `goodbot ask`: the meaning of a command in a home or world.
//!
//! The robot listens to the command once, as `goodbot teach` does: in homes and in worlds from files, from the first lesson on.
//!
//! - [`meanings`]: the place, what the robot hears there, with the possible meanings and the actions that lead to a goal;
//! - [`why`]: the evidence of each word for a task;
//! - [`told`]: commands in worlds without actions, where no robot listens.

mod meanings;
mod told;
mod why;

use super::teach::site::{Setting, Site, SiteState};
use clap::{Args, ValueHint};
use goodbot::Agent;
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::home::Map;
use goodbot::language::{Synonyms, first_words};
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::talk::{ClosedWords, Hypothesis, Verdict, Weights};
use goodbot_console::load::input::Place;
use goodbot_console::load::words::said_in_known_words;
use goodbot_console::messages::{is_colored, tell};
use goodbot_console::training_data::worlds;
use goodbot_console::whole_file::options_of_model;
use goodbot_console::{ClosedWordOptions, Failure, InputFile, Printed, StarterOptions, SynonymOptions, TaskKinds, counted, input};
use goodbot_lesson::Fault;
use meanings::{Interpretation, Meaning, Plan, plan};
use serde_json::json;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use told::Told;
use why::Word;

/// The options of `goodbot ask`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct AskOptions {
    /// A model that `goodbot learn` wrote
    #[arg(long, short = 'w', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    with: PathBuf,
    /// A home, as JSON or drawn as text, or a world from a file; - is standard input
    #[arg(long, short = 'e', value_name = "HOME", value_hint = ValueHint::FilePath)]
    environment: InputFile,
    /// The command, in as many words as you like; - asks each line of standard input
    #[arg(value_name = "COMMAND", required = true)]
    command: Vec<String>,
    /// Show word by word what supports the answer
    #[arg(long)]
    why: bool,
    #[command(flatten)]
    synonyms: SynonymOptions,
    #[command(flatten)]
    closed_words: ClosedWordOptions,
    /// What decides whether the robot acts on what was said, in place of the built-in weights (goodbot acts --weights writes such a file)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    acts: Option<InputFile>,
    #[command(flatten)]
    kinds: TaskKinds,
    #[command(flatten)]
    starter: StarterOptions,
    /// The robot can pull blocks too
    #[arg(long)]
    pull: bool,
    /// Each command begins where the one before ends, and may refer to it: "put it back", "go there", "again"
    #[arg(long)]
    conversation: bool,
    /// Print a line of JSON for each command
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Tasks that are done already are possible meanings too; the plan is for the most likely task that is not done. The robot also tells the kind of \
sentence: a command, nothing that it can do, a thing that is not here, several commands, a prohibition, talk. In a world without actions no robot \
listens, and every answer is \"unsure\".

Refused commands are reported on standard error; the others are asked.

With --json, \"tasks\" are the probabilities of the tasks if the sentence is a command, or its first command; \"meanings\" are the table that is \
shown without --json. A command that is refused has a line of the type \"error\".

Examples:
  goodbot ask --with words.goodbot --environment home.json go to the orange room
  goodbot ask --with words.goodbot --environment home.json --why take the bag to the blue room
  goodbot ask --with words.goodbot --environment home.json --synonyms words.txt go to the crimson room
  printf 'go to the red room\\nthen go back\\n' | goodbot ask --with words.goodbot --environment home.json --conversation -
  echo \"go to the red room\" | goodbot ask --with words.goodbot --environment home.json -";

/// The answer to a command.
struct Answer {
    /// The command with unknown words replaced by known synonyms.
    heard: String,
    understood: Interpretation,
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
    let (setting, commands) = match asked(options)? {
        Asked::Heard(setting, commands) => (setting, commands),
        Asked::Told(commands) => return told::ask(options, &commands),
    };
    let (mut agent, site, mut start) = meanings::robot(options, &setting)?;
    let (synonyms, closed) = (options.synonyms.read()?, options.closed_words.read()?);
    let weights = options.acts.as_ref().map(|file| Ok::<_, Failure>((file, input::bytes(file)?))).transpose()?;
    let closed = match &weights {
        Some((file, bytes)) => closed.weighed(Weights::new(bytes).map_err(|error| Fault::new(input::name(file), error))?),
        None => closed,
    };
    let mut out = Printed::stdout();
    let mut refused = 0_usize;
    for (number, command) in commands.iter().enumerate() {
        let answer = match answer(&mut agent, &site, &start, command, synonyms, closed) {
            // The other commands are still asked.
            Err(Failure::Input(message)) if commands.len() > 1 => {
                refused += 1;
                tell_refused(&mut out, options, command, &message)?;
                continue;
            }
            answer => answer?,
        };
        let before = start;
        if options.conversation && ["sure", "done"].contains(&answer.verdict()) {
            answer.understood.steps.iter().for_each(|(task, before)| agent.remember(&site, before, task));
            start = answer.end;
        }
        if options.json {
            writeln!(out, "{}", to_json(&answer, command))?;
            continue;
        }
        if number > 0 {
            writeln!(out)?;
        }
        if let (Site::Floor(home), SiteState::Floor(before)) = (&site, &before) {
            draw(&mut out, &Map::new(home, before))?;
            writeln!(out)?;
        }
        print(&mut out, options, command, &answer)?;
    }
    out.flush()?;
    end(refused, commands.len())
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

/// The commands: to a robot that listens in a place, or in a world where none does.
enum Asked {
    Heard(Setting, Vec<String>),
    Told(Vec<Told>),
}

fn asked(options: &AskOptions) -> Result<Asked, Failure> {
    let are_read = matches!(options.command.as_slice(), [only] if only == "-");
    if are_read && options.environment.is_standard() {
        let message = "the place and the commands cannot both come from standard input; name a file for the place";
        return Err(Failure::Input(message.to_owned()));
    }
    let place = input::place(&options.environment)?;
    if matches!(place, Place::World(_)) && (options.pull || options.starter.is_given()) {
        return Err(Failure::Input("--pull and --starter are for homes; leave them out in a world from a file".to_owned()));
    }
    let commands = if are_read { lines()? } else { vec![options.command.join(" ")] };
    let world = match place {
        Place::Home(home) => return Ok(Asked::Heard(Setting::Floor(home), commands)),
        Place::World(read) => read.world,
    };
    if !world.actions.is_empty() {
        return Ok(Asked::Heard(Setting::Other(Arc::new(world)), commands));
    }
    // No robot listens here and tells why.
    if options.why || options.conversation || options.acts.is_some() {
        let message = "--why, --conversation and --acts are for homes, and for worlds with actions; leave them out here";
        return Err(Failure::Input(message.to_owned()));
    }
    let model = options_of_model(&options.with)?;
    let told = |command: &String| match worlds::question(input::name(&options.environment), &world, command, model) {
        // The other commands are still asked.
        Err(refused) if commands.len() > 1 && refused.field.as_deref() == Some("command") => Ok(Err((command.clone(), refused.message))),
        told => Ok(Ok(told?)),
    };
    commands.iter().map(told).collect::<Result<_, Failure>>().map(Asked::Told)
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

fn answer(
    agent: &mut Agent<impl AgentMemory>,
    site: &Site,
    start: &SiteState,
    command: &str,
    synonyms: Synonyms<'_>,
    closed: ClosedWords<'_>,
) -> Result<Answer, Failure> {
    let first = first_words(command);
    // The blank between belongs to the rest.
    let first = first.trim_end();
    let unheard = command.get(first.len()..).unwrap_or("");
    // Commas separate commands, and a question mark shows a question, so both are kept.
    let heard = said_in_known_words(synonyms, agent.language(), first)?.into_owned() + unheard;
    let read = first_words(&heard);
    let unread = heard.get(read.len()..).map_or(0, |rest| rest.split_whitespace().count());
    let understood = meanings::meanings(agent, site, start, (&heard, read), closed)?;
    let listened = &understood.listened;
    let is_to_do = listened.hypothesis == Hypothesis::Command && listened.verdict != Verdict::Done;
    let (plan, end) = match (&understood.followed, understood.best) {
        (Some(followed), _) => (followed.plan.clone().filter(|_| followed.verdict == Verdict::Sure), followed.end),
        (None, Some(best)) if is_to_do => plan(agent, site, *start, best)?.map_or((None, *start), |(plan, end)| (Some(plan), end)),
        (None, _) => (None, *start),
    };
    let unread = if understood.followed.is_some() { 0 } else { unread };
    Ok(Answer { heard, understood, plan, end, unread })
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
    fn verdict(&self) -> &'static str {
        let Interpretation { listened, followed, meanings, .. } = &self.understood;
        let verdict = followed.as_ref().map_or(listened.verdict, |followed| followed.verdict);
        let is_sure = matches!(verdict, Verdict::Sure | Verdict::Done);
        match (is_sure, meanings.first()) {
            (true, Some(Meaning { done: true, .. })) => "done",
            (true, _) => "sure",
            _ if listened.verdict == Verdict::None => "none",
            _ => "unsure",
        }
    }
}

fn to_json(answer: &Answer, command: &str) -> serde_json::Value {
    let Interpretation { tasks, words, meanings, listened, .. } = &answer.understood;
    let tasks: serde_json::Map<_, _> = tasks.iter().map(|task| (task.name.clone(), json!(task.probability))).collect();
    let word = |it: &Word| {
        let mut word = json!({"word": it.word, "token": it.token, "share": it.share, "probability": it.probability});
        if let Some(known) = &it.taken_for {
            word["taken_for"] = known.as_str().into();
        }
        word
    };
    let meaning = |it: &Meaning| json!({"task": it.name, "words": it.words, "probability": it.probability, "done": it.done});
    let mut line = json!({
        "type": "answer", "command": command, "task": answer.task(), "tied": answer.tied(),
        "tasks": tasks, "plan": answer.plan.as_ref().map(|plan| &plan.actions), "exact": answer.plan.as_ref().map(|plan| plan.is_exact), "words": words.iter().map(word).collect::<Vec<_>>(),
        "taken_for": listened.hypothesis.to_string(), "verdict": answer.verdict(), "meanings": meanings.iter().map(meaning).collect::<Vec<_>>(),
    });
    if answer.heard != command {
        line["heard"] = answer.heard.as_str().into();
    }
    if answer.unread > 0 {
        line["unread"] = answer.unread.into();
    }
    line
}

fn print(out: &mut Printed, options: &AskOptions, command: &str, answer: &Answer) -> Result<(), Failure> {
    writeln!(out, "\"{}\"", command.escape_debug())?;
    if answer.heard != command {
        writeln!(out, "heard as \"{}\"", answer.heard.escape_debug())?;
    }
    for meaning in &answer.understood.meanings {
        let done = if meaning.done { "  (already done here)" } else { "" };
        writeln!(out, "  {:6.3}  {:44} {}{done}", meaning.probability, meaning.words, meaning.name)?;
    }
    let said = answer.understood.words.iter().map(|word| (word.word.as_str(), word.is_never_heard(), word.taken_for.as_deref()));
    let new = why::new_words(said);
    if !new.is_empty() {
        writeln!(out, "\n{}", new.join("\n"))?;
    }
    if answer.unread > 0 {
        writeln!(out, "\n{}", unread_words())?;
    }
    verdict(out, answer)?;
    if answer.tied() > 1 {
        writeln!(out, "the plan is for one of {} equally likely", answer.tied())?;
    }
    let purpose = answer.purpose();
    match &answer.plan {
        Some(plan) if plan.actions.is_empty() => writeln!(out, "plan{purpose}: nothing to do")?,
        Some(plan) if plan.is_exact => writeln!(out, "plan{purpose}: {}", plan.actions.join(" "))?,
        Some(plan) => writeln!(out, "plan{purpose}: {} (approximate: a shorter way may exist)", plan.actions.join(" "))?,
        None if answer.verdict() == "done" => writeln!(out, "no plan: it is done already")?,
        None if answer.understood.listened.hypothesis != Hypothesis::Command => writeln!(out, "no plan: I do nothing that I was not told")?,
        None => writeln!(out, "plan{purpose}: none was found")?,
    }
    if options.why {
        words(out, answer)?;
    }
    Ok(())
}

fn verdict(out: &mut impl Write, answer: &Answer) -> std::io::Result<()> {
    let percent = |meaning: &Meaning| format!("{} ({:.0} % sure)", meaning.words, 100.0 * meaning.probability);
    let taken_for = answer.understood.listened.hypothesis;
    match (answer.verdict(), answer.understood.meanings.as_slice()) {
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

/// Prints the evidence of each word for the answer.
fn words(out: &mut impl Write, answer: &Answer) -> std::io::Result<()> {
    let words = &answer.understood.words;
    let width = |text: fn(&Word) -> &String| words.iter().map(|word| text(word).chars().count()).max().unwrap_or(0).max(14);
    let (said, token) = (width(|word| &word.word), width(|word| &word.token));
    writeln!(out, "\n{:said$}    {:token$}  share of it", "word", "explained by")?;
    for word in words {
        writeln!(out, "  {:said$}  {:token$}  {:6.2}", word.word, word.token, word.share)?;
    }
    Ok(())
}

/// Draws a home.
///
/// # Errors
/// The error of the output.
pub fn draw(out: &mut Printed, map: &Map<'_, impl HomeMemory>) -> io::Result<()> {
    for line in map.to_string().lines() {
        write!(out, "  ")?;
        for character in line.chars() {
            match code(character).filter(|_| is_colored()) {
                Some(code) => out.paint(code, character.encode_utf8(&mut [0; 4]))?,
                None => write!(out, "{character}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The terminal's colour for a letter of the drawing.
fn code(character: char) -> Option<u8> {
    Some(match character {
        'r' => 31,
        'g' => 32,
        'b' => 34,
        'y' | 'o' => 33,
        'p' => 35,
        't' => 36,
        '@' => 1,
        _ => return None,
    })
}
