//! A control loop with a fixed tick that never waits for the robot's mind: each turn of the loop gives planning or learning a small part
//! of a tick, and the rest is the controller's own. Prints the longest of each kind of call, and the digest of all posteriors, which must
//! be that of the course without budgets; exits with 0 if no tick was missed and all tests pass. Then the trainer's voice says "stop" at
//! many moments: each time the robot is still within the tick.

#![no_std]
#![no_main]

mod board;
mod fault;
mod memory;
#[allow(dead_code, reason = "only the course reports its stack")]
mod stack;

use board::report;
#[cfg(not(feature = "tiny"))]
use goodbot_drill::stop;
use goodbot_drill::{Budget, SEED, Watch, Work, run};

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

/// Instructions of one tick: 10 ms of a micro:bit's processor, which does at most 16 million a second, or of the other boards' 25 million.
const TICK: u32 = if cfg!(feature = "microbit") { 160_000 } else { 250_000 };
/// The budget of one turn of the loop.
const BUDGET: Budget = Budget { hear: 1, plan: 8, finish: 1, learn: 16 };

/// The loop: each call begins with a tick.
struct Loop {
    began: u64,
    period: u32,
    turns: u32,
    missed: u32,
    longest: [u32; Work::ALL.len()],
    longest_stop: u32,
}

impl Loop {
    /// The instructions since the work began, which counts as a turn of the loop.
    fn take(&mut self) -> u32 {
        let spent = board::instructions().wrapping_sub(self.began) as u32;
        let late = board::periods().wrapping_sub(self.period);
        self.missed = self.missed.wrapping_add(late);
        self.turns = self.turns.wrapping_add(1);
        spent
    }
}

impl Watch for Loop {
    fn begin(&mut self) {
        // Here a robot would read its sensors and set its motors.
        board::sleep_through(board::periods());
        self.period = board::periods();
        self.began = board::instructions();
    }

    fn end(&mut self, work: Work, _number: usize) {
        let spent = self.take();
        if let Some(longest) = self.longest.get_mut(work as usize) {
            *longest = spent.max(*longest);
        }
    }

    fn stopped(&mut self) {
        self.longest_stop = self.take().max(self.longest_stop);
    }
}

#[board::entry]
fn main() -> ! {
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    board::start_counter(TICK);
    let mut turns = Loop { began: 0, period: 0, turns: 0, missed: 0, longest: [0; Work::ALL.len()], longest_stop: 0 };
    let outcome = run(&mut memory.home, &mut memory.agent, SEED, BUDGET, &mut turns);
    // The course alone fills the smallest board's memory.
    #[cfg(not(feature = "tiny"))]
    let stops = stop(&mut memory.home, &mut memory.agent, BUDGET, &mut turns);
    #[cfg(feature = "tiny")]
    let stops = Ok::<_, ()>(goodbot_drill::Stops { count: 0, are_clean: true });
    for ((_, name), &longest) in Work::ALL.iter().zip(&turns.longest) {
        report(name, longest);
    }
    report("stop", turns.longest_stop);
    report("tick", TICK);
    report("turns", turns.turns);
    report("missed", turns.missed);
    let (Ok(outcome), Ok(stops)) = (outcome, stops) else { board::exit(2) };
    report("stops", stops.count);
    report("digest", outcome.digest.0);
    board::exit(if turns.missed == 0 && stops.are_clean && outcome.passed == outcome.tests { 0 } else { 1 })
}
