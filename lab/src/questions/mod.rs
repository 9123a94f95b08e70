//! `goodbot questions`: the costs and savings of questions, with simulated trainers.
//!
//! - [`simulation`]: one session.

pub mod simulation;

use crate::mean::Mean;
use clap::Args;
use goodbot::asking::{Asking, CHOICES};
use goodbot::{Capacities, HeapMemory};
use goodbot_console::messages::bar;
use goodbot_console::numbers::{between, name_of};
use goodbot_console::outcome::Failure;
use goodbot_console::output;
use rayon::prelude::*;
use serde_json::json;
use simulation::{MOST_STEPS, Setting, Spent, Trained, simulate};
use std::io::Write;

/// The options of `goodbot questions`.
#[derive(Debug, Args)]
#[command(after_help = "\
A robot that knows no word is told something in a random home of four rooms and two blocks, and is trained until the intended task has 95 %,
for 80 steps at most. The cost of a session is its steps and kappa for each question. Each row has the same homes, tasks and trainers.

  balanced     silent seven times out of ten, one mistake in ten
  punish-only  punishes nearly every wrong action, and never rewards
  real         drawn from the strategies of real people, and so is what the robot expects

Example:
  goodbot questions --runs 1000 --kappa 2,8,20 --eta 0.05,0.15")]
pub struct QuestionsOptions {
    /// The number of sessions for each row, 1 to 100000, each with a seed of its own, counted up from --seed
    #[arg(long, short = 'n', value_name = "N", default_value = "200", value_parser = between(1_u32, 100_000))]
    runs: u32,
    /// Seed of the first session
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = goodbot_console::numbers::seed)]
    seed: u64,
    /// The cost of a question, in steps
    #[arg(long, value_name = "STEPS", value_delimiter = ',', default_value = "2,4,8,15,20", value_parser = goodbot_console::numbers::cost)]
    kappa: Vec<f32>,
    /// The share of wrong answers
    #[arg(long, value_name = "SHARE", value_delimiter = ',', default_value = "0.05", value_parser = goodbot_console::numbers::wrong_share)]
    eta: Vec<f32>,
    /// The trainers
    #[arg(long, value_enum, value_delimiter = ',', default_value = "balanced,punish-only,real")]
    trainer: Vec<Trained>,
    /// The most meanings that a question offers, 1 to 3; with 1, the answer is yes or no
    #[arg(long, value_name = "N", default_value = "3", value_parser = between(1, CHOICES as u8))]
    choices: u8,
    /// Take any action that leads to the goal, not the most informative one
    #[arg(long)]
    any_action: bool,
    /// Print a line of JSON for each row
    #[arg(long)]
    json: bool,
}

/// The sessions of one row.
#[derive(Debug)]
struct Row {
    setting: Setting,
    sessions: Vec<Spent>,
}

impl Row {
    fn mean(&self, value: impl Fn(&Spent) -> f64) -> f64 {
        self.sessions.iter().map(value).sum::<f64>() / self.sessions.len().max(1) as f64
    }

    /// The mean cost, if a question costs `kappa` steps.
    fn cost(&self, kappa: f32) -> f64 {
        self.mean(|spent| cost(spent, kappa))
    }
}

fn cost(spent: &Spent, kappa: f32) -> f64 {
    let asked = if spent.questions == 0 { 0.0 } else { f64::from(kappa) * f64::from(spent.questions) };
    f64::from(spent.steps) + asked
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &QuestionsOptions) -> Result<(), Failure> {
    let base = |kappa, eta| Asking { kappa, eta, choices: options.choices, ..Asking::DEFAULT };
    for (&kappa, &eta) in options.kappa.iter().flat_map(|kappa| options.eta.iter().map(move |eta| (kappa, eta))) {
        base(kappa, eta).check().map_err(|error| Failure::Input(error.to_string()))?;
    }
    let mut settings = vec![];
    for &trainer in &options.trainer {
        let setting = |asking| Setting { trainer, asking, telling: !options.any_action };
        settings.push(setting(Asking::NEVER));
        settings.extend(options.eta.iter().flat_map(|&eta| options.kappa.iter().map(move |&kappa| setting(base(kappa, eta)))));
    }
    let progress = bar(settings.len() * options.runs as usize, "simulating sessions");
    let mut rows = vec![];
    for setting in settings {
        let simulated = (0..options.runs).into_par_iter().map_init(
            || HeapMemory::new(&Capacities { states: 16_384, ..Capacities::STANDARD }),
            |memory, run| {
                progress.inc(1);
                simulate(memory, &setting, options.seed.wrapping_add(u64::from(run)))
            },
        );
        let sessions = simulated.collect::<Result<Vec<Spent>, _>>().map_err(|error| Failure::Result(error.to_string()))?;
        rows.push(Row { setting, sessions });
    }
    progress.finish_and_clear();
    let mut out = output::text(&[])?;
    if !options.json {
        writeln!(
            out,
            "trainer      kappa   eta   cost  (never asking)  cost saved, 95 %  steps  questions  words  understood in {MOST_STEPS}"
        )?;
    }
    let mut without: Option<&Row> = None;
    for row in &rows {
        let Setting { trainer, asking, .. } = row.setting;
        if asking.kappa.is_infinite() {
            without = Some(row);
        }
        let plain = without.unwrap_or(row);
        let pairs = plain.sessions.iter().zip(&row.sessions);
        let Mean { mean: saved, half: wide } = Mean::of(pairs.map(|(plain, asked)| cost(plain, asking.kappa) - cost(asked, asking.kappa)));
        let (cost, never) = (row.cost(asking.kappa), plain.cost(asking.kappa));
        let (steps, questions) = (row.mean(|spent| spent.steps.into()), row.mean(|spent| spent.questions.into()));
        let (words, understood) = (row.mean(|spent| spent.words.into()), row.mean(|spent| f64::from(u8::from(spent.understood))));
        if options.json {
            let kappa = asking.kappa.is_finite().then_some(asking.kappa);
            let line = json!({
                "trainer": name_of(trainer), "kappa": kappa, "eta": asking.eta, "sessions": row.sessions.len(), "seed": options.seed,
                "choices": options.choices, "actions_that_tell_more": row.setting.telling, "cost": cost, "cost_never_asking": never,
                "saved": [saved - wide, saved + wide], "steps": steps, "questions": questions, "words": words, "understood": understood,
            });
            writeln!(out, "{line}")?;
        } else {
            let kappa = if asking.kappa.is_finite() { format!("{:5}", asking.kappa) } else { "never".to_owned() };
            let (name, eta, percent) = (name_of(trainer), asking.eta, 100.0 * understood);
            writeln!(
                out,
                "{name:11}  {kappa}  {eta:4.2}  {cost:5.1}  {never:14.1}  {saved:8.1} ± {wide:4.1}  {steps:5.1}  {questions:9.2}  {words:5.1}  {percent:5.1} %"
            )?;
        }
    }
    Ok(out.flush()?)
}
