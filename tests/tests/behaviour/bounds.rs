//! Where the joint states do not fit the memory, two bounds on the distance that agree make a plan exact. Brute force says the same.

use goodbot::home::{self, Cell, Home, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, ActionKind, Domain, apply};
use goodbot::planning::{Judgement, OptimalSet, Plan};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::sweep::Sweep;
use rand_pcg::Pcg32;

/// What the plans say of tasks whose goals do not hold.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    sets: u32,
    exact: u32,
    dead: u32,
    /// Judgements of one action for one task, and those that are certain.
    judgements: u32,
    certain: u32,
}

impl Seen {
    fn take(&mut self, found: OptimalSet) {
        self.sets += u32::from(found != OptimalSet::Goal);
        self.exact += u32::from(matches!(found, OptimalSet::Toward(_)));
        self.dead += u32::from(matches!(found, OptimalSet::DeadEnd(_)));
    }

    /// Counts the judgements of each action for a task.
    fn judge(&mut self, plan: &Plan<'_>, task: usize, actions: &[ActionKind<'_>]) {
        let actions = (0..actions.len()).map(|action| Action::new(action as u8));
        let judged = actions.chain([Action::NOOP]).map(|action| plan.judge(task, action));
        let (certain, open): (Vec<_>, Vec<_>) = judged.partition(|&judgement| judgement != Judgement::Unknown);
        self.judgements += (certain.len() + open.len()) as u32;
        self.certain += certain.len() as u32;
    }

    /// The share of sets that are known exactly.
    fn share(&self) -> f64 {
        f64::from(self.exact + self.dead) / f64::from(self.sets)
    }
}

/// The same home with all things on random cells, in doorways too.
fn scattered<M: HomeMemory>(random: &mut Pcg32, home: &Home<M>, state: &HomeState) -> HomeState {
    let cells: Vec<Cell> = home.places().iter().map(|place| place.cell()).collect();
    let things: Vec<_> = std::iter::once(home.agent()).chain(home.blocks().iter().copied()).collect();
    loop {
        let anywhere = |&thing| (thing, cells[below(random, cells.len() as i32) as usize]);
        if let Some(placed) = home.placed(state, &things.iter().map(anywhere).collect::<Vec<_>>()) {
            return placed;
        }
    }
}

/// Compares the plans of a random walk with those of brute force.
fn compare(seed: u64, size: Size, moves: Moves, states: usize, seen: &mut Seen) {
    let mut random = Pcg32::new(seed, 9);
    let capacities = Capacities { states, hashed_states: 0, ..Capacities::STANDARD };
    let mut memory = HeapMemory::new(&capacities);
    let (home, start) = random_home(&mut random, size, moves, &mut memory.home);
    let mut state = scattered(&mut random, &home, &start);
    let [agent, block] = home::paper_tasks().unwrap();
    let parse = |text| LiftedTask::parse(text, &home::SCHEMA).unwrap();
    let with_agent = parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)");
    let two_blocks = parse("blockInRoom(?o1, ?r1) & blockInRoom(?o2, ?r2)");
    let lifted = if size.columns * size.rows == 2 { vec![agent, block, with_agent, two_blocks] } else { vec![agent, block] };
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &state, &mut tasks).unwrap();
    let sweep = Sweep::new(&home, &state, &lifted, &tasks[..count]);
    let mut planner = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
    for step in 0..30 {
        let plan = planner.plan_for(&home, &state, TaskSet::first(count), [1, 17, u32::MAX][step % 3]);
        let reachable = sweep.reachable(&home, &state);
        for task in 0..count {
            let found = plan.optimal(task);
            match found {
                OptimalSet::DeadEnd(_) => assert!(!reachable.contains(task), "a goal of {task} can be reached from {state:?}"),
                OptimalSet::Toward(_) => {
                    let exact = (OptimalSet::Toward(sweep.toward(&home, &state, task)), sweep.distance(&home, &state, task));
                    assert_eq!((found, plan.distance(task)), exact, "task {task} in {state:?}, seed {seed}");
                }
                OptimalSet::Goal | OptimalSet::Approximate(_) | OptimalSet::Unknown => {}
            }
            seen.take(found);
        }
        let action = Action::new(below(&mut random, home.actions().len() as i32) as u8);
        state = apply(&home, &state, action).unwrap_or(state);
    }
}

#[test]
fn no_judgement_by_bounds_is_wrong_in_random_homes_with_blocks_anywhere() {
    for (columns, rows, side, blocks, states) in [(2, 1, 3, 2, 1_024), (2, 1, 3, 3, 1_024), (2, 2, 2, 3, 1_024), (3, 1, 2, 3, 512)] {
        for moves in [Moves::Push, Moves::PushAndPull] {
            let mut seen = Seen::default();
            (0..12).for_each(|seed| compare(seed, Size { columns, rows, side, blocks }, moves, states, &mut seen));
            println!("{columns} x {rows} rooms of side {side}, {blocks} blocks, {moves:?}: {seen:?}");
            assert!(seen.exact > 100 && seen.share() > 0.5, "{seen:?}");
        }
    }
}

/// Plans in walks through homes whose joint states do not fit the memory.
fn plan_in(homes: u64, size: Size, states: usize) -> Seen {
    let mut seen = Seen::default();
    for seed in 0..homes {
        let mut random = Pcg32::new(seed, 2);
        let capacities = Capacities { states, hashed_states: 0, ..Capacities::STANDARD };
        let mut memory = HeapMemory::new(&capacities);
        let (home, mut state) = random_home(&mut random, size, Moves::Push, &mut memory.home);
        let lifted = home::paper_tasks().unwrap();
        let mut tasks = [GroundedTask::UNUSED; TaskSet::MOST];
        let count = ground(&home, &lifted, &state, &mut tasks).unwrap();
        let mut planner = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
        for _ in 0..10 {
            // Of more tasks than one word tells apart, ten are likely.
            let drawn = if count > TaskSet::MOST_OF_ONE_WORD { 10 } else { 0 };
            let likely: TaskSet = (0..drawn).map(|_| below(&mut random, count as i32) as usize).collect();
            let likely = if drawn == 0 { TaskSet::first(count) } else { likely };
            let plan = planner.plan_expecting(&home, &state, likely);
            for task in likely.iter() {
                seen.take(plan.optimal(task));
                seen.judge(&plan, task, home.actions());
            }
            state = apply(&home, &state, Action::new(below(&mut random, 4) as u8)).unwrap();
        }
    }
    seen
}

#[test]
fn most_sets_are_exact_in_homes_whose_joint_states_do_not_fit() {
    for (columns, rows, side, blocks, states, homes, least) in [
        (2, 2, 4, 1, 2_048, 12, 0.9),
        (2, 2, 4, 2, 16_384, 12, 0.9),
        (2, 2, 4, 4, 16_384, 12, 0.9),
        (2, 2, 4, 8, 16_384, 12, 0.9),
        (4, 2, 4, 7, 1 << 20, 6, 0.9),
        (5, 2, 4, 5, 1 << 20, 6, 0.95),
        // More states than can be numbered.
        (3, 3, 4, 8, 1 << 20, 6, 0.9),
        (5, 2, 4, 10, 1 << 20, 6, 0.85),
        (5, 2, 4, 20, 1 << 20, 6, 0.85),
    ] {
        let seen = plan_in(homes, Size { columns, rows, side, blocks }, states);
        let without_dead_ends = f64::from(seen.exact) / f64::from(seen.sets - seen.dead);
        println!(
            "{columns} x {rows} rooms of side {side}, {blocks} blocks, room for {states} states: {seen:?}, {:.1} % exact, {:.1} % of those that are no dead ends, {:.1} % of the judgements are certain",
            100.0 * seen.share(),
            100.0 * without_dead_ends,
            100.0 * f64::from(seen.certain) / f64::from(seen.judgements)
        );
        assert!(seen.share() >= least, "{seen:?}");
    }
}
