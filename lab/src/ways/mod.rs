//! `goodbot ways`: commands with ways, learned from reward and punishment alone.
//!
//! - [`exercise`]: homes of three storeys, and commands in them.

mod exercise;

use crate::calibration::{Mean, wilson};
use crate::canvas::{BLUE, GREEN, INK, chart, draw as canvas};
use crate::questions::answer;
use clap::{Args, ValueHint};
use exercise::{Exercise, ThreeStoreys};
use goodbot::asking::Asking;
use goodbot::feedback::Strategy;
use goodbot::home::{AGENT_IN_ROOM, SCHEMA, with_routes};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_console::{Failure, Output, bar, between, output};
use goodbot_course::{CourseTrainer, Lesson, Turn, generator};
use plotters::prelude::*;
use rayon::prelude::*;
use serde_json::json;
use std::error::Error;
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
    #[arg(long, short = 'n', value_name = "N", default_value = "20", value_parser = between(1_u32, 100_000))]
    runs: u32,
    /// Seed of the first robot
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = goodbot_console::typed::seed)]
    seed: u64,
    /// Lessons of each robot, 1 to 500
    #[arg(long, value_name = "N", default_value = "30", value_parser = between(1_usize, 500))]
    lessons: usize,
    /// Test after every N lessons
    #[arg(long, value_name = "N", default_value = "10", value_parser = between(1_usize, 500))]
    every: usize,
    /// Commands of a test, 1 to 1000
    #[arg(long, value_name = "N", default_value = "20", value_parser = between(1_usize, 1_000))]
    tests: usize,
    /// The cost of a question, in steps, for the robot that asks
    #[arg(long, value_name = "STEPS", default_value = "4", value_parser = goodbot_console::typed::cost)]
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
        plot.draw(draw(&robots, options))?;
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

/// One line for robots that never ask, and one for those that do. Vertical strokes are 95 % intervals over robots.
fn draw(robots: &[Robots; 2], options: &WaysOptions) -> Result<String, Box<dyn Error>> {
    canvas((720, 440), |area| {
        let caption = format!("Commands that say how, understood by {} robots after lessons", options.runs);
        let right = format!("% right of {} commands", options.tests);
        let mut chart = chart(area, &caption, [("lessons", options.lessons.max(1) as f64), (&right, 100.0)])?;
        for (robots, color, name) in [(&robots[0], BLUE, "never asks"), (&robots[1], GREEN, "asks")] {
            let at =
                |test: &Test, shift: f64| (test.lessons as f64, (100.0 * (test.share.mean + shift * test.share.half)).clamp(0.0, 100.0));
            let line = LineSeries::new(robots.tests.iter().map(|test| at(test, 0.0)), color.stroke_width(2));
            chart.draw_series(line)?.label(name).legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
            let intervals = robots.tests.iter().map(|test| PathElement::new([at(test, -1.0), at(test, 1.0)], color.stroke_width(1)));
            chart.draw_series(intervals)?;
            chart.draw_series(robots.tests.iter().map(|test| Circle::new(at(test, 0.0), 3, color.filled())))?;
        }
        chart.configure_series_labels().position(SeriesLabelPosition::UpperLeft).border_style(INK).background_style(WHITE).draw()?;
        Ok(())
    })
}

/// The settings of the simulation.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The kinds of tasks that commands may mean.
    pub lifted: Vec<LiftedTask>,
    /// When the robot asks.
    pub asking: Asking,
    /// The number of lessons.
    pub lessons: usize,
    /// The robot is tested before the first lesson, and after each this many lessons.
    pub every: usize,
    /// The number of commands in a test.
    pub tests: usize,
}

/// The results of one robot.
#[derive(Clone, Debug, Default)]
pub struct Learned {
    /// Commands understood in each test.
    pub right: Vec<usize>,
    /// Steps of all lessons.
    pub steps: usize,
    /// Words of reward and punishment in all lessons.
    pub words: usize,
    /// Questions in all lessons.
    pub questions: usize,
}

/// Trains one robot, each lesson in a new home, with the paper's balanced trainer.
///
/// # Errors
/// The robot's error.
pub fn simulate(memory: &mut HeapMemory, setting: &Setting, seed: u64) -> Result<Learned, Failure> {
    let mut random = generator(seed);
    // Tests are drawn separately, so that they are the same with and without questions.
    let mut drawn = generator(seed ^ TESTS);
    let mut agent = Agent::new(&mut memory.agent, &setting.lifted, Options::DEFAULT)?;
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)])?;
    let mut learned = Learned::default();
    for lesson in 0..=setting.lessons {
        if lesson % setting.every.max(1) == 0 || lesson == setting.lessons {
            let mut right = 0;
            for _ in 0..setting.tests {
                let home = ThreeStoreys::random(&mut memory.home, &mut drawn).map_err(|error| Failure::Result(error.to_string()))?;
                let exercise = Exercise::random(&home, &mut drawn);
                agent.hear(&home.home, &home.start, &exercise.command)?;
                let meant = exercise.find(&agent, &home);
                right += usize::from(meant.is_some() && agent.most_likely() == meant);
            }
            learned.right.push(right);
        }
        if lesson == setting.lessons {
            break;
        }
        let home = ThreeStoreys::random(&mut memory.home, &mut random).map_err(|error| Failure::Result(error.to_string()))?;
        let exercise = Exercise::random(&home, &mut random);
        agent.hear(&home.home, &home.start, &exercise.command)?;
        let Some(meant) = exercise.find(&agent, &home) else {
            return Err(Failure::Result(format!("no task of the home is what \"{}\" means", exercise.command)));
        };
        let mut under_way = Lesson::meaning(&home.start, meant);
        let report = loop {
            let state = *under_way.state();
            agent.plan_fully(&home.home, &state)?;
            while let Some(question) = agent.question(&home.home, &state, &setting.asking)? {
                learned.questions += 1;
                let _ = agent.answer(answer(&question, meant, setting.asking.eta, &mut random))?;
            }
            match under_way.act(&mut agent, &home.home, &CourseTrainer::BALANCED, &mut random) {
                Ok(Turn::Acted(_)) => {}
                Ok(Turn::Ended(ending)) => break under_way.report(ending),
                Err(error) => return Err(Failure::Result(error.to_string())),
            }
        };
        let _ = agent.finish(&home.home)?;
        agent.learn_fully();
        learned.steps += usize::from(report.steps);
        learned.words += (report.feedback.reward + report.feedback.punish) as usize;
    }
    Ok(learned)
}

/// Separates the seed of the tests from that of the lessons.
const TESTS: u64 = 0x7e57_7e57_7e57_7e57;
