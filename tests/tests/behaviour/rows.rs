//! The search that expands whole rows of states finds the same plans as the search that expands single states.

use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::{OptimalSet, Progress};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::without_grid::WithoutGrid;

use rand_pcg::Pcg32;

const ROOMY: Capacities = Capacities { states: 1 << 20, hashed_states: 0, ..Capacities::STANDARD };

#[derive(Debug, Default)]
struct Seen {
    goals: usize,
    ways: usize,
    dead_ends: usize,
    fewer_expansions: usize,
}

/// Compares both in the states of a random walk.
fn compare(random: &mut Pcg32, size: Size, moves: Moves, budget: u32, goal_entries: usize, seen: &mut Seen) {
    let capacities = Capacities { goal_entries, ..ROOMY };
    let mut memory = HeapMemory::new(&ROOMY);
    let (home, start) = random_home(random, size, moves, &mut memory.home);
    let pairs = LiftedTask::parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)", &home::SCHEMA).unwrap();
    let [agent, block] = home::paper_tasks().unwrap();
    let lifted = [agent, block, pairs];
    let mut tasks = [GroundedTask::UNUSED; 64];
    let kinds = if size.columns * size.rows * size.blocks > 8 { 2 } else { 3 };
    let count = ground(&home, &lifted[..kinds], &start, &mut tasks).unwrap();
    let one_by_one = WithoutGrid { domain: &home };
    let mut rows = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
    let mut states = OwnPlanner::new(&ROOMY, &one_by_one, &lifted, &tasks[..count]);
    let mut state = start;
    for step in 0..8 {
        let wanted = if step == 3 { TaskSet::of(count / 2) } else { TaskSet::first(count) };
        let rows = rows.plan_for(&home, &state, wanted, budget);
        let states = states.plan_for(&one_by_one, &state, wanted, u32::MAX);
        assert!(rows.approximate().is_empty());
        for task in 0..count {
            assert_eq!(rows.optimal(task), states.optimal(task), "{size:?} {moves:?}, step {step}, task {task}");
            assert_eq!(rows.distance(task), states.distance(task));
            match rows.optimal(task) {
                OptimalSet::Goal => seen.goals += 1,
                OptimalSet::Toward(_) => seen.ways += 1,
                OptimalSet::DeadEnd(_) => seen.dead_ends += 1,
                OptimalSet::Approximate(_) | OptimalSet::Unknown => assert!(!wanted.contains(task)),
            }
        }
        seen.fewer_expansions += usize::from(rows.expansions() < states.expansions());
        for _ in 0..5 {
            let action = Action::new(below(random, home.actions().len() as i32) as u8);
            state = apply(&home, &state, action).unwrap_or(state);
        }
    }
}

#[test]
fn rows_and_states_one_by_one_give_equal_sets_and_distances_in_random_homes() {
    let mut random = Pcg32::new(11, 11);
    let mut seen = Seen::default();
    let sizes = [
        Size { columns: 1, rows: 1, side: 4, blocks: 1 },
        Size { columns: 3, rows: 1, side: 3, blocks: 0 },
        Size { columns: 2, rows: 2, side: 3, blocks: 1 },
        // 71, 95 and 167 bits per row.
        Size { columns: 2, rows: 2, side: 4, blocks: 2 },
        Size { columns: 3, rows: 2, side: 3, blocks: 2 },
        Size { columns: 6, rows: 2, side: 3, blocks: 1 },
        // A line of rooms without ways north or south, and one that is wider than a word.
        Size { columns: 8, rows: 1, side: 1, blocks: 2 },
        Size { columns: 15, rows: 1, side: 4, blocks: 1 },
    ];
    for size in sizes {
        for (moves, budget, goal_entries) in [(Moves::Push, u32::MAX, 8_192), (Moves::PushAndPull, 1, 8_192), (Moves::Push, 3, 0)] {
            compare(&mut random, size, moves, budget, goal_entries, &mut seen);
        }
    }
    assert!(seen.goals > 30 && seen.ways > 500 && seen.dead_ends > 100 && seen.fewer_expansions > 100, "{seen:?}");
}

/// Plans, with a budget of 50, how the robot goes from one room of a home to the other. Returns the distance, the expansions, the calls,
/// the words of a row and the cells of the home.
fn go_to_the_other_room(areas: [Area; 2], door: Cell) -> [u32; 5] {
    let mut memory = HeapMemory::new(&Capacities { cells: 4_096, ..ROOMY });
    let mut builder = HomeBuilder::new(&mut memory.home);
    builder.room("room0", areas[0], "red").unwrap();
    builder.room("room1", areas[1], "green").unwrap();
    builder.door("door0", Area::new(door.x, door.y, door.x, door.y)).unwrap();
    builder.agent("agent0", Cell::new(areas[0].left + 1, areas[0].bottom + 1)).unwrap();
    let (home, start) = builder.build(Moves::Push).unwrap();
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let capacities = Capacities { states: 1 << 16, ..ROOMY };
    let mut planner = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
    planner.begin(TaskSet::first(count));
    let mut calls = 1;
    while planner.advance(&home, &start, 50) == Progress::Working {
        calls += 1;
    }
    let plan = planner.plan();
    let distance = (0..count).filter_map(|task| plan.distance(task)).max().unwrap();
    let box_of = |one: Area, other: Area| {
        // Without the outer walls; one extra bit separates two lines.
        let width = one.right.max(other.right) - one.left.min(other.left);
        (width * (one.top.max(other.top) - one.bottom.min(other.bottom) - 1) - 1) as u32
    };
    [distance, plan.expansions(), calls, box_of(areas[0], areas[1]).div_ceil(64), home.places().len() as u32]
}

#[test]
fn a_row_takes_as_many_expansions_as_it_has_words_so_that_a_budget_bounds_the_time_of_a_call() {
    let [distance, expansions, calls, words, _] =
        go_to_the_other_room([Area::new(-200, 0, 0, 5), Area::new(0, 0, 200, 5)], Cell::new(0, 2));
    assert!(words > 20 && distance > 190);
    // One row per distance.
    assert_eq!(expansions, words * distance);
    assert!(calls >= expansions / (50 + words), "{calls} calls");
}

#[test]
fn where_few_cells_of_the_box_are_places_states_are_expanded_one_by_one() {
    // Two corridors: one leads east, the other north from its end.
    let [distance, expansions, _, words, places] =
        go_to_the_other_room([Area::new(0, 0, 202, 2), Area::new(200, 2, 202, 204)], Cell::new(201, 2));
    assert!(words > 600 && distance > 200);
    assert!(expansions <= places, "{expansions} expansions of {places} places");
}
