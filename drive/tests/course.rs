//! Robots whose wheels slip and whose sensors are noisy go through the paper's lessons: they learn what they would learn without, and they
//! never touch a wall.

use goodbot::{Agent, Options, home};
use goodbot_course::generator;
use goodbot_drive::simulation::{Tally, course};

goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }

/// 10,003 lessons: 1,429 robots, each with its own seed, on all cores.
#[test]
fn a_robot_on_slipping_wheels_learns_the_course_and_never_touches_a_wall() {
    let threads = 4;
    let tallies: Vec<Tally> = std::thread::scope(|scope| {
        let run = |first: u64| {
            scope.spawn(move || {
                let mut tally = Tally::default();
                for seed in (first..1429).step_by(threads) {
                    let mut memory = Memory::new();
                    let mut agent = Agent::new(memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
                    course(&mut agent, &mut memory.home, &mut generator(seed), &mut tally).unwrap();
                }
                tally
            })
        };
        let running: Vec<_> = (0..threads as u64).map(run).collect();
        running.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    let sum = |of: fn(&Tally) -> u32| tallies.iter().map(of).sum::<u32>();
    let (lessons, actions, failed) = (sum(|t| t.lessons), sum(|t| t.actions), sum(|t| t.failed));
    println!("{lessons} lessons, {actions} actions, {failed} of them failed; {} of {} tests right", sum(|t| t.right), 1429 * 5);
    assert_eq!(lessons, 10_003);
    assert_eq!(sum(|t| t.walls_hit), 0, "of {actions} actions");
    assert!(failed > actions / 30, "the world is too kind to test anything: {failed} of {actions} actions failed");
    let right = f64::from(sum(|t| t.right)) / f64::from(1429 * 5);
    assert!(right > 0.98, "{right} of the tests were right");
}
