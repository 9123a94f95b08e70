//! Trains a language model in the home environment and uses it, unchanged, in a robot that turns and drives.
//!
//! `cargo run --example turning_robot --features alloc -p goodbot`

mod domain;

use domain::{TurningRobot, TurningState};
use goodbot::feedback::Feedback;
use goodbot::home::Map;
use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeError, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain, action_name};
use goodbot::session::Evidence;
use goodbot::{Agent, Capacities, HeapMemory, Options};

fn rooms<M: HomeMemory>(memory: M, colors: [&str; 3]) -> Result<(Home<M>, HomeState), HomeError> {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), colors[0])?;
    builder.room("room1", Area::new(0, 4, 4, 8), colors[1])?;
    builder.room("room2", Area::new(4, 4, 8, 8), colors[2])?;
    builder.door("door0", Area::new(2, 4, 2, 4))?;
    builder.door("door1", Area::new(6, 4, 6, 4))?;
    builder.agent("agent0", Cell::new(4, 2))?;
    builder.build(Moves::Push)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;

    for (color, room) in [("green", "room1"), ("red", "room2")] {
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let (home, mut state) = rooms(&mut memory.home, ["blue", "green", "red"])?;
        agent.hear(&home, &state, &format!("go to the {color} room"))?;
        for _ in 0..8 {
            agent.plan_fully(&home, &state)?;
            let decision = agent.decide(&home, &state)?;
            let goal = agent.tasks()[decision.task];
            let right = home.world().objects.name(goal.bindings[1]) == room;
            state = agent.acted(&home, &state, decision.action)?;
            assert_eq!(agent.feedback(if right { Feedback::Reward } else { Feedback::Punish })?, Evidence::Used);
        }
        assert_eq!(agent.finish(&home)?.gave_way.count(), 0);
        agent.learn_fully();
    }

    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, start) = rooms(&mut memory.home, ["green", "blue", "red"])?;
    let robot = TurningRobot { home };
    let mut state = TurningState { home: start, heading: 0 };
    println!("{}", Map::new(&robot.home, &state.home));
    agent.hear(&robot, &state, "go to the red room")?;
    loop {
        agent.plan_fully(&robot, &state)?;
        let decision = agent.decide(&robot, &state)?;
        if decision.action == Action::NOOP {
            break;
        }
        print!("{} ", action_name(&robot, decision.action));
        state = agent.acted(&robot, &state, decision.action)?;
    }
    println!("\n\n{}", Map::new(&robot.home, &state.home));
    Ok(())
}
