//! `goodbot learn`: trains a model on recorded sessions.

use clap::{Args, ValueHint};
use goodbot::{Agent, Capacities};
use goodbot_console::load::kinds::with_kinds;
use goodbot_console::training_data::LogOptions;
use goodbot_console::{
    Believes, Failure, InputFile, Kind, Learner, Limit, Output, StarterOptions, TaskKinds, counted, output, training, training_data, typed,
};
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// The options of `goodbot learn`.
#[derive(Debug, Args)]
#[command(after_help = "\
All sessions are learned from at once, in no order. The evidence of a session about its task is its steps, not its words.
Sessions that are marked not to be learned from are checked and left out. The model keeps its kinds of task: ask, teach and evaluate --with use them.

Example:
  goodbot learn turk-simplified.jsonl --out words.goodbot
  goodbot learn few.jsonl --starter en --out words.goodbot
  goodbot learn --starter en --learner roles --out starter.goodbot")]
pub struct LearnOptions {
    /// Session logs (JSON Lines): feedback, demonstrations or labels; - is standard input
    #[arg(required_unless_present = "starter", value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<InputFile>,
    /// The model file to write; - is standard output
    #[arg(long, short = 'o', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    out: PathBuf,
    #[command(flatten)]
    kinds: TaskKinds,
    /// The settings of the language model
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    learner: Learner,
    #[command(flatten)]
    starter: StarterOptions,
    /// The trainers to expect, in place of those that the sessions name: population (real people, whose ends of sessions are evidence, as in teach),
    /// logged, paper, or probabilities. By default a session without strategies has the paper's trainer
    #[arg(long, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON[,LAGS]", allow_hyphen_values = true)]
    believes: Option<Believes>,
    /// Replace a file that is no model
    #[arg(long)]
    force: bool,
    /// Leave out the session of this id; may be given several times
    #[arg(long, value_name = "ID")]
    without: Vec<String>,
    #[command(flatten)]
    limit: Limit,
    /// Skip sessions with faults, and count them
    #[arg(long)]
    keep_going: bool,
    /// Print a summary of the training data as a line of JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(options: &LearnOptions) -> Result<(), Failure> {
    let lifted = options.kinds.lifted()?;
    let target = Output::new(Kind::Model, &options.out, &options.files, options.force)?;
    let log_options = LogOptions { believes: options.believes.clone(), keep_going: options.keep_going, limit: options.limit };
    let training_data::Lessons { mut lessons, skipped, with_way, no_task, long } =
        training_data::read(&options.files, &lifted, options.learner.options(), &log_options)?;
    if let Some(unknown) = options.without.iter().find(|id| lessons.iter().all(|lesson| lesson.id != **id)) {
        return Err(Failure::Input(format!("no session has the id {unknown:?}; check --without")));
    }
    lessons.retain(|lesson| !options.without.contains(&lesson.id));
    let learned = lessons.iter().filter(|lesson| lesson.learn).count();
    if learned == 0 && !options.starter.is_given() {
        return Err(Failure::Input("no session is to be learned from; set \"learn\" to true at the end of one".to_owned()));
    }
    let starter = options.starter.read(&lifted, options.learner.options())?;
    let own = lessons.len();
    lessons.extend(starter.beside(learned).cloned());
    let capacities = training::capacities(&lessons, Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD });
    let settings = options.learner.options().language;
    let room = || typed::memory(&capacities, &settings, training::tasks(&lessons));
    let mut memory = room();
    // A model file keeps the training data, and whoever reads it trains on them: so nothing is trained here.
    let model = training::data(&mut memory, lessons.iter(), settings)?;
    let words = model.saved()?;
    // The saved file is the whole robot: the same training data, with its options, trainer strategies and kinds of task. Lessons from world
    // files have no vocabulary of the core's.
    let of_worlds = lessons.iter().any(|lesson| lesson.world.is_some());
    let tasks = if of_worlds { &[][..] } else { &lifted };
    let mut agent = Agent::new(room(), tasks, options.learner.options())?;
    let _ = agent.join(&words)?;
    let file = agent.saved()?;
    // A world names its own kinds of task.
    let file = if of_worlds { file } else { with_kinds(file, &lifted) };
    target.write(&file)?;
    let numbers = model.read().bitext().sessions() - lessons.iter().filter(|lesson| lesson.learn).count();
    let (words, tokens, pairs) = (model.read().words().len(), model.read().tokens().len(), model.read().bitext().pairs().len());
    let mut out = output::text(&[Some(&target)])?;
    if options.json {
        let line = json!({
            "type": "model", "sessions": learned, "skipped": skipped, "left_out_with_way": with_way, "left_out_no_task": no_task, "long_commands": long, "starter": lessons.len() - own, "numbers": numbers, "words": words, "tokens": tokens, "pairs": pairs, "bytes": file.len(),
        });
        writeln!(out, "{line}")?;
    } else {
        let [sessions, words, tokens] = [(learned, "session"), (words, "word"), (tokens, "machine token")].map(|(n, it)| counted(n, it));
        let beside = |count, text: String| if count == 0 { String::new() } else { format!(" and {text}") };
        let numbers = beside(numbers, counted(numbers, "number"));
        let starter = lessons.len() - own;
        let starter = beside(starter, format!("{} of the starter", counted(starter, "sentence")));
        writeln!(out, "{sessions}{numbers}{starter}, {words}, {tokens}: {} bytes in {}", file.len(), target.name())?;
    }
    Ok(out.flush()?)
}
