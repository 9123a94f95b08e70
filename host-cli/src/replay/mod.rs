//! `goodbot replay`: Algorithm 1 on recorded sessions, with exactly the recorded steps.
//!
//! - [`history`]: the agent that replays them, one after another.

mod history;

use crate::paper::options::WeightsChoice;
use clap::{Args, ValueHint};
use goodbot::Options;
use goodbot_console::load::input::Content;
use goodbot_console::load::input::tell;
use goodbot_console::training_data::{MOST_FAULTS, tell_long};
use goodbot_console::{
    Believes, Failure, InputFile, Learner, Limit, Output, Printed, SynonymOptions, TaskKinds, counted, counting, input, output, say,
};
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Kind, SessionReader};
use goodbot_formats::task_text::GroundTaskText;
use goodbot_formats::world::{Line, WorldReader};
use goodbot_lab::calibration;
use goodbot_lab::fit_trainers::believing::Rightness;
use goodbot_lesson::Fault;
use goodbot_lesson::fault::quoted;
use history::{History, Learning, Outcome};
use indicatif::ProgressBar;
use std::fmt;
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

/// The most likely task of a belief.
struct MostLikely<'a> {
    task: &'a GroundTaskText,
    probability: f32,
    /// How many tasks have this probability, this one included.
    tied: usize,
}

fn most_likely(belief: &PosteriorLine<f32>) -> Option<MostLikely<'_>> {
    let best = belief.tasks.iter().map(|&(_, probability)| probability).fold(0.0, f32::max);
    let mut tied = belief.tasks.iter().filter(|&&(_, probability)| probability >= best);
    let (task, probability) = tied.next()?;
    Some(MostLikely { task, probability: *probability, tied: 1 + tied.count() })
}

/// Whether the intended task alone is the most likely one.
fn is_right(belief: Option<&PosteriorLine<f32>>, intended: &GroundTaskText) -> bool {
    belief.and_then(most_likely).is_some_and(|likely| likely.tied == 1 && likely.task.is_same(intended))
}

impl fmt::Display for MostLikely<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:.3}", self.task, self.probability)?;
        if self.tied > 1 { write!(f, " (one of {} equally likely)", self.tied) } else { Ok(()) }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let again = if self.continues { ", once more" } else { "" };
        writeln!(f, "{}: {}{again}", self.id.escape_debug(), quoted(&self.command))?;
        if let Some(likely) = self.beliefs.first().and_then(most_likely) {
            writeln!(f, "  before    {likely}")?;
        }
        if let Some(likely) = self.beliefs.last().and_then(most_likely) {
            writeln!(f, "  after     {likely}")?;
        }
        if let Some(intended) = &self.intended {
            let right = if is_right(self.beliefs.last(), intended) { "  (right)" } else { "" };
            writeln!(f, "  expected  {intended}{right}")?;
        }
        let steps = self.steps;
        let [reward, punish, neutral] = self.feedback;
        write!(f, "  {}", counted(steps, "step"))?;
        match self.kind {
            Kind::Feedback => write!(f, ": {reward} rewarded, {punish} punished, {neutral} in silence")?,
            Kind::Demonstration | Kind::Labelled => f.write_str(" shown")?,
        }
        writeln!(f, "; {}", if self.learned { "learned from" } else { "not learned from" })
    }
}

/// The totals of all sessions.
#[derive(Debug, Default)]
pub struct Totals {
    /// Sessions replayed.
    pub sessions: usize,
    /// Sessions at fault.
    pub skipped: usize,
    steps: usize,
    feedback: [usize; 3],
    learned: usize,
    trained: usize,
    intended: usize,
    right_before: usize,
    right_after: usize,
    rightness: Rightness,
}

impl Totals {
    /// Adds a session.
    pub fn add(&mut self, outcome: &Outcome) {
        self.sessions += 1;
        self.steps += outcome.steps;
        self.learned += usize::from(outcome.learned);
        self.trained += usize::from(outcome.trained);
        self.feedback.iter_mut().zip(outcome.feedback).for_each(|(sum, count)| *sum += count);
        if let Some(intended) = &outcome.intended {
            self.intended += 1;
            self.right_before += usize::from(is_right(outcome.beliefs.first(), intended));
            self.right_after += usize::from(is_right(outcome.beliefs.last(), intended));
            let [reward, punish, _] = outcome.feedback;
            if let Some(last) = outcome.beliefs.last().filter(|_| reward + punish > 0) {
                let probabilities: Vec<f64> = last.tasks.iter().map(|&(_, probability)| f64::from(probability)).collect();
                if let Some(intended) = last.tasks.iter().position(|(task, _)| task.is_same(intended)) {
                    self.rightness.add(&probabilities, intended, false);
                }
            }
        }
    }
}

impl Totals {
    /// How right the beliefs at the end of sessions with feedback were.
    pub const fn rightness(&self) -> &Rightness {
        &self.rightness
    }

    /// Whether some sessions waited for a later training.
    pub const fn learned_later(&self) -> bool {
        self.trained < self.learned
    }
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [reward, punish, neutral] = self.feedback;
        writeln!(f, "\nsessions             {}, {} learned from", self.sessions, self.learned)?;
        if self.skipped > 0 {
            writeln!(f, "skipped              {} with faults", self.skipped)?;
        }
        if self.learned_later() {
            let times = counted(self.trained, "time");
            writeln!(f, "words retrained      {times}, from the hundredth session on after a fiftieth more")?;
        }
        writeln!(f, "steps                {}", self.steps)?;
        if reward + punish + neutral > 0 {
            let [reward, punish, neutral] =
                [(reward, "reward"), (punish, "punishment"), (neutral, "silence")].map(|(n, it)| counted(n, it));
            writeln!(f, "feedback             {reward}, {punish}, {neutral}")?;
        }
        if self.intended > 0 {
            writeln!(f, "right on hearing     {} of {} whose intended task is known", self.right_before, self.intended)?;
            writeln!(f, "right at the end     {} of {}", self.right_after, self.intended)?;
        }
        let it = &self.rightness;
        if it.sessions() > 0 {
            let (top, loss, low) = (it.on_top(), it.log_loss(), 100.0 * it.given_up());
            writeln!(f, "in {} with feedback, at the end:", counted(it.sessions(), "session"))?;
            writeln!(f, "  intended task alone on top {top:.3}, mean log loss {loss:.3}, intended below 5 % in {low:.1} %")?;
        }
        Ok(())
    }
}
