//! Makes the robot's agent and its home, at the start and whenever they are replaced during a visit.
//!
//! A robot with a starter has the starter's sentences beside its own sessions: the more own sessions, the fewer sentences. They are in the
//! agent's memory only; its saved model has its own sessions, as without a starter.

use crate::teach::site::{Setting, Site, SiteState};
use goodbot::feedback::population;
use goodbot::home::{self, Moves};
use goodbot::memory::AgentHeap;
use goodbot::session::Finished;
use goodbot::snapshot::Places;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_console::{Believes, Failure, Learner, Starter, training, typed};
use goodbot_lesson::home as homes;
use goodbot_lesson::world::robot::{self, Tables, WorldFlaw};
use std::sync::Arc;

/// The kinds of task of a place. With `ways`, kinds with a way too; only homes have them.
pub fn kinds_of_task(site: &Site, ways: bool) -> Result<Vec<LiftedTask>, Failure> {
    match site {
        Site::Floor(_) => {
            let paper = home::paper_tasks()?;
            Ok(if ways { home::with_routes(&paper)?.to_vec() } else { paper.to_vec() })
        }
        Site::Other(_) if ways => Err(Failure::Input("commands may mean ways in homes only; leave out --routes".to_owned())),
        Site::Other(robot) => robot::tasks(robot.file(), robot).map_err(flawed),
    }
}

/// An agent without training, for the kinds of task `lifted`. `believes` is its expected trainer, by default real people. `tasks` is the
/// total number of possible tasks that it keeps for all sessions.
pub fn new_mind(
    capacities: &Capacities,
    tasks: usize,
    lifted: &[LiftedTask],
    believes: Option<&Believes>,
) -> Result<Agent<AgentHeap>, Failure> {
    let options = Learner::Default.options();
    let mut mind = Agent::new(typed::memory(capacities, &options.language, tasks), lifted, options)?;
    expect(&mut mind, believes)?;
    Ok(mind)
}

/// Sets the trainer that an agent expects, by default real people: the trainer's end of a session is then evidence.
pub fn expect(mind: &mut Agent<AgentHeap>, believes: Option<&Believes>) -> Result<(), Failure> {
    let believes = believes.unwrap_or(&Believes::Population);
    let options = Options { drift: Options::DEFAULT.drift, ending: Options::DEFAULT.ending, ..*mind.options() };
    mind.set_options(believes.options(options))?;
    Ok(mind.set_strategies(believes.strategies().unwrap_or(&population::STRATEGIES))?)
}

/// Builds the place of a file, with its initial state.
pub fn build(file: &Setting) -> Result<(Site, SiteState), Failure> {
    match file {
        Setting::Floor(file) => {
            let (home, start) = homes::build(file, Moves::Push, homes::memory()).map_err(|flaw| Failure::Input(flaw.message(file)))?;
            Ok((Site::Floor(home), SiteState::Floor(start)))
        }
        Setting::Other(file) => {
            let tables = Tables::of(Arc::clone(file)).map_err(flawed)?;
            let start = tables.start();
            Ok((Site::Other(tables.keep()), SiteState::Other(start)))
        }
    }
}

fn flawed(flaw: WorldFlaw) -> Failure {
    Failure::Input(flaw.to_string())
}

/// The sentences, and their places in the agent's training data.
#[derive(Debug, Default)]
pub struct StarterSessions {
    starter: Starter,
    places: Places,
    /// The agent without them, as the bytes of a model file.
    own: Vec<u8>,
}

impl StarterSessions {
    /// A starter that is in no agent yet.
    pub fn new(starter: Starter) -> Self {
        Self { starter, ..Self::default() }
    }

    fn is_on(&self) -> bool {
        !self.starter.lessons().is_empty()
    }

    /// Capacities for the agent's own data and the sentences.
    pub fn room(&self, own: Capacities) -> Capacities {
        self.starter.room(own)
    }

    /// The total number of possible tasks of the sentences.
    pub fn tasks(&self) -> usize {
        training::tasks(self.starter.lessons())
    }

    /// The number of sentences in the agent's training data.
    pub fn count(&self) -> usize {
        self.places.count()
    }

    /// The agent without the sentences, as the bytes of a model file; `None` without a starter.
    pub fn own(&self) -> Option<&[u8]> {
        self.is_on().then_some(&self.own)
    }

    /// Adds the sentences to an agent that has only its own sessions.
    pub fn join(&mut self, mind: &mut Agent<AgentHeap>) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        let own = mind.language().bitext().sessions();
        self.own = mind.saved()?;
        let joined = self.starter.join(mind, own)?;
        self.places = Places::last(mind, joined);
        Ok(())
    }

    /// Removes sentences after the agent has learned from a session of its own. Older sessions may have given way.
    pub fn fade(&mut self, mind: &mut Agent<AgentHeap>, finished: &Finished) -> Result<(), Failure> {
        if !self.is_on() {
            return Ok(());
        }
        if !self.places.find_after(finished) {
            *self = Self::default();
            return Ok(());
        }
        self.places.leave(mind);
        self.join(mind)
    }
}
