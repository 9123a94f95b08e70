//! Each benchmark natively and in WebAssembly, in one run, the quickest of nine: `wasm MODULE`.

use std::process::{Command, ExitCode};

use goodbot_benches::timing::{ROUNDS, time};
use goodbot_benches::works;

/// Benchmarks whose single run takes longer, in seconds, are left out, because each is run about a hundred times.
const LONGEST: f64 = 0.2;

fn main() -> ExitCode {
    let Some(module) = std::env::args().nth(1) else {
        eprintln!("error: name the module, the works built for WebAssembly; `cargo xtask bench-wasm` does so");
        return ExitCode::from(2);
    };
    println!("| work | native | WebAssembly | ratio |\n|---|---:|---:|---:|");
    for (position, work) in works::all().into_iter().enumerate() {
        let mut run = (work.prepare)();
        let once = time(&mut run).as_secs_f64();
        if once > LONGEST {
            continue;
        }
        let times = (0.02 / once.max(1e-9)).clamp(1.0, 1e6) as u32;
        let quickest = (0..ROUNDS).map(|_| time(|| (0..times).for_each(|_| run())) / times).min();
        let native = quickest.unwrap_or_default().as_secs_f64() * 1e3;
        match in_node(&module, position) {
            Ok(wasm) => println!("| {} | {native:.4} ms | {wasm:.4} ms | {:.2} |", work.name, wasm / native),
            Err(problem) => {
                eprintln!("error: {}: {problem}", work.name);
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Milliseconds in node.
fn in_node(module: &str, position: usize) -> Result<f64, String> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/peers/wasm.mjs");
    let output = Command::new("node").args([script, module, &position.to_string()]).output().map_err(|error| format!("node: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    text.trim().parse().map_err(|_| format!("node gave no time: {text}{}", String::from_utf8_lossy(&output.stderr)))
}
