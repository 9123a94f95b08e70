//! `goodbot study`: compares agents that learn from a person's feedback, with many kinds of trainers.
//!
//! The simulation:
//!
//! - [`course`]: the lessons and tests, each a command in a home: its tasks, their facts, and the right actions in each state;
//! - [`trainer`]: the trainers: their feedback to right and wrong actions, its delay, and when they leave;
//! - [`agent`]: the agents: each inference with each language, and goodbot as it is used;
//! - [`trial`]: one agent with one trainer: lessons, then tests;
//! - [`tuning`]: how the settings of the other methods were chosen.
//!
//! The command:
//!
//! - [`plan`]: the courses, trainers, agents and seeds to compare, and the runs;
//! - [`summary`]: means with intervals, as tables, lines and a picture;
//! - [`likeness`]: real trainers, and how similar simulated ones are to them;
//! - [`report`]: the tables of the documentation.
//!
//! ```
//! use goodbot_lab::study::agent::AGENTS;
//! use goodbot_lab::study::course::Course;
//! use goodbot_lab::study::trainer::{TRAINERS, population::Population};
//! use goodbot_lab::study::trial::{CoursePlaces, run};
//! let (agent, trainer, seed) = (&AGENTS[0], &TRAINERS[0], 1);
//! let habits = trainer.habits(&Population::fitted(), seed);
//! let outcome = run(&agent.learns, habits, &mut CoursePlaces::new(Course::Paper, seed)?, seed)?;
//! assert_eq!(outcome.tests_right(), 5);
//! # Ok::<(), goodbot_lab::study::trial::StudyError>(())
//! ```

pub mod agent;
pub mod course;
mod likeness;
mod plan;
mod report;
mod summary;
pub mod trainer;
pub mod trial;
pub mod tuning;

use crate::study::agent::language::program;
use crate::study::agent::{AGENTS, Contestant, Learns};
use crate::study::course::{COMPARED, Course};
use crate::study::trainer::population::Population;
use crate::study::trainer::{TRAINERS, Trainer};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, ValueHint};
use goodbot_console::{Failure, InputFile, Output, between, output};
use plan::{Plan, Run};
use std::io::Write;
use std::path::{Path, PathBuf};
use summary::Row;

/// The trainers in the picture, if none is named.
const DRAWN: [&str; 2] = ["balanced", "mute"];

const EXAMPLES: &str = "\
An agent is an inference and a language: tamer+roles finds the intended task as TAMER does, and learns words as the role \
model does. goodbot, people, asking and paper are goodbot as it is used; they run only where they are named. Those whose \
language is a program of yours run with --program; docs/appendix/study.md says what it reads and answers. The courses free \
and told are taught by balanced, population, mute, contrary and shuffled only.

Every agent meets the same homes and the same trainers: the same seed gives the same lines, whatever the number \
of cores. Each lesson lasts until the agent rests at the goal, at most 150 steps; then come five tests without a word.

With --json the first line names what is compared, then there is a line for each run, and at the end one for each \
course, trainer and agent:
  tests_right      how many of the five tests were right: done, and then rested
  words            how often the trainer said good bot or bad bot, or answered a question
  answers          how many of these were answers
  steps            steps of a lesson; one that ended before the goal counts as 150
  wrongly_certain  percentage of the commands at which it held a wrong task for more than 95 % likely
  gave_up          percentage of lessons that ended before the goal

Examples:
  goodbot study --runs 20
  goodbot study --courses told --agents this+roles,tamer+roles --trainers balanced,mute
  goodbot study --runs 100 --tables --plot study.svg  tables in Markdown, and a picture
  goodbot study --program ./mine --program-runs 30  a program of yours as a language, with fewer seeds
  goodbot study --fit log.jsonl                     what the trainers of a log do, and whether simulated ones are like them";

/// Compare agents that learn from a trainer's words, with many kinds of trainers
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct StudyOptions {
    /// Only these courses, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = courses(), conflicts_with = "tune")]
    pub courses: Vec<String>,
    /// Only these agents, separated by commas [default: each inference with each language]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = agents())]
    pub agents: Vec<String>,
    /// The command of a program that is the language of the agents NAME+program; its arguments have no spaces
    #[arg(long, value_name = "COMMAND")]
    pub program: Option<String>,
    /// The most seconds for an answer of the program, 1 to 86400; the first answer includes its start
    #[arg(long, value_name = "N", default_value = "300", value_parser = between(1_u32, 86_400), requires = "program")]
    pub program_seconds: u32,
    /// How many seeds for the agents NAME+program, the first of --runs [default: all]
    #[arg(long, value_name = "N", value_parser = between(1_u32, 100_000), requires = "program")]
    pub program_runs: Option<u32>,
    /// Only these trainers, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = trainers(), conflicts_with = "tune")]
    pub trainers: Vec<String>,
    /// How many seeds, 1 to 100000, counted up from --seed
    #[arg(long, short = 'n', value_name = "N", default_value = "100", value_parser = between(1_u32, 100_000))]
    pub runs: u32,
    /// The first seed: the same seed gives the same run everywhere
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = between(0, u64::MAX))]
    pub seed: u64,
    /// Fit trainers to session logs, and compare simulated trainers with them
    #[arg(long, value_name = "LOG", num_args = 1.., value_hint = ValueHint::FilePath, conflicts_with_all = ["csv", "json", "tables", "plot"])]
    pub fit: Vec<InputFile>,
    /// Try all settings of the other inferences and of the log-linear language, and tell which are best; on seeds of their own
    #[arg(long, conflicts_with_all = ["fit", "csv", "json", "tables", "plot", "agents"])]
    pub tune: bool,
    /// Print the tables of docs/appendix/study.md
    #[arg(long, conflicts_with_all = ["json", "csv"])]
    pub tables: bool,
    /// Write a picture of the tests that were right, with --trainers or else balanced and mute; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    pub plot: Option<PathBuf>,
    /// Print JSON lines
    #[arg(long)]
    pub json: bool,
    /// Print a table of comma-separated values: a line for each trainer and agent
    #[arg(long, conflicts_with = "json")]
    pub csv: bool,
    /// Replace files that goodbot has not written
    #[arg(long, requires = "plot")]
    pub force: bool,
}

fn courses() -> PossibleValuesParser {
    PossibleValuesParser::new(Course::ALL.map(|course| PossibleValue::new(course.name()).help(course.is())))
}

fn agents() -> PossibleValuesParser {
    PossibleValuesParser::new(AGENTS.iter().map(|agent| PossibleValue::new(agent.name).help(agent.is)))
}

fn trainers() -> PossibleValuesParser {
    PossibleValuesParser::new(TRAINERS.map(|trainer| PossibleValue::new(trainer.name).help(trainer.does)))
}

/// The named ones, in the order of the tables; all if none is named.
fn named<T: Copy>(all: &[T], names: &[String], name: impl Fn(&T) -> &'static str) -> Vec<T> {
    all.iter().filter(|one| names.is_empty() || names.iter().any(|asked| asked == name(one))).copied().collect()
}

impl StudyOptions {
    fn plan(&self) -> Plan {
        // goodbot as it is used plans by itself, which takes much longer.
        let is_default = |agent: &Contestant| match agent.program() {
            Some(_) => self.program.is_some(),
            None => matches!(agent.learns, Learns::Factors(..)),
        };
        let settings = program::Settings::new(self.program.as_deref().unwrap_or_default(), self.program_seconds);
        Plan {
            courses: named(&Course::ALL, &self.courses, |course| course.name()),
            agents: named(AGENTS, &self.agents, |agent: &Contestant| agent.name)
                .into_iter()
                .filter(|agent| !self.agents.is_empty() || is_default(agent))
                .map(|agent| agent.with_program(settings))
                .collect(),
            trainers: named(&TRAINERS, &self.trainers, |trainer: &Trainer| trainer.name),
            population: Population::fitted(),
            seed: self.seed,
            runs: self.runs,
            program_runs: self.program_runs.unwrap_or(self.runs).min(self.runs),
        }
    }

    /// The plan and its runs.
    fn runs(&self) -> Result<(Plan, Vec<Run>), Failure> {
        let plan = self.plan();
        if plan.taught().is_empty() {
            let known = COMPARED.join(", ");
            return Err(Failure::Input(format!("only {known} teach the courses free and told; name one of them, or the course paper")));
        }
        if let Some(agent) = plan.agents.iter().find(|agent| agent.program().is_some_and(|command| command.trim().is_empty())) {
            let name = agent.name;
            return Err(Failure::Input(format!("the language of {name} is a program of yours; give its command by --program")));
        }
        if self.program.is_some() && plan.agents.iter().all(|agent| agent.program().is_none()) {
            return Err(Failure::Input("no agent asks the program; name one, such as sabl+program".to_owned()));
        }
        let runs = plan::run_all(&plan)?;
        Ok((plan, runs))
    }
}

/// Runs the study or fits trainers, and shows the results.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &StudyOptions) -> Result<(), Failure> {
    let plot = Output::picture(&options.plot, [] as [&Path; 0], options.force)?;
    let mut out = output::text(&[plot.as_ref()])?;
    if !options.fit.is_empty() {
        likeness::show(&mut out, options)?;
        return Ok(out.flush()?);
    }
    if options.tune {
        tuning::show(&mut out)?;
        return Ok(out.flush()?);
    }
    let (plan, runs) = options.runs()?;
    let rows = summary::rows(&plan, &runs);
    if let Some(plot) = plot {
        let drawn: Vec<Row> = rows.iter().filter(|row| !options.trainers.is_empty() || DRAWN.contains(&row.trainer)).cloned().collect();
        plot.draw(summary::picture(&plan, &drawn))?;
    }
    if options.tables {
        write!(out, "{}", report::tables(&plan, &runs, &rows))?;
    } else if options.json {
        writeln!(out, "{}", summary::plan_to_json(&plan))?;
        runs.iter().try_for_each(|run| writeln!(out, "{}", summary::run_to_json(&plan, run)))?;
        rows.iter().try_for_each(|row| writeln!(out, "{}", row.to_json()))?;
    } else if options.csv {
        summary::csv(&mut out, &plan, &rows)?;
    } else {
        summary::print(&mut out, &plan, &rows)?;
    }
    Ok(out.flush()?)
}
