//! `goodbot merge`: joins the models of two robots.

use clap::{Args, ValueHint};
use goodbot::capacity::{LIFTED_TASKS, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use goodbot::home::paper_tasks;
use goodbot::snapshot::{Contents, RestoreError};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_console::load::kinds::{kept, with_kinds};
use goodbot_console::{Failure, Kind, Output, counted, read_model, say, typed};
use std::path::{Path, PathBuf};

/// Join the models of two robots
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct MergeArgs {
    /// The first model: its sessions come first, and its settings stay
    #[arg(value_name = "A", value_hint = ValueHint::FilePath)]
    pub first: PathBuf,
    /// The second model: its sessions follow
    #[arg(value_name = "B", value_hint = ValueHint::FilePath)]
    pub second: PathBuf,
    /// The merged model to write; - is standard output
    #[arg(long, short = 'o', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub out: PathBuf,
    /// Replace a file that is no model
    #[arg(long)]
    pub force: bool,
}

/// The largest table of translations. Larger models are refused with an error that names it.
const MOST_TRANSLATIONS: usize = 1 << 24;

const EXAMPLES: &str = "\
Words and machine tokens are matched by their text. Sessions that both models have, to the last bit of their \
weights, come from a common past and are kept once. The kinds of task are those of both. The belief about trainers is A's. Models whose words or \
machine commands are formed differently (--learner paper and default) are refused.

Example:
  goodbot merge kitchen.model garden.model --out both.model";

/// Joins two models.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(options: &MergeArgs) -> Result<(), Failure> {
    let target = Output::new(Kind::Model, &options.out, [&options.first, &options.second], options.force)?;
    let (first, second) = (read_model(&options.first)?, read_model(&options.second)?);
    let contents = |path, bytes| Contents::read(bytes).map_err(|error| Failure::of(path, error));
    let (ours, theirs) = (contents(&options.first, &first)?, contents(&options.second, &second)?);
    if ours.vocabulary != 0 && theirs.vocabulary != 0 && ours.vocabulary != theirs.vocabulary {
        return Err(Failure::of(&options.second, RestoreError::OtherDomain));
    }
    let memory = typed::memory(&room_for(&ours, &theirs), &ours.options.language, ours.possible.len() + theirs.possible.len());
    let mut agent = Agent::new(memory, &[], Options::PAPER)?;
    agent.restore(&first).map_err(|error| Failure::of(&options.first, error))?;
    let added = agent.join(&second).map_err(|error| Failure::of(&options.second, error))?;
    // The belief about the trainer has nothing to do with how words were learned.
    let learns = |options: &Options| (options.language, options.weights, options.least_weight);
    if learns(&ours.options) != learns(&theirs.options) {
        say!("{}: trained with other settings; those of {} stay", options.second.display(), options.first.display());
    }
    let model = agent.saved_for(if ours.vocabulary == 0 { theirs.vocabulary } else { ours.vocabulary })?;
    target.write(&with_kinds(model, &kinds([(&options.first, &first), (&options.second, &second)])?))?;
    let (words, sessions) = (agent.language().words().len(), agent.language().bitext().sessions());
    say!("{}: {}, {added} of them added; {}", target.name(), counted(sessions, "session"), counted(words, "word"));
    Ok(())
}

/// The kinds of task of both models. A model without kinds has the paper's two.
fn kinds(models: [(&Path, &[u8]); 2]) -> Result<Vec<LiftedTask>, Failure> {
    let mut all: Vec<LiftedTask> = Vec::new();
    for (file, model) in models {
        let kinds = kept(file, model)?.map_or_else(|| paper_tasks().map(Vec::from), Ok)?;
        let new: Vec<LiftedTask> = kinds.into_iter().filter(|kind| !all.contains(kind)).collect();
        all.extend(new);
    }
    if all.len() > LIFTED_TASKS {
        let [(first, _), (second, _)] = models;
        return Err(Failure::Input(format!(
            "{} and {}: have {} kinds of task together, and {LIFTED_TASKS} are the most; learn one model from the sessions of both",
            first.display(),
            second.display(),
            all.len()
        )));
    }
    Ok(all)
}

/// Room for the tables of both models, and at least the standard capacities.
fn room_for(ours: &Contents<'_>, theirs: &Contents<'_>) -> Capacities {
    let standard = Capacities::STANDARD;
    let both = standard.at_least(ours.needs().plus(theirs.needs()));
    // All pairs of lengths that a model can have.
    let length_pairs = (TOKENS_PER_COMMAND + 1) * (WORDS_PER_COMMAND + 1);
    let alignments = (TOKENS_PER_COMMAND + 1) * (TOKENS_PER_COMMAND + 2) / 2 * (WORDS_PER_COMMAND + 1) * WORDS_PER_COMMAND / 2;
    let translations = both.words.saturating_mul(both.tokens + 1).clamp(standard.translations, MOST_TRANSLATIONS);
    Capacities { translations, alignments, length_pairs, states: 0, hashed_states: 0, ..both }
}
