//! `goodbot paper`: the paper's experiment.
//!
//! - [`options`]: the options, with trainers by name or numbers;
//! - [`experiment`]: the runs, and the paper's own results;
//! - [`story`]: one run as it happens;
//! - [`summary`]: the summary of all runs, as tables and JSON; the learned words of one run as a picture.

mod experiment;
pub mod options;
mod story;
pub mod summary;

use goodbot_console::{Failure, Output, output, say};
use goodbot_course::{LESSONS, TESTS};
use options::PaperOptions;
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
        picture(target, summary::learned_words(&lexicon))?;
    }
    told?;
    Ok(summary::one_run(out, &run, &lexicon)?)
}

fn many_runs(options: &PaperOptions, target: Option<&Output>, out: &mut impl Write) -> Result<(), Failure> {
    if target.is_some() && options.runs > 1 {
        return Err(Failure::Input("--plot draws the words that one robot learned; leave out --runs".to_owned()));
    }
    let runs = experiment::run_all(options)?;
    let summary = Summary::of(&runs);
    if let (Some(target), [run]) = (target, runs.as_slice()) {
        picture(target, summary::learned_words(&experiment::run_seed(options, run.seed, &mut ())?.1))?;
    }
    if options.json {
        runs.iter().try_for_each(|run| writeln!(out, "{}", run_to_json(run)))?;
        writeln!(out, "{}", summary.to_json(options))?;
    } else if options.csv {
        summary::csv(out, options, &summary)?;
    } else {
        summary::many_runs(out, options, &summary)?;
    }
    Ok(())
}

fn picture(target: &Output, drawing: Result<String, Box<dyn std::error::Error>>) -> Result<(), Failure> {
    target.draw(drawing)?;
    say!("picture: {}", target.name());
    Ok(())
}
