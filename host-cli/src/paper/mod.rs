//! `goodbot paper`: the paper's experiment.
//!
//! - [`options`]: the options, with trainers by name or numbers;
//! - [`sweep`]: a range of values for a number of the trainer, and all combinations of sweeps;
//! - [`experiment`]: the runs, and the paper's own results;
//! - [`story`]: one run as it happens;
//! - [`summary`]: the summary of all runs, as tables, JSON and pictures.

mod experiment;
pub mod options;
mod story;
pub mod summary;
pub mod sweep;

use goodbot_console::{Failure, Output, output, say};
use goodbot_course::{LESSONS, TESTS};
use options::PaperOptions;
use std::io::Write;
use std::path::Path;
use summary::{Summary, run_to_json};
use sweep::{Setting, settings};

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
        picture(target, summary::learned_words(&lexicon))?;
    }
    told?;
    Ok(summary::one_run(out, &run, &lexicon)?)
}

fn many_runs(options: &PaperOptions, target: Option<&Output>, out: &mut impl Write) -> Result<(), Failure> {
    let mut rows: Vec<(Setting, Summary)> = Vec::new();
    for setting in settings(options).map_err(Failure::Input)? {
        let runs = experiment::run_all(&setting.options)?;
        let summary = Summary::of(&runs);
        if let Some(target) = target {
            let lone = runs.first().filter(|_| runs.len() == 1);
            let drawn = match lone {
                Some(run) => summary::learned_words(&experiment::run_seed(options, run.seed, &mut ())?.1),
                None => summary::shares(&summary, options),
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
        rows if options.csv => summary::csv(out, options, rows)?,
        [(_, summary)] if options.sweep.is_empty() => summary::many_runs(out, options, summary)?,
        rows => summary::sweep(out, options, rows)?,
    }
    Ok(())
}

fn picture(target: &Output, drawing: Result<String, Box<dyn std::error::Error>>) -> Result<(), Failure> {
    target.draw(drawing)?;
    say!("picture: {}", target.name());
    Ok(())
}
