//! `cargo xtask worst`: a search for the input that takes the most instructions of each call of the C interface.
//!
//! `capi/tests/worst.c` draws worlds, lessons and sentences on the emulated Cortex-M4F, and keeps what makes a call longer. The code of a
//! Cortex-M0 runs there, too.

use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::capi::{M0, M4F, Processor, program_that_calls, search_program};
use crate::firmware::{FLASH, bytes, run_alone};
use crate::footprint;

/// Worlds that one run of the program tries. It must end before the emulator's limit.
const TRIALS: u32 = 40;
/// Those of a check.
const TRIALS_OF_A_CHECK: u32 = 12;
/// The most instructions of a call with the smallest budget, as the header promises: a quarter of a tick of 10 ms at 25 MHz.
const MOST: u64 = 62_500;
/// The same on a Cortex-M0, which computes floats in software.
const MOST_ON_M0: u64 = 200_000;

/// Calls of the search, by their names in C.
const CALLS: [(&str, &str); 47] = [
    ("begin_hearing", "goodbot_begin_hearing"),
    ("hear_on", "goodbot_hear_on, budget 1"),
    ("hear_again", "goodbot_hear_again"),
    ("plan", "goodbot_plan, budget 1"),
    ("decide", "goodbot_decide"),
    ("done", "goodbot_acted"),
    ("feedback", "goodbot_feedback"),
    ("trainer_ended", "goodbot_trainer_ended"),
    ("demonstration", "goodbot_demonstration"),
    ("remark", "goodbot_remark"),
    ("begin_finishing", "goodbot_begin_finishing"),
    ("finish_on", "goodbot_finish_on, budget 1"),
    ("forget", "goodbot_forget"),
    ("learn", "goodbot_learn, budget 1"),
    ("learn-16", "goodbot_learn, budget 16"),
    ("task_count", "goodbot_task_count"),
    ("task_probability", "goodbot_task_probability"),
    ("most_likely", "goodbot_most_likely"),
    ("task_text", "goodbot_task_text"),
    ("question", "goodbot_question, budget 1"),
    ("question_text", "goodbot_question_text"),
    ("answer", "goodbot_answer"),
    ("remember", "goodbot_remember"),
    ("converse_anew", "goodbot_converse_anew"),
    ("session_count", "goodbot_session_count"),
    ("usage", "goodbot_usage"),
    ("full", "goodbot_full"),
    ("table_set_state", "goodbot_table_set_state"),
    ("saved_size", "goodbot_saved_size"),
    ("begin_saving", "goodbot_begin_saving"),
    ("save_on", "goodbot_save_on, budget 1"),
    ("begin_restoring", "goodbot_begin_restoring"),
    ("restore_on", "goodbot_restore_on, budget 1"),
    ("begin_storing", "goodbot_begin_storing"),
    ("store_on", "goodbot_store_on, budget 1"),
    ("trainer", "goodbot_trainer"),
    ("trainers", "goodbot_trainers"),
    ("home_find_cells", "goodbot_home_find_cells, budget 1"),
    ("home_place", "goodbot_home_place"),
    ("home_sense", "goodbot_home_sense"),
    ("home_where", "goodbot_home_where"),
    ("current_options", "goodbot_current_options"),
    ("set_options", "goodbot_set_options"),
    ("explain_on", "goodbot_explain_on, budget 1"),
    ("explain_word", "goodbot_explain_word, read by goodbot_explain_on"),
    ("said-alone", "goodbot_said, without a table"),
    ("said", "goodbot_said (at once)"),
];

/// Calls that do all at once: the header says that a control loop does not call them.
fn is_bounded(title: &str) -> bool {
    !title.ends_with("(at once)")
}

/// How long to search.
#[derive(Args)]
pub struct Options {
    /// For about this many minutes
    #[arg(long, default_value_t = 10)]
    minutes: u64,
    /// The first seed; another one tries other inputs
    #[arg(long, default_value_t = 1)]
    seed: u32,
}

/// What was found of each call.
#[derive(Clone, Copy, Default)]
struct Found {
    instructions: u64,
    stack: u64,
}

/// Searches on both processors, one seed after the other, and writes the table of what was found.
pub fn run(options: &Options) -> Result<()> {
    let until = Instant::now() + Duration::from_secs(60 * options.minutes);
    let first = options.seed;
    let searches = [&M4F, &M0].map(|processor| std::thread::spawn(move || search_on(processor, first, until)));
    let [found, on_m0] = searches.map(|search| search.join().unwrap_or_else(|_| Err(anyhow::anyhow!("a search could not be followed"))));
    let (found, on_m0) = (found?, on_m0?);
    let alone = bytes(&program_that_calls(None)?, &FLASH)?;
    let mut rows = Vec::new();
    for (((_, title), found), m0) in CALLS.iter().zip(&found).zip(&on_m0) {
        let function = title.split([',', ' ']).next();
        let flash = bytes(&program_that_calls(function)?, &FLASH)?.saturating_sub(alone);
        rows.push(((*title).to_owned(), [found.instructions, m0.instructions, found.stack, flash]));
    }
    footprint::write_worst(rows.into_iter())?;
    let titled = |found: Vec<Found>| CALLS.iter().zip(found).map(|((_, title), found)| (*title, found.instructions));
    within(titled(found), MOST)?;
    within(titled(on_m0), MOST_ON_M0).context("on a Cortex-M0")
}

fn search_on(processor: &Processor, first: u32, until: Instant) -> Result<Vec<Found>> {
    let (mut found, mut seed) = (vec![Found::default(); CALLS.len()], first);
    while seed == first || Instant::now() < until {
        let report = run_alone(&search_program(processor, TRIALS, seed)?)?;
        for (most, (name, _)) in found.iter_mut().zip(CALLS) {
            most.instructions = most.instructions.max(report.number(name)?);
            most.stack = most.stack.max(report.number(&format!("stack-{name}"))?);
        }
        seed += 1;
    }
    eprintln!("{processor:?}: searched with the seeds {first} to {}, {TRIALS} worlds each", seed - 1);
    Ok(found)
}

/// A short search, which finds no call that is too long.
pub fn check() -> Result<()> {
    let report = run_alone(&search_program(&M4F, TRIALS_OF_A_CHECK, 1)?)?;
    let found = CALLS.iter().map(|(name, title)| Ok((*title, report.number(name)?))).collect::<Result<Vec<_>>>()?;
    println!("the longest calls of {TRIALS_OF_A_CHECK} worlds:");
    found.iter().for_each(|(title, most)| println!("  {most} {title}"));
    within(found.into_iter(), MOST)
}

/// It is an error if a call that a control loop makes was never made, or is too long.
fn within<'a>(found: impl Iterator<Item = (&'a str, u64)>, allowed: u64) -> Result<()> {
    for (title, most) in found {
        ensure!(most > 0, "the search never called {title}");
        ensure!(most <= allowed || !is_bounded(title), "{title} took {most} instructions, and {allowed} are the most");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_of_a_control_loop_that_is_too_long_or_was_never_made_is_told() {
        assert!(within([("goodbot_plan", MOST), ("goodbot_said (at once)", MOST + 1)].into_iter(), MOST).is_ok());
        assert!(within([("goodbot_plan", MOST + 1)].into_iter(), MOST).is_err());
        assert!(within([("goodbot_plan", MOST + 1)].into_iter(), MOST_ON_M0).is_ok());
        assert!(within([("goodbot_said (at once)", 0)].into_iter(), MOST).is_err());
    }

    #[test]
    fn the_search_reports_each_call_that_is_told() {
        let program = crate::process::shell().unwrap().read_file("capi/tests/worst.c").unwrap();
        for (name, _) in CALLS {
            assert!(program.contains(&format!("\"{name}\"")), "{name}");
        }
    }
}
