//! What a course costs: time and states of the search, time of learning, for each agent on average, on one core.
//!
//! `cargo run --profile dist -p goodbot-course --example cost`

use goodbot::feedback::{SimulatedTrainer, Strategy};
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_course::{Homes, LESSONS, Lesson, Turn, generator};
use std::time::{Duration, Instant};

const AGENTS: u64 = 200;

fn timed<T>(sum: &mut Duration, work: impl FnOnce() -> T) -> T {
    let begin = Instant::now();
    let done = work();
    *sum += begin.elapsed();
    done
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [mut homes_time, mut search_time, mut learn_time] = [Duration::ZERO; 3];
    let (mut plans, mut states) = (0_u64, 0_u64);
    let trainer = SimulatedTrainer { strategy: Strategy::BALANCED };
    let begin = Instant::now();
    for seed in 1..=AGENTS {
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let mut random = generator(seed);
        let homes = timed(&mut homes_time, || Homes::random(&mut random, &mut memory.home));
        let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::PAPER)?;
        for exercise in &LESSONS {
            let (home, start) = homes.layout(exercise.home).build(&mut memory.home)?;
            let mut lesson = Lesson::begin(&mut agent, &home, &start, exercise)?;
            loop {
                timed(&mut search_time, || agent.plan_fully(&home, lesson.state()))?;
                plans += 1;
                states += u64::from(agent.planned().expansions());
                if let Turn::Ended(_) = lesson.act(&mut agent, &home, &trainer, &mut random)? {
                    break;
                }
            }
            let _ = agent.finish(&home)?;
            timed(&mut learn_time, || agent.learn_fully());
        }
    }
    let whole = begin.elapsed();
    let each = |sum: Duration| sum.as_secs_f64() * 1e3 / AGENTS as f64;
    println!("one course of seven lessons, mean of {AGENTS} agents:");
    println!("  search   {:7.3} ms, {} plans, {} expansions", each(search_time), plans / AGENTS, states / AGENTS);
    println!("  learning {:7.3} ms, 7 trainings of 10 rounds", each(learn_time));
    println!("  homes    {:7.3} ms to draw them at random, each solvable", each(homes_time));
    println!("  together {:7.3} ms", each(whole));
    Ok(())
}
