//! Robots whose wheels slip and whose sensors are noisy go through the paper's lessons: they learn what they would learn without, and they
//! never touch a wall.

use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::Home;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Action;
use goodbot::planning::OptimalSet;
use goodbot::{Agent, Options, home};
use goodbot_course::{CourseTrainer, Exercise, Homes, LESSONS, TESTS, Trainer, generator};
use goodbot_drive::simulation::World;
use rand_pcg::Pcg32;

goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }

/// What one robot's lessons came to.
#[derive(Debug, Default)]
struct Tally {
    lessons: u32,
    actions: u32,
    /// Actions after which the robot stood elsewhere than planned.
    failed: u32,
    walls_hit: u32,
    right: u32,
}

/// One lesson, acted out on wheels.
fn lesson(
    agent: &mut Agent<impl AgentMemory>,
    home: &Home<impl HomeMemory>,
    start: home::HomeState,
    exercise: &Exercise,
    random: &mut Pcg32,
    tally: &mut Tally,
) {
    let mut state = start;
    agent.hear(home, &state, exercise.command).unwrap();
    let intended = exercise.intention.find(agent, home).unwrap();
    let mut world = World::new(home, &state).unwrap();
    let mut rests = 0;
    for _ in 0..300 {
        agent.plan_fully(home, &state).unwrap();
        let right = agent.planned().optimal(intended);
        if rests == 3 || matches!(right, OptimalSet::DeadEnd(_)) {
            break;
        }
        let decision = agent.decide_by(home, &state, random).unwrap();
        let correct = right.exact().or(right.onward()).is_some_and(|actions| actions.contains(decision.action));
        rests = if right == OptimalSet::Goal && decision.action == Action::NOOP { rests + 1 } else { 0 };
        let expected = agent.acted(home, &state, decision.action).unwrap();
        if expected != state {
            world.act(home, decision.action, agent.belief().probability(decision.task), random).unwrap();
        }
        let feedback: Feedback = CourseTrainer::BALANCED.feedback(correct, random);
        let _ = agent.feedback(feedback).unwrap();
        // Where things are is sensed, and not taken from what the action should have done.
        state = world.sensed(home, &state);
        tally.actions += 1;
        tally.failed += u32::from(state != expected);
    }
    let _ = agent.finish(home).unwrap();
    agent.learn_fully();
    tally.lessons += 1;
    tally.walls_hit += world.walls_hit;
}

/// Seven lessons and five tests.
fn course(seed: u64, tally: &mut Tally) {
    let mut memory = Memory::new();
    let mut random = generator(seed);
    let mut agent = Agent::new(memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)]).unwrap();
    for exercise in &LESSONS {
        let (home, start) = Homes::FIXED.layout(exercise.home).build(&mut memory.home).unwrap();
        lesson(&mut agent, &home, start, exercise, &mut random, tally);
    }
    let (home, start) = Homes::FIXED.test.build(&mut memory.home).unwrap();
    for exercise in &TESTS {
        let intended = exercise.pose(&mut agent, &home, &start).unwrap().unwrap();
        tally.right += u32::from(agent.most_likely() == Some(intended));
        agent.forget();
    }
}

/// 10,003 lessons: 1,429 robots, each of its own seed, on all cores.
#[test]
fn a_robot_on_slipping_wheels_learns_the_course_and_never_touches_a_wall() {
    let threads = 4;
    let tallies: Vec<Tally> = std::thread::scope(|scope| {
        let run = |first: u64| {
            scope.spawn(move || {
                let mut tally = Tally::default();
                (first..1429).step_by(threads).for_each(|seed| course(seed, &mut tally));
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
