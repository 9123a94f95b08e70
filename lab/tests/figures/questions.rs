//! What questions cost and save, with simulated trainers.
//!
//! `GOODBOT_ROBOTS=300 cargo test -p goodbot-lab --test figures questions:: -- --nocapture` prints the figures of docs/how-it-works.md. A robot that
//! knows no word is told something in a random home of four rooms and two blocks, and is trained until the intended task has 95 %. The cost of a
//! session is its steps, and kappa for each question. Each row has the same homes, tasks and trainers.

use crate::robots;
use goodbot::asking::Asking;
use goodbot::feedback::{Feedback, Judged, LAGS, Strategy, population};
use goodbot::home::paper_tasks;
use goodbot::random::{below, unit};
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use goodbot_course::{CourseTrainer, Homes, SimulatedTrainer, Trainer, generator};
use goodbot_lab::calibration::Mean;
use goodbot_lab::study::trainer::answer;
use rand_core::Rng;
use rayon::prelude::*;

/// The robot has understood when the intended task has this probability.
const UNDERSTOOD: f32 = 0.95;
/// The most steps of a session.
const MOST_STEPS: u32 = Asking::DEFAULT.patience as u32;

/// The trainers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trained {
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
struct Setting {
    /// The trainer.
    trainer: Trained,
    /// When the robot asks.
    asking: Asking,
}

/// The result of a session.
#[derive(Clone, Copy, Debug, Default)]
struct Spent {
    /// Steps until the robot understood; [`MOST_STEPS`] if it never did.
    steps: u32,
    /// Questions until then.
    questions: u32,
    /// Words of reward and punishment until then.
    words: u32,
    /// Whether it understood.
    understood: bool,
}

/// Simulates a session of a robot without words, in a random home of four rooms and two blocks, with a random task.
fn simulate(memory: &mut HeapMemory, setting: Setting, seed: u64) -> Result<Spent, AgentError> {
    let mut random = generator(seed);
    let homes = Homes::random(&mut random, &mut memory.home);
    let (home, start) = homes.test.build(&mut memory.home).expect("a home");
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().expect("the paper's tasks"), Options::DEFAULT)?;
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

fn cost(spent: &Spent, kappa: f32) -> f64 {
    let asked = if spent.questions == 0 { 0.0 } else { f64::from(kappa) * f64::from(spent.questions) };
    f64::from(spent.steps) + asked
}

fn sessions(trainer: Trained, asking: Asking) -> Vec<Spent> {
    let memory = || HeapMemory::new(&Capacities { states: 16_384, ..Capacities::STANDARD });
    let session = |memory: &mut HeapMemory, run: u64| simulate(memory, Setting { trainer, asking }, 1 + run).expect("a session");
    (0..robots(20)).into_par_iter().map_init(memory, session).collect()
}

#[test]
fn questions_that_cost_two_steps_halve_what_a_session_costs() {
    for trainer in [Trained::Balanced, Trained::PunishOnly, Trained::Real] {
        let silent = sessions(trainer, Asking::NEVER);
        let mean = |sessions: &[Spent], of: &dyn Fn(&Spent) -> f64| sessions.iter().map(of).sum::<f64>() / sessions.len() as f64;
        println!("{trainer:?}: {:.1} steps without questions", mean(&silent, &|spent| spent.steps.into()));
        for eta in [0.05, 0.15] {
            for kappa in [2.0, 4.0, 8.0, 15.0, 20.0] {
                let asked = sessions(trainer, Asking { kappa, eta, ..Asking::DEFAULT });
                let pairs = silent.iter().zip(&asked);
                let Mean { mean: saved, half } = Mean::of(pairs.map(|(silent, asked)| cost(silent, kappa) - cost(asked, kappa)));
                let understood = 100.0 * mean(&asked, &|spent| f64::from(u8::from(spent.understood)));
                println!(
                    "  kappa {kappa:2}, eta {eta:4}: saves {saved:5.1} ± {half:4.1} by {:5.2} questions; {:5.1} steps, {:4.1} words, {understood:5.1} % understood",
                    mean(&asked, &|spent| spent.questions.into()),
                    mean(&asked, &|spent| spent.steps.into()),
                    mean(&asked, &|spent| spent.words.into()),
                );
                if (kappa, eta) == (2.0, 0.05) {
                    assert!(saved > 0.5 * mean(&silent, &|spent| spent.steps.into()), "{trainer:?}");
                }
            }
        }
    }
}
