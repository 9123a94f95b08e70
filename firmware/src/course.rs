//! The paper's whole course, training and tests, on a microcontroller. Prints what it cost; exits with 0 where all five tests pass.

#![no_std]
#![no_main]

mod board;
mod stack;

use board::report;
use goodbot_drill::{LESSONS, SEED, Watch, Work, run};

#[cfg(not(feature = "tiny"))]
goodbot::memory! { struct RobotMemory = goodbot::Capacities::SMALL; }
#[cfg(feature = "tiny")]
goodbot::memory! { struct RobotMemory = goodbot::Capacities::TINY; }

static mut MEMORY: RobotMemory = RobotMemory::new();

/// The dearest of each kind of work, in instructions.
struct Counter {
    began: u64,
    most: [u64; Work::ALL.len()],
    /// Hearing a command, planning and acting for the first time, for each lesson.
    first: [u64; LESSONS],
    /// The first plan of each lesson.
    plans: [u64; LESSONS],
    acted: bool,
    all: u64,
}

impl Watch for Counter {
    fn begin(&mut self) {
        self.began = board::instructions();
    }

    fn end(&mut self, work: Work, number: usize) {
        let spent = board::instructions().wrapping_sub(self.began);
        self.all = self.all.wrapping_add(spent);
        if let Some(most) = self.most.get_mut(work as usize) {
            *most = spent.max(*most);
        }
        self.acted &= work != Work::Hear;
        if let (Some(first), Some(plan), false) = (self.first.get_mut(number), self.plans.get_mut(number), self.acted) {
            match work {
                Work::Plan => *plan = spent,
                Work::Act => self.acted = true,
                _ => {}
            }
            if matches!(work, Work::Hear | Work::Plan | Work::Act) {
                *first = first.wrapping_add(spent);
            }
        }
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    board::start_counter();
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let mut counter =
        Counter { began: 0, most: [0; Work::ALL.len()], first: [0; LESSONS], plans: [0; LESSONS], acted: false, all: 0 };
    let outcome = run(memory.split(), SEED, &mut counter);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    for ((_, name), &most) in Work::ALL.iter().zip(&counter.most) {
        report(name, most);
    }
    for &plan in &counter.plans {
        report("first-plan", plan);
    }
    report("hear-plan-act", counter.first.iter().copied().max().unwrap_or(0));
    report("all", counter.all);
    match outcome {
        Ok(outcome) => {
            report("steps", u64::from(outcome.steps));
            report("digest", u64::from(outcome.digest.0));
            report("passed", u64::from(outcome.passed));
            board::exit(if outcome.passed == outcome.tests { 0 } else { 1 })
        }
        Err(_) => {
            board::print("error: the memory is too small for the course\n");
            board::exit(2)
        }
    }
}
