//! The robot's mind and its home, each made anew when it is replaced during a visit.

use super::{Refusal, refused};
use crate::teach::site::{Setting, Site, SiteState};
use goodbot::feedback::population;
use goodbot::home::{self, Moves};
use goodbot::memory::AgentHeap;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_console::believes::Believes;
use goodbot_console::learner::{self, Learner};
use goodbot_lesson::home as homes;
use goodbot_lesson::world::robot::{self, Flaw, Tables};
use std::sync::Arc;

/// What commands may mean in a place. `ways` says whether that is tasks with a way too, in a home.
pub fn kinds_of_task(site: &Site, ways: bool) -> Result<Vec<LiftedTask>, Refusal> {
    match site {
        Site::Home(_) => {
            let paper = home::paper_tasks().map_err(refused)?;
            Ok(if ways { home::with_routes(&paper).map_err(refused)?.to_vec() } else { paper.to_vec() })
        }
        Site::World(_) if ways => Err(Refusal("commands may mean ways in homes only; leave out --routes".to_owned())),
        Site::World(robot) => robot::tasks(robot.file(), robot).map_err(flawed),
    }
}

/// A mind that has learned nothing yet, and commands may mean `lifted`. `believes` is what it expects of its trainer, where that is not what real
/// people do. `tasks` is how many possible tasks it keeps of all sessions together.
pub fn new_mind(
    capacities: &Capacities,
    tasks: usize,
    lifted: &[LiftedTask],
    believes: Option<&Believes>,
) -> Result<Agent<AgentHeap>, Refusal> {
    let options = Learner::Default.options();
    let mut mind = Agent::new(learner::memory(capacities, &options.language, tasks), lifted, options).map_err(refused)?;
    expect(&mut mind, believes)?;
    Ok(mind)
}

/// Makes a mind expect this of its trainer, or else what real people do: it knows that the trainer ends its sessions.
pub fn expect(mind: &mut Agent<AgentHeap>, believes: Option<&Believes>) -> Result<(), Refusal> {
    let believes = believes.unwrap_or(&Believes::Population);
    let options = Options { drift: Options::DEFAULT.drift, ending: Options::DEFAULT.ending, ..*mind.options() };
    mind.set_options(believes.options(options)).map_err(refused)?;
    mind.set_strategies(believes.strategies().unwrap_or(&population::STRATEGIES)).map_err(refused)
}

/// The place of a file, and where everything is in it.
pub fn build(file: &Setting) -> Result<(Site, SiteState), Refusal> {
    match file {
        Setting::Home(file) => {
            let (home, start) = homes::build(file, Moves::Push, homes::memory()).map_err(|flaw| Refusal(flaw.message(file)))?;
            Ok((Site::Home(home), SiteState::Home(start)))
        }
        Setting::World(file) => {
            let tables = Tables::of(Arc::clone(file)).map_err(flawed)?;
            let start = tables.start();
            Ok((Site::World(tables.keep()), SiteState::World(start)))
        }
    }
}

fn flawed(flaw: Flaw) -> Refusal {
    Refusal(flaw.to_string())
}
