//! The summary of all runs, and the JSON lines.

use super::experiment::Run;
use super::reported::REPORTED;
use super::settings::Setting;
use goodbot_console::numbers::name_of;
use goodbot_course::{FeedbackCounts, LESSONS, TESTS};
use goodbot_lab::mean::Mean;
use goodbot_lab::mean::wilson;
use serde_json::{Map, Value, json};

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
    pub fn to_json(&self, setting: &Setting) -> Value {
        let options = &setting.options;
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
        for (sweep, &value) in options.sweep.iter().zip(&setting.values) {
            line["sweep"][&sweep.name] = json!(rounded(value));
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
