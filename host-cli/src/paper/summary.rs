//! All runs together, and the JSON lines.

use super::experiment::Run;
use crate::cli::PaperOptions;
use goodbot_course::{FeedbackCounts, LESSONS, TESTS};
use serde_json::{Map, Value, json};

/// The translations that the paper reports, and those that tell go from take.
pub const REPORTED: [(&str, &str); 4] = [("agentInRoom", "go"), ("shapeBag", "bag"), ("roomIsRed", "red"), ("blockInRoom", "take")];

/// Shares over all runs.
#[derive(Debug)]
pub struct Summary {
    /// How many runs.
    pub runs: usize,
    /// For each lesson: the share of runs in which its command was understood on hearing it.
    pub train_right: [f64; LESSONS.len()],
    /// For each test: the share of runs in which the most likely task was the intended one.
    pub test_right: [f64; TESTS.len()],
    /// The share of runs in which all tests were right.
    pub test_all_right: f64,
    /// The mean of each of [`REPORTED`].
    pub translations: [f64; REPORTED.len()],
    /// What the trainers said, all runs together.
    pub feedback: FeedbackCounts,
}

impl Summary {
    /// The shares of these runs.
    pub fn of(runs: &[Run]) -> Self {
        let whole = runs.len().max(1) as f64;
        let share = |right: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| right(run)).count() as f64 / whole;
        let mean = |(token, word)| runs.iter().map(|run| f64::from(run.lexicon.translation(token, word))).sum::<f64>() / whole;
        Self {
            runs: runs.len(),
            train_right: std::array::from_fn(|lesson| share(&|run| run.results.lessons[lesson].understood)),
            test_right: std::array::from_fn(|test| share(&|run| run.results.tests[test].right)),
            test_all_right: share(&|run| run.results.all_tests_right()),
            translations: REPORTED.map(mean),
            feedback: runs.iter().fold(FeedbackCounts::default(), |sum, run| sum.plus(run.results.feedback())),
        }
    }

    /// The last line of `--json`.
    pub fn to_json(&self, options: &PaperOptions) -> Value {
        json!({
            "type": "summary",
            "trainer": options.trainer.name,
            "layouts": options.homes().name(),
            "runs": self.runs,
            "train_right": self.train_right,
            "test_right": self.test_right,
            "test_all_right": self.test_all_right,
            "translations": translations(self.translations),
            "feedback": feedback(self.feedback),
        })
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
        "translations": translations(REPORTED.map(|(token, word)| rounded(run.lexicon.translation(token, word)))),
        "feedback": feedback(run.results.feedback()),
    })
}

/// As many digits as single precision has, and no others.
fn rounded(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(0.0)
}

fn translations(values: [f64; REPORTED.len()]) -> Value {
    let mut tokens = Map::new();
    for ((token, word), value) in REPORTED.iter().zip(values) {
        tokens.insert((*token).to_owned(), json!({ *word: value }));
    }
    tokens.into()
}

fn feedback(counts: FeedbackCounts) -> Value {
    json!({"reward": counts.reward, "punish": counts.punish, "neutral": counts.neutral})
}
