//! The same plans, found by the crate pathfinding.

use crate::homes::Scene;
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, CellId, Domain, Piece, PushGrid};
use goodbot::task::GroundedTask;
use goodbot_tests::random_homes::Size;
use pathfinding::directed::astar::astar;
use pathfinding::directed::dijkstra::dijkstra;

/// The homes in which searches are compared: three rooms and two blocks.
pub const HOMES: Size = Size { columns: 3, rows: 1, side: 4, blocks: 2 };

/// The states that the actions lead to.
fn next(scene: &Scene, state: &HomeState) -> Vec<(HomeState, u32)> {
    (0..4).filter_map(|action| Some((scene.home.step(state, Action::new(action))?, 1))).collect()
}

/// Whether a task is done in a state.
fn is_done(scene: &Scene, task: &GroundedTask, state: &HomeState) -> bool {
    task.propositions(&scene.lifted[usize::from(task.lifted)]).all(|part| scene.home.holds(&part, state))
}

/// The distance of each task, found by its own search with the crate pathfinding, as a user of that crate would write it.
pub fn one_dijkstra_a_task(scene: &Scene) -> Vec<Option<u32>> {
    let distance = |task| dijkstra(&scene.start, |state| next(scene, state), |state| is_done(scene, task, state)).map(|(_, cost)| cost);
    scene.tasks.iter().map(distance).collect()
}

/// The same by A*. The heuristic counts cells as if there were no walls: from the task's piece to the nearest cell of its goal, and, for a block
/// that is not there yet, from the agent to a cell beside it.
pub fn one_a_star_a_task(scene: &Scene) -> Vec<Option<u32>> {
    let (home, cells) = (&scene.home, scene.home.floor().cells);
    let apart = |one: CellId, other: CellId| {
        let (one, other) = (cells[one.index()], cells[other.index()]);
        u32::from(one.x.abs_diff(other.x)) + u32::from(one.y.abs_diff(other.y))
    };
    let distance = |task: &GroundedTask| {
        let lifted = &scene.lifted[usize::from(task.lifted)];
        let piece = task.propositions(lifted).find_map(|part| home.piece_of(&part)).expect("a task of one piece");
        let all = (0..cells.len()).map(|cell| CellId::new(cell as u16));
        let goals: Vec<CellId> = all.filter(|&cell| is_done(scene, task, &home.put(&scene.start, piece, cell))).collect();
        let heuristic = |state: &HomeState| {
            let cell = home.cell(state, piece);
            let left = goals.iter().map(|&goal| apart(cell, goal)).min().unwrap_or(0);
            let before = if left == 0 { 0 } else { apart(home.cell(state, Piece::ROBOT), cell).saturating_sub(1) };
            left + before
        };
        astar(&scene.start, |state| next(scene, state), heuristic, |state| is_done(scene, task, state)).map(|(_, cost)| cost)
    };
    scene.tasks.iter().map(distance).collect()
}
