//! The robot's mind and its home, each in memory of its own, so that both can be replaced during a visit.

use super::{Refusal, refused};
use crate::load::home as homes;
use goodbot::home::{self, Home, HomeState, Moves};
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_formats::environment::EnvironmentFile;
use self_cell::{MutBorrow, self_cell};

self_cell! {
    /// The robot's mind in its own memory.
    pub struct Mind {
        owner: MutBorrow<HeapMemory>,
        #[covariant]
        dependent: Agent,
    }
}

self_cell! {
    /// A home in its own memory.
    pub struct Rooms {
        owner: MutBorrow<HeapMemory>,
        #[covariant]
        dependent: Home,
    }
}

/// A mind that has learned nothing yet.
pub fn new_mind(capacities: &Capacities) -> Result<Mind, Refusal> {
    let lifted = home::paper_tasks().map_err(refused)?;
    let memory = MutBorrow::new(HeapMemory::new(capacities));
    Mind::try_new(memory, |memory| Agent::new(memory.borrow_mut().split().agent, &lifted, Options::DEFAULT)).map_err(refused)
}

/// The home of an environment, and where everything is in it.
pub fn build(file: &EnvironmentFile) -> Result<(Rooms, HomeState), Refusal> {
    let mut start = None;
    let rooms = Rooms::try_new(MutBorrow::new(homes::memory()), |memory| {
        let (home, state) =
            homes::build(file, Moves::Push, memory.borrow_mut().split().home).map_err(|flaw| Refusal(flaw.message(file)))?;
        start = Some(state);
        Ok::<_, Refusal>(home)
    })?;
    start.map(|start| (rooms, start)).ok_or_else(|| Refusal("the home has no start".to_owned()))
}
