//! The agent that replays recorded sessions, one after the other.

use goodbot::feedback::Feedback;
use goodbot::language::Synonyms;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Domain;
use goodbot::session::{Evidence, Options};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities};
use goodbot_console::believes::Believes;
use goodbot_console::load::synonyms::said_in_known_words;
use goodbot_console::outcome::Failure;
use goodbot_console::training_data::{evidence, restored};
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

/// Training runs again when the sessions have grown by one part in this many: under a hundred sessions, after each. A training takes time
/// for all sessions so far. All trainings together then take time for this many times the sessions, and not for the square of their number.
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
    /// What commands may mean in homes.
    lifted: Vec<LiftedTask>,
    /// The worlds of the logs so far, each with its robot and what commands may mean there.
    worlds: Vec<(Arc<WorldFile>, Robot<'static>, Vec<LiftedTask>)>,
    strategies: Vec<String>,
    /// What is expected of trainers, where that is not what the sessions say.
    believes: Option<Believes>,
    /// Words that the agent hears as words that it knows.
    synonyms: Synonyms<'static>,
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
    /// That not all words of the command are read, where it is so.
    pub long: Option<Fault>,
}

impl History {
    /// An agent that has learned nothing yet. `lifted` are the tasks that commands may mean, and `believes` is what it expects of trainers,
    /// in place of what the sessions say. Unknown words are heard as known ones of their line of `synonyms`.
    pub fn new(
        lifted: &[LiftedTask],
        options: Options,
        learning: Learning,
        believes: Option<Believes>,
        synonyms: Synonyms<'static>,
    ) -> Result<Self, goodbot::AgentError> {
        let options = believes.as_ref().map_or(options, |believes| believes.options(options));
        Ok(Self {
            agent: Agent::new(goodbot_console::learner::memory(&CAPACITIES, &options.language, CAPACITIES.pairs), lifted, options)?,
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

    /// Replays a session in a world.
    ///
    /// # Errors
    /// What is wrong with it, or with its world. Nothing is then learned from it.
    pub fn replay_in(&mut self, file: &str, recorded: &SessionInWorld) -> Result<Outcome, Vec<Fault>> {
        // No session in a home goes on from one in another world.
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
        let mut session = world::checked::check_steps(file, recorded, *robot, lifted)?;
        let lifted = lifted.clone();
        self.expect_tasks(&lifted).map_err(|message| at(&message))?;
        self.go_through(file, &recorded.session, &mut session, "this step of the demonstration changes nothing")
    }

    /// Makes the agent one whose commands may mean these tasks. What the words mean is taken along.
    fn expect_tasks(&mut self, lifted: &[LiftedTask]) -> Result<(), Failure> {
        if self.agent.lifted() == lifted {
            return Ok(());
        }
        let options = *self.agent.options();
        let memory = goodbot_console::learner::memory(&CAPACITIES, &options.language, CAPACITIES.pairs);
        let mut agent = Agent::new(memory, lifted, options)?;
        if self.learned + self.kept > 0 {
            agent.join(&restored::words(&self.agent.saved()?)?)?;
            agent.learn_fully();
        }
        self.agent = agent;
        // The trainer is met anew.
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

    /// Replays a session. `bump` says of a demonstration's step that it changes nothing.
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

    /// Remarks on a step that was just taken.
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

    /// Whether it expects of trainers what it was told, and not what the sessions say.
    fn expects(&self) -> bool {
        self.believes.as_ref().and_then(Believes::strategies).is_some()
    }

    /// Ends a session that is learned from. Gives whether the words were learned anew.
    fn learn<D: Domain>(&mut self, home: &D) -> Result<bool, AgentError> {
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

    fn belief<D: Domain>(&self, id: &str, step: u64, session: &CheckedSession<D>) -> PosteriorLine<f32> {
        let belief = self.agent.belief();
        let tasks = session.tasks.iter().enumerate().map(|(position, (_, name))| (name.clone(), belief.probability(position)));
        let strategies = self.strategies.iter().enumerate().map(|(position, name)| (name.clone(), belief.strategy_probability(position)));
        PosteriorLine { session: id.to_owned(), step, tasks: tasks.collect(), strategies: strategies.collect() }
    }
}
