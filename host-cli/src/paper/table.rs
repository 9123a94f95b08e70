//! Results as tables.

use super::experiment::Run;
use super::lexicon::Lexicon;
use super::options::PaperOptions;
use super::reported::REPORTED;
use super::settings::Setting;
use super::summary::Summary;
use goodbot_console::csv::{self, Cell};
use goodbot_console::messages::counted;
use goodbot_console::numbers::name_of;
use goodbot_course::{LESSONS, TESTS};
use goodbot_lab::mean::wilson;
use std::io::{self, Write};

/// The most words for each machine token.
const WORDS: usize = 4;

/// One run: the results of lessons and tests, and the learned words.
pub fn one_run(out: &mut impl Write, run: &Run, lexicon: &Lexicon) -> io::Result<()> {
    writeln!(out, "\nLessons                                      on hearing  steps  good  bad  ended")?;
    for (exercise, lesson) in LESSONS.iter().zip(&run.results.lessons) {
        let (feedback, understood) = (lesson.feedback, if lesson.understood { "understood" } else { "-" });
        let (steps, ending) = (lesson.steps, lesson.ending.name());
        writeln!(out, "  {:<42} {understood:<10} {steps:>6} {:>5} {:>4}  {ending}", exercise.command, feedback.reward, feedback.punish)?;
    }
    writeln!(out, "\nTests                                        result      its probability")?;
    for (exercise, test) in TESTS.iter().zip(&run.results.tests) {
        writeln!(out, "  {:<42} {:<10} {:>6.3}", exercise.command, if test.right { "right" } else { "wrong" }, test.probability)?;
    }
    let right = run.results.tests.iter().filter(|test| test.right).count();
    writeln!(out, "  {right} of {} right", TESTS.len())?;
    writeln!(out, "\nThe words learned for each machine token, with their probabilities")?;
    for (token, row) in &lexicon.rows {
        let words: Vec<String> = lexicon.best(row, WORDS).iter().map(|(word, t)| format!("{word:<7} {t:.2}")).collect();
        writeln!(out, "  {token:<14} {}", words.join("   "))?;
    }
    Ok(())
}

/// A share with its 95 % interval.
fn share(right: usize, all: usize) -> String {
    let (low, high) = wilson(right, all);
    format!("{:>6.1} %  ({:.1} to {:.1})", 100.0 * right as f64 / all.max(1) as f64, 100.0 * low, 100.0 * high)
}

/// Many runs: shares of right answers, beside the paper's results for its one agent.
pub fn many_runs(out: &mut impl Write, options: &PaperOptions, summary: &Summary) -> io::Result<()> {
    let (homes, learner) = (name_of(options.homes()), name_of(options.learner));
    let last = options.seed.wrapping_add(u64::from(options.runs) - 1);
    writeln!(out, "{}, seeds {} to {last}, {homes} homes, learner {learner}", counted(summary.runs, "agent"), options.seed)?;
    writeln!(out, "trainer {}{}; the agent believes {}\n", options.trainer.name, options.trainer.withheld(), options.believed().name)?;
    let paper = options.reported_by_paper();
    writeln!(out, "Lessons: understood on hearing                share, 95 % interval")?;
    for (number, (exercise, right)) in LESSONS.iter().zip(summary.train_right).enumerate() {
        let paper = paper.and_then(|paper| paper.lessons).and_then(|lessons| lessons.get(number).copied());
        let paper = paper.map_or("", |right| if right { "  paper: needed no correction" } else { "  paper: was corrected" });
        writeln!(out, "  {:<42} {}{paper}", exercise.command, share(right, summary.runs))?;
    }
    writeln!(out, "\nTests: right")?;
    for (exercise, right) in TESTS.iter().zip(summary.test_right) {
        writeln!(out, "  {:<42} {}", exercise.command, share(right, summary.runs))?;
    }
    let reported = paper.map_or_else(String::new, |paper| format!("  paper: {} of {} right", paper.tests, TESTS.len()));
    writeln!(out, "  {:<42} {}{reported}", "all five", share(summary.test_all_right, summary.runs))?;
    writeln!(out, "\nLearned, mean over all agents with 95 % interval")?;
    for (number, ((token, _, word), mean)) in REPORTED.iter().zip(summary.translations).enumerate() {
        let paper = paper.and_then(|paper| paper.translations).and_then(|all| all.get(number).copied());
        let paper = paper.map_or_else(String::new, |value| format!("  paper: {value:.2}"));
        let name = format!("t({word} given {token})");
        writeln!(out, "  {name:<42} {:>6.2}    ({:.2} to {:.2}){paper}", mean.mean, mean.mean - mean.half, mean.mean + mean.half)?;
    }
    let feedback = summary.feedback;
    writeln!(out, "\nFeedback: {} \"good bot\", {} \"bad bot\", {} times nothing", feedback.reward, feedback.punish, feedback.neutral)
}

/// Sweeps: a line for each setting.
pub fn sweep(out: &mut impl Write, options: &PaperOptions, rows: &[(Setting, Summary)]) -> io::Result<()> {
    let (homes, learner) = (name_of(options.homes()), name_of(options.learner));
    writeln!(out, "{} for each setting, {homes} homes, learner {learner}\n", counted(options.runs as usize, "agent"))?;
    let names: Vec<String> = options.sweep.iter().map(|sweep| format!("{:>17}", sweep.name)).collect();
    writeln!(out, "{}  all five tests right, 95 % interval", names.join(" "))?;
    for (setting, summary) in rows {
        let values: Vec<String> = setting.values.iter().map(|value| format!("{value:>17}")).collect();
        writeln!(out, "{}  {}", values.join(" "), share(summary.test_all_right, summary.runs))?;
    }
    Ok(())
}

/// A line of comma-separated values for each setting.
pub fn csv(out: &mut impl Write, options: &PaperOptions, rows: &[(Setting, Summary)]) -> io::Result<()> {
    let mut names: Vec<String> = options.sweep.iter().map(|sweep| sweep.name.clone()).collect();
    let fixed = ["trainer", "believes", "layouts", "learner", "seed", "runs", "all_right", "all_right_low", "all_right_high"];
    names.extend(fixed.map(str::to_owned));
    names.extend((1..=LESSONS.len()).map(|number| format!("lesson_{number}")));
    names.extend((1..=TESTS.len()).map(|number| format!("test_{number}")));
    names.extend(REPORTED.iter().map(|(token, _, word)| format!("t_{word}_given_{token}")));
    names.extend(["rewards", "punishments", "silences"].map(str::to_owned));
    csv::line(out, names.into_iter().map(Cell::Text))?;
    for (setting, summary) in rows {
        let of = &setting.options;
        let share = |right: usize| right as f64 / summary.runs.max(1) as f64;
        let (low, high) = wilson(summary.test_all_right, summary.runs);
        let mut cells: Vec<Cell> = setting.values.iter().map(Cell::number).collect();
        cells.extend([&of.trainer.name, &of.believed().name].map(Cell::text));
        cells.extend([name_of(of.homes()), name_of(of.learner)].map(Cell::text));
        cells.extend([Cell::number(of.seed), Cell::number(summary.runs)]);
        let shares = [share(summary.test_all_right), low, high].into_iter();
        let shares = shares.chain(summary.train_right.map(share)).chain(summary.test_right.map(share));
        cells.extend(shares.chain(summary.translations.map(|it| it.mean)).map(|number| Cell::Number(format!("{number:.6}"))));
        let said = summary.feedback;
        cells.extend([said.reward, said.punish, said.neutral].map(Cell::number));
        csv::line(out, cells)?;
    }
    Ok(())
}
