//! The home of three storeys in which plans with path constraints are measured, with every task of one clause.

use crate::homes::Scene;
use goodbot::Capacities;
use goodbot::home::{AGENT_IN_ROOM, Area, Cell, HomeBuilder, HomeState, Moves, SCHEMA, with_routes};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::Plan;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, Way, WayState, ground};
use goodbot_tests::own_planner::OwnPlanner;
use pathfinding::directed::dijkstra::dijkstra;

const MEMORY: Capacities = Capacities { states: 4_096, hashed_states: 0, ..Capacities::STANDARD };

/// The home: the robot in the lowest room, three rooms above it, one on top. The 50 tasks: to go to each room, through one, through one
/// of two, avoiding one; and to return to the robot's room, through one or one of two.
pub fn three_storeys() -> Scene {
    let mut builder = HomeBuilder::new(HomeHeap::new(&MEMORY));
    let rooms = [
        (Area::new(0, 8, 12, 12), "green"),
        (Area::new(0, 4, 4, 8), "blue"),
        (Area::new(4, 4, 8, 8), "red"),
        (Area::new(8, 4, 12, 8), "yellow"),
        (Area::new(0, 0, 12, 4), "pink"),
    ];
    for (number, (area, color)) in rooms.into_iter().enumerate() {
        builder.room(&format!("room{number}"), area, color).expect("a room");
    }
    for (number, (x, y)) in [(2, 4), (6, 4), (10, 4), (2, 8), (6, 8), (10, 8)].into_iter().enumerate() {
        builder.door(&format!("door{number}"), Area::new(x, y, x, y)).expect("a door");
    }
    builder.agent("agent0", Cell::new(6, 2)).expect("a robot");
    let (home, start) = builder.build(Moves::Push).expect("a home");
    let lifted = with_routes(&[LiftedTask::single(AGENT_IN_ROOM, &SCHEMA).expect("a task")]).expect("four kinds").to_vec();
    let mut tasks = vec![GroundedTask::UNUSED; TaskSet::MOST];
    let count = ground(&home, &lifted, &start, &mut tasks).expect("room for the tasks");
    tasks.truncate(count);
    let planner = OwnPlanner::new(&MEMORY, &home, &lifted, &tasks);
    Scene { home, start, lifted, tasks, planner }
}

/// Plans for all tasks from the start.
pub fn plan(scene: &mut Scene) -> Plan<'_> {
    scene.planner.plan_for_ways(&scene.home, &scene.start, &scene.lifted, &scene.tasks, u32::MAX)
}

/// The distance of each task, found by its own search in the product of the home and the task's way with the crate pathfinding.
pub fn one_dijkstra_a_task(scene: &Scene) -> Vec<Option<u32>> {
    let home = &scene.home;
    let distance = |task: &GroundedTask| {
        let lifted = &scene.lifted[usize::from(task.lifted)];
        let way = Way::of(task, lifted);
        let next = |(state, past): &(HomeState, WayState)| -> Vec<((HomeState, WayState), u32)> {
            if way.is_violated(|part| home.holds(part, state)) {
                return vec![];
            }
            let after = |state: HomeState| ((state, way.pass(*past, |part| home.holds(part, &state))), 1);
            (0..4).filter_map(|action| home.step(state, Action::new(action)).map(after)).collect()
        };
        let goal = |(state, past): &(HomeState, WayState)| {
            way.leads_to_goal(*past) && task.propositions(lifted).all(|part| home.holds(&part, state))
        };
        dijkstra(&(scene.start, WayState::START), next, goal).map(|(_, cost)| cost)
    };
    scene.tasks.iter().map(distance).collect()
}
