//! The search that looks at whole rows of states finds what the search finds that looks at them one by one.

use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::{GoalTable, OptimalSet, Planner, Progress, Search};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::without_grid::WithoutGrid;

use rand_pcg::Pcg32;

const ROOMY: Capacities = Capacities { states: 1 << 20, hashed_states: 0, ..Capacities::STANDARD };

#[derive(Debug, Default)]
struct Seen {
    goals: usize,
    ways: usize,
    dead_ends: usize,
    fewer_looks: usize,
}

/// Compares both in the states of a random walk.
fn compare(random: &mut Pcg32, size: Size, moves: Moves, budget: u32, goal_entries: usize, seen: &mut Seen) {
    let mut memory = HeapMemory::new(&Capacities { goal_entries, ..ROOMY });
    let mut other = HeapMemory::new(&ROOMY);
    let (parts, other) = (memory.split(), other.split());
    let (home, start) = random_home(random, size, moves, parts.home);
    let pairs = LiftedTask::parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)", &home::SCHEMA).unwrap();
    let [agent, block] = home::paper_tasks().unwrap();
    let lifted = [agent, block, pairs];
    let mut tasks = [GroundedTask::UNUSED; 64];
    let kinds = if size.columns * size.rows * size.blocks > 8 { 2 } else { 3 };
    let count = ground(&home, &lifted[..kinds], &start, &mut tasks).unwrap();
    let mut goals = GoalTable::new(parts.agent.session.goals);
    goals.fill(&home, &lifted, &tasks[..count], &start).unwrap();
    let mut other_goals = GoalTable::new(other.agent.session.goals);
    let one_by_one = WithoutGrid { domain: &home, with_variables: false };
    other_goals.fill(&one_by_one, &lifted, &tasks[..count], &start).unwrap();
    let (mut rows, mut states) = (
        Search::new(parts.agent.session.plan, parts.agent.language.tables.counts),
        Search::new(other.agent.session.plan, other.agent.language.tables.counts),
    );
    let mut state = start;
    for step in 0..8 {
        let wanted = if step == 3 { TaskSet::of(count / 2) } else { TaskSet::first(count) };
        rows.begin(&home, &goals, &state, wanted, TaskSet::EMPTY);
        while rows.advance(&home, &goals, budget) == Progress::Working {}
        states.begin(&one_by_one, &other_goals, &state, wanted, TaskSet::EMPTY);
        while states.advance(&one_by_one, &other_goals, u32::MAX) == Progress::Working {}
        for task in 0..count {
            assert_eq!(rows.optimal(task), states.optimal(task), "{size:?} {moves:?}, step {step}, task {task}");
            assert_eq!(rows.distance(task), states.distance(task));
            match rows.optimal(task) {
                OptimalSet::Goal => seen.goals += 1,
                OptimalSet::Toward(_) => seen.ways += 1,
                OptimalSet::DeadEnd(_) => seen.dead_ends += 1,
                OptimalSet::Unknown => assert!(!wanted.contains(task)),
            }
        }
        seen.fewer_looks += usize::from(rows.looks() < states.looks());
        for _ in 0..5 {
            let action = Action(below(random, home.actions().len() as i32) as u8);
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
        // 71, 95 and 167 bits a row.
        Size { columns: 2, rows: 2, side: 4, blocks: 2 },
        Size { columns: 3, rows: 2, side: 3, blocks: 2 },
        Size { columns: 6, rows: 2, side: 3, blocks: 1 },
        // A line of rooms in which north and south lead nowhere, and one that is broader than a word.
        Size { columns: 8, rows: 1, side: 1, blocks: 2 },
        Size { columns: 15, rows: 1, side: 4, blocks: 1 },
    ];
    for size in sizes {
        for (moves, budget, goal_entries) in [(Moves::Push, u32::MAX, 8_192), (Moves::PushAndPull, 1, 8_192), (Moves::Push, 3, 0)] {
            compare(&mut random, size, moves, budget, goal_entries, &mut seen);
        }
    }
    assert!(seen.goals > 30 && seen.ways > 500 && seen.dead_ends > 100 && seen.fewer_looks > 100, "{seen:?}");
}

#[test]
fn rows_and_states_one_by_one_give_equal_sets_where_other_blocks_stand_still() {
    // Room for the agent and one block, not for two.
    let capacities = Capacities { states: 1 << 12, ..ROOMY };
    let mut random = Pcg32::new(12, 12);
    let (mut ways, mut fewer_looks) = (0, 0);
    for _ in 0..6 {
        let (mut memory, mut other) = (HeapMemory::new(&capacities), HeapMemory::new(&capacities));
        let (parts, other) = (memory.split(), other.split());
        let size = Size { columns: 3, rows: 1, side: 4, blocks: 2 };
        let (home, mut state) = random_home(&mut random, size, Moves::PushAndPull, parts.home);
        let without_grid = WithoutGrid { domain: &home, with_variables: true };
        let lifted = home::paper_tasks().unwrap();
        let mut tasks = [GroundedTask::UNUSED; 64];
        let count = ground(&home, &lifted, &state, &mut tasks).unwrap();
        let (mut goals, mut other_goals) = (GoalTable::new(parts.agent.session.goals), GoalTable::new(other.agent.session.goals));
        goals.fill(&home, &lifted, &tasks[..count], &state).unwrap();
        other_goals.fill(&without_grid, &lifted, &tasks[..count], &state).unwrap();
        let mut rows = Planner::new(parts.agent.session.plan, parts.agent.language.tables.counts);
        let mut states = Planner::new(other.agent.session.plan, other.agent.language.tables.counts);
        rows.forget(count);
        states.forget(count);
        for _ in 0..10 {
            rows.begin(&home, &goals, &state, TaskSet::first(count), TaskSet::EMPTY);
            while rows.advance(&home, &goals, &state, 10) == Progress::Working {}
            states.begin(&without_grid, &other_goals, &state, TaskSet::first(count), TaskSet::EMPTY);
            while states.advance(&without_grid, &other_goals, &state, u32::MAX) == Progress::Working {}
            assert_eq!(rows.search().relaxed(), states.search().relaxed());
            for task in 0..count {
                assert_eq!(rows.search().optimal(task), states.search().optimal(task), "task {task}");
                assert_eq!(rows.search().distance(task), states.search().distance(task));
                ways += usize::from(rows.search().relaxed().contains(task));
            }
            fewer_looks += usize::from(rows.search().looks() < states.search().looks());
            for _ in 0..5 {
                state = apply(&home, &state, Action(below(&mut random, 5) as u8)).unwrap_or(state);
            }
        }
    }
    assert!(ways > 200 && fewer_looks > 50, "{ways} {fewer_looks}");
}

/// Plans with a budget of 50 for the robot to go from one room of a home to the other. Gives the distance, the looks, the calls, and how
/// many words a row has and how many places the home.
fn go_to_the_other_room(areas: [Area; 2], door: Cell) -> [u32; 5] {
    let mut memory = HeapMemory::new(&Capacities { states: 1 << 16, cells: 4_096, ..ROOMY });
    let parts = memory.split();
    let mut builder = HomeBuilder::new(parts.home);
    builder.room("room0", areas[0], "red").unwrap();
    builder.room("room1", areas[1], "green").unwrap();
    builder.door("door0", Area::new(door.x, door.y, door.x, door.y)).unwrap();
    builder.agent("agent0", Cell::new(areas[0].left + 1, areas[0].bottom + 1)).unwrap();
    let (home, start) = builder.build(Moves::Push).unwrap();
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let mut goals = GoalTable::new(parts.agent.session.goals);
    goals.fill(&home, &lifted, &tasks[..count], &start).unwrap();
    let mut search = Search::new(parts.agent.session.plan, parts.agent.language.tables.counts);
    search.begin(&home, &goals, &start, TaskSet::first(count), TaskSet::EMPTY);
    let mut calls = 1;
    while search.advance(&home, &goals, 50) == Progress::Working {
        calls += 1;
    }
    let distance = (0..count).filter_map(|task| search.distance(task)).max().unwrap();
    [distance, search.looks(), calls, home.grid().unwrap().bits.div_ceil(64) as u32, home.values(0) as u32]
}

#[test]
fn a_row_takes_as_many_looks_as_it_has_words_so_that_a_budget_bounds_the_time_of_a_call() {
    let [distance, looks, calls, words, _] = go_to_the_other_room([Area::new(-200, 0, 0, 5), Area::new(0, 0, 200, 5)], Cell::new(0, 2));
    assert!(words > 20 && distance > 190);
    // One row, at each distance.
    assert_eq!(looks, words * distance);
    assert!(calls >= looks / (50 + words), "{calls} calls");
}

#[test]
fn where_few_cells_of_the_grid_are_places_states_are_looked_at_one_by_one() {
    // Two corridors, one to the east, one north from its end.
    let [distance, looks, _, words, places] =
        go_to_the_other_room([Area::new(0, 0, 202, 2), Area::new(200, 2, 202, 204)], Cell::new(201, 2));
    assert!(words > 600 && distance > 200);
    assert!(looks <= places, "{looks} looks at {places} places");
}
