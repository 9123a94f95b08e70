//! Where memory cannot hold the joint states of even the robot and one block, plans are made region by region.

use goodbot::home::{self, Home, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, apply};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::sweep::{Sweep, satisfied};
use rand_pcg::Pcg32;

/// Counts of the plans in random homes.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Single actions judged by approximate sets, and how many of them exact sets judge alike.
    judged: u32,
    equal: u32,
    unknown: u32,
    /// Sets that are exact.
    exact: u32,
    /// Tasks whose goals can be reached, and those whose goals the robot reached.
    reachable: u32,
    reached: u32,
}

/// Plans for tasks of one block each, with room for this many states.
struct Scene<'a, M> {
    home: &'a Home<M>,
    planner: OwnPlanner,
    sweep: Sweep,
    of_blocks: TaskSet,
}

impl<M: HomeMemory> Scene<'_, M> {
    fn judge(&mut self, state: &HomeState, seen: &mut Seen) {
        let plan = self.planner.plan_for(self.home, state, self.of_blocks, 100);
        let reachable = self.sweep.reachable(self.home, state);
        for task in self.of_blocks.common(reachable).iter().filter(|&task| plan.distance(task) != Some(0)) {
            let exact = self.sweep.toward(self.home, state, task);
            match plan.optimal(task) {
                OptimalSet::Unknown => seen.unknown += 1,
                OptimalSet::Approximate(found) => {
                    let equal = (0..4).filter(|&action| found.contains(Action::new(action)) == exact.contains(Action::new(action)));
                    (seen.judged, seen.equal) = (seen.judged + 4, seen.equal + equal.count() as u32);
                }
                found => {
                    assert_eq!(found, OptimalSet::Toward(exact), "what is not exact must say so");
                    seen.exact += 1;
                }
            }
        }
    }

    /// Whether the robot reaches the goal by doing the first action of each plan.
    fn follow(&mut self, start: &HomeState, task: usize) -> bool {
        let mut state = *start;
        for _ in 0..300 {
            let plan = self.planner.plan_for(self.home, &state, TaskSet::of(task), u32::MAX).optimal(task);
            let Some(actions) = plan.onward() else { return plan == OptimalSet::Goal };
            state = apply(self.home, &state, actions.iter().next().unwrap()).unwrap();
        }
        false
    }
}

fn try_home(seed: u64, size: Size, states: usize, seen: &mut Seen) {
    let mut random = Pcg32::new(seed, 2);
    let capacities = Capacities { states, hashed_states: 0, ..Capacities::STANDARD };
    let mut memory = HeapMemory::new(&capacities);
    let (home, start) = random_home(&mut random, size, Moves::Push, &mut memory.home);
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let sweep = Sweep::new(&home, &start, &lifted, &tasks[..count]);
    let planner = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
    let of_blocks = (0..count).filter(|&task| tasks[task].lifted == 1).fold(TaskSet::EMPTY, TaskSet::with);
    let mut scene = Scene { home: &home, planner, sweep, of_blocks };

    let mut state = start;
    for _ in 0..40 {
        scene.judge(&state, seen);
        state = apply(&home, &state, Action::new(below(&mut random, 4) as u8)).unwrap();
    }
    let asked = of_blocks.common(scene.sweep.reachable(&home, &start)).without(satisfied(&home, &start, &lifted, &tasks[..count]));
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
        assert!(seen.judged + 4 * seen.exact > 2_000 && f64::from(seen.equal) >= 0.88 * f64::from(seen.judged), "{seen:?}");
        all.judged += seen.judged;
        all.equal += seen.equal;
        all.unknown += seen.unknown;
        all.exact += seen.exact;
        all.reachable += seen.reachable;
        all.reached += seen.reached;
    }
    println!("all: {all:?}");
    assert!(f64::from(all.equal) >= 0.94 * f64::from(all.judged) && all.unknown * 40 < all.judged / 4, "{all:?}");
    assert!(all.exact > 300, "{all:?}");
    assert!(all.reachable > 100 && f64::from(all.reached) >= 0.95 * f64::from(all.reachable), "{all:?}");
}
