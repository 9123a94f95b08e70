//! Homes whose joint state space is out of reach are planned for with blocks that stand still, and say so.

use goodbot::home::{self, Moves};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::{GoalTable, OptimalSet, Planner, Progress, Sweep};
use goodbot::task::{GroundedTask, TaskSet, ground};
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::random_homes::{Size, below, random_home};
use rand_pcg::Pcg32;

/// Of the judgements of all tasks and actions, in states of random walks in random homes of three rooms and two blocks: how many are
/// equal where the blocks stand still and where they do not, how many there are, and how many sets were unknown.
fn judgements(seed: u64) -> (u32, u32, u32) {
    let mut random = Pcg32::new(seed, 1);
    // Room for one block and the agent, not for two.
    let mut memory = HeapMemory::new(&Capacities { states: 1 << 12, hashed_states: 0, ..Capacities::STANDARD });
    let parts = memory.split();
    let size = Size { columns: 3, rows: 1, side: 4, blocks: 2 };
    let (home, start) = random_home(&mut random, size, Moves::Push, parts.home);
    let lifted = home::paper_tasks().unwrap();
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let mut goals = GoalTable::new(parts.agent.session.goals);
    goals.fill(&home, &lifted, &tasks[..count], &start).unwrap();
    let all = TaskSet::first(count);
    let mut words = vec![0; Sweep::words_needed(&home, count).unwrap()];
    let mut sweep = Sweep::new(&mut words);
    assert!(sweep.begin(&home, &start, all));
    while sweep.advance(&home, &goals, u32::MAX) == Progress::Working {}

    let mut planner = Planner::new(parts.agent.session.plan, parts.agent.language.tables.counts);
    planner.forget(count);
    let (mut equal, mut judged, mut unknown, mut state) = (0, 0, 0, start);
    for _ in 0..60 {
        planner.begin(&home, &goals, &state, all, TaskSet::EMPTY);
        while planner.advance(&home, &goals, &state, 1_000) == Progress::Working {}
        let holds = goals.satisfied(&home, &state);
        for task in all.without(holds).common(sweep.reachable(&home, &state)).iter() {
            let exact = sweep.toward(&home, &state, task);
            match planner.search().optimal(task) {
                OptimalSet::Unknown => unknown += 1,
                found => {
                    assert!(planner.search().relaxed().contains(task), "a set that is not exact must say so");
                    let found = found.actions().unwrap();
                    judged += 4;
                    equal += (0..4).filter(|&action| found.contains(Action(action)) == exact.contains(Action(action))).count() as u32;
                }
            }
        }
        state = apply(&home, &state, Action(below(&mut random, 4) as u8)).unwrap();
    }
    (equal, judged, unknown)
}

#[test]
fn plans_with_blocks_that_stand_still_judge_nearly_as_exact_plans_do() {
    let sums = (0..12).map(judgements).fold((0, 0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1, sum.2 + one.2));
    let (equal, judged, unknown) = sums;
    println!("{equal} of {judged} judgements equal, {unknown} sets unknown");
    assert!(f64::from(equal) >= 0.95 * f64::from(judged), "{sums:?}");
    // There is no room here for the other block to move too, where it is in the way.
    assert!(unknown * 6 < judged / 4 + unknown, "{sums:?}");
}

#[test]
fn a_home_of_six_rooms_and_four_blocks_is_planned_for_and_says_how() {
    let mut random = Pcg32::new(5, 5);
    let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::STANDARD), HeapMemory::new(&Capacities::STANDARD));
    let size = Size { columns: 3, rows: 2, side: 5, blocks: 4 };
    let (home, mut state) = random_home(&mut random, size, Moves::Push, home_memory.split().home);
    assert!(home.state_count() > 1 << 35);
    let mut agent = Agent::new(memory.split().agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
    agent.hear(&home, &state, "take the chair to the blue room").unwrap();
    agent.plan_fully(&home, &state).unwrap();
    let search = agent.search();
    let of_blocks: Vec<usize> = (0..agent.tasks().len()).filter(|&task| agent.tasks()[task].lifted == 1).collect();
    let planned = of_blocks.iter().filter(|&&task| matches!(search.optimal(task), OptimalSet::Toward(_))).count();
    assert!(planned > 0 && (0..agent.tasks().len()).all(|task| search.unknown().contains(task) || search.relaxed().contains(task)));

    // The plan can be followed to a goal.
    let task = of_blocks.into_iter().find(|&task| matches!(agent.search().optimal(task), OptimalSet::Toward(_))).unwrap();
    for _ in 0..200 {
        agent.plan_fully(&home, &state).unwrap();
        match agent.search().optimal(task) {
            OptimalSet::Toward(actions) => state = apply(&home, &state, actions.iter().next().unwrap()).unwrap(),
            other => return assert_eq!(other, OptimalSet::Goal),
        }
    }
    panic!("the goal was not reached");
}
