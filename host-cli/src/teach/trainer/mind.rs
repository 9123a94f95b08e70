//! The robot's mind and its home, each made anew when it is replaced during a visit.

use super::{Refusal, refused};
use goodbot::feedback::population;
use goodbot::home::{self, Home, HomeState, Moves};
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::{Agent, Capacities, Options};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home as homes;

/// A mind that has learned nothing yet, and expects what real people do. `ways` says whether commands may mean tasks with a way.
pub fn new_mind(capacities: &Capacities, ways: bool) -> Result<Agent<AgentHeap>, Refusal> {
    let paper = home::paper_tasks().map_err(refused)?;
    let lifted = if ways { home::with_routes(&paper).map_err(refused)?.to_vec() } else { paper.to_vec() };
    let mut mind = Agent::new(AgentHeap::new(capacities), &lifted, Options::DEFAULT.for_people()).map_err(refused)?;
    mind.set_strategies(&population::STRATEGIES).map_err(refused)?;
    Ok(mind)
}

/// The home of an environment, and where everything is in it.
pub fn build(file: &EnvironmentFile) -> Result<(Home<HomeHeap>, HomeState), Refusal> {
    homes::build(file, Moves::Push, homes::memory()).map_err(|flaw| Refusal(flaw.message(file)))
}
