//! Environments: any bytes.

use super::assert_sound;
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves, paper_tasks};
use goodbot::memory::HomeMemory;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};

/// Homes up to this size are planned.
const CAPACITIES: Capacities = Capacities { hashed_states: 1_024, ..Capacities::SMALL };

/// Reads any bytes as an environment. An environment that can be read is written and read again; in a home that can be built, a robot
/// hears, plans and decides.
pub fn environment(input: &[u8]) {
    let Ok(text) = std::str::from_utf8(input) else { return };
    let Ok(file) = EnvironmentFile::parse(text) else { return };
    assert_eq!(EnvironmentFile::parse(&file.to_json_line()), Ok(file.clone()));
    for moves in [Moves::Push, Moves::PushAndPull] {
        let mut memory = HeapMemory::new(&CAPACITIES);
        let Some((home, state)) = home(&file, moves, &mut memory.home) else { continue };
        let mut agent = Agent::new(&mut memory.agent, &paper_tasks().expect("the paper's tasks"), Options::PAPER).expect("two tasks fit");
        if agent.hear(&home, &state, "go to the red room").is_ok() {
            agent.plan_fully(&home, &state).expect("a session is under way");
            agent.decide(&home, &state).expect("the plan is done");
            assert_sound(&agent);
        }
    }
}

/// The home of an environment.
fn home<M: HomeMemory>(file: &EnvironmentFile, moves: Moves, memory: M) -> Option<(Home<M>, HomeState)> {
    let mut builder = HomeBuilder::new(memory);
    for object in &file.objects {
        match object {
            ObjectRecord::Room { name, left, bottom, right, top, color } => {
                builder.room(name, Area::new(*left, *bottom, *right, *top), color).ok()?;
            }
            ObjectRecord::Door { name, left, bottom, right, top } => {
                builder.door(name, Area::new(*left, *bottom, *right, *top)).ok()?;
            }
            ObjectRecord::Block { name, x, y, color, shape } => {
                builder.block(name, Cell::new(*x, *y), color, shape).ok()?;
            }
            ObjectRecord::Agent { name, x, y } => {
                builder.agent(name, Cell::new(*x, *y)).ok()?;
            }
        }
    }
    builder.build(moves).ok()
}
