//! The results of one agent with one trainer in one course, means with 95 % intervals: as a table for each course and trainer, as
//! comma-separated values, as JSON lines with those of the runs, and as a picture with a bar for each agent.

use super::agent::Learns;
use super::course::Course;
use super::plan::{Plan, Run};
use super::trial::{Ending, LessonOutcome, Outcome};
use crate::calibration::Mean;
use crate::canvas::{BLUE, Canvas, Drawn, GREEN, INK, PALE, draw, write};
use goodbot_console::printed;
use goodbot_console::printed::Cell;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use serde_json::{Value, json};
use std::error::Error;
use std::io::{self, Write};

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

/// Prints a table for each course and trainer.
pub fn print(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let last = plan.seed_at(plan.runs - 1);
    writeln!(out, "Seeds {} to {last}; means with 95 % intervals.", plan.seed)?;
    let wide = rows.iter().map(|row| row.agent.len()).max().unwrap_or(0);
    for group in rows.chunks(plan.agents.len()) {
        let Some(first) = group.first() else { continue };
        writeln!(out, "\nCourse {}, trainer {}", first.course.name(), first.trainer)?;
        write!(out, "  {:wide$}", "")?;
        for column in Column::ALL {
            write!(out, "  {:>20}", column.head())?;
        }
        writeln!(out)?;
        for row in group {
            write!(out, "  {:wide$}", row.agent)?;
            for column in Column::ALL {
                write!(out, "  {:>20}", told(row.mean(column)))?;
            }
            writeln!(out)?;
        }
    }
    Ok(())
}

/// A mean with half of its interval.
fn told(Mean { mean, half }: Mean) -> String {
    if mean.abs() < 10.0 { format!("{mean:.2} ± {half:.2}") } else { format!("{mean:.1} ± {half:.1}") }
}

/// A line for each course, trainer and agent.
pub fn csv(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let names = Column::ALL.map(|column| format!("{0},{0}_low,{0}_high", column.name()));
    writeln!(out, "course,trainer,agent,seed,seeds,{}", names.join(","))?;
    for row in rows {
        let cells = Column::ALL.map(|column| {
            let Mean { mean, half } = row.mean(column);
            [mean, mean - half, mean + half].map(|number| Cell::Number(format!("{number:.6}")))
        });
        let names = [row.course.name(), row.trainer, row.agent].map(Cell::text);
        printed::csv_line(
            out,
            names.into_iter().chain([Cell::number(plan.seed), Cell::number(row.seeds)]).chain(cells.into_iter().flatten()),
        )?;
    }
    Ok(())
}

/// The version of the lines.
const VERSION: u64 = 4;

/// The first line: the plan, with all settings.
pub fn plan_to_json(plan: &Plan) -> Value {
    let agents: Vec<Value> = plan.agents.iter().map(|agent| json!({"name": agent.name, "settings": agent.learns.to_string()})).collect();
    let trainers: Vec<&str> = plan.trainers.iter().map(|trainer| trainer.name).collect();
    let courses: Vec<&str> = plan.courses.iter().map(|course| course.name()).collect();
    json!({
        "type": "study",
        "version": VERSION,
        "program": env!("CARGO_PKG_VERSION"),
        "courses": courses,
        "agents": agents,
        "trainers": trainers,
        "seed": plan.seed,
        "runs": plan.runs,
        "program_runs": plan.program_runs,
    })
}

/// The line of a run.
pub fn run_to_json(plan: &Plan, run: &Run) -> Value {
    let Outcome { lessons, tests } = &run.outcome;
    let of = |number: fn(&LessonOutcome) -> u16| lessons.iter().map(number).collect::<Vec<_>>();
    let certain = lessons.iter().map(|lesson| lesson.wrongly_certain).chain(tests.iter().map(|test| test.wrongly_certain));
    json!({
        "type": "run",
        "seed": run.seed,
        "course": plan.courses[run.course].name(),
        "trainer": plan.trainers[run.trainer].name,
        "agent": plan.agents[run.agent].name,
        "endings": lessons.iter().map(|lesson| lesson.ending.name()).collect::<Vec<_>>(),
        "steps": of(|lesson| lesson.steps),
        "words": of(|lesson| lesson.words),
        "answers": of(|lesson| lesson.answers),
        "tests": tests.iter().map(|test| test.right).collect::<Vec<_>>(),
        "wrongly_certain": certain.collect::<Vec<_>>(),
    })
}

/// Panels beside each other.
const PANELS: usize = 2;
// In pixels: the names of agents, the bars, the numbers after them, and the height of a bar.
const LEFT: i32 = 130;
const WIDE: i32 = 240;
const RIGHT: i32 = 110;
const HIGH: i32 = 20;

/// Draws them.
pub fn picture(plan: &Plan, rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let agents = plan.agents.len();
    let groups: Vec<&[Row]> = rows.chunks(agents).collect();
    let most = rows.iter().map(|row| row.mean(Column::Tests)).map(|Mean { mean, half }| mean + half).fold(1e-9, f64::max);
    let (across, down) = (LEFT + WIDE + RIGHT, 46 + agents as i32 * HIGH);
    let size = ((across * PANELS as i32 + 20) as u32, (80 + down * groups.len().div_ceil(PANELS) as i32) as u32);
    draw(size, |canvas| {
        let title = format!("{}: {} seeds, means with 95 % intervals", Column::Tests.head(), plan.runs);
        write(canvas, &title, (20, 28), 18, HPos::Left, INK)?;
        write(canvas, "blue: goodbot as it is used; green: an inference and a language", (20, 54), 13, HPos::Left, INK)?;
        for (number, group) in groups.iter().enumerate() {
            let corner = ((number % PANELS) as i32 * across, 80 + (number / PANELS) as i32 * down);
            panel(canvas, plan, group, most, corner)?;
        }
        Ok(())
    })
}

fn panel(canvas: &Canvas<'_>, plan: &Plan, group: &[Row], most: f64, corner: (i32, i32)) -> Drawn {
    let Some(first) = group.first() else { return Ok(()) };
    let left = corner.0 + LEFT;
    write(canvas, &format!("{}: {}", first.course.name(), first.trainer), (left, corner.1 + 10), 14, HPos::Left, INK)?;
    let at = |value: f64| left + (value.max(0.0) / most * f64::from(WIDE)).round() as i32;
    for ((row, contestant), y) in group.iter().zip(&plan.agents).zip((corner.1 + 22..).step_by(HIGH as usize)) {
        let middle = y + HIGH / 2;
        write(canvas, row.agent, (left - 8, middle), 12, HPos::Right, INK)?;
        canvas.draw(&Rectangle::new([(left, y + 3), (left + WIDE, y + HIGH - 3)], PALE.filled()))?;
        let Mean { mean, half } = row.mean(Column::Tests);
        let color = if matches!(contestant.learns, Learns::Whole(_)) { BLUE } else { GREEN };
        canvas.draw(&Rectangle::new([(left, y + 3), (at(mean), y + HIGH - 3)], color.filled()))?;
        canvas.draw(&PathElement::new([(at(mean - half), middle), (at(mean + half), middle)], INK.stroke_width(2)))?;
        write(canvas, &told(Mean { mean, half }), (left + WIDE + 6, middle), 12, HPos::Left, INK)?;
    }
    Ok(())
}
