//! `goodbot teach`: train the robot, on a screen or in lines.
//!
//! - [`pupil`]: a robot in its [`site`], and the session under way: all calls to the core;
//! - [`kept`]: the robot's files; [`lessons`]: the tour, and what to teach next; [`classroom`]: all of these together;
//! - [`protocol`]: lines in, JSON out;
//! - [`visit`]: the effects of [`keys`] and of time. [`screen`] draws it in the colours of [`palette`], on a [`terminal`].

mod classroom;
pub mod kept;
mod keys;
mod lessons;
mod palette;
mod protocol;
mod pupil;
mod screen;
pub mod site;
mod terminal;
mod visit;

use clap::{Args, ValueHint};
use classroom::Classroom;
use goodbot_console::load::input::Place;
use goodbot_console::load::kinds;
use goodbot_console::messages::is_colored;
use goodbot_console::{
    Believes, ClosedWordOptions, Failure, InputFile, Learner, Printed, StarterOptions, SynonymOptions, between, counted, input, printed,
    say,
};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::world::WorldFile;
use goodbot_lesson::first_words::words_read;
use goodbot_lesson::world::robot::{self, Tables};
use kept::{Kept, Past, RobotFiles};
use lessons::Tour;
use palette::Palette;
use pupil::{Pupil, build, kinds_of_task};
use site::Setting;
use std::io::{IsTerminal, Write, stdin};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use visit::Visit;
use visit::time::Pace;

/// The default names of the robot, and of the tour's robot.
const ROBOT: &str = "robot";
const TOUR_ROBOT: &str = "tour";

/// The options of `goodbot teach`.
#[derive(Debug, Args)]
#[command(after_help = "\
The robot is saved after each session, by its name in the platform's folder for data, or in the files of --model and --log. With --lines, nothing \
is saved unless --model or --robot is given.

Without a terminal, or with --lines, each line of standard input is a request, such as command go to the red room, step, good, bad, silence, \
finish; the answers are lines of JSON. Send help for all requests. docs/teach.md describes them.

Examples:
  goodbot teach                        teach your robot in a home of four rooms
  goodbot teach --tour                 the paper's seven lessons and five tests
  goodbot teach home.json              a home of your own; a drawing does too
  goodbot teach lift.json              any robot, in a world from a file (goodbot example world prints one)
  goodbot teach --random --seed 7      a home at random
  goodbot teach --starter en           a robot that knows everyday English
  goodbot teach --wanted commands.txt  the commands that it is to understand; tab proposes the next lesson
  printf 'command go to the red room\\nstep\\ngood\\nfinish\\n' | goodbot teach --seed 1")]
pub struct TeachOptions {
    /// A home: an environment (JSON), or a drawing; or a world with a robot (JSON) [default: four rooms, a chair and a bag]
    #[arg(value_name = "HOME", value_hint = ValueHint::FilePath)]
    home: Option<InputFile>,
    /// The paper's lessons and tests, one after the other; with --seed in random homes
    #[arg(long, conflicts_with_all = ["home", "random", "starter"])]
    tour: bool,
    /// A home at random
    #[arg(long, conflicts_with = "home")]
    random: bool,
    /// Seed of everything that is drawn: the same seed and the same words give the same visit [default: 1]
    #[arg(long, short = 's', value_name = "S", value_parser = between(0, u64::MAX))]
    seed: Option<u64>,
    /// Consider ways too: commands may mean to go through a room, through one of two, or to avoid one
    #[arg(long, conflicts_with = "tour")]
    routes: bool,
    /// The trainer that the robot expects: population (real people), paper, or probabilities as in replay [default: population, or a saved robot's
    /// own belief]
    #[arg(long, value_parser = of_trainer, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON[,LAGS]", allow_hyphen_values = true)]
    believes: Option<Believes>,
    #[command(flatten)]
    starter: StarterOptions,
    /// How fast the robot goes
    #[arg(long, value_enum, default_value_t, conflicts_with = "lines")]
    speed: Pace,
    /// The robot's name, by which it is saved [default: robot, or tour for the tour]
    #[arg(long, value_name = "NAME", conflicts_with = "model")]
    robot: Option<String>,
    /// The robot's model file
    #[arg(long, short = 'm', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: Option<PathBuf>,
    /// The log to which its sessions are added [default: beside the model, ending in .jsonl]
    #[arg(long, value_name = "FILE", requires = "model", value_hint = ValueHint::FilePath)]
    log: Option<PathBuf>,
    /// The commands that it should understand in the end, one on each line: they decide what to teach next [default: the commands so far]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    wanted: Option<PathBuf>,
    #[command(flatten)]
    closed_words: ClosedWordOptions,
    #[command(flatten)]
    synonyms: SynonymOptions,
    /// Read requests as lines, also in a terminal
    #[arg(long)]
    lines: bool,
}

/// Runs the command.
pub fn run(options: &TeachOptions) -> Result<(), Failure> {
    let seed = options.seed.unwrap_or(1);
    let dumb = std::env::var("TERM").is_ok_and(|terminal| terminal == "dumb");
    let lines = options.lines || dumb || !stdin().is_terminal() || !printed::is_terminal();
    let mut classroom = open(options, lines)?;
    if !lines {
        return visit(classroom, options.speed, seed);
    }
    let spoken = protocol::speak(&mut classroom, seed, stdin().lock(), Printed::stdout())?;
    match spoken.refused {
        0 => Ok(()),
        refused => Err(Failure::Input(format!("{} refused; see the lines of type error", counted(refused, "request")))),
    }
}

/// A visit in the terminal.
fn visit(classroom: Classroom, pace: Pace, seed: u64) -> Result<(), Failure> {
    let palette = if is_colored() { Palette::of_terminal() } else { Palette::None };
    let mut visit = Visit::new(classroom, pace, seed);
    let shown = terminal::show(&mut visit, palette);
    // Learning is completed, and a session under way goes to the log.
    let written = visit.classroom.leave();
    let learned = visit.classroom.pupil.lessons_learned();
    if let Some(kept) = visit.classroom.kept.as_ref().filter(|_| learned > 0) {
        // If the window was closed, nobody reads this.
        let all = counted(learned, "session");
        let told = if kept.sessions() < learned { format!("{all}, and the file has {} of them", kept.sessions()) } else { all };
        let mut out = Printed::stdout();
        let _ = writeln!(out, "It has learned from {told}: {}", kept.files().model.display()).and_then(|()| out.flush());
    }
    written.map_err(|refusal| Failure::Result(refusal.to_string()))?;
    match shown {
        Err(error) if printed::is_terminal() && stdin().is_terminal() => Err(Failure::Output(error)),
        _ => Ok(()),
    }
}

/// Opens the robot with its files, in its home.
fn open(options: &TeachOptions, lines: bool) -> Result<Classroom, Failure> {
    let home = setting(options)?;
    let world = if let Setting::Other(world) = &home { Some(world) } else { None };
    let place = build(&home).and_then(|place| Ok((kinds_of_task(&place.0, options.routes)?, place)));
    let (mut lifted, place) = place.map_err(|refusal| match &options.home {
        Some(file) => Failure::Input(format!("{}: {refusal}", input::name(file))),
        None => refusal,
    })?;
    let files = robot_files(options, lines, world)?;
    // What is read of these files is still there when they are written: nobody else writes them from here on.
    let kept = files.map(|files| Kept::open(files, world)).transpose()?;
    if let (None, Some((kept, Past { model: Some(model), .. }))) = (world, &kept)
        && let Some(kinds) = kinds::kept(&kept.files().model, model)?
    {
        lifted = kinds::agreed(&kept.files().model, kinds, options.routes.then_some(lifted), "--routes")?;
    }
    if options.starter.is_given() && world.is_some() {
        return Err(Failure::Input("--starter is for homes; leave it out in a world from a file".to_owned()));
    }
    let starter = options.starter.read(&lifted, Learner::Default.options())?;
    let mut pupil = Pupil::new(place, &lifted, options.seed.unwrap_or(1), options.believes.clone(), starter)?;
    pupil.lesson.closed = options.closed_words.read()?;
    pupil.synonyms = options.synonyms.read()?;
    let learned = kept.iter().flat_map(|(_, past)| past.learned.iter().map(String::as_str));
    let tour = options.tour.then(|| Tour::new(options.seed, learned));
    let in_log = kept.as_ref().map_or(0, |(_, past)| past.taught);
    let mut classroom = Classroom::new(pupil, kept, tour)?;
    let known = classroom.pupil.lessons_learned();
    if let Some(RobotFiles { model, log }) = classroom.kept.as_ref().map(Kept::files).filter(|_| known < in_log) {
        let (model, log) = (model.display(), log.display());
        say!(
            "{log} has {} that taught something, and {model} knows {known}: the others gave way to newer ones, or the program was stopped while it \
             wrote. goodbot learn {log} --out NEW learns from all",
            counted(in_log, "session")
        );
    }
    classroom.wanted = options.wanted.as_deref().map(wanted).transpose()?.unwrap_or_default();
    Ok(classroom)
}

/// The paths of the robot's files; `None` for a robot that is not kept.
fn robot_files(options: &TeachOptions, lines: bool, world: Option<&Arc<WorldFile>>) -> Result<Option<RobotFiles>, Failure> {
    Ok(match (&options.model, &options.robot) {
        (Some(model), _) => Some(RobotFiles::beside(model, options.log.as_deref())),
        (None, Some(robot)) => Some(RobotFiles::of_robot(robot)?),
        (None, None) if lines => None,
        (None, None) => Some(match world {
            // A robot keeps the tasks of one world, so each world has its own robot.
            Some(world) => RobotFiles::of_robot(&format!("{ROBOT}-{}", world.name)).map_err(|_| {
                let message = format!("the world {:?} has a name that no file can have; name the robot with --robot", world.name);
                Failure::Input(message)
            })?,
            None => RobotFiles::of_robot(if options.tour { TOUR_ROBOT } else { ROBOT })?,
        }),
    })
}

/// Parses the expected trainer. Without a log, `logged` is impossible.
fn of_trainer(text: &str) -> Result<Believes, String> {
    match text.parse()? {
        Believes::Logged => Err("there is no log to take strategies from; give population, paper or probabilities".to_owned()),
        believes => Ok(believes),
    }
}

/// The commands of a file, one on each line.
fn wanted(path: &Path) -> Result<Vec<String>, Failure> {
    let name = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::Input(format!("{name}: cannot be read ({error}); it is a text with a command on each line")))?;
    let commands: Vec<String> =
        text.lines().map(str::trim).filter(|line| !line.is_empty()).map(|line| words_read(line).to_owned()).collect();
    if commands.is_empty() {
        return Err(Failure::Input(format!("{name}: has no command; write one on each line")));
    }
    Ok(commands)
}

fn no_home() -> Failure {
    Failure::Input("no home could be drawn; name a file with one".to_owned())
}

fn first_home() -> Result<EnvironmentFile, Failure> {
    lessons::first_home().ok_or_else(no_home)
}

/// The home, or the world.
fn setting(options: &TeachOptions) -> Result<Setting, Failure> {
    let Some(file) = &options.home else {
        let home = if options.random { lessons::random_home(options.seed.unwrap_or(1)).ok_or_else(no_home) } else { first_home() };
        return home.map(Setting::Floor);
    };
    if file.is_standard() {
        return Err(Failure::Input("standard input is where requests come from; name a file for the home".to_owned()));
    }
    match input::place(file)? {
        Place::World(read) => {
            // A fault of the robot is reported in the world's file.
            let robot = Tables::of(Arc::new(read.world.clone())).and_then(|tables| tables.lend(|robot| robot::tasks(&read.world, robot)));
            robot.map_err(|flaw| read.fault(&flaw.field, &flaw.message))?;
            Ok(Setting::Other(Arc::new(read.world)))
        }
        Place::Home(home) => Ok(Setting::Floor(home)),
    }
}
