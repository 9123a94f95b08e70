//! The agent that replays recorded sessions, one after another.

use goodbot::feedback::Feedback;
use goodbot::language::Synonyms;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Domain;
use goodbot::session::Evidence;
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_console::load::words::said_in_known_words;
use goodbot_console::{Believes, Failure, evidence, restored};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Kind, RecordedSession};
use goodbot_formats::task_text::GroundTaskText;
use goodbot_formats::world::{SessionInWorld, WorldFile};
use goodbot_lab::recorded::trainer_of;
use goodbot_lesson::checked::{CheckedSession, check_steps};
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::walk::Step;
use goodbot_lesson::world::robot::{self, Robot, Tables};
use goodbot_lesson::{Fault, home, world};
use std::borrow::Cow;
use std::sync::Arc;

/// The name of the paper's trainer strategy, the default of sessions without strategies.
const BALANCED: &str = "balanced";

/// The agent's capacities: recorded histories are longer than a robot's own.
const CAPACITIES: Capacities = Capacities {
    sessions: 4_096,
    sentence_words: 131_072,
    pairs: 262_144,
    commands: 8_192,
    command_tokens: 98_304,
    ..Capacities::STANDARD
};

/// Training runs again when the number of sessions has grown by one in this many; below a hundred sessions, after each. A training takes
/// time in proportion to all sessions so far. The total time thus grows with the number of sessions times this, and not with its square.
const PART: usize = 50;

/// When the words are trained again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Learning {
    /// After enough new sessions.
    InParts,
    /// After every session: the paper's Algorithm 1.
    EverySession,
}

/// An agent and its training history.
pub struct History {
    agent: Agent<AgentHeap>,
    learning: Learning,
    /// How many sessions the words were trained on, and how many wait for training.
    learned: usize,
    kept: usize,
    /// The kinds of task in homes.
    lifted: Vec<LiftedTask>,
    /// The worlds of the logs so far, each with its robot and its kinds of task.
    worlds: Vec<(Arc<WorldFile>, Robot<'static>, Vec<LiftedTask>)>,
    strategies: Vec<String>,
    /// The expected trainers, in place of the sessions' own.
    believes: Option<Believes>,
    /// The synonyms that replace unknown words.
    synonyms: Synonyms<'static>,
    /// The last trainer.
    trainer: Option<String>,
    last: Last,
}

/// The session before.
enum Last {
    Nothing,
    Broken,
    Session(String, EnvironmentFile),
}

/// The result of one session.
pub struct Outcome {
    /// The session's name.
    pub id: String,
    /// The command.
    pub command: String,
    /// The kind of session.
    pub kind: Kind,
    /// Whether it continued the session before.
    pub continues: bool,
    /// The intended task.
    pub intended: Option<GroundTaskText>,
    /// The belief before the first step and after each. If the end of a session is evidence, also after the end.
    pub beliefs: Vec<PosteriorLine<f32>>,
    /// The number of steps.
    pub steps: usize,
    /// How often each feedback was given: reward, punishment, silence.
    pub feedback: [usize; 3],
    /// Whether it was learned from.
    pub learned: bool,
    /// Whether all words were trained again after it.
    pub trained: bool,
    /// Remarks that are no faults.
    pub remarks: Vec<Fault>,
    /// The command's length, if only its first words are read.
    pub long: Option<Fault>,
}

impl History {
    /// An agent without training. `lifted` are the kinds of task that commands may mean. `believes` replaces the trainer strategies that
    /// the sessions name. `synonyms` replace unknown words.
    pub fn new(
        lifted: &[LiftedTask],
        options: Options,
        learning: Learning,
        believes: Option<Believes>,
        synonyms: Synonyms<'static>,
    ) -> Result<Self, goodbot::AgentError> {
        let options = believes.as_ref().map_or(options, |believes| believes.options(options));
        Ok(Self {
            agent: Agent::new(goodbot_console::typed::memory(&CAPACITIES, &options.language, CAPACITIES.pairs), lifted, options)?,
            learning,
            learned: 0,
            kept: 0,
            lifted: lifted.to_vec(),
            worlds: vec![],
            strategies: vec![BALANCED.to_owned()],
            believes,
            synonyms,
            trainer: None,
            last: Last::Nothing,
        })
    }

    /// Notes that a session could not be read.
    pub fn broken(&mut self) {
        self.last = Last::Broken;
    }

    /// Replays a session.
    ///
    /// # Errors
    /// The faults of the session. Nothing is learned from it then.
    pub fn replay(&mut self, file: &str, recorded: &RecordedSession) -> Result<Outcome, Vec<Fault>> {
        let replayed = self.try_replay(file, recorded);
        self.last = match &replayed {
            Ok(_) => Last::Session(recorded.header.command.clone(), recorded.header.environment.clone()),
            Err(_) => Last::Broken,
        };
        replayed
    }

    /// Replays a session in a world.
    ///
    /// # Errors
    /// The faults of the session or its world. Nothing is learned from it then.
    pub fn replay_in(&mut self, file: &str, recorded: &SessionInWorld) -> Result<Outcome, Vec<Fault>> {
        // No session in a home continues one in another world.
        self.last = Last::Nothing;
        let at = |message: &dyn std::fmt::Display| vec![Fault::on_line(file, recorded.session.header_line, message).in_field("world")];
        let known = self.worlds.iter().position(|(known, ..)| *known == recorded.world);
        let known = match known {
            Some(known) => known,
            None => {
                let robot = Tables::of(Arc::clone(&recorded.world)).map_err(|flaw| at(&flaw))?.keep();
                let lifted = robot::tasks(&recorded.world, &robot).map_err(|flaw| at(&flaw))?;
                self.worlds.push((Arc::clone(&recorded.world), robot, lifted));
                self.worlds.len() - 1
            }
        };
        let Some((_, robot, lifted)) = self.worlds.get(known) else { return Err(vec![]) };
        let mut session = world::check_steps(file, recorded, *robot, lifted)?;
        let lifted = lifted.clone();
        self.expect_tasks(&lifted).map_err(|message| at(&message))?;
        self.go_through(file, &recorded.session, &mut session, "this step of the demonstration changes nothing")
    }

    /// Replaces the agent by one with these kinds of task. The learned words are kept.
    fn expect_tasks(&mut self, lifted: &[LiftedTask]) -> Result<(), Failure> {
        if self.agent.lifted() == lifted {
            return Ok(());
        }
        let options = *self.agent.options();
        let memory = goodbot_console::typed::memory(&CAPACITIES, &options.language, CAPACITIES.pairs);
        let mut agent = Agent::new(memory, lifted, options)?;
        if self.learned + self.kept > 0 {
            agent.join(&restored::words(&self.agent.saved()?)?)?;
            agent.learn_fully();
        }
        self.agent = agent;
        // The new agent has not met the trainer.
        self.trainer = None;
        Ok(())
    }

    fn try_replay(&mut self, file: &str, recorded: &RecordedSession) -> Result<Outcome, Vec<Fault>> {
        self.check_continues(file, recorded)?;
        let mut session = check_steps(file, recorded, &self.lifted, home::memory())?;
        let lifted = self.lifted.clone();
        self.expect_tasks(&lifted).map_err(|message| vec![Fault::on_line(file, recorded.header_line, message)])?;
        self.go_through(file, recorded, &mut session, "the demonstration walks into a wall or a held block, and nothing moves")
    }

    /// Replays a session. `bump` is the remark on a demonstrated step that changes nothing.
    fn go_through<D: Domain>(
        &mut self,
        file: &str,
        recorded: &RecordedSession,
        session: &mut CheckedSession<D>,
        bump: &str,
    ) -> Result<Outcome, Vec<Fault>> {
        let header = &recorded.header;
        let at = |line: usize| move |error: AgentError| vec![Fault::on_line(file, line, error)];
        self.meet(file, recorded).map_err(at(recorded.header_line))?;
        let said = [Some(&mut session.walk.command), session.walk.listening.as_mut().map(|listening| &mut listening.utterance)];
        for words in said.into_iter().flatten() {
            let heard = said_in_known_words(self.synonyms, self.agent.language(), words).map(Cow::into_owned);
            *words = heard.map_err(|error| at(recorded.header_line)(error.into()))?;
        }
        if let (Some(records), false) = (&header.strategies, self.expects()) {
            self.strategies = records.iter().map(|record| record.name.clone()).collect();
        }
        let mut outcome = Outcome {
            id: header.id.clone().unwrap_or_else(|| format!("{file}:{}", recorded.header_line)),
            command: header.command.clone(),
            kind: header.kind,
            continues: header.continues,
            intended: header.meant().and_then(Result::ok),
            beliefs: vec![],
            steps: session.walk.steps.len(),
            feedback: [0; 3],
            learned: recorded.learn,
            trained: false,
            remarks: vec![],
            long: session.long.map(|long| Fault::on_line(file, recorded.header_line, long).in_field("command")),
        };
        self.walk(file, session, bump, &mut outcome)?;
        if recorded.learn {
            outcome.trained = self.learn(&session.walk.home).map_err(at(recorded.end_line))?;
        } else {
            self.agent.forget();
        }
        Ok(outcome)
    }

    fn walk<D: Domain>(&mut self, file: &str, session: &CheckedSession<D>, bump: &str, outcome: &mut Outcome) -> Result<(), Vec<Fault>> {
        let mut replay = Replay::new(Rules { strategies: !self.expects(), ..Rules::AS_IT_WAS });
        let mut taken = 0;
        loop {
            let event = replay.advance(&mut self.agent, &session.walk, u32::MAX);
            match event.map_err(|refused| vec![Fault::on_line(file, refused.line, refused.error)])? {
                Event::Working | Event::Planned(_) => continue,
                Event::Ended => return Ok(()),
                Event::Heard | Event::Closed(Evidence::Used) => {}
                Event::Closed(_) => continue,
                Event::Answered(answer) => {
                    if answer.after < session.walk.steps.len() {
                        continue;
                    }
                    // An answer after the last step belongs to the last belief.
                    outcome.beliefs.pop();
                    taken -= 1;
                }
                Event::Took(step, evidence) => {
                    if session.walk.kind == Kind::Feedback {
                        let [reward, punish, neutral] = &mut outcome.feedback;
                        *match step.feedback {
                            Feedback::Reward => reward,
                            Feedback::Punish => punish,
                            Feedback::Neutral => neutral,
                        } += 1;
                    }
                    self.remark(file, session.walk.kind, (step, bump), evidence, &mut outcome.remarks);
                }
            }
            outcome.beliefs.push(self.belief(&outcome.id, taken, session));
            taken += 1;
        }
    }

    /// Adds remarks on the step that was taken last.
    fn remark<S>(&self, file: &str, kind: Kind, (step, bump): (&Step<S>, &str), evidence: Evidence, remarks: &mut Vec<Fault>) {
        let mut remark = |message: &str| remarks.push(Fault::on_line(file, step.line, message));
        if let Some(message) = evidence::remark(evidence) {
            remark(message);
        }
        let plan = self.agent.planned();
        if !plan.unknown().union(plan.approximate()).is_empty() {
            remark("the search reached its limit: for some tasks no exact plan is known, and the step is no evidence about these");
        }
        if step.bump && kind == Kind::Demonstration {
            remark(bump);
        }
    }

    /// Whether the agent expects the trainers of `believes`, and not those of the sessions.
    fn expects(&self) -> bool {
        self.believes.as_ref().and_then(Believes::strategies).is_some()
    }

    /// Ends a session that is learned from. Returns `true` if the words were trained again.
    fn learn<D: Domain>(&mut self, home: &D) -> Result<bool, AgentError> {
        self.kept += 1;
        let enough = ((self.learned + self.kept) / PART).max(1);
        // A session that does not fit makes room for itself, and everything is trained again.
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

    /// Sets the expected strategies for a trainer whom the agent has not met.
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

    fn belief<D: Domain>(&self, id: &str, step: u64, session: &CheckedSession<D>) -> PosteriorLine<f32> {
        let belief = self.agent.belief();
        let tasks = session.tasks.iter().enumerate().map(|(position, (_, name))| (name.clone(), belief.probability(position)));
        let strategies = self.strategies.iter().enumerate().map(|(position, name)| (name.clone(), belief.strategy_probability(position)));
        PosteriorLine { session: id.to_owned(), step, tasks: tasks.collect(), strategies: strategies.collect() }
    }
}
