//! Compares plans by bounds, in memory too small for the joint states, with exact search over all of them.

use super::Bytes;
use crate::own_planner::OwnPlanner;
use crate::random_homes::{Size, below, random_home};
use crate::sweep::Sweep;
use goodbot::home::{self, Cell, Home, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, ActionKind, Domain, apply};
use goodbot::planning::{Judgement, OptimalSet, Plan};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use rand_pcg::Pcg32;

/// Homes, each with a memory too small for its joint states, which are still swept in milliseconds.
const TIGHT: [(Size, usize); 4] = [
    (Size { columns: 2, rows: 1, side: 2, blocks: 2 }, 128),
    (Size { columns: 2, rows: 1, side: 2, blocks: 3 }, 512),
    (Size { columns: 3, rows: 1, side: 2, blocks: 2 }, 512),
    (Size { columns: 2, rows: 1, side: 3, blocks: 2 }, 1_024),
];

/// Counts of the plans for tasks whose goals do not hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// All optimal sets.
    pub sets: u32,
    /// Sets with all first actions of the shortest plans.
    pub exact: u32,
    /// Sets of dead ends.
    pub dead: u32,
    /// Judgements of one action for one task.
    pub judgements: u32,
    /// Judgements that are right or wrong for certain.
    pub certain: u32,
}

impl Seen {
    /// Counts an optimal set.
    pub fn take(&mut self, found: OptimalSet) {
        self.sets += u32::from(found != OptimalSet::Goal);
        self.exact += u32::from(matches!(found, OptimalSet::Toward(_)));
        self.dead += u32::from(matches!(found, OptimalSet::DeadEnd(_)));
    }

    /// Counts the judgements of each action for a task.
    pub fn judge(&mut self, plan: &Plan<'_>, task: usize, actions: &[ActionKind<'_>]) {
        let actions = (0..actions.len()).map(|action| Action::new(action as u8));
        for action in actions.chain([Action::NOOP]) {
            self.judgements += 1;
            self.certain += u32::from(plan.judge(task, action) != Judgement::Unknown);
        }
    }

    /// The share of sets that are known exactly.
    pub fn share(&self) -> f64 {
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

/// Compares the plans of a random walk of `steps` steps with those of exact search.
pub fn compare(seed: u64, (size, states): (Size, usize), moves: Moves, steps: usize, seen: &mut Seen) {
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
    for step in 0..steps {
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

/// Tests a home and a walk that the bytes choose.
pub fn bounds(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let (tight, moves) = (choices.one_of(&TIGHT), choices.one_of(&[Moves::Push, Moves::PushAndPull]));
    let seed = u64::from_le_bytes([(); 8].map(|()| choices.byte()));
    compare(seed, tight, moves, 1 + choices.below(6), &mut Seen::default());
}
