//! Plans for all states at once, against reference numbers computed by an independent implementation.

use goodbot::home::{self, Moves};
use goodbot::task::{GroundedTask, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::fixture::{home, read, task_text};
use goodbot_tests::plan_sums::PlanSums;
use goodbot_tests::reachable::reachable;
use goodbot_tests::sweep::Sweep;

#[test]
fn one_sweep_gives_the_reference_plans_of_every_state_of_every_home() {
    let reference = read("plans.json");
    for case in reference.as_array().unwrap() {
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let (home, start) = home(&case["world"], &mut memory.home, Moves::PushAndPull);
        let lifted = home::paper_tasks().unwrap();
        let mut tasks = [GroundedTask::UNUSED; 64];
        let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
        let tasks = &tasks[..count];
        let sweep = Sweep::new(&home, &start, &lifted, tasks);

        let mut sums = vec![PlanSums::default(); count];
        let states = reachable(&home, &start);
        assert_eq!(sweep.states(), states.len());
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
