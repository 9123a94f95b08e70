//! `goodbot paper`: the paper's experiment.
//!
//! - [`experiment`]: the runs;
//! - [`lexicon`]: what an agent learned;
//! - [`story`]: one run as it happens;
//! - [`table`]: results as tables;
//! - [`summary`]: all runs together, and JSON;
//! - [`plot`][]: pictures;
//! - [`trainer`]: trainers as they are typed.

mod experiment;
pub mod lexicon;
pub mod plot;
mod story;
mod summary;
pub mod table;
pub mod trainer;

use crate::cli::PaperOptions;
use crate::outcome::Failure;
use crate::whole_file::write_whole;
use experiment::Run;
use std::io::{BufWriter, Write};
use std::path::Path;
use summary::{Summary, run_to_json};

/// Where the story of one run leaves its picture.
const PICTURE: &str = "goodbot-paper.svg";

/// Runs the experiment and shows it as the options say.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &PaperOptions) -> Result<(), Failure> {
    // Not buffered by line: two hundred runs make two hundred lines.
    let mut out = BufWriter::new(std::io::stdout().lock());
    if options.is_story() {
        let run = story::tell(options, &mut out)?;
        table::one_run(&mut out, &run, options.model.options().language.word_letters)?;
        story_picture(options, &run, &mut out)?;
    } else {
        let runs = experiment::run_all(options)?;
        let summary = Summary::of(&runs);
        if options.json {
            for run in &runs {
                writeln!(out, "{}", run_to_json(run))?;
            }
            writeln!(out, "{}", summary.to_json(options))?;
        } else {
            table::many_runs(&mut out, options, &summary)?;
        }
        if let Some(path) = &options.plot {
            picture(path, options, &runs, &summary)?;
            eprintln!("picture: {}", path.display());
        }
    }
    Ok(out.flush()?)
}

fn picture(path: &Path, options: &PaperOptions, runs: &[Run], summary: &Summary) -> Result<(), Failure> {
    let drawing = match runs {
        [run] => plot::learned_words(&run.lexicon),
        _ => plot::shares(summary, options),
    }
    .map_err(|error| Failure::Result(format!("cannot draw the picture: {error}")))?;
    write_whole(path, drawing.as_bytes()).map_err(|error| Failure::Input(format!("cannot write {}: {error}", path.display())))
}

/// The picture at the end of the story. Where nobody asked for it, it may fail: the folder need not be ours to write in.
fn story_picture(options: &PaperOptions, run: &Run, out: &mut impl Write) -> Result<(), Failure> {
    if options.no_plot {
        return Ok(());
    }
    let path = options.plot.as_deref().unwrap_or(Path::new(PICTURE));
    let drawn = picture(path, options, std::slice::from_ref(run), &Summary::of(std::slice::from_ref(run)));
    match drawn {
        Ok(()) => writeln!(out, "\nThe learned words as a picture: {}", path.display())?,
        Err(failure) if options.plot.is_none() => eprintln!("no picture: {failure}; say where with --plot FILE.svg"),
        Err(failure) => return Err(failure),
    }
    Ok(())
}
