//! `goodbot fit-trainers`: fits the trainers that a robot should expect to real feedback.
//!
//! - [`recorded`]: recorded sessions as actions that were right or wrong for each task;
//! - [`fit`]: the population of trainer strategies that makes the feedback most probable, and the probability that they end a session;
//! - [`believing`]: the rightness of a robot with such an expectation, and the share of trainers who judge every step rightly.

pub mod believing;
pub mod fit;

use crate::recorded::{self, Walk};
use believing::{Expectation, Rightness};
use clap::{Args, ValueHint};
use fit::{FeedbackCounts, Fit, Shape};
use goodbot::feedback::population::DRIFT;
use goodbot::feedback::{Ending, Hazard, Strategy};
use goodbot_console::{Failure, InputFile, TaskKinds, bar, counted, output};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::io::Write;

/// The options of `goodbot fit-trainers`.
#[derive(Debug, Args)]
#[command(after_help = "\
A robot that learns from feedback must expect something of its trainer: how often silence means that all is well, how often a word is a
mistake, and how late it comes. This finds the population of strategies that makes the words of real trainers most probable, given their
intended tasks (\"intended\" in the log), and how often they ended a session at the goal and elsewhere. The trainer is the session's id up to
its first dot, as in w03.1-2; sessions without a dot in their ids have one trainer for each file.

Each line of the table leaves out one trainer at a time, fits the rest, and replays the sessions of the one left out with a robot that
expects the rest. At the end of each session:
  on top    share of sessions with feedback in which the intended task is alone the most likely one
  log loss  mean of -ln of the intended task's probability
  below 5 % share in which the intended task is given up
  ECE       mean difference between the probabilities of tasks and the shares of intended tasks
  words     ln of the probability of all words of the trainers left out
  in brackets the 95 % interval, by a bootstrap over the trainers

Example:
  goodbot fit-trainers feedback.jsonl --rust > core/src/feedback/population/fitted.rs")]
pub struct FitOptions {
    /// Session logs (JSON Lines) with feedback; - is standard input
    #[arg(required = true, value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<InputFile>,
    #[command(flatten)]
    kinds: TaskKinds,
    /// Print the population as lines of JSON: one for each strategy, and a last one with the rest
    #[arg(long)]
    json: bool,
    /// Print the population as the library's source code, without leaving trainers out
    #[arg(long, conflicts_with = "json")]
    rust: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &FitOptions) -> Result<(), Failure> {
    let walks = recorded::read(&options.files, &options.kinds.lifted()?)?;
    let trainers = fit::by_trainer(&walks);
    if trainers.len() < 3 {
        let found = counted(trainers.len(), "trainer");
        return Err(Failure::Input(format!(
            "{found} with feedback whose intended task is known: give the sessions of 3 or more (a trainer is the id up to its first dot)"
        )));
    }
    let everyone: Vec<&FeedbackCounts> = trainers.values().collect();
    let fitted = Fit::to(&everyone, POPULATION.shape);
    let Expectation { strategies, ending, .. } = expectation(&walks.iter().collect::<Vec<_>>(), fitted.strategies(), POPULATION);
    let mut out = output::text(&[])?;
    if options.rust {
        return write_rust(&mut out, &strategies, &ending);
    }
    let compared = compare(&walks);
    if options.json {
        for (strategy, share) in &strategies {
            writeln!(out, "{}", strategy_json(strategy, *share))?;
        }
        let compared: Vec<Value> = compared.iter().map(Compared::json).collect();
        let (trainers, sessions) = (trainers.len(), walks.len());
        let line = json!({
            "type": "fit", "trainers": trainers, "sessions": sessions, "hold": fitted.hold,
            "ends_at_goal": hazard_json(&ending.at_goal), "ends_elsewhere": hazard_json(&ending.elsewhere), "leaving_each_trainer_out": compared,
        });
        writeln!(out, "{line}")?;
        return Ok(out.flush()?);
    }
    writeln!(out, "{}, {}", counted(trainers.len(), "trainer"), counted(walks.len(), "session"))?;
    writeln!(out, "\n              moves                   rests                         lags")?;
    writeln!(out, "share   mu+    mu-  epsilon    mu+    mu-  epsilon  inside    0      1      2")?;
    for (strategy, share) in &strategies {
        let [now, before, earlier] = strategy.lags();
        let (mu_plus, mu_minus, epsilon) = (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon());
        let [plus, minus, mistake, inside] = strategy.rests();
        write!(
            out,
            "{share:5.3}  {mu_plus:5.3}  {mu_minus:5.3}  {epsilon:5.3}    {plus:5.3}  {minus:5.3}  {mistake:5.3}    {inside:3.1} "
        )?;
        writeln!(out, "  {now:5.3}  {before:5.3}  {earlier:5.3}")?;
    }
    writeln!(out, "\neach strategy is drawn towards that of all trainers, with the weight of {} words", fitted.hold)?;
    writeln!(out, "\na session ends after   a move  a rest  a later one  times, after praise  after blame")?;
    for (place, Hazard { moved, rested, resting, praised, scolded }) in [("at the goal", ending.at_goal), ("elsewhere", ending.elsewhere)] {
        writeln!(out, "{place:21}   {moved:6.3}  {rested:6.3}  {resting:11.3}  {praised:19.3}  {scolded:11.3}")?;
    }
    writeln!(out, "\nleaving each trainer out  sessions  on top  log loss            below 5 %    ECE                 words")?;
    for Compared { name, rightness, intervals: [[least_loss, most_loss], [least, most]], words, .. } in &compared {
        let (sessions, top, loss, low) = (rightness.sessions(), rightness.on_top(), rightness.log_loss(), 100.0 * rightness.given_up());
        let ece = rightness.calibration_error();
        let words = words.map_or_else(String::new, |words| format!("{words:9.1}"));
        write!(out, "{name:25} {sessions:8}  {top:6.3}  {loss:5.3} ({least_loss:.3} to {most_loss:.3})")?;
        writeln!(out, "  {low:7.1} %  {ece:.3} ({least:.3} to {most:.3}){words}")?;
    }
    if let Some(last) = compared.last() {
        let (mean, most) = last.rightness.calibration_error_of_chance();
        writeln!(out, "\nbeliefs that are exactly right, as often: ECE {mean:.3}, at most {most:.3} in 39 of 40 draws")?;
        if let [(least, one), .., (most, other)] = last.without.as_slice() {
            writeln!(out, "without one trainer's sessions: ECE {least:.3} (without {one}) to {most:.3} (without {other})")?;
        }
    }
    Ok(out.flush()?)
}

/// The expectation about trainers that a robot would learn from these sessions.
fn expectation(walks: &[&Walk], strategies: Vec<(Strategy, f32)>, settings: Settings) -> Expectation {
    let ending = if settings.end { fit::fit(walks.iter().copied()) } else { Ending::NO_EVIDENCE };
    let mut expected = Expectation { strategies, drift: DRIFT, ending };
    if settings.exact {
        expected.strategies = believing::added(&expected, walks);
    }
    expected
}

/// The settings of a fit.
#[derive(Clone, Copy, Debug)]
struct Settings {
    name: &'static str,
    shape: Shape,
    exact: bool,
    end: bool,
}

const AS_MOVES: Shape = Shape { lagging: false, rests: false };
const RESTS_APART: Shape = Shape { lagging: false, rests: true };
const LATE: Shape = Shape { lagging: true, rests: true };

/// The settings to compare; the last is the population's.
const COMPARED: [Settings; 5] = [
    Settings { name: "rests as moves", shape: AS_MOVES, exact: false, end: false },
    Settings { name: "rests apart", shape: RESTS_APART, exact: false, end: false },
    Settings { name: "rests apart, late words", shape: LATE, exact: false, end: false },
    Settings { name: "rests apart, end", shape: RESTS_APART, exact: false, end: true },
    POPULATION,
];
/// The settings of the library's population.
const POPULATION: Settings = Settings { name: "rests apart, exact, end", shape: RESTS_APART, exact: true, end: true };

/// The rightness of a robot with some settings.
struct Compared {
    name: &'static str,
    rightness: Rightness,
    /// The 95 % intervals of the log loss and of the calibration error.
    intervals: [[f64; 2]; 2],
    /// The calibration error without the sessions of one trainer, and that trainer; the least first.
    without: Vec<(f64, String)>,
    /// The logarithm of the probability of all words.
    words: Option<f64>,
}

impl Compared {
    fn of(name: &'static str, names: &[&str], trainers: Vec<Rightness>, words: Option<f64>) -> Self {
        let (names, trainers): (Vec<&str>, Vec<Rightness>) =
            names.iter().copied().zip(trainers).filter(|(_, rightness)| rightness.sessions() > 0).unzip();
        let all_but = |out: usize| {
            let mut all = Rightness::default();
            trainers.iter().enumerate().filter(|&(at, _)| at != out).for_each(|(_, one)| all.extend(one.clone()));
            all
        };
        let mut without: Vec<(f64, String)> =
            names.iter().enumerate().map(|(out, &name)| (all_but(out).calibration_error(), name.to_owned())).collect();
        without.sort_by(|one, other| one.0.total_cmp(&other.0));
        Self { name, rightness: all_but(trainers.len()), intervals: believing::intervals(&trainers), without, words }
    }

    fn json(&self) -> Value {
        let [log_loss, calibration_error] = self.intervals;
        let (mean, most) = self.rightness.calibration_error_of_chance();
        let without: Value = self.without.iter().map(|(error, trainer)| (trainer.clone(), json!(error))).collect();
        json!({
            "settings": self.name, "held_out": self.rightness.json(), "log_probability_of_words": self.words,
            "intervals": {"mean_log_loss": log_loss, "calibration_error": calibration_error},
            "calibration_error_of_chance": {"mean": mean, "most": most},
            "calibration_error_without": without,
        })
    }
}

/// For each trainer, replays the sessions with a robot whose expectation was fitted to the other trainers. The first row has the paper's
/// expectation.
fn compare(walks: &[Walk]) -> Vec<Compared> {
    let paper = Expectation { strategies: vec![(Strategy::BALANCED, 1.0)], drift: 0.0, ending: Ending::NO_EVIDENCE };
    let trainers = fit::by_trainer(walks);
    let believed = |trainer: &str, expected: &Expectation| believing::replay(walks.iter().filter(|walk| walk.trainer == trainer), expected);
    let names: Vec<&str> = trainers.keys().copied().collect();
    let papers = names.iter().map(|trainer| believed(trainer, &paper)).collect();
    let mut compared = vec![Compared::of("the paper's balanced one", &names, papers, None)];
    let progress = bar(COMPARED.len() * trainers.len(), "leaving each trainer out");
    for settings in COMPARED {
        let parts: Vec<(Rightness, f64)> = trainers
            .par_iter()
            .map(|(&out, heard)| {
                let others: Vec<&FeedbackCounts> =
                    trainers.iter().filter(|&(&trainer, _)| trainer != out).map(|(_, heard)| heard).collect();
                let fitted = Fit::to(&others, settings.shape);
                let known: Vec<&Walk> = walks.iter().filter(|walk| walk.trainer != out).collect();
                let expected = expectation(&known, fitted.strategies(), settings);
                progress.inc(1);
                (believed(out, &expected), fitted.log_likelihood(heard))
            })
            .collect();
        let words: f64 = parts.iter().map(|(_, words)| words).sum();
        compared.push(Compared::of(settings.name, &names, parts.into_iter().map(|(rightness, _)| rightness).collect(), Some(words)));
    }
    progress.finish_and_clear();
    compared
}

fn strategy_json(strategy: &Strategy, share: f32) -> Value {
    json!({
        "mu_plus": strategy.mu_plus(), "mu_minus": strategy.mu_minus(), "epsilon": strategy.epsilon(),
        "rests": strategy.rests(), "lags": strategy.lags(), "prior": share,
    })
}

fn hazard_json(Hazard { moved, rested, resting, praised, scolded }: &Hazard) -> Value {
    json!({"moved": moved, "rested": rested, "resting": resting, "praised": praised, "scolded": scolded})
}

fn write_rust(out: &mut impl Write, strategies: &[(Strategy, f32)], ending: &Ending) -> Result<(), Failure> {
    writeln!(out, "//! Made by `goodbot fit-trainers feedback.jsonl --rust`; do not edit.")?;
    writeln!(out, "\nuse crate::feedback::{{Ending, Hazard, Strategy}};")?;
    writeln!(out, "\n/// The strategies of real trainers and of exact ones, each with its share of them: see [`population`](super).")?;
    writeln!(out, "pub const STRATEGIES: [(Strategy, f32); {}] = [", strategies.len())?;
    for (strategy, share) in strategies {
        let (plus, minus, epsilon) = (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon());
        let (rests, lags) = (strategy.rests(), strategy.lags());
        writeln!(out, "    (Strategy::of_people([{plus:?}, {minus:?}, {epsilon:?}], {rests:?}, {lags:?}), {share:?}),")?;
    }
    writeln!(out, "];")?;
    writeln!(out, "\n/// How often real trainers end a session at the goal, and elsewhere.")?;
    writeln!(out, "pub const ENDING: Ending = Ending {{")?;
    for (place, Hazard { moved, rested, resting, praised, scolded }) in [("at_goal", ending.at_goal), ("elsewhere", ending.elsewhere)] {
        let numbers = format!("moved: {moved:?}, rested: {rested:?}, resting: {resting:?}, praised: {praised:?}, scolded: {scolded:?}");
        writeln!(out, "    {place}: Hazard {{ {numbers} }},")?;
    }
    writeln!(out, "}};")?;
    Ok(out.flush()?)
}
