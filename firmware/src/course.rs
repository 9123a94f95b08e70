//! The paper's whole course, training and tests, on a microcontroller. Prints its cost; exits with 0 if all five tests pass.

#![no_std]
#![no_main]

mod board;
mod fault;
mod memory;
mod stack;

use board::report;
use goodbot_drill::{Budget, LESSONS, SEED, Watch, Work, run};

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

/// Instructions: the most of each kind of work, all its calls in a row together.
struct Counter {
    began: u64,
    /// The work that ended last, and the instructions of all its calls in a row.
    last: (Option<Work>, u32),
    most: [u32; Work::ALL.len()],
    /// Hearing a command, planning and acting for the first time, for each lesson.
    first: [u32; LESSONS],
    /// The first plan of each lesson.
    plans: [u32; LESSONS],
    acted: bool,
    round: u32,
    longest_round: u32,
    /// The most that a training takes after its rounds.
    longest_kinds: u32,
    all: u32,
}

impl Watch for Counter {
    fn begin(&mut self) {
        self.began = board::instructions();
    }

    fn end(&mut self, work: Work, number: usize) {
        let spent = board::instructions().wrapping_sub(self.began) as u32;
        self.all = self.all.wrapping_add(spent);
        let before = if self.last.0 == Some(work) { self.last.1 } else { 0 };
        self.last = (Some(work), before.wrapping_add(spent));
        if let Some(most) = self.most.get_mut(work as usize) {
            *most = self.last.1.max(*most);
        }
        if work == Work::Learn {
            self.round = self.round.wrapping_add(spent);
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

    fn round(&mut self) {
        self.longest_round = self.longest_round.max(self.round);
        self.round = 0;
    }

    fn trained(&mut self) {
        self.longest_kinds = self.longest_kinds.max(self.round);
        self.round = 0;
    }
}

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let mut counter = Counter {
        began: 0,
        last: (None, 0),
        most: [0; Work::ALL.len()],
        first: [0; LESSONS],
        plans: [0; LESSONS],
        acted: false,
        round: 0,
        longest_round: 0,
        longest_kinds: 0,
        all: 0,
    };
    let outcome = run(&mut memory.home, &mut memory.agent, SEED, Budget::ROUNDS, &mut counter);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    for ((_, name), &most) in Work::ALL.iter().zip(&counter.most) {
        report(name, most);
    }
    report("round", counter.longest_round);
    report("kinds", counter.longest_kinds);
    for &plan in &counter.plans {
        report("first-plan", plan);
    }
    report("hear-plan-act", counter.first.iter().copied().max().unwrap_or(0));
    report("all", counter.all);
    match outcome {
        Ok(outcome) => {
            report("steps", outcome.steps);
            report("digest", outcome.digest.0);
            report("passed", outcome.passed);
            report("tests", outcome.tests);
            board::exit(if outcome.passed == outcome.tests { 0 } else { 1 })
        }
        Err(_) => {
            board::print("error: the memory is too small for the course\n");
            board::exit(2)
        }
    }
}
