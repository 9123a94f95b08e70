//! `goodbot questions`: the costs and savings of questions, with simulated trainers.

use crate::calibration::Mean;
use clap::Args;
use goodbot::asking::{Answer, Asking, Question};
use goodbot::feedback::{Feedback, Judged, LAGS, Strategy, population};
use goodbot::home::paper_tasks;
use goodbot::random::{below, unit};
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use goodbot_console::{Failure, bar, between, name_of, output};
use goodbot_course::{CourseTrainer, Homes, SimulatedTrainer, Trainer, generator};
use rand_core::Rng;
use rayon::prelude::*;
use serde_json::json;
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
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = goodbot_console::typed::seed)]
    seed: u64,
    /// The cost of a question, in steps
    #[arg(long, value_name = "STEPS", value_delimiter = ',', default_value = "2,4,8,15,20", value_parser = goodbot_console::typed::cost)]
    kappa: Vec<f32>,
    /// The share of wrong answers
    #[arg(long, value_name = "SHARE", value_delimiter = ',', default_value = "0.05", value_parser = goodbot_console::typed::wrong_share)]
    eta: Vec<f32>,
    /// The trainers
    #[arg(long, value_enum, value_delimiter = ',', default_value = "balanced,punish-only,real")]
    trainer: Vec<Trained>,
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
    let base = |kappa, eta| Asking { kappa, eta, ..Asking::DEFAULT };
    for (&kappa, &eta) in options.kappa.iter().flat_map(|kappa| options.eta.iter().map(move |eta| (kappa, eta))) {
        base(kappa, eta).check().map_err(|error| Failure::Input(error.to_string()))?;
    }
    let mut settings = vec![];
    for &trainer in &options.trainer {
        let setting = |asking| Setting { trainer, asking };
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
                "cost": cost, "cost_never_asking": never,
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

/// The robot has understood when the intended task has this probability.
pub const UNDERSTOOD: f32 = 0.95;
/// The most steps of a session.
pub const MOST_STEPS: u32 = Asking::DEFAULT.patience as u32;

/// The trainers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Trained {
    /// The paper's balanced trainer
    Balanced,
    /// The paper's trainer who punishes and never rewards
    PunishOnly,
    /// One drawn from the strategies of real people
    Real,
}

impl Trained {
    /// The strategies that the robot expects: the trainer's own; for a real person, the whole population.
    fn expected(self) -> Vec<(Strategy, f32)> {
        match self {
            Self::Balanced => vec![(Strategy::BALANCED, 1.0)],
            Self::PunishOnly => vec![(Strategy::PUNISH_ONLY, 1.0)],
            Self::Real => population::STRATEGIES.to_vec(),
        }
    }

    fn says(self, strategy: Strategy, judged: [Judged; LAGS], random: &mut impl Rng) -> Feedback {
        let right = matches!(judged, [Judged::Nearer | Judged::RestsAtGoal, ..]);
        match self {
            Self::Balanced => CourseTrainer::BALANCED.feedback(right, random),
            Self::PunishOnly => CourseTrainer::PUNISH_ONLY.feedback(right, random),
            Self::Real => SimulatedTrainer { strategy }.late_feedback(judged, random),
        }
    }
}

/// A session to simulate.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The trainer.
    pub trainer: Trained,
    /// When the robot asks.
    pub asking: Asking,
}

/// The result of a session.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spent {
    /// Steps until the robot understood; [`MOST_STEPS`] if it never did.
    pub steps: u32,
    /// Questions until then.
    pub questions: u32,
    /// Words of reward and punishment until then.
    pub words: u32,
    /// Whether it understood.
    pub understood: bool,
}

/// Simulates a session of a robot without words, in a random home of four rooms and two blocks, with a random task.
///
/// # Errors
/// The robot's error.
pub fn simulate(memory: &mut HeapMemory, setting: &Setting, seed: u64) -> Result<Spent, AgentError> {
    let mut random = generator(seed);
    let homes = Homes::random(&mut random, &mut memory.home);
    let Ok((home, start)) = homes.test.build(&mut memory.home) else { return Ok(Spent::default()) };
    let Ok(lifted) = paper_tasks() else { return Ok(Spent::default()) };
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options::DEFAULT)?;
    agent.set_strategies(&setting.trainer.expected())?;
    agent.hear(&home, &start, "do what is meant")?;
    let intended = below(agent.tasks().len(), &mut random);
    let mut share = unit(&mut random);
    let mut strategy = Strategy::BALANCED;
    for &(drawn, probability) in &population::STRATEGIES {
        if (0.0..probability).contains(&share) {
            strategy = drawn;
        }
        share -= probability;
    }
    let (mut spent, mut state) = (Spent::default(), start);
    loop {
        agent.plan_fully(&home, &state)?;
        while agent.belief().probability(intended) < UNDERSTOOD {
            let Some(question) = agent.question(&home, &state, &setting.asking)? else { break };
            spent.questions += 1;
            let _ = agent.answer(answer(&question, intended, setting.asking.eta, &mut random))?;
        }
        spent.understood = agent.belief().probability(intended) >= UNDERSTOOD;
        if spent.understood || spent.steps >= MOST_STEPS {
            return Ok(spent);
        }
        let decision = agent.decide_with(&home, &state, &mut random)?;
        state = agent.acted(&home, &state, decision.action)?;
        let feedback = setting.trainer.says(strategy, agent.judged(intended), &mut random);
        let _ = agent.feedback(feedback)?;
        spent.words += u32::from(feedback != Feedback::Neutral);
        spent.steps += 1;
    }
}

/// The answer of a trainer with this intended task, who is wrong with probability `eta`.
pub fn answer(question: &Question, intended: usize, eta: f32, random: &mut impl Rng) -> Answer {
    let wrong = unit(random) < eta;
    let count = usize::from(question.subject.choices());
    if count == 0 {
        return if question.yes.contains(intended) != wrong { Answer::Yes } else { Answer::No };
    }
    // One of the choices; after the last, none of them.
    let right = question.choices.iter().take(count).position(|choice| choice.contains(intended)).unwrap_or(count);
    let given = if wrong { (right + 1 + below(count, random)) % (count + 1) } else { right };
    if given == count { Answer::No } else { Answer::This(given as u8) }
}
