//! `goodbot evaluate`: how well are commands understood that were not trained on?
//!
//! - [`method`]: the models that are compared;
//! - [`folds`]: what is trained on and what is asked;
//! - [`novel`]: the same commands in other layouts;
//! - [`curve`]: accuracy against the number of sessions;
//! - [`report`]: what is told.

mod curve;
mod folds;
mod method;
mod novel;
mod report;

use crate::lessons;
use crate::load::kinds::TaskKinds;
use crate::model::Model;
use crate::outcome::Failure;
use crate::whole_file::{new_file, write_whole};
use clap::{Args, ValueHint};
use method::Method;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// The options of `goodbot evaluate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct EvaluateOptions {
    /// Session logs (JSON Lines); - is standard input
    #[arg(required = true, value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<String>,
    /// For every session, train on all the others (the default)
    #[arg(long, conflicts_with = "k_fold")]
    leave_one_out: bool,
    /// Train on all but one of K parts, in turn (2 or more)
    #[arg(long, value_name = "K")]
    k_fold: Option<NonZeroUsize>,
    /// A kind of task beside the paper's two, such as "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"; may be given several times
    #[arg(long = "lifted", alias = "task", value_name = "TASK", value_parser = TaskKinds::parse)]
    lifted: Vec<goodbot::task::LiftedTask>,
    /// Ask each command in N random layouts of its home instead of the one it was given in
    #[arg(long, value_name = "N")]
    novel_environments: Option<NonZeroUsize>,
    /// The model that is trained
    #[arg(long, value_enum, default_value_t)]
    model: Method,
    /// Compare the default with the same without one choice at a time, in a table
    #[arg(long)]
    ablation: bool,
    /// Seed of the parts, layouts and curves
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    seed: u64,
    /// Orders of the sessions that a learning curve is averaged over
    #[arg(long, value_name = "N", default_value = "10")]
    runs: NonZeroUsize,
    /// Write accuracy against the number of training sessions as a picture
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath, value_parser = new_file)]
    plot: Option<PathBuf>,
    /// Pass over sessions that are at fault, and count them
    #[arg(long)]
    keep_going: bool,
    /// Print JSON lines: one for each command asked, and a summary at the end
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
A session is trained on by what its steps show of the task: the posterior over tasks without any word. \
What was intended is used to count right answers, never to learn. A demonstration that ends at its goal \
speaks for that goal as much as one more step of doing nothing would.

Examples:
  goodbot evaluate turk-simplified.jsonl --leave-one-out
  goodbot evaluate expert.jsonl --leave-one-out --lifted \"agentInRoom(?a,?r1) & blockInRoom(?o,?r2)\"
  goodbot evaluate turk-simplified.jsonl --k-fold 10 --model bag-of-words
  goodbot evaluate turk-simplified.jsonl --plot curve.svg --runs 20
  goodbot evaluate turk-simplified.jsonl --ablation";

/// Runs the command.
pub fn run(options: &EvaluateOptions) -> Result<(), Failure> {
    let lifted = TaskKinds::and(&options.lifted).map_err(|error| Failure::Input(error.to_string()))?;
    let capacity = |error: goodbot::AgentError| Failure::Input(error.to_string());
    if options.ablation {
        let mut rows = Vec::new();
        for (name, settings) in method::ablations() {
            let (lessons, _) = read(options, &lifted, settings)?;
            let parts = folds::parts(lessons.len(), options.k_fold, options.seed);
            let answers = folds::ask_all(&lessons, &lessons_of(&lessons), &parts, Method::Default, settings).map_err(capacity)?;
            rows.push((name, report::Summary::of(&answers, lessons.len(), 0)));
        }
        return Ok(report::ablation(&rows, options.json)?);
    }
    let settings = options.model.settings();
    let (lessons, skipped) = read(options, &lifted, settings)?;
    let asked = match options.novel_environments {
        Some(count) => novel::layouts(&lessons, &lifted, settings, count.get(), options.seed)?,
        None => lessons_of(&lessons),
    };
    let parts = folds::parts(lessons.len(), options.k_fold, options.seed);
    let answers = folds::ask_all(&lessons, &asked, &parts, options.model, settings).map_err(capacity)?;
    let summary = report::Summary::of(&answers, lessons.len(), skipped);
    report::print(&answers, &summary, options.json)?;
    if let Some(plot) = &options.plot {
        let points = curve::points(&lessons, options.model, settings, options.runs.get(), options.seed).map_err(capacity)?;
        let svg = curve::draw(&points, options.runs.get()).map_err(|error| Failure::Result(error.to_string()))?;
        write_whole(plot, svg.as_bytes()).map_err(|error| Failure::Input(format!("{} cannot be written: {error}", plot.display())))?;
        if !options.json {
            report::print_curve(&points)?;
        }
    }
    Ok(())
}

fn read(
    options: &EvaluateOptions,
    lifted: &[goodbot::task::LiftedTask],
    settings: goodbot::language::Settings,
) -> Result<(Vec<lessons::Lesson>, usize), Failure> {
    let agent = goodbot::Options { language: settings, ..Model::Default.options() };
    let (lessons, skipped) = lessons::read(&options.files, lifted, agent, options.model == Method::Action, options.keep_going)?;
    if lessons.len() < 2 {
        return Err(Failure::Input("there is one session alone, and nothing to train on; name files that have more".to_owned()));
    }
    Ok((lessons, skipped))
}

/// Each lesson asked as it stands.
fn lessons_of(lessons: &[lessons::Lesson]) -> Vec<Vec<lessons::Lesson>> {
    lessons.iter().map(|lesson| vec![lesson.clone()]).collect()
}
