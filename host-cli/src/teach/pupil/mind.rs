//! Makes the robot's agent and its home, at the start and whenever they are replaced during a visit.

use crate::teach::site::{Setting, Site, SiteState};
use goodbot::feedback::population;
use goodbot::home::{self, Moves};
use goodbot::memory::AgentHeap;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_console::believes::Believes;
use goodbot_console::learner::{self, Learner};
use goodbot_console::outcome::Failure;
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
    let mut mind = Agent::new(learner::memory(capacities, &options.language, tasks), lifted, options)?;
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
