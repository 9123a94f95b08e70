//! The interface between core and robot: another kind of robot in the same rooms understands by the first one's model.

use crate::turning_robot;

use goodbot::feedback::Feedback;
use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::{Judgement, OptimalSet};
use goodbot::session::Evidence;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use turning_robot::{TurningRobot, TurningState};

fn three_rooms<M: HomeMemory>(memory: M, colors: [&str; 3], block: Option<(&str, &str)>) -> (Home<M>, HomeState) {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), colors[0]).unwrap();
    builder.room("room1", Area::new(0, 4, 4, 8), colors[1]).unwrap();
    builder.room("room2", Area::new(4, 4, 8, 8), colors[2]).unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    if let Some((color, shape)) = block {
        builder.block("block0", Cell::new(4, 2), color, shape).unwrap();
    }
    builder.build(Moves::Push).unwrap()
}

/// Trains with a trainer who means the task that brings `subject` into `room`.
fn train(agent: &mut Agent<impl AgentMemory>, command: &str, colors: [&str; 3], block: Option<(&str, &str)>, subject: &str, room: &str) {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, mut state) = three_rooms(&mut memory.home, colors, block);
    agent.hear(&home, &state, command).unwrap();
    for _ in 0..30 {
        agent.plan_fully(&home, &state).unwrap();
        let decision = agent.decide(&home, &state).unwrap();
        let name = |object| home.world().objects.name(object);
        let intended = agent.tasks().iter().position(|task| name(task.bindings[0]) == subject && name(task.bindings[1]) == room).unwrap();
        let right = agent.planned().judge(intended, decision.action) == Judgement::Correct;
        state = agent.acted(&home, &state, decision.action).unwrap();
        assert_eq!(agent.feedback(if right { Feedback::Reward } else { Feedback::Punish }), Ok(Evidence::Used));
    }
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
}

#[test]
fn what_was_learned_in_the_home_is_understood_by_a_robot_that_turns() {
    for options in [Options::PAPER, Options::DEFAULT] {
        is_understood_by_a_robot_that_turns(options);
    }
}

fn is_understood_by_a_robot_that_turns(options: Options) {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), options).unwrap();
    train(&mut agent, "go to the green room", ["blue", "green", "red"], None, "agent0", "room1");
    train(&mut agent, "go to the red room", ["blue", "green", "red"], None, "agent0", "room2");
    train(&mut agent, "go to the blue room", ["red", "yellow", "blue"], None, "agent0", "room2");
    train(&mut agent, "take the blue chair to the green room", ["red", "green", "yellow"], Some(("blue", "chair")), "block0", "room1");
    train(&mut agent, "take the green bag to the red room", ["blue", "yellow", "red"], Some(("green", "bag")), "block0", "room2");

    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, start) = three_rooms(&mut memory.home, ["green", "blue", "red"], Some(("yellow", "bag")));
    let robot = TurningRobot { home };
    for (command, subject, room) in [
        ("go to the red room", "agent0", "room2"),
        ("go to the blue room", "agent0", "room1"),
        ("take the yellow bag to the red room", "block0", "room2"),
    ] {
        let mut state = TurningState { home: start, heading: 3 };
        agent.hear(&robot, &state, command).unwrap();
        let understood = agent.tasks()[agent.most_likely().unwrap()];
        assert_eq!(robot.world().objects.name(understood.bindings[0]), subject, "{command}");
        assert_eq!(robot.world().objects.name(understood.bindings[1]), room, "{command}");
        for _ in 0..100 {
            agent.plan_fully(&robot, &state).unwrap();
            let decision = agent.decide(&robot, &state).unwrap();
            if decision.plan == OptimalSet::Goal {
                break;
            }
            state = robot.step(&state, decision.action).unwrap();
        }
        agent.plan_fully(&robot, &state).unwrap();
        assert_eq!(agent.decide(&robot, &state).unwrap().plan, OptimalSet::Goal, "{command}");
    }
}

#[test]
fn the_cost_of_an_action_counts_in_the_plan() {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, start) = three_rooms(&mut memory.home, ["green", "blue", "red"], None);
    let robot = TurningRobot { home };
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
    let state = TurningState { home: start, heading: 0 };
    agent.hear(&robot, &state, "go").unwrap();
    agent.plan_fully(&robot, &state).unwrap();
    // From (4, 1) to (2, 5): four cells north and two west, 12 for driving. Facing north, some turns must be made on the way: west and
    // north again, 2.
    let blue = agent.tasks().iter().position(|task| robot.world().objects.name(task.bindings[1]) == "room1").unwrap();
    assert_eq!(agent.planned().distance(blue), Some(14));
    let OptimalSet::Toward(first) = agent.planned().optimal(blue) else { panic!("a way exists") };
    assert!(first.contains(Action::new(0)) && first.contains(Action::new(2)) && !first.contains(Action::new(1)));
}
