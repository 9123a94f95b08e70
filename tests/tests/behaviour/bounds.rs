//! Where the joint states do not fit into memory, a plan is exact if the two bounds on the distance agree. Brute force confirms it.

use goodbot::home::{self, Moves};
use goodbot::oomdp::{Action, ActionKind, BitRows, CellId, Domain, Floor, GroundProposition, Piece, PushGrid, StateKey, World, apply};
use goodbot::planning::Progress;
use goodbot::task::{GroundedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::hostile::{Seen, compare};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use rand_pcg::Pcg32;
use std::cell::Cell;

#[test]
fn no_judgement_by_bounds_is_wrong_in_random_homes_with_blocks_anywhere() {
    let tight = [(2, 1, 3, 2, 1_024), (2, 1, 3, 3, 1_024), (2, 2, 2, 3, 1_024), (3, 1, 2, 3, 512)];
    // With room for lower bounds of single tasks, which know pieces that are in the way.
    let roomy = [(2, 1, 3, 3, 8_192), (2, 2, 2, 3, 8_192), (3, 1, 2, 3, 4_096)];
    for (columns, rows, side, blocks, states) in tight.into_iter().chain(roomy) {
        let size = Size { columns, rows, side, blocks };
        for moves in [Moves::Push, Moves::PushAndPull] {
            let mut seen = Seen::default();
            (0..6).for_each(|seed| compare(seed, (size, states), moves, 30, &mut seen));
            println!("{size:?}, {moves:?}: {seen:?}");
            assert!(seen.exact > 50 && seen.share() > 0.5, "{seen:?}");
        }
    }
}

/// Plans during random walks through homes whose joint states do not fit into memory.
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
            // If the tasks exceed one word of a task set, only ten are likely.
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
        (4, 2, 4, 7, 1 << 20, 6, 0.97),
        (5, 2, 4, 5, 1 << 20, 6, 0.99),
        // More states than can be numbered.
        (3, 3, 4, 8, 1 << 20, 6, 0.9),
        (5, 2, 4, 10, 1 << 20, 6, 0.99),
        (5, 2, 4, 20, 1 << 20, 6, 0.95),
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

#[test]
fn likely_tasks_of_one_room_share_the_search_for_pieces_in_the_way() {
    let size = Size { columns: 5, rows: 2, side: 3, blocks: 20 };
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, state) = random_home(&mut Pcg32::new(1, 3), size, Moves::Push, &mut memory.home);
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; TaskSet::MOST];
    let count = ground(&home, &lifted, &state, &mut tasks).unwrap();
    let mut planner = OwnPlanner::new(&Capacities::STANDARD, &home, &lifted, &tasks[..count]);
    // Four of these ten tasks bring a block to the same room. Alone, each would take a lower bound of 43 thousand expansions.
    let likely: TaskSet = (0..count).step_by(count / 10).take(10).collect();
    let expansions = planner.plan_expecting(&home, &state, likely).expansions();
    assert!(expansions < 170_000, "{expansions}");
}

/// A floor that counts how often it is asked whether pieces can be swapped: once for each expansion, and once for each search of a task.
struct Asked<'d, D> {
    domain: &'d D,
    times: Cell<u32>,
}

impl<D: PushGrid> Domain for Asked<'_, D> {
    type State = D::State;
    type Search = BitRows;

    fn world(&self) -> World<'_> {
        self.domain.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.domain.actions()
    }

    fn step(&self, state: &D::State, action: Action) -> Option<D::State> {
        self.domain.step(state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &D::State) -> bool {
        self.domain.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.domain.state_count()
    }

    fn number(&self, state: &D::State) -> u64 {
        self.domain.number(state)
    }

    fn numbered(&self, number: u64) -> D::State {
        self.domain.numbered(number)
    }

    fn key(&self, state: &D::State) -> StateKey {
        self.domain.key(state)
    }

    fn keyed(&self, key: StateKey) -> D::State {
        self.domain.keyed(key)
    }
}

impl<D: PushGrid> PushGrid for Asked<'_, D> {
    fn is_numbered(&self) -> bool {
        self.domain.is_numbered()
    }

    fn floor(&self) -> Floor<'_> {
        self.domain.floor()
    }

    fn pieces(&self) -> usize {
        self.domain.pieces()
    }

    fn cell(&self, state: &D::State, piece: Piece) -> CellId {
        self.domain.cell(state, piece)
    }

    fn put(&self, state: &D::State, piece: Piece, cell: CellId) -> D::State {
        self.domain.put(state, piece, cell)
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        self.domain.piece_of(proposition)
    }

    fn can_pull(&self) -> bool {
        self.domain.can_pull()
    }

    fn pushes_plainly(&self) -> bool {
        self.domain.pushes_plainly()
    }

    fn swaps(&self) -> bool {
        self.times.set(self.times.get() + 1);
        self.domain.swaps()
    }
}

#[test]
fn no_call_makes_more_expansions_than_its_budget() {
    let size = Size { columns: 2, rows: 2, side: 4, blocks: 4 };
    for (moves, budget) in [(Moves::Push, 1), (Moves::Push, 8), (Moves::PushAndPull, 8)] {
        // With room for lower bounds of single tasks.
        let capacities = Capacities { states: 1 << 18, hashed_states: 0, ..Capacities::STANDARD };
        let mut memory = HeapMemory::new(&capacities);
        let (home, state) = random_home(&mut Pcg32::new(1, 2), size, moves, &mut memory.home);
        let mut tasks = [GroundedTask::UNUSED; TaskSet::MOST];
        let lifted = home::paper_tasks().unwrap();
        let count = ground(&home, &lifted, &state, &mut tasks).unwrap();
        let asked = Asked { domain: &home, times: Cell::new(0) };
        let mut planner = OwnPlanner::new(&capacities, &asked, &lifted, &tasks[..count]);
        planner.begin(TaskSet::first(count));
        let (mut all, mut is_done) = (0, false);
        while !is_done {
            asked.times.set(0);
            is_done = planner.advance(&asked, &state, budget) == Progress::Done;
            // Each task has at least one expansion, so no call begins more tasks than it has expansions, and one.
            assert!(asked.times.get() <= 2 * budget + 1, "{} times, {} before", asked.times.get(), all);
            all += asked.times.get();
        }
        // All work is by bounds, and counted.
        assert!(all > 10_000 && all > planner.plan().expansions() / 2, "{all} of {}", planner.plan().expansions());
    }
}
