//! All runs of one agent with one trainer together: means with 95 % intervals.

use super::plan::Plan;
use super::runs::Run;
use crate::mean::Mean;
use crate::study::trainer::Who;
use crate::study::trial::{Ending, MOST_STEPS};
use goodbot_course::{LESSONS, TESTS};
use serde_json::{Value, json};

/// The part of a population's people that is told apart.
const WORST: u32 = 10;

/// What is counted in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// How many of the five tests were right.
    Tests,
    /// How many words the trainer said in the seven lessons, answers included.
    Words,
    /// How many of them were answers.
    Answers,
    /// Steps of a lesson until the agent rested at the goal; one that did not get there counts as all that were allowed.
    Steps,
    /// The percentage of the twelve commands at which the agent was certain of a wrong task.
    WronglyCertain,
    /// The percentage of the seven lessons that ended before the goal.
    GaveUp,
}

impl Column {
    /// All, in the order of the tables.
    pub const ALL: [Self; 6] = [Self::Tests, Self::Words, Self::Answers, Self::Steps, Self::WronglyCertain, Self::GaveUp];

    /// Its name in data.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tests => "tests_right",
            Self::Words => "words",
            Self::Answers => "answers",
            Self::Steps => "steps",
            Self::WronglyCertain => "wrongly_certain",
            Self::GaveUp => "gave_up",
        }
    }

    /// Its head in tables.
    pub const fn head(self) -> &'static str {
        match self {
            Self::Tests => "tests right, of 5",
            Self::Words => "words said",
            Self::Answers => "of these answers",
            Self::Steps => "steps a lesson",
            Self::WronglyCertain => "wrongly certain, %",
            Self::GaveUp => "gave up, %",
        }
    }

    /// Its value in a run; `None` where it cannot be told.
    fn of(self, run: &Run) -> Option<f64> {
        let (lessons, tests) = (&run.outcome.lessons, &run.outcome.tests);
        let gave_up = lessons.iter().filter(|lesson| lesson.ending != Ending::Goal).count();
        Some(match self {
            Self::Tests => run.outcome.tests_right() as f64,
            Self::Words => lessons.iter().map(|lesson| f64::from(lesson.words)).sum(),
            Self::Answers => lessons.iter().map(|lesson| f64::from(lesson.answers)).sum(),
            Self::Steps => steps(run).map(f64::from).sum::<f64>() / LESSONS.len() as f64,
            Self::WronglyCertain => {
                let certain = lessons.iter().map(|lesson| lesson.wrongly_certain).chain(tests.iter().map(|test| test.wrongly_certain));
                let certain: Option<Vec<bool>> = certain.collect();
                100.0 * certain?.into_iter().filter(|&is| is).count() as f64 / (LESSONS.len() + TESTS.len()) as f64
            }
            Self::GaveUp => 100.0 * gave_up as f64 / LESSONS.len() as f64,
        })
    }
}

/// The steps of each lesson, as the column has them.
fn steps(run: &Run) -> impl Iterator<Item = u16> {
    run.outcome.lessons.iter().map(|lesson| if lesson.ending == Ending::Goal { lesson.steps } else { MOST_STEPS })
}

/// One agent with one trainer.
#[derive(Clone, Debug)]
pub struct Row {
    /// The trainer's name.
    pub trainer: String,
    /// The agent's name.
    pub agent: &'static str,
    /// How many seeds.
    pub seeds: usize,
    /// The mean of each column; `None` where it cannot be told.
    pub means: [Option<Mean>; Column::ALL.len()],
    /// The median of the steps of all lessons.
    pub median_steps: u16,
}

impl Row {
    fn of(trainer: &str, agent: &'static str, runs: &[&Run]) -> Self {
        let mean = |column: Column| {
            let values: Option<Vec<f64>> = runs.iter().map(|run| column.of(run)).collect();
            values.map(|values| Mean::of(values.into_iter()))
        };
        let mut all: Vec<u16> = runs.iter().flat_map(|run| steps(run)).collect();
        all.sort_unstable();
        let median_steps = all.get(all.len() / 2).copied().unwrap_or(0);
        Self { trainer: trainer.to_owned(), agent, seeds: runs.len(), means: Column::ALL.map(mean), median_steps }
    }

    /// The mean of a column.
    pub fn mean(&self, column: Column) -> Option<Mean> {
        self.means[column as usize]
    }

    /// As a line of JSON.
    pub fn to_json(&self) -> Value {
        let mut line = json!({"type": "summary", "trainer": self.trainer, "agent": self.agent, "seeds": self.seeds});
        if let Some(fields) = line.as_object_mut() {
            for column in Column::ALL {
                let mean = self.mean(column);
                let interval = mean.map(|Mean { mean, half }| [mean - half, mean + half]);
                fields.insert(column.name().to_owned(), json!({"mean": mean.map(|mean| mean.mean), "interval": interval}));
            }
            fields.insert("median_steps".to_owned(), json!(self.median_steps));
        }
        line
    }
}

/// A row for each trainer and agent, in the plan's order. The people whose words tell least follow those of whom they are a part.
pub fn rows(plan: &Plan, runs: &[Run]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (trainer, teaches) in plan.trainers.iter().enumerate() {
        let mut group = |name: &str, has: &dyn Fn(u64) -> bool| {
            for (agent, contestant) in plan.agents.iter().enumerate() {
                let own: Vec<&Run> = runs.iter().filter(|run| run.trainer == trainer && run.agent == agent && has(run.seed)).collect();
                rows.push(Row::of(name, contestant.name, &own));
            }
        };
        group(teaches.name, &|_| true);
        if let Who::Population { .. } = teaches.who {
            let worst = least_telling(plan);
            group(&format!("{}, worst tenth", teaches.name), &|seed| worst.contains(&seed));
        }
    }
    rows
}

/// The tenth of the seeds whose person's words tell least whether an action was right. Every agent meets the same.
fn least_telling(plan: &Plan) -> Vec<u64> {
    let mut people: Vec<(f64, u64)> =
        (0..plan.runs).map(|at| plan.seed_at(at)).map(|seed| (plan.population.person(seed).information(), seed)).collect();
    people.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    people.truncate(plan.runs.div_ceil(WORST) as usize);
    people.into_iter().map(|(_, seed)| seed).collect()
}
