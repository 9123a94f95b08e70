//! Runs one benchmark COUNT times, for a program that counts instructions: `measure NAME COUNT`. `measure` alone prints the names.

use std::process::ExitCode;

use goodbot_benches::works;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.as_slice() {
        [] => {
            for work in works::all() {
                println!("{}", work.name);
            }
            ExitCode::SUCCESS
        }
        [name, count] => {
            let (Some(work), Ok(count)) = (works::all().into_iter().find(|work| work.name == *name), count.parse::<u32>()) else {
                eprintln!("error: no work is called {name:?}, or {count:?} is no count; `measure` alone gives the names");
                return ExitCode::from(2);
            };
            let mut run = (work.prepare)();
            for _ in 0..count {
                run();
            }
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("error: give the name of a work and how often to do it");
            ExitCode::from(2)
        }
    }
}
