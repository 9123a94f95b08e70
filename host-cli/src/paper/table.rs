//! Results as tables.

use super::experiment::Run;
use super::summary::{REPORTED, Summary};
use crate::cli::PaperOptions;
use goodbot_course::{LESSONS, TESTS};
use std::io::{self, Write};

/// Words shown for each machine token.
const WORDS: usize = 4;

/// One run: which commands were understood, and what was learned.
pub fn one_run(out: &mut impl Write, run: &Run, letters: u8) -> io::Result<()> {
    writeln!(out, "\nLessons                                      on hearing  steps  good  bad  ended")?;
    for (exercise, lesson) in LESSONS.iter().zip(&run.results.lessons) {
        let (feedback, understood) = (lesson.feedback, if lesson.understood { "understood" } else { "-" });
        let (steps, ending) = (lesson.steps, lesson.ending.name());
        writeln!(out, "  {:<42} {understood:<10} {steps:>6} {:>5} {:>4}  {ending}", exercise.command, feedback.reward, feedback.punish)?;
    }
    writeln!(out, "\nTests                                        result      probability of what was meant")?;
    for (exercise, test) in TESTS.iter().zip(&run.results.tests) {
        writeln!(out, "  {:<42} {:<10} {:>6.3}", exercise.command, if test.right { "right" } else { "wrong" }, test.probability)?;
    }
    let right = run.results.tests.iter().filter(|test| test.right).count();
    writeln!(out, "  {right} of {} right", TESTS.len())?;
    writeln!(out, "\nThe words learned for each machine token, with their probabilities{}", forms(letters))?;
    for (token, row) in &run.lexicon.rows {
        let words: Vec<String> = run.lexicon.best(row, WORDS).iter().map(|(word, t)| format!("{word:<7} {t:.2}")).collect();
        writeln!(out, "  {token:<14} {}", words.join("   "))?;
    }
    Ok(())
}

/// Why words are cut, where they are: as many letters of a word count, 0 for all.
pub fn forms(letters: u8) -> String {
    if letters == 0 { String::new() } else { format!("; a word is known by its first {letters} letters") }
}

/// Many runs: shares of right answers.
pub fn many_runs(out: &mut impl Write, options: &PaperOptions, summary: &Summary) -> io::Result<()> {
    let (name, homes) = (&options.trainer.name, options.homes().name());
    let last = options.seed.wrapping_add(u64::from(options.runs) - 1);
    writeln!(out, "{} agents, seeds {} to {last}, trainer {name}, {homes} homes\n", summary.runs, options.seed)?;
    writeln!(out, "Lessons: understood on hearing")?;
    for (exercise, share) in LESSONS.iter().zip(summary.train_right) {
        writeln!(out, "  {:<42} {:>6.1} %", exercise.command, share * 100.0)?;
    }
    writeln!(out, "\nTests: right")?;
    for (exercise, share) in TESTS.iter().zip(summary.test_right) {
        writeln!(out, "  {:<42} {:>6.1} %", exercise.command, share * 100.0)?;
    }
    writeln!(out, "  {:<42} {:>6.1} %", "all five", summary.test_all_right * 100.0)?;
    writeln!(out, "\nLearned, mean over all agents")?;
    for ((token, word), value) in REPORTED.iter().zip(summary.translations) {
        writeln!(out, "  t({word} given {token}) = {value:.2}")?;
    }
    let feedback = summary.feedback;
    writeln!(out, "\nFeedback: {} \"good bot\", {} \"bad bot\", {} times nothing", feedback.reward, feedback.punish, feedback.neutral)
}
