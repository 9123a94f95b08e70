//! The results: a summary of all runs, as tables and as JSON lines; and the learned words of one run as a picture.

use super::experiment::{REPORTED, Run};
use super::options::PaperOptions;
use crate::words::Lexicon;
use goodbot_console::printed::Cell;
use goodbot_console::{counted, name_of, printed};
use goodbot_course::{FeedbackCounts, LESSONS, TESTS};
use goodbot_lab::calibration::{Mean, wilson};
use goodbot_lab::canvas::{INK, PALE, draw, write};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use serde_json::{Map, Value, json};
use std::error::Error;
use std::io::{self, Write};

/// The summary of all runs.
#[derive(Debug)]
pub struct Summary {
    /// How many runs.
    pub runs: usize,
    /// For each lesson: in how many runs its command was understood on hearing it.
    pub train_right: [usize; LESSONS.len()],
    /// For each test: in how many runs the most likely task was the intended one.
    pub test_right: [usize; TESTS.len()],
    /// How many runs had all tests right.
    pub test_all_right: usize,
    /// The mean of each translation of [`REPORTED`].
    pub translations: [Mean; REPORTED.len()],
    /// The feedback of the trainers in all runs.
    pub feedback: FeedbackCounts,
}

impl Summary {
    /// The summary of these runs.
    pub fn of(runs: &[Run]) -> Self {
        let count = |right: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| right(run)).count();
        Self {
            runs: runs.len(),
            train_right: std::array::from_fn(|lesson| count(&|run| run.results.lessons[lesson].understood)),
            test_right: std::array::from_fn(|test| count(&|run| run.results.tests[test].right)),
            test_all_right: count(&|run| run.results.all_tests_right()),
            translations: std::array::from_fn(|at| Mean::of(runs.iter().map(|run| f64::from(run.reported[at])))),
            feedback: runs.iter().fold(FeedbackCounts::default(), |sum, run| sum.plus(run.results.feedback())),
        }
    }

    /// The last line of `--json`.
    pub fn to_json(&self, options: &PaperOptions) -> Value {
        let share = |right: usize| right as f64 / self.runs.max(1) as f64;
        let interval = |right: usize| <[f64; 2]>::from(wilson(right, self.runs));
        let mut line = json!({
            "type": "summary",
            "trainer": options.trainer.name,
            "believes": options.believed().name,
            "layouts": name_of(options.homes()),
            "learner": name_of(options.learner),
            "runs": self.runs,
            "train_right": self.train_right.map(share),
            "train_right_intervals": self.train_right.map(interval),
            "test_right": self.test_right.map(share),
            "test_right_intervals": self.test_right.map(interval),
            "test_all_right": share(self.test_all_right),
            "test_all_right_interval": interval(self.test_all_right),
            "translations": translations(self.translations.map(|it| it.mean)),
            "translations_half_intervals": translations(self.translations.map(|it| it.half)),
            "feedback": feedback(self.feedback),
        });
        if let Some(paper) = options.reported_by_paper() {
            let values = paper.translations.map(translations);
            line["paper"] = json!({"tests_right": paper.tests, "train_right": paper.lessons, "translations": values});
        }
        line
    }
}

/// The line of one run.
pub fn run_to_json(run: &Run) -> Value {
    let lessons = &run.results.lessons;
    let tests = &run.results.tests;
    json!({
        "type": "run",
        "seed": run.seed,
        "train_right": lessons.map(|lesson| lesson.understood),
        "endings": lessons.map(|lesson| lesson.ending.name()),
        "steps": lessons.map(|lesson| lesson.steps),
        "test_right": tests.map(|test| test.right),
        "test_probability": tests.map(|test| rounded(test.probability)),
        "translations": translations(run.reported.map(rounded)),
        "feedback": feedback(run.results.feedback()),
    })
}

/// The digits of single precision, without those that conversion adds.
fn rounded(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(0.0)
}

fn translations(values: [f64; REPORTED.len()]) -> Value {
    let mut tokens = Map::new();
    for ((token, _, word), value) in REPORTED.iter().zip(values) {
        tokens.insert((*token).to_owned(), json!({ *word: value }));
    }
    tokens.into()
}

fn feedback(counts: FeedbackCounts) -> Value {
    json!({"reward": counts.reward, "punish": counts.punish, "neutral": counts.neutral})
}

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

/// The names of the values, and a line with these.
pub fn csv(out: &mut impl Write, of: &PaperOptions, summary: &Summary) -> io::Result<()> {
    let fixed = ["trainer", "believes", "layouts", "learner", "seed", "runs", "all_right", "all_right_low", "all_right_high"];
    let mut names: Vec<String> = fixed.map(str::to_owned).into();
    names.extend((1..=LESSONS.len()).map(|number| format!("lesson_{number}")));
    names.extend((1..=TESTS.len()).map(|number| format!("test_{number}")));
    names.extend(REPORTED.iter().map(|(token, _, word)| format!("t_{word}_given_{token}")));
    names.extend(["rewards", "punishments", "silences"].map(str::to_owned));
    printed::csv_line(out, names.into_iter().map(Cell::Text))?;
    let share = |right: usize| right as f64 / summary.runs.max(1) as f64;
    let (low, high) = wilson(summary.test_all_right, summary.runs);
    let mut cells: Vec<Cell> = [&of.trainer.name, &of.believed().name].map(Cell::text).into();
    cells.extend([name_of(of.homes()), name_of(of.learner)].map(Cell::text));
    cells.extend([Cell::number(of.seed), Cell::number(summary.runs)]);
    let shares = [share(summary.test_all_right), low, high].into_iter();
    let shares = shares.chain(summary.train_right.map(share)).chain(summary.test_right.map(share));
    cells.extend(shares.chain(summary.translations.map(|it| it.mean)).map(|number| Cell::Number(format!("{number:.6}"))));
    let said = summary.feedback;
    cells.extend([said.reward, said.punish, said.neutral].map(Cell::number));
    printed::csv_line(out, cells)
}

/// A heat map: a row for each machine token, a column for each word, and darker cells for more probable words.
pub fn learned_words(lexicon: &Lexicon) -> Result<String, Box<dyn Error>> {
    let (left, top, wide, high) = (150, 90, 56, 26);
    let (columns, rows) = (lexicon.words.len() as i32, lexicon.rows.len() as i32);
    let size = ((left + columns * wide + 20) as u32, (top + rows * high + 20) as u32);
    draw(size, |canvas| {
        write(canvas, "What the agent learned: t(word | machine token)", (20, 28), 18, HPos::Left, INK)?;
        for (column, word) in (0..).zip(&lexicon.words) {
            write(canvas, word, (left + column * wide + wide / 2, top - 16), 13, HPos::Center, INK)?;
        }
        for (row, (token, probabilities)) in (0..).zip(&lexicon.rows) {
            let y = top + row * high;
            write(canvas, token, (left - 10, y + high / 2), 13, HPos::Right, INK)?;
            for (column, &probability) in (0..).zip(probabilities) {
                let x = left + column * wide;
                let box_style = shade(probability).filled();
                canvas.draw(&Rectangle::new([(x + 1, y + 1), (x + wide - 1, y + high - 1)], box_style))?;
                if probability >= 0.05 {
                    let ink = if probability > 0.35 { WHITE } else { INK };
                    write(canvas, &format!("{probability:.2}"), (x + wide / 2, y + high / 2), 12, HPos::Center, ink)?;
                }
            }
        }
        Ok(())
    })
}

/// From pale at 0 to the darkest colour at 0.6 and above.
fn shade(probability: f32) -> RGBColor {
    let depth = (probability / 0.6).clamp(0.0, 1.0);
    let mix = |pale: u8, dark: u8| (f32::from(pale) + (f32::from(dark) - f32::from(pale)) * depth).round() as u8;
    RGBColor(mix(PALE.0, 22), mix(PALE.1, 70), mix(PALE.2, 110))
}
