//! `goodbot ways`: commands with ways, learned from reward and punishment alone.
//!
//! - [`exercise`]: homes of three storeys, and commands in them;
//! - [`simulation`]: one robot's lessons and tests;
//! - [`picture`]: the results of all robots, as a picture.

mod exercise;
mod picture;
mod simulation;

use crate::mean::Mean;
use crate::mean::wilson;
use clap::{Args, ValueHint};
use goodbot::asking::Asking;
use goodbot::home::{AGENT_IN_ROOM, SCHEMA, with_routes};
use goodbot::task::LiftedTask;
use goodbot::{Capacities, HeapMemory};
use goodbot_console::messages::bar;
use goodbot_console::numbers::between;
use goodbot_console::outcome::Failure;
use goodbot_console::output::{self, Output};
use rayon::prelude::*;
use serde_json::json;
use simulation::{Learned, Setting, simulate};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The options of `goodbot ways`.
#[derive(Debug, Args)]
#[command(after_help = "\
A robot without words hears commands to go somewhere, through a room, through one of two rooms, or without entering a room. Each lesson \
has a new home of three storeys, and the paper's balanced trainer, who is silent seven times out of ten. A test has commands in homes of \
its own, without any feedback; a command is right if the most probable of about 50 tasks is the intended one. The second row is a robot \
that asks.

Examples:
  goodbot ways --runs 200 --lessons 30
  goodbot ways --plot ways.svg")]
pub struct WaysOptions {
    /// Number of robots, 1 to 100000; their seeds count up from --seed
    #[arg(long, short = 'n', value_name = "N", default_value = "20", value_parser = between(1_u32, 100_000), allow_negative_numbers = true)]
    runs: u32,
    /// Seed of the first robot
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = goodbot_console::numbers::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Lessons of each robot, 1 to 500
    #[arg(long, value_name = "N", default_value = "30", value_parser = between(1_usize, 500), allow_negative_numbers = true)]
    lessons: usize,
    /// Test after every N lessons
    #[arg(long, value_name = "N", default_value = "10", value_parser = between(1_usize, 500), allow_negative_numbers = true)]
    every: usize,
    /// Commands of a test, 1 to 1000
    #[arg(long, value_name = "N", default_value = "20", value_parser = between(1_usize, 1_000), allow_negative_numbers = true)]
    tests: usize,
    /// The cost of a question, in steps, for the robot that asks
    #[arg(long, value_name = "STEPS", default_value = "4", value_parser = goodbot_console::numbers::cost)]
    kappa: f32,
    /// Print a line of JSON for each test
    #[arg(long)]
    json: bool,
    /// Write the shares of commands that were understood as a picture; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    plot: Option<PathBuf>,
    /// Replace a file that is no picture of goodbot's
    #[arg(long, requires = "plot")]
    force: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &WaysOptions) -> Result<(), Failure> {
    let asking = Asking { kappa: options.kappa, ..Asking::DEFAULT };
    asking.check().map_err(|error| Failure::Input(error.to_string()))?;
    let task = LiftedTask::single(AGENT_IN_ROOM, &SCHEMA)?;
    let lifted = with_routes(&[task])?.to_vec();
    let plot = Output::picture(&options.plot, [] as [&Path; 0], options.force)?;
    let mut out = output::text(&[plot.as_ref()])?;
    let progress = bar(2 * options.runs as usize, "simulating robots");
    let robots = [("none", Asking::NEVER), ("asked", asking)].map(|(name, asking)| {
        let setting = Setting { lifted: lifted.clone(), asking, lessons: options.lessons, every: options.every, tests: options.tests };
        let learned: Vec<Learned> = (0..options.runs)
            .into_par_iter()
            .map_init(
                || HeapMemory::new(&Capacities { states: 4_096, hashed_states: 0, ..Capacities::STANDARD }),
                |memory, run| {
                    progress.inc(1);
                    simulate(memory, &setting, options.seed.wrapping_add(u64::from(run)))
                },
            )
            .collect::<Result<_, Failure>>()?;
        Ok::<_, Failure>(Robots::new(name, asking, learned, options))
    });
    progress.finish_and_clear();
    let [silent, asking] = robots;
    let robots = [silent?, asking?];
    // The picture comes first, so that it is written even if the reader of the text stops early.
    if let Some(plot) = plot {
        plot.draw(picture::draw(&robots, options))?;
    }
    if !options.json {
        writeln!(out, "questions  lessons  right of {} commands, 95 %      robots with 9 of 10 right", options.tests)?;
    }
    for robots in &robots {
        robots.tell(options, &mut out)?;
    }
    Ok(out.flush()?)
}

/// The results of robots that ask, or of those that never do.
struct Robots {
    /// The name of their kind.
    name: &'static str,
    asking: Asking,
    learned: Vec<Learned>,
    tests: Vec<Test>,
}

/// One test of all robots.
struct Test {
    /// The number of lessons before it.
    lessons: usize,
    /// The commands that were understood, and those that were asked.
    right: usize,
    asked: usize,
    /// The mean share of commands that a robot understood. Robots differ, so the interval is over robots, not over commands.
    share: Mean,
    robots_with_nine_of_ten: usize,
}

impl Robots {
    fn new(name: &'static str, asking: Asking, learned: Vec<Learned>, options: &WaysOptions) -> Self {
        let tests = (0..learned.first().map_or(0, |first| first.right.len())).map(|test| {
            let right: Vec<usize> = learned.iter().filter_map(|robot| robot.right.get(test).copied()).collect();
            Test {
                lessons: (test * options.every).min(options.lessons),
                right: right.iter().sum(),
                asked: right.len() * options.tests,
                share: Mean::of(right.iter().map(|&right| right as f64 / options.tests.max(1) as f64)),
                robots_with_nine_of_ten: right.iter().filter(|&&right| 10 * right >= 9 * options.tests).count(),
            }
        });
        Self { name, asking, tests: tests.collect(), learned }
    }

    /// The mean of a count for one lesson.
    fn in_a_lesson(&self, of: fn(&Learned) -> usize, options: &WaysOptions) -> f64 {
        let all: usize = self.learned.iter().map(of).sum();
        all as f64 / self.learned.len().max(1) as f64 / options.lessons.max(1) as f64
    }

    fn tell(&self, options: &WaysOptions, out: &mut impl Write) -> Result<(), Failure> {
        let (name, robots) = (self.name, self.learned.len());
        for Test { lessons, right, asked, share: Mean { mean, half }, robots_with_nine_of_ten } in &self.tests {
            if options.json {
                let line = json!({
                    "type": "test", "questions": name, "kappa": self.asking.kappa.is_finite().then_some(self.asking.kappa), "lessons": lessons,
                    "robots": robots, "seed": options.seed, "right": right, "asked": asked, "accuracy": mean,
                    "interval": [mean - half, mean + half], "robots_with_nine_of_ten": robots_with_nine_of_ten,
                });
                writeln!(out, "{line}")?;
            } else {
                let (low, high) = wilson(*robots_with_nine_of_ten, robots);
                writeln!(
                    out,
                    "{name:9}  {lessons:7}  {:6.1} % ± {:3.1}  {right:5} of {asked:5}    {:5.1} %  ({:.0} to {:.0})",
                    100.0 * mean,
                    100.0 * half,
                    100.0 * *robots_with_nine_of_ten as f64 / robots.max(1) as f64,
                    100.0 * low,
                    100.0 * high
                )?;
            }
        }
        let steps = self.in_a_lesson(|it| it.steps, options);
        let (words, questions) = (self.in_a_lesson(|it| it.words, options), self.in_a_lesson(|it| it.questions, options));
        if options.json {
            let line = json!({"type": "lessons", "questions": name, "steps": steps, "words": words, "questions_asked": questions});
            writeln!(out, "{line}")?;
        } else {
            writeln!(out, "{:9}  a lesson took {steps:.1} steps, {words:.1} words of feedback, {questions:.2} questions", "")?;
        }
        Ok(())
    }
}
