//! `goodbot paper`: the paper's experiment.
//!
//! - [`options`]: the options;
//! - [`experiment`]: the runs;
//! - [`trainer`]: trainers by name or numbers, and the agent's belief about them;
//! - `reported`: the paper's own results;
//! - [`lexicon`]: the learned words of an agent;
//! - [`story`]: one run as it happens;
//! - [`table`]: results as tables;
//! - [`summary`]: the summary of all runs, and JSON;
//! - [`plot`][]: the picture of the learned words.

mod experiment;
pub mod lexicon;
pub mod options;
pub mod plot;
mod reported;
mod story;
mod summary;
mod table;
pub mod trainer;

use goodbot_console::messages::say;
use goodbot_console::outcome::Failure;
use goodbot_console::output::{self, Output};
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
    match target {
        Some(_) if !options.is_story() => return Err(Failure::Input("--plot shows the words of one run: leave out --runs".to_owned())),
        _ if options.is_story() => one_run(options, target.as_ref(), &mut out)?,
        _ => many_runs(options, &mut out)?,
    }
    Ok(out.flush()?)
}

fn one_run(options: &PaperOptions, target: Option<&Output>, out: &mut impl Write) -> Result<(), Failure> {
    let ((run, lexicon), told) = story::tell(options, out)?;
    let commands = LESSONS.iter().chain(&TESTS).map(|exercise| exercise.command);
    let lexicon = lexicon.written_out(commands, options.learner.options().language.letters_kept());
    // The picture comes first, so that it is written even if the reader of the text stops early.
    if let Some(target) = target {
        target.draw(plot::learned_words(&lexicon))?;
        say!("picture: {}", target.name());
    }
    told?;
    Ok(table::one_run(out, &run, &lexicon)?)
}

fn many_runs(options: &PaperOptions, out: &mut impl Write) -> Result<(), Failure> {
    let runs = experiment::run_all(options)?;
    let summary = Summary::of(&runs);
    if options.json {
        for run in &runs {
            writeln!(out, "{}", run_to_json(run))?;
        }
        writeln!(out, "{}", summary.to_json(options))?;
    } else if options.csv {
        table::csv(out, options, &summary)?;
    } else {
        table::many_runs(out, options, &summary)?;
    }
    Ok(())
}
