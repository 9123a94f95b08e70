//! The drill on this machine: prints its digest.

use goodbot_drill::{Budget, SEED, run};
use std::process::ExitCode;

goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }

fn main() -> ExitCode {
    let mut memory = Memory::new();
    match run(&mut memory.home, &mut memory.agent, SEED, Budget::ROUNDS, &mut ()) {
        Ok(outcome) => {
            println!("passed {}\nsteps {}\ndigest {}", outcome.passed, outcome.steps, outcome.digest.0);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error:?}");
            ExitCode::FAILURE
        }
    }
}
