//! `goodbot replay`: Algorithm 1 on recorded sessions, with exactly the recorded steps.
//!
//! - [`history`]: the agent that replays them, one after another;
//! - [`report`]: the report of each, for people.

mod history;
mod report;

use crate::paper::options::WeightsChoice;
use clap::{Args, ValueHint};
use goodbot::Options;
use goodbot_console::believes::Believes;
use goodbot_console::learner::Learner;
use goodbot_console::load::content::Content;
use goodbot_console::load::input::tell;
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::load::kinds::TaskKinds;
use goodbot_console::load::limit::Limit;
use goodbot_console::load::synonyms::SynonymOptions;
use goodbot_console::messages::{counted, counting, say};
use goodbot_console::outcome::Failure;
use goodbot_console::output::{self, Output};
use goodbot_console::printed::Printed;
use goodbot_console::training_data::{MOST_FAULTS, tell_long};
use goodbot_formats::session::SessionReader;
use goodbot_formats::world::{Line, WorldReader};
use goodbot_lab::calibration;
use goodbot_lesson::Fault;
use history::{History, Learning, Outcome};
use indicatif::ProgressBar;
use report::Totals;
use std::io::Write;
use std::path::PathBuf;

/// Replay recorded sessions, and print the robot's belief after each step
///
/// The robot begins without words. Each session gives it the command, the recorded steps and the trainer's feedback; then it learns, unless
/// the session is marked otherwise. Several files are one history, in the given order. As in the paper, all words are retrained after each
/// session; from the hundredth session on, only when the number of sessions has grown by a fiftieth (`goodbot learn` trains once, on all
/// sessions).
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 all sessions were replayed, 2 a file is at fault (nothing after the fault is replayed, unless --keep-going is given).

Examples:
  goodbot replay --json lessons.jsonl > beliefs.jsonl
  goodbot replay --believes population --json lessons.jsonl | tail -1
  goodbot replay --believes population --plot reliability.svg lessons.jsonl"
)]
pub struct ReplayArgs {
    /// Session logs (JSON Lines); - is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<InputFile>,
    /// Print each belief as a line of JSON: before the first step, and after each
    #[arg(long)]
    json: bool,
    /// The learner
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    learner: Learner,
    /// How machine commands are weighted when a session is learned from
    #[arg(long, value_enum, default_value_t = WeightsChoice::Paper)]
    weights: WeightsChoice,
    #[command(flatten)]
    kinds: TaskKinds,
    /// The trainers to expect, in place of those that the sessions name: population (real people, whose ends of sessions are evidence),
    /// logged, paper, or probabilities. The robot then meets each trainer (the session's id up to its first dot) once; with --json a last
    /// line tells how right it was in sessions with feedback
    #[arg(long, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON[,LAGS]", allow_hyphen_values = true)]
    believes: Option<Believes>,
    #[command(flatten)]
    synonyms: SynonymOptions,
    /// Write a reliability diagram: how often a task was intended, against its probability at the end; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    plot: Option<PathBuf>,
    /// Replace a file that is no picture of goodbot's
    #[arg(long, requires = "plot")]
    force: bool,
    /// Retrain all words after every session: the time grows with the square of the number of sessions
    #[arg(long)]
    every_session: bool,
    #[command(flatten)]
    limit: Limit,
    /// Skip sessions with faults, and count them
    #[arg(long)]
    keep_going: bool,
}

impl ReplayArgs {
    fn options(&self) -> Options {
        Options { weights: self.weights.into(), ..self.learner.options() }
    }
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &ReplayArgs) -> Result<(), Failure> {
    let plot = Output::picture(&args.plot, &args.files, args.force)?;
    let learning = if args.every_session { Learning::EverySession } else { Learning::InParts };
    let mut replay = Replay {
        history: History::new(&args.kinds.lifted()?, args.options(), learning, args.believes.clone(), args.synonyms.read()?)?,
        totals: Totals::default(),
        progress: counting("sessions replayed"),
        output: output::text(&[plot.as_ref()])?,
        plot,
        long: vec![],
    };
    let done = replay.files(args);
    replay.progress.finish_and_clear();
    done
}

/// A replay under way.
struct Replay {
    history: History,
    totals: Totals,
    progress: ProgressBar,
    output: Printed,
    plot: Option<Output>,
    /// Commands that are read by their first words only.
    long: Vec<Fault>,
}

impl Replay {
    fn files(&mut self, args: &ReplayArgs) -> Result<(), Failure> {
        let (mut commands, mut left) = (0, args.limit.count());
        for file in &args.files {
            if left == 0 {
                break;
            }
            let opened = input::log(file)?;
            let name = input::name(file);
            if Content::of(opened.buffer()) == Content::Worlds {
                for line in WorldReader::new(opened) {
                    if left == 0 {
                        break;
                    }
                    let replayed = match line {
                        Ok(Line::Session(session)) => self.history.replay_in(name, &session),
                        Ok(Line::World(_)) => continue,
                        Ok(Line::Command(_)) => {
                            commands += 1;
                            continue;
                        }
                        Err(error) => Err(vec![Fault::from_format(name, error)]),
                    };
                    left -= 1;
                    self.take_or_tell(args, replayed)?;
                }
                continue;
            }
            for session in SessionReader::new(opened).take(left) {
                left -= 1;
                let replayed = match session {
                    Ok(session) => self.history.replay(name, &session),
                    Err(error) => {
                        self.history.broken();
                        Err(vec![Fault::from_format(name, error)])
                    }
                };
                self.take_or_tell(args, replayed)?;
            }
        }
        tell_long(&self.long.iter().collect::<Vec<_>>());
        if commands > 0 {
            say!("{} left out: commands have no steps to replay; learn from them with goodbot learn", counted(commands, "command"));
        }
        if self.totals.sessions == 0 && self.totals.skipped == 0 {
            let message = "the files have no session; name a session log, with one JSON object on each line";
            return Err(Failure::Input(message.to_owned()));
        }
        if let Some(plot) = &self.plot {
            let rightness = self.totals.rightness();
            let caption = format!("How probable at the end, and how often meant: {}", counted(rightness.sessions(), "session"));
            let (across, up) = ("% probable at the end, on average", "% meant, with 95 % interval");
            plot.draw(calibration::draw(&rightness.reliability(), &caption, across, up))?;
        }
        if args.json {
            if args.believes.is_some() {
                let mut line = self.totals.rightness().json();
                line["type"] = "summary".into();
                writeln!(self.output, "{line}")?;
            }
            if self.totals.skipped > 0 {
                say!("{} with faults skipped", counted(self.totals.skipped, "session"));
            }
            if self.totals.learned_later() {
                say!("from the hundredth session on, words were retrained only after a fiftieth more sessions; see --every-session");
            }
        } else {
            write!(self.output, "{}", self.totals)?;
        }
        self.output.flush()?;
        if self.totals.sessions == 0 { Err(Failure::Told) } else { Ok(()) }
    }

    /// Adds the result of a session. A session with faults ends the replay, unless it is to be skipped.
    fn take_or_tell(&mut self, args: &ReplayArgs, replayed: Result<Outcome, Vec<Fault>>) -> Result<(), Failure> {
        self.progress.inc(1);
        match replayed {
            Ok(outcome) => return self.take(args, &outcome),
            Err(faults) => self.tell(&faults),
        }
        self.totals.skipped += 1;
        if !args.keep_going {
            return Err(Failure::Told);
        }
        if self.totals.skipped > MOST_FAULTS {
            return Err(Failure::Input(format!("more than {MOST_FAULTS} sessions are at fault; check that this is a session log")));
        }
        Ok(())
    }

    fn take(&mut self, args: &ReplayArgs, outcome: &Outcome) -> Result<(), Failure> {
        self.tell(&outcome.remarks);
        self.long.extend(outcome.long.clone());
        self.totals.add(outcome);
        if args.json {
            for line in &outcome.beliefs {
                writeln!(self.output, "{}", line.to_json_line().map_err(|error| Failure::Input(error.to_string()))?)?;
            }
        } else {
            write!(self.output, "{outcome}")?;
        }
        Ok(())
    }

    fn tell(&self, faults: &[Fault]) {
        self.progress.suspend(|| tell(faults));
    }
}
