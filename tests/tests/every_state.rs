//! The plans of every state at once, against reference numbers computed by an independent implementation.

use goodbot::home::{self, Moves};
use goodbot::oomdp::Domain;
use goodbot::planning::{GoalTable, Progress, Sweep};
use goodbot::task::{GroundedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::fixture::{home, read, task_text};
use goodbot_tests::plan_sums::PlanSums;
use goodbot_tests::reachable::reachable;

#[test]
fn one_sweep_gives_the_reference_plans_of_every_state_of_every_home() {
    let reference = read("plans.json");
    for case in reference.as_array().unwrap() {
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let parts = memory.split();
        let (home, start) = home(&case["world"], parts.home, Moves::PushAndPull);
        let lifted = home::paper_tasks().unwrap();
        let mut tasks = [GroundedTask::UNUSED; 64];
        let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
        let tasks = &tasks[..count];
        let mut goals = GoalTable::new(parts.agent.session.goals);
        goals.fill(&home, &lifted, tasks, &start).unwrap();
        let mut words = vec![0; Sweep::words_needed(&home, count).unwrap()];
        let mut sweep = Sweep::new(&mut words);
        assert!(sweep.begin(&home, &start, TaskSet::first(count)));
        while sweep.advance(&home, &goals, 10_000) == Progress::Working {}

        let mut sums = vec![PlanSums::default(); count];
        let known = (0..home.state_count()).map(|number| home.numbered(number)).filter(|state| sweep.knows(&home, state));
        let states = reachable(&home, &start);
        assert!(known.map(|state| home.number(&state)).eq(states.keys().copied()), "the sweep knows what can be reached");
        for state in states.into_values() {
            for (task, sums) in sums.iter_mut().enumerate() {
                let Some(distance) = sweep.distance(&home, &state, task).map(u64::from) else { continue };
                sums.add(distance, sweep.toward(&home, &state, task).len() as u64);
            }
        }
        for (task, sums) in tasks.iter().zip(&sums) {
            let name = task_text(&home, &lifted, task);
            sums.assert_are(&name, &case["tasks"][&name]);
        }
    }
}
