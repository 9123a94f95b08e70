//! Where the memory cannot hold even the robot and one block, plans are made region by region.

use goodbot::home::{self, Home, HomeState, Moves};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::{GoalTable, OptimalSet, Planner, Progress, Sweep};
use goodbot::task::{GroundedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::random_homes::{Size, below, random_home};
use rand_pcg::Pcg32;

/// What the plans in random homes come to.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Judgements of an action, and those equal to exact ones.
    judged: u32,
    equal: u32,
    unknown: u32,
    /// Tasks whose goals can be reached, and those that a robot reaches.
    reachable: u32,
    reached: u32,
}

/// Plans for tasks of one block each, with room for so many states.
struct Scene<'a, 'm> {
    home: &'a Home<'m>,
    goals: GoalTable<'m>,
    planner: Planner<'m>,
    sweep: Sweep<'a>,
    of_blocks: TaskSet,
}

impl Scene<'_, '_> {
    fn plan(&mut self, state: &HomeState, wanted: TaskSet, budget: u32) {
        self.planner.begin(self.home, &self.goals, state, wanted, TaskSet::EMPTY);
        while self.planner.advance(self.home, &self.goals, state, budget) == Progress::Working {}
        let unresolved = wanted.iter().filter(|&task| matches!(self.planner.search().optimal(task), OptimalSet::Toward(_)));
        assert!(unresolved.into_iter().all(|task| self.planner.search().relaxed().contains(task)), "a set that is not exact must say so");
    }

    fn judge(&mut self, state: &HomeState, seen: &mut Seen) {
        self.plan(state, self.of_blocks, 100);
        let asked = self.of_blocks.without(self.goals.satisfied(self.home, state)).common(self.sweep.reachable(self.home, state));
        for task in asked.iter() {
            let exact = self.sweep.toward(self.home, state, task);
            match self.planner.search().optimal(task).actions() {
                None => seen.unknown += 1,
                Some(found) => {
                    let equal = (0..4).filter(|&action| found.contains(Action(action)) == exact.contains(Action(action)));
                    (seen.judged, seen.equal) = (seen.judged + 4, seen.equal + equal.count() as u32);
                }
            }
        }
    }

    /// Whether a robot that does the first action of each plan comes to the goal.
    fn follow(&mut self, start: &HomeState, task: usize) -> bool {
        let mut state = *start;
        for _ in 0..300 {
            self.plan(&state, TaskSet::of(task), u32::MAX);
            match self.planner.search().optimal(task) {
                OptimalSet::Toward(actions) => state = apply(self.home, &state, actions.iter().next().unwrap()).unwrap(),
                other => return other == OptimalSet::Goal,
            }
        }
        false
    }
}

fn try_home(seed: u64, size: Size, states: usize, seen: &mut Seen) {
    let mut random = Pcg32::new(seed, 2);
    let capacities = Capacities { states, hashed_states: 0, ..Capacities::STANDARD };
    let mut memory = HeapMemory::new(&capacities);
    let parts = memory.split();
    let (home, start) = random_home(&mut random, size, Moves::Push, parts.home);
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let mut goals = GoalTable::new(parts.agent.session.goals);
    goals.fill(&home, &lifted, &tasks[..count], &start).unwrap();
    let mut words = vec![0; Sweep::words_needed(&home, count).unwrap()];
    let mut sweep = Sweep::new(&mut words);
    assert!(sweep.begin(&home, &start, TaskSet::first(count)));
    while sweep.advance(&home, &goals, u32::MAX) == Progress::Working {}
    let mut planner = Planner::new(parts.agent.session.plan, parts.agent.language.tables.counts);
    planner.forget(count);
    let of_blocks = (0..count).filter(|&task| tasks[task].lifted == 1).fold(TaskSet::EMPTY, |set, task| set.union(TaskSet::of(task)));
    let mut scene = Scene { home: &home, goals, planner, sweep, of_blocks };

    let mut state = start;
    for _ in 0..40 {
        scene.judge(&state, seen);
        state = apply(&home, &state, Action(below(&mut random, 4) as u8)).unwrap();
    }
    let asked = of_blocks.common(scene.sweep.reachable(&home, &start)).without(scene.goals.satisfied(&home, &start));
    for task in asked.iter() {
        seen.reachable += 1;
        seen.reached += u32::from(scene.follow(&start, task));
    }
}

#[test]
fn a_robot_that_plans_region_by_region_judges_nearly_as_exact_plans_do_and_reaches_its_goals() {
    let mut all = Seen::default();
    for (columns, rows, side, blocks, states) in
        [(2, 2, 4, 1, 2_048), (3, 2, 4, 1, 2_048), (3, 2, 5, 1, 4_096), (4, 2, 3, 1, 1_024), (2, 2, 4, 2, 2_048)]
    {
        let mut seen = Seen::default();
        (0..12).for_each(|seed| try_home(seed, Size { columns, rows, side, blocks }, states, &mut seen));
        println!("{columns} x {rows} rooms of side {side}, {blocks} blocks, room for {states} states: {seen:?}");
        assert!(seen.judged > 2_000 && f64::from(seen.equal) >= 0.88 * f64::from(seen.judged), "{seen:?}");
        all.judged += seen.judged;
        all.equal += seen.equal;
        all.unknown += seen.unknown;
        all.reachable += seen.reachable;
        all.reached += seen.reached;
    }
    println!("all: {all:?}");
    assert!(f64::from(all.equal) >= 0.94 * f64::from(all.judged) && all.unknown * 40 < all.judged / 4, "{all:?}");
    assert!(all.reachable > 100 && f64::from(all.reached) >= 0.95 * f64::from(all.reachable), "{all:?}");
}

#[test]
fn each_place_of_a_home_lies_in_one_region_and_is_found_there() {
    let mut random = Pcg32::new(3, 3);
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let size = Size { columns: 3, rows: 2, side: 3, blocks: 1 };
    let (home, _) = random_home(&mut random, size, Moves::Push, memory.split().home);
    let mut met = std::collections::HashSet::new();
    for place in 0..home.values(0) {
        let (region, position) = home.region_of(place).unwrap();
        assert!(region < home.regions() && position < home.region_size(region));
        assert!(met.insert((region, position)));
        assert_eq!(home.place_in(region, position), Some(place));
    }
    let regions: std::collections::HashSet<usize> = met.iter().map(|&(region, _)| region).collect();
    assert_eq!((regions.len(), met.len()), (6 + 7, 6 * 9 + 7));
    assert_eq!(home.region_of(home.values(0)), None);
}
