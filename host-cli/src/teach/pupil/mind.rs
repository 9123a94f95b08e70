//! The robot's mind and its home, each made anew when it is replaced during a visit.

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
use goodbot_lesson::world::robot::{self, Flaw, Tables};
use std::sync::Arc;

/// What commands may mean in a place. `ways` says whether that is tasks with a way too, in a home.
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

/// A mind that has learned nothing yet, and commands may mean `lifted`. `believes` is what it expects of its trainer, where that is not what real
/// people do. `tasks` is how many possible tasks it keeps of all sessions together.
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

/// Makes a mind expect this of its trainer, or else what real people do: it knows that the trainer ends its sessions.
pub fn expect(mind: &mut Agent<AgentHeap>, believes: Option<&Believes>) -> Result<(), Failure> {
    let believes = believes.unwrap_or(&Believes::Population);
    let options = Options { drift: Options::DEFAULT.drift, ending: Options::DEFAULT.ending, ..*mind.options() };
    mind.set_options(believes.options(options))?;
    Ok(mind.set_strategies(believes.strategies().unwrap_or(&population::STRATEGIES))?)
}

/// The place of a file, and where everything is in it.
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

fn flawed(flaw: Flaw) -> Failure {
    Failure::Input(flaw.to_string())
}
