//! `goodbot fit-trainers`: what trainers to expect, from what real ones said.
//!
//! - [`walk`]: recorded sessions as actions that were right or wrong for each task;
//! - [`fit`]: a population of trainer strategies under which what was said is most probable;
//! - [`believing`]: how right a robot with such an expectation would have been.

pub mod believing;
pub mod fit;
pub mod walk;

use believing::{Expectation, Rightness};
use clap::{Args, ValueHint};
use fit::{Fit, Heard};
use goodbot::feedback::population::DRIFT;
use goodbot::feedback::{Ending, Strategy};
use goodbot_console::load::kinds::TaskKinds;
use goodbot_console::messages::{bar, counted};
use goodbot_console::outcome::Failure;
use goodbot_console::output;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::io::Write;
use walk::Walk;

/// The options of `goodbot fit-trainers`.
#[derive(Debug, Args)]
#[command(after_help = "\
A robot that learns from feedback must expect something of its trainer: how often silence means that all is well, how often a word is a
mistake, and how late it comes. This finds a population of strategies under which the words of real trainers are most probable, given what
they meant (\"intended\" in the log), and how often they ended a session at the goal and elsewhere. Who trained is the session's id up to its
first dot, as in w03.1-2; sessions whose ids have none are those of one trainer for each file.

Each line of the table leaves one trainer out after the other, fits the rest, and asks what a robot that expects those trainers would have
believed at the end of each session of the one left out:
  on top    share of sessions with feedback in which the intended task is alone the most likely one
  log loss  mean of -ln of the intended task's probability
  below 5 % share in which the intended task is given up
  words     ln of the probability of all that the trainers left out said

Example:
  goodbot fit-trainers feedback.jsonl --rust > core/src/feedback/population/fitted.rs")]
pub struct FitOptions {
    /// Session logs (JSON Lines) with feedback; - is standard input
    #[arg(required = true, value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<String>,
    #[command(flatten)]
    kinds: TaskKinds,
    /// Print the population as lines of JSON: a strategy each, and a last one with the rest
    #[arg(long)]
    json: bool,
    /// Print the population as the library's source has it, and leave no trainer out
    #[arg(long, conflicts_with = "json")]
    rust: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &FitOptions) -> Result<(), Failure> {
    let faults = |faults: Vec<goodbot_lesson::Fault>| Failure::Input(faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"));
    let walks = walk::read(&options.files, &options.kinds.lifted()?).map_err(faults)?;
    let trainers = fit::by_trainer(&walks);
    if trainers.len() < 3 {
        let found = counted(trainers.len(), "trainer");
        return Err(Failure::Input(format!(
            "{found} with feedback whose intended task is known: give the sessions of 3 or more (a trainer is the id up to its first dot)"
        )));
    }
    let everyone: Vec<&Heard> = trainers.values().collect();
    let fitted = Fit::to(&everyone, true);
    let (strategies, ending) = (fitted.strategies(), ending(walks.iter()));
    let mut out = output::text(&[])?;
    if options.rust {
        return write_rust(&mut out, &strategies, &ending);
    }
    let compared = compare(&walks);
    if options.json {
        for (strategy, share) in &strategies {
            writeln!(out, "{}", strategy_json(strategy, *share))?;
        }
        let compared: Vec<Value> = compared
            .iter()
            .map(|(name, rightness, words)| json!({"settings": name, "held_out": rightness.json(), "log_probability_of_words": words}))
            .collect();
        let (trainers, sessions) = (trainers.len(), walks.len());
        let line = json!({
            "type": "fit", "trainers": trainers, "sessions": sessions, "hold": fitted.hold,
            "ends_at_goal": ending.at_goal, "ends_elsewhere": ending.elsewhere, "leaving_each_trainer_out": compared,
        });
        writeln!(out, "{line}")?;
        return Ok(out.flush()?);
    }
    writeln!(out, "{}, {}", counted(trainers.len(), "trainer"), counted(walks.len(), "session"))?;
    writeln!(out, "\nshare   mu+    mu-  epsilon  lag 0  lag 1  lag 2")?;
    for (strategy, share) in &strategies {
        let [now, before, earlier] = strategy.lags();
        let (mu_plus, mu_minus, epsilon) = (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon());
        writeln!(out, "{share:5.3}  {mu_plus:5.3}  {mu_minus:5.3}  {epsilon:5.3}    {now:5.3}  {before:5.3}  {earlier:5.3}")?;
    }
    writeln!(out, "\neach strategy is held to what all trainers do by {} of their words", fitted.hold)?;
    writeln!(out, "a session ends after {:.3} of the steps at the goal, and after {:.3} elsewhere", ending.at_goal, ending.elsewhere)?;
    writeln!(out, "\nleaving each trainer out    sessions  on top  log loss  below 5 %    words")?;
    for (name, rightness, words) in &compared {
        let (sessions, top, loss, low) = (rightness.sessions(), rightness.on_top(), rightness.log_loss(), 100.0 * rightness.given_up());
        let words = words.map_or_else(String::new, |words| format!("{words:9.1}"));
        writeln!(out, "{name:26}  {sessions:8}  {top:6.3}  {loss:8.3}  {low:7.1} %{words}")?;
    }
    Ok(out.flush()?)
}

/// How often trainers ended a session after a step at the intended goal, and after one elsewhere.
fn ending<'a>(walks: impl Iterator<Item = &'a Walk>) -> Ending {
    // As if one step had been seen at the goal and twenty elsewhere, one of which ended a session: no probability is 0.
    let mut counts = [[0.1, 1.0], [1.0, 20.0]];
    for walk in walks {
        let Some(intended) = walk.intended else { continue };
        for (step, left) in walk.steps.iter().zip((0..walk.steps.len()).rev()) {
            let Some(at_goal) = step.at_goal.get(intended).copied().flatten() else { continue };
            let [ended, all] = &mut counts[usize::from(!at_goal)];
            *all += 1.0;
            *ended += if left == 0 { 1.0 } else { 0.0 };
        }
    }
    let [at_goal, elsewhere] = counts.map(|[ended, all]: [f64; 2]| ((ended / all * 1_000.0).round() / 1_000.0) as f32);
    Ending { at_goal, elsewhere }
}

/// What robots would have believed of each trainer who had learned from the others what to expect; the paper's expectation first.
fn compare(walks: &[Walk]) -> Vec<(&'static str, Rightness, Option<f64>)> {
    let paper = Expectation { strategies: vec![(Strategy::BALANCED, 1.0)], drift: 0.0, ending: Ending::NO_EVIDENCE };
    let mut compared = vec![("the paper's balanced one", believing::replay(walks.iter(), &paper), None)];
    let trainers = fit::by_trainer(walks);
    let progress = bar(2 * trainers.len(), "leaving each trainer out");
    for (lag, names) in [(false, ["no lag, no end", "no lag, end"]), (true, ["lag, no end", "lag, end"])] {
        let parts: Vec<([Rightness; 2], f64)> = trainers
            .par_iter()
            .map(|(&out, heard)| {
                let others: Vec<&Heard> = trainers.iter().filter(|&(&trainer, _)| trainer != out).map(|(_, heard)| heard).collect();
                let fitted = Fit::to(&others, lag);
                let believed = [Ending::NO_EVIDENCE, ending(walks.iter().filter(|walk| walk.trainer != out))].map(|ending| {
                    let expectation = Expectation { strategies: fitted.strategies(), drift: DRIFT, ending };
                    believing::replay(walks.iter().filter(|walk| walk.trainer == out), &expectation)
                });
                progress.inc(1);
                (believed, fitted.log_likelihood(heard))
            })
            .collect();
        let words: f64 = parts.iter().map(|(_, words)| words).sum();
        let mut rightness = [Rightness::default(), Rightness::default()];
        for (believed, _) in parts {
            rightness.iter_mut().zip(believed).for_each(|(all, part)| all.extend(part));
        }
        compared.extend(names.into_iter().zip(rightness).map(|(name, rightness)| (name, rightness, Some(words))));
    }
    progress.finish_and_clear();
    compared
}

fn strategy_json(strategy: &Strategy, share: f32) -> Value {
    json!({
        "mu_plus": strategy.mu_plus(), "mu_minus": strategy.mu_minus(), "epsilon": strategy.epsilon(),
        "lags": strategy.lags(), "prior": share,
    })
}

fn write_rust(out: &mut impl Write, strategies: &[(Strategy, f32)], ending: &Ending) -> Result<(), Failure> {
    writeln!(out, "//! Made by `goodbot fit-trainers feedback.jsonl --rust`; do not edit.")?;
    writeln!(out, "\nuse crate::feedback::{{Ending, Strategy}};")?;
    writeln!(out, "\n/// The strategies of real trainers, each with its share of them: see [`population`](super).")?;
    writeln!(out, "pub const STRATEGIES: [(Strategy, f32); {}] = [", strategies.len())?;
    for (strategy, share) in strategies {
        let (plus, minus, epsilon, lags) = (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), strategy.lags());
        writeln!(out, "    (Strategy::known({plus:?}, {minus:?}, {epsilon:?}, {lags:?}), {share:?}),")?;
    }
    writeln!(out, "];")?;
    writeln!(out, "\n/// How often real trainers end a session at the goal, and elsewhere.")?;
    writeln!(out, "pub const ENDING: Ending = Ending {{ at_goal: {:?}, elsewhere: {:?} }};", ending.at_goal, ending.elsewhere)?;
    Ok(out.flush()?)
}
