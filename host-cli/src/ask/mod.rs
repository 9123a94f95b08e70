//! `goodbot ask`: what does a command mean here?

use crate::lessons::{evidence, restored};
use crate::load::kinds::TaskKinds;
use crate::load::{home, input, task_name::task_name};
use crate::outcome::Failure;
use clap::{Args, ValueHint};
use goodbot::memory::AgentMemory;
use goodbot::home::Moves;
use goodbot::language::{Meaning, Model};
use goodbot::oomdp::{Domain, Schema, apply};
use goodbot::planning::OptimalSet;
use goodbot::symbols::Symbol;
use goodbot::task::{Role, RoleKind};
use goodbot::{Agent, AgentError};
use goodbot_formats::environment::EnvironmentFile;
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// The longest plan that is printed.
const LONGEST_PLAN: usize = 1_000;

/// The options of `goodbot ask`.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  goodbot ask --model words.goodbot --environment home.json \"go to the orange room\"")]
pub struct AskOptions {
    /// A model that `goodbot learn` wrote
    #[arg(long, value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// An environment (JSON); - is standard input
    #[arg(long, value_name = "ENV.json", value_hint = ValueHint::FilePath)]
    environment: String,
    /// The command
    #[arg(value_name = "COMMAND")]
    command: String,
    /// A kind of task beside the paper's two; may be given several times
    #[arg(long = "lifted", alias = "task", value_name = "TASK", value_parser = TaskKinds::parse)]
    lifted: Vec<goodbot::task::LiftedTask>,
    /// The robot can pull blocks too
    #[arg(long)]
    pull: bool,
    /// Print one line of JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(options: &AskOptions) -> Result<(), Failure> {
    let fault = |error: &dyn std::fmt::Display| Failure::Input(error.to_string());
    let lifted = TaskKinds::and(&options.lifted).map_err(|error| fault(&error))?;
    let mut agent = restored::agent(&options.model, &lifted)?;
    let name = input::name(&options.environment);
    let bytes = input::bytes(&options.environment).map_err(|error| fault(&error))?;
    let text = String::from_utf8(bytes).map_err(|_| Failure::Input(format!("{name}: is no text in UTF-8")))?;
    let environment = EnvironmentFile::parse(&text).map_err(|error| fault(&crate::load::Fault::from_format(name, error)))?;
    let mut memory = home::memory();
    let moves = if options.pull { Moves::PushAndPull } else { Moves::Push };
    let (home, start) = home::build(&environment, moves, &mut memory)
        .map_err(|flaw| Failure::Input(format!("{name}: field \"{}\": {}", flaw.field(), flaw.message(&environment))))?;
    agent.hear(&home, &start, &options.command).map_err(|error| fault(&error))?;
    let best = agent.most_likely().ok_or_else(|| fault(&AgentError::NoTask))?;
    let mut tasks = Vec::new();
    for (position, task) in agent.tasks().iter().enumerate() {
        let Some(kind) = lifted.get(usize::from(task.lifted)) else { continue };
        let text = task_name(&home, kind, task).map_err(|error| fault(&error))?;
        tasks.push((text.to_string(), agent.belief().probability(position)));
    }
    let words = words(&mut agent, &home, &start, best).map_err(|error| fault(&error))?;
    let plan = plan(&mut agent, &home, start, best).map_err(|error| fault(&error))?;
    print(options, tasks, &words, plan.as_ref(), best)
}

/// The actions that lead to a task's goal, and whether there is no shorter way; nothing where they are not known or there are none.
fn plan<D: Domain>(agent: &mut Agent<impl AgentMemory>, home: &D, start: D::State, task: usize) -> Result<Option<(Vec<String>, bool)>, AgentError> {
    let (mut state, mut plan, mut exact) = (start, vec![], true);
    while plan.len() < LONGEST_PLAN {
        agent.plan_fully(home, &state)?;
        let here = agent.planned().optimal(task);
        if here == OptimalSet::Goal {
            return Ok(Some((plan, exact)));
        }
        let Some(actions) = here.onward() else { return Ok(None) };
        exact &= here.exact().is_some();
        let Some((action, next)) = actions.iter().next().and_then(|action| Some((action, apply(home, &state, action)?))) else { break };
        plan.push(home.actions().get(usize::from(action.0)).map_or_else(String::new, |action| action.name.to_owned()));
        state = next;
    }
    Ok(None)
}

/// How a word was explained.
struct Word {
    word: String,
    token: String,
    share: f32,
}

/// The words, each with what the role model takes it for.
fn words_by_roles<D: Domain>(agent: &mut Agent<impl AgentMemory>, home: &D, best: usize) -> Result<Vec<Word>, AgentError> {
    let mut meanings: Vec<Option<(Meaning, f32)>> = vec![None; agent.sentence().len()];
    agent.explain(home, best, |position, meaning, share| {
        if let Some(slot) = meanings.get_mut(position).filter(|slot| slot.is_none_or(|(_, most)| share > most)) {
            *slot = Some((meaning, share));
        }
    })?;
    let language = agent.language();
    let word = |(word, meaning): (&Option<Symbol>, Option<(Meaning, f32)>)| {
        let (meaning, share) = meaning?;
        let token = match meaning {
            Meaning::Background => "NULL".to_owned(),
            Meaning::Task => "task".to_owned(),
            Meaning::Value(role, value) => format!("{} {}", role_name(&home.world().schema, role), language.tokens().text(value)),
        };
        Some(Word { word: word.map_or_else(|| "?".to_owned(), |word| language.words().text(word).to_owned()), token, share })
    };
    Ok(agent.sentence().iter().zip(meanings).filter_map(word).collect())
}

/// A role in words.
fn role_name(schema: &Schema<'_>, role: Role) -> String {
    match role.kind() {
        RoleKind::Goal => format!("goal of {}", schema.proposition_name(role.proposition())),
        RoleKind::Subject => format!("subject of {}", schema.proposition_name(role.proposition())),
        RoleKind::Start => format!("start of {}", schema.proposition_name(role.proposition())),
        RoleKind::OtherPlace | RoleKind::Other => format!("other {}", schema.class_name(role.class())),
    }
}

/// The words, each with the machine token that explains it best in the task's most likely machine command.
fn words<D: Domain>(agent: &mut Agent<impl AgentMemory>, home: &D, start: &D::State, best: usize) -> Result<Vec<Word>, AgentError> {
    if agent.options().language.model == Model::Roles {
        return words_by_roles(agent, home, best);
    }
    let Some(task) = agent.tasks().get(best) else { return Ok(vec![]) };
    let language = agent.language();
    let find = |command: &Vec<String>| -> Option<Vec<Symbol>> { command.iter().map(|token| language.tokens().find(token)).collect() };
    let commands: Vec<Vec<Symbol>> = evidence::commands(home, agent.lifted(), task, start, agent.options())?.iter().filter_map(find).collect();
    let sentence = agent.sentence();
    let likelier = |best: Option<Vec<Symbol>>, command: Vec<Symbol>| match best {
        Some(best) if !language.likelihood(sentence, &command).exceeds(language.likelihood(sentence, &best)) => Some(best),
        _ => Some(command),
    };
    let Some(command) = commands.into_iter().fold(None, likelier) else { return Ok(vec![]) };
    Ok(crate::lessons::training::explained(language, sentence, &command)
        .into_iter()
        .map(|it| Word {
            token: if it.probability.is_some() { it.token } else { "never heard".to_owned() },
            word: it.word,
            share: it.share,
        })
        .collect())
}

fn print(options: &AskOptions, mut tasks: Vec<(String, f32)>, words: &[Word], plan: Option<&(Vec<String>, bool)>, best: usize) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let (said, likeliest) = tasks.get(best).cloned().unwrap_or_default();
    let tied = tasks.iter().filter(|&&(_, share)| share >= likeliest).count();
    if options.json {
        let tasks: serde_json::Map<_, _> = tasks.into_iter().map(|(name, share)| (name, json!(share))).collect();
        let words: Vec<_> = words.iter().map(|it| json!({"word": it.word, "token": it.token, "share": it.share})).collect();
        let (exact, plan) = (plan.map(|(_, exact)| exact), plan.map(|(actions, _)| actions));
        let line =
            json!({"type": "answer", "command": options.command, "task": said, "tied": tied, "tasks": tasks, "plan": plan, "exact": exact, "words": words});
        writeln!(out, "{line}")?;
        return Ok(());
    }
    tasks.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (name, share) in &tasks {
        writeln!(out, "{share:6.3}  {name}")?;
    }
    if tied > 1 {
        writeln!(out, "\nthe plan is for {said}, one of {tied} equally likely")?;
    }
    match plan {
        Some((plan, _)) if plan.is_empty() => writeln!(out, "\nplan: nothing to do")?,
        Some((plan, true)) => writeln!(out, "\nplan: {}", plan.join(" "))?,
        Some((plan, false)) => writeln!(out, "\nplan: {} (approximate: a shorter way may exist)", plan.join(" "))?,
        None => writeln!(out, "\nplan: none was found")?,
    }
    writeln!(out, "\nword explained by")?;
    words.iter().try_for_each(|it| writeln!(out, "  {:12} {:16} {:.2}", it.word, it.token, it.share))?;
    Ok(())
}
