//! One session with a simulated trainer, with or without questions.

use goodbot::asking::{Answer, Asking, Question};
use goodbot::feedback::{Feedback, Judged, LAGS, SimulatedTrainer, Strategy, population};
use goodbot::home::paper_tasks;
use goodbot::random::{below, unit};
use goodbot::{Agent, AgentError, HeapMemory, Options};
use goodbot_course::{CourseTrainer, Homes, Trainer, generator};
use rand_core::Rng;

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
    /// Whether it takes informative actions.
    pub telling: bool,
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
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options { telling: setting.telling, ..Options::DEFAULT })?;
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
