//! The same plans, found by the crate pathfinding.

use crate::homes::Scene;
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, Domain};
use goodbot::task::GroundedTask;
use goodbot_tests::random_homes::Size;
use pathfinding::directed::dijkstra::dijkstra;

/// The homes in which searches are compared: three rooms and two blocks.
pub const HOMES: Size = Size { columns: 3, rows: 1, side: 4, blocks: 2 };

/// The distance of each task, found by its own search with the crate pathfinding, as a user of that crate would write it.
pub fn one_dijkstra_a_task(scene: &Scene) -> Vec<Option<u32>> {
    let next = |state: &HomeState| -> Vec<(HomeState, u32)> {
        (0..4).filter_map(|action| Some((scene.home.step(state, Action::new(action))?, 1))).collect()
    };
    let distance = |task: &GroundedTask| {
        let lifted = &scene.lifted[usize::from(task.lifted)];
        let goal = |state: &HomeState| task.propositions(lifted).all(|part| scene.home.holds(&part, state));
        dijkstra(&scene.start, next, goal).map(|(_, cost)| cost)
    };
    scene.tasks.iter().map(distance).collect()
}
