//! The agent that goes through recorded sessions, one after the other.

use super::believes::Believes;
use crate::fit_trainers::walk::trainer_of;
use crate::lessons::evidence;
use crate::load::session::{Session, load};
use crate::load::{Fault, home};
use goodbot::feedback::Feedback;
use goodbot::home::Home;
use goodbot::memory::{AgentHeap, HomeMemory};
use goodbot::oomdp::apply;
use goodbot::session::{Evidence, Options};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Kind, RecordedSession};
use goodbot_formats::task_text::GroundTaskText;

/// The name of the paper's trainer strategy, which is considered where no session names others.
const BALANCED: &str = "balanced";

/// What the agent has room for: recorded histories are longer than what one learns at a time.
const CAPACITIES: Capacities = Capacities {
    sessions: 4_096,
    sentence_words: 131_072,
    pairs: 262_144,
    commands: 8_192,
    command_tokens: 98_304,
    ..Capacities::STANDARD
};

/// All words are learned anew when one in so many sessions has come since they were: under a hundred, after each. A training takes time for
/// all sessions so far. All of them together then take time for so many times the sessions, and not for the square of their number.
const PART: usize = 50;

/// When words are learned anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Learning {
    /// When enough sessions have come.
    InParts,
    /// After every session: the paper's Algorithm 1.
    EverySession,
}

/// An agent and what it went through.
pub struct History {
    agent: Agent<AgentHeap>,
    learning: Learning,
    /// How many sessions were learned from, and how many are to be.
    learned: usize,
    kept: usize,
    lifted: Vec<LiftedTask>,
    strategies: Vec<String>,
    /// What is expected of trainers, where that is not what the sessions say.
    believes: Option<Believes>,
    /// Who trained last.
    trainer: Option<String>,
    last: Last,
}

/// What came before.
enum Last {
    Nothing,
    Broken,
    Session(String, EnvironmentFile),
}

/// What became of one session.
pub struct Outcome {
    /// Its name.
    pub id: String,
    /// What was said.
    pub command: String,
    /// How it taught.
    pub kind: Kind,
    /// Whether it continued the one before.
    pub continues: bool,
    /// What was meant.
    pub intended: Option<GroundTaskText>,
    /// The belief before the first step and after each; where the end of a session is evidence, also after it.
    pub beliefs: Vec<PosteriorLine<f32>>,
    /// How many steps.
    pub steps: usize,
    /// How often each feedback was given: reward, punishment, silence.
    pub feedback: [usize; 3],
    /// Whether it was learned from.
    pub learned: bool,
    /// Whether all words were learned anew after it.
    pub trained: bool,
    /// What is worth knowing, and no fault.
    pub remarks: Vec<Fault>,
}

impl History {
    /// An agent that has learned nothing yet. `lifted` are the tasks that commands may mean, and `believes` is what it expects of trainers,
    /// in place of what the sessions say.
    pub fn new(
        lifted: &[LiftedTask],
        options: Options,
        learning: Learning,
        believes: Option<Believes>,
    ) -> Result<Self, goodbot::AgentError> {
        let options = believes.as_ref().map_or(options, |believes| believes.options(options));
        Ok(Self {
            agent: Agent::new(AgentHeap::new(&CAPACITIES), lifted, options)?,
            learning,
            learned: 0,
            kept: 0,
            lifted: lifted.to_vec(),
            strategies: vec![BALANCED.to_owned()],
            believes,
            trainer: None,
            last: Last::Nothing,
        })
    }

    /// A session could not be read.
    pub fn broken(&mut self) {
        self.last = Last::Broken;
    }

    /// Replays a session.
    ///
    /// # Errors
    /// What is wrong with it. Nothing is then learned from it.
    pub fn replay(&mut self, file: &str, recorded: &RecordedSession) -> Result<Outcome, Vec<Fault>> {
        let replayed = self.try_replay(file, recorded);
        self.last = match &replayed {
            Ok(_) => Last::Session(recorded.header.command.clone(), recorded.header.environment.clone()),
            Err(_) => Last::Broken,
        };
        replayed
    }

    fn try_replay(&mut self, file: &str, recorded: &RecordedSession) -> Result<Outcome, Vec<Fault>> {
        let header = &recorded.header;
        let at = |line: usize| move |error: AgentError| vec![Fault::on_line(file, line, error)];
        if header.kind == Kind::Labelled {
            let message = "a labelled session has no steps to go through; learn from it with goodbot learn";
            return Err(vec![Fault::on_line(file, recorded.header_line, message).in_field("kind")]);
        }
        self.check_continues(file, recorded)?;
        let mut memory = home::memory();
        let session = load(file, recorded, &self.lifted, &mut memory)?;
        self.meet(file, recorded).map_err(at(recorded.header_line))?;
        self.begin(recorded, &session).map_err(at(recorded.header_line))?;
        let id = header.id.clone().unwrap_or_else(|| format!("{file}:{}", recorded.header_line));
        let mut outcome = Outcome {
            id,
            command: header.command.clone(),
            kind: header.kind,
            continues: header.continues,
            intended: header.meant().and_then(Result::ok),
            beliefs: vec![],
            steps: session.steps.len(),
            feedback: [0; 3],
            learned: recorded.learn,
            trained: false,
            remarks: vec![],
        };
        outcome.beliefs.push(self.belief(&outcome.id, 0, &session));
        let answered = |agent: &mut Agent<AgentHeap>, steps: usize| {
            session.answer(agent, steps).map_err(|(line, error)| vec![Fault::on_line(file, line, error)])
        };
        for (step, count) in session.steps.iter().zip(1_u64..) {
            answered(&mut self.agent, count as usize - 1)?;
            self.agent.plan_fully(&session.home, &step.before).map_err(at(step.line))?;
            let counted = match header.kind {
                Kind::Feedback => {
                    let [reward, punish, neutral] = &mut outcome.feedback;
                    *match step.feedback {
                        Feedback::Reward => reward,
                        Feedback::Punish => punish,
                        Feedback::Neutral => neutral,
                    } += 1;
                    self.agent.acted(&session.home, &step.before, step.action).map_err(at(step.line))?;
                    self.agent.feedback(step.feedback)
                }
                Kind::Demonstration => self.agent.demonstrated(&session.home, &step.before, step.action),
                // Has no steps, and was refused.
                Kind::Labelled => Ok(Evidence::Used),
            };
            let mut remark = |message: &str| outcome.remarks.push(Fault::on_line(file, step.line, message));
            if let Some(message) = evidence::remark(counted.map_err(at(step.line))?) {
                remark(message);
            }
            let plan = self.agent.planned();
            if !plan.unknown().union(plan.approximate()).is_empty() {
                remark(
                    "the search was bounded: for some tasks the optimal actions are not known exactly, and the step says nothing of these",
                );
            }
            if step.bump && header.kind == Kind::Demonstration {
                remark("the demonstration goes against a wall or a block that is held, and nothing moves");
            }
            outcome.beliefs.push(self.belief(&outcome.id, count, &session));
        }
        if session.answers.iter().any(|answer| answer.after == session.steps.len()) {
            answered(&mut self.agent, session.steps.len())?;
            // What was answered behind the last step belongs to the last belief.
            outcome.beliefs.pop();
            outcome.beliefs.push(self.belief(&outcome.id, session.steps.len() as u64, &session));
        }
        if self.ends(&session, header.kind).map_err(at(recorded.end_line))? {
            outcome.beliefs.push(self.belief(&outcome.id, session.steps.len() as u64 + 1, &session));
        }
        if recorded.learn {
            outcome.trained = self.learn(&session.home).map_err(at(recorded.end_line))?;
        } else {
            self.agent.forget();
        }
        Ok(outcome)
    }

    /// Ends a session that is learned from. Gives whether the words were learned anew.
    fn learn(&mut self, home: &Home<impl HomeMemory>) -> Result<bool, AgentError> {
        self.kept += 1;
        let enough = ((self.learned + self.kept) / PART).max(1);
        // What has no room beside the others makes room for itself, and all is learned anew.
        if self.learning == Learning::InParts && self.kept < enough && self.agent.finish_for_later(home).is_ok() {
            return Ok(false);
        }
        let _ = self.agent.finish(home)?;
        self.agent.learn_fully();
        (self.learned, self.kept) = (self.learned + self.kept, 0);
        Ok(true)
    }

    fn check_continues(&self, file: &str, recorded: &RecordedSession) -> Result<(), Vec<Fault>> {
        let header = &recorded.header;
        let message = match &self.last {
            _ if !header.continues => return Ok(()),
            Last::Session(command, environment) if *command == header.command && *environment == header.environment => return Ok(()),
            Last::Session(..) => "the session before has another command or environment; remove \"continues\"",
            Last::Broken => "the session before could not be replayed, so nothing can be continued; mend that one first",
            Last::Nothing => "there is no session before; remove \"continues\", or name the file with that session first",
        };
        Err(vec![Fault::on_line(file, recorded.header_line, message).in_field("continues")])
    }

    /// Expects what it expects of a trainer whom it has not met yet.
    fn meet(&mut self, file: &str, recorded: &RecordedSession) -> Result<(), AgentError> {
        let Some(strategies) = self.believes.as_ref().and_then(Believes::strategies) else { return Ok(()) };
        let trainer = trainer_of(recorded.header.id.as_deref(), file);
        if self.trainer.as_deref() != Some(trainer) {
            self.trainer = Some(trainer.to_owned());
            self.agent.set_strategies(strategies)?;
            self.strategies = (1..=strategies.len()).map(|number| format!("strategy {number}")).collect();
        }
        Ok(())
    }

    /// Takes in that the trainer ended the session, where that is evidence. Gives whether it was.
    fn ends(&mut self, session: &Session<impl HomeMemory>, kind: Kind) -> Result<bool, AgentError> {
        let Some(last) = session.steps.last().filter(|_| kind == Kind::Feedback && self.agent.options().ending.is_evidence()) else {
            return Ok(false);
        };
        let state = apply(&session.home, &last.before, last.action).unwrap_or(last.before);
        self.agent.plan_fully(&session.home, &state)?;
        Ok(self.agent.trainer_ended(&session.home, &state)? == Evidence::Used)
    }

    fn begin(&mut self, recorded: &RecordedSession, session: &Session<impl HomeMemory>) -> Result<(), AgentError> {
        let header = &recorded.header;
        let expected = self.believes.as_ref().and_then(Believes::strategies).is_some();
        if let (Some(strategies), Some(records), false) = (&session.strategies, &header.strategies, expected) {
            self.agent.set_strategies(strategies)?;
            self.strategies = records.iter().map(|record| record.name.clone()).collect();
        }
        if header.continues {
            self.agent.hear_again(&session.home, &session.start)
        } else if session.prior.is_some() {
            self.agent.hear_with_prior(&session.home, &session.start, &header.command, |task, _| session.prior_of(task))
        } else {
            self.agent.hear(&session.home, &session.start, &header.command)
        }
    }

    fn belief(&self, id: &str, step: u64, session: &Session<impl HomeMemory>) -> PosteriorLine<f32> {
        let belief = self.agent.belief();
        let tasks = session.tasks.iter().enumerate().map(|(position, (_, name))| (name.clone(), belief.probability(position)));
        let strategies = self.strategies.iter().enumerate().map(|(position, name)| (name.clone(), belief.strategy_probability(position)));
        PosteriorLine { session: id.to_owned(), step, tasks: tasks.collect(), strategies: strategies.collect() }
    }
}
