//! `goodbot paper`: the paper's experiment.
//!
//! - [`options`]: the options;
//! - [`experiment`]: the runs;
//! - [`trainer`]: trainers by name or numbers, and the agent's belief about them;
//! - [`sweep`]: a range of values for a number of the trainer; `settings`: all combinations of sweeps;
//! - `reported`: the paper's own results;
//! - [`lexicon`]: the learned words of an agent;
//! - [`story`]: one run as it happens;
//! - [`table`]: results as tables;
//! - [`summary`]: the summary of all runs, and JSON;
//! - [`plot`][]: pictures.

mod experiment;
pub mod lexicon;
pub mod options;
pub mod plot;
mod reported;
mod settings;
mod story;
mod summary;
pub mod sweep;
mod table;
pub mod trainer;

use goodbot_console::messages::say;
use goodbot_console::outcome::Failure;
use goodbot_console::output::{self, Output};
use goodbot_course::{LESSONS, TESTS};
use options::PaperOptions;
use settings::{Setting, settings};
use std::io::Write;
use std::path::Path;
use summary::{Summary, run_to_json};

/// Runs the experiment, and prints it in the form that the options choose.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &PaperOptions) -> Result<(), Failure> {
    let target = Output::picture(&options.plot, [] as [&Path; 0], options.force)?;
    // Buffered, because two hundred runs print two hundred lines.
    let mut out = output::text(&[target.as_ref()])?;
    if options.is_story() {
        one_run(options, target.as_ref(), &mut out)?
    } else {
        many_runs(options, target.as_ref(), &mut out)?
    }
    Ok(out.flush()?)
}

fn one_run(options: &PaperOptions, target: Option<&Output>, out: &mut impl Write) -> Result<(), Failure> {
    let ((run, lexicon), told) = story::tell(options, out)?;
    let commands = LESSONS.iter().chain(&TESTS).map(|exercise| exercise.command);
    let lexicon = lexicon.written_out(commands, options.learner.options().language.letters_kept());
    // The picture comes first, so that it is written even if the reader of the text stops early.
    if let Some(target) = target {
        picture(target, plot::learned_words(&lexicon))?;
    }
    told?;
    Ok(table::one_run(out, &run, &lexicon)?)
}

fn many_runs(options: &PaperOptions, target: Option<&Output>, out: &mut impl Write) -> Result<(), Failure> {
    let mut rows: Vec<(Setting, Summary)> = Vec::new();
    for setting in settings(options).map_err(Failure::Input)? {
        let runs = experiment::run_all(&setting.options)?;
        let summary = Summary::of(&runs);
        if let Some(target) = target {
            let lone = runs.first().filter(|_| runs.len() == 1);
            let drawn = match lone {
                Some(run) => plot::learned_words(&experiment::run_seed(options, run.seed, &mut ())?.1),
                None => plot::shares(&summary, options),
            };
            picture(target, drawn)?;
        }
        if options.json {
            for run in &runs {
                writeln!(out, "{}", run_to_json(run))?;
            }
            writeln!(out, "{}", summary.to_json(&setting))?;
        }
        rows.push((setting, summary));
    }
    match rows.as_slice() {
        _ if options.json => {}
        rows if options.csv => table::csv(out, options, rows)?,
        [(_, summary)] if options.sweep.is_empty() => table::many_runs(out, options, summary)?,
        rows => table::sweep(out, options, rows)?,
    }
    Ok(())
}

fn picture(target: &Output, drawing: Result<String, Box<dyn std::error::Error>>) -> Result<(), Failure> {
    target.draw(drawing)?;
    say!("picture: {}", target.name());
    Ok(())
}
