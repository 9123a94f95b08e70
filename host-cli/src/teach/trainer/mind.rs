//! The robot's mind and its home, each made anew when it is replaced during a visit.

use super::{Refusal, refused};
use goodbot::feedback::population;
use goodbot::home::{self, Home, HomeState, Moves};
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::{Agent, Capacities, Options};
use goodbot_console::believes::Believes;
use goodbot_console::learner::{self, Learner};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home as homes;

/// A mind that has learned nothing yet. `ways` says whether commands may mean tasks with a way, and `believes` what it expects of its trainer,
/// where that is not what real people do. `tasks` is how many possible tasks it keeps of all sessions together.
pub fn new_mind(capacities: &Capacities, tasks: usize, ways: bool, believes: Option<&Believes>) -> Result<Agent<AgentHeap>, Refusal> {
    let paper = home::paper_tasks().map_err(refused)?;
    let lifted = if ways { home::with_routes(&paper).map_err(refused)?.to_vec() } else { paper.to_vec() };
    let options = Learner::Default.options();
    let mut mind = Agent::new(learner::memory(capacities, &options.language, tasks), &lifted, options).map_err(refused)?;
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

/// The home of an environment, and where everything is in it.
pub fn build(file: &EnvironmentFile) -> Result<(Home<HomeHeap>, HomeState), Refusal> {
    homes::build(file, Moves::Push, homes::memory()).map_err(|flaw| Refusal(flaw.message(file)))
}
