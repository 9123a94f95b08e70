//! The results of one agent with one trainer in one course: means with 95 % intervals.

use super::plan::Plan;
use super::runs::Run;
use crate::mean::Mean;
use crate::study::course::Course;
use crate::study::trial::Ending;
use serde_json::{Value, json};

/// The figures of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// How many of the five tests were right.
    Tests,
    /// How many words the trainer gave in all lessons, answers included.
    Words,
    /// How many of them were answers.
    Answers,
    /// The steps of a lesson until the agent rested at the goal; a lesson that ended before counts as the most steps.
    Steps,
    /// The percentage of commands for which the agent was ever certain of a wrong task.
    WronglyCertain,
    /// The percentage of the lessons that ended before the goal.
    GaveUp,
}

impl Column {
    /// All columns, in the order of the tables.
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

    /// Its value in a run.
    fn of(self, run: &Run) -> f64 {
        let (lessons, tests) = (&run.outcome.lessons, &run.outcome.tests);
        let commands = (lessons.len() + tests.len()) as f64;
        match self {
            Self::Tests => run.outcome.tests_right() as f64,
            Self::Words => lessons.iter().map(|lesson| f64::from(lesson.words)).sum(),
            Self::Answers => lessons.iter().map(|lesson| f64::from(lesson.answers)).sum(),
            Self::Steps => run.outcome.steps().map(f64::from).sum::<f64>() / lessons.len() as f64,
            Self::WronglyCertain => {
                let certain = lessons.iter().map(|lesson| lesson.wrongly_certain).chain(tests.iter().map(|test| test.wrongly_certain));
                100.0 * certain.filter(|&is| is).count() as f64 / commands
            }
            Self::GaveUp => 100.0 * lessons.iter().filter(|lesson| lesson.ending != Ending::Goal).count() as f64 / lessons.len() as f64,
        }
    }
}

/// The results of one agent with one trainer in one course.
#[derive(Clone, Debug)]
pub struct Row {
    /// The course.
    pub course: Course,
    /// The trainer's name.
    pub trainer: &'static str,
    /// The agent's name.
    pub agent: &'static str,
    /// The number of seeds.
    pub seeds: usize,
    /// The mean of each column.
    pub means: [Mean; Column::ALL.len()],
}

impl Row {
    /// The mean of a column.
    pub fn mean(&self, column: Column) -> Mean {
        self.means[column as usize]
    }

    /// The row as a line of JSON.
    pub fn to_json(&self) -> Value {
        let (course, trainer) = (self.course.name(), self.trainer);
        let mut line = json!({"type": "summary", "course": course, "trainer": trainer, "agent": self.agent, "seeds": self.seeds});
        for column in Column::ALL {
            let Mean { mean, half } = self.mean(column);
            line[column.name()] = json!({"mean": mean, "interval": [mean - half, mean + half]});
        }
        line
    }
}

/// A row for each course, trainer and agent, in the plan's order.
pub fn rows(plan: &Plan, runs: &[Run]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (course, trainer) in plan.taught() {
        let taught: Vec<&Run> = runs.iter().filter(|run| (run.course, run.trainer) == (course, trainer)).collect();
        for (agent, contestant) in plan.agents.iter().enumerate() {
            let own: Vec<&Run> = taught.iter().copied().filter(|run| run.agent == agent).collect();
            rows.push(Row {
                course: plan.courses[course],
                trainer: plan.trainers[trainer].name,
                agent: contestant.name,
                seeds: own.len(),
                means: Column::ALL.map(|column| Mean::of(own.iter().map(|run| column.of(run)))),
            });
        }
    }
    rows
}
