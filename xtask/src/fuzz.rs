//! The fuzz targets, each for a while, as many at once as there are processors. The compiler of every day is enough: libFuzzer needs only
//! to see which branches are taken.

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::thread;

use anyhow::{Context, Result, bail};

use crate::{process, project};

#[derive(clap::Args)]
pub struct Options {
    /// Only this target.
    target: Option<String>,
    /// How long each target runs: all seven take a quarter of an hour on two processors.
    #[arg(long, default_value_t = 220)]
    seconds: u32,
}

/// What the compiler adds for libFuzzer, and the checks of a debug build.
const FLAGS: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 -Cdebug-assertions -Coverflow-checks";
/// The flags are for this target alone, not for the programs that build it.
const HOST: &str = "x86_64-unknown-linux-gnu";

/// Builds and runs the targets, and says how many inputs each had.
pub fn run(options: &Options) -> Result<()> {
    let fuzz = project::root().join("fuzz");
    let folder = project::target_dir().join("fuzz");
    let mut build = project::cargo();
    build.args(["build", "--release", "--bins", "--target", HOST, "--manifest-path"]).arg(fuzz.join("Cargo.toml"));
    process::run(build.env("RUSTFLAGS", FLAGS).arg("--target-dir").arg(&folder)).context("the fuzz targets need Linux on x86-64")?;
    let mut targets: Vec<String> = Vec::new();
    for file in std::fs::read_dir(fuzz.join("fuzz_targets"))? {
        let name = file?.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        targets.extend(Some(name).filter(|name| options.target.as_ref().is_none_or(|only| only == name)));
    }
    if targets.is_empty() {
        bail!("there is no fuzz target of this name; see fuzz/fuzz_targets");
    }
    targets.sort();
    println!("{} targets, {} s each", targets.len(), options.seconds);
    let (waiting, failed) = (Mutex::new(targets.iter().rev().collect::<Vec<_>>()), Mutex::new(Vec::new()));
    let next = || waiting.lock().ok().and_then(|mut waiting| waiting.pop());
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(target) = next() {
                    match fuzz_one(target, &fuzz, &folder, options.seconds) {
                        Ok(inputs) => println!("{target}: {inputs} inputs"),
                        Err(error) => {
                            eprintln!("{target}: {error:#}");
                            failed.lock().map(|mut failed| failed.push(target)).unwrap_or_default();
                        }
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap_or_default();
    if failed.is_empty() {
        return Ok(());
    }
    bail!("{failed:?} failed: mend it, and keep the input in fuzz/corpus with a name that says what was wrong; `fuzz_smoke` then tests it")
}

/// Runs one target on its kept corpus, and on what it makes of it. Returns how many inputs that were.
fn fuzz_one(target: &str, fuzz: &Path, folder: &Path, seconds: u32) -> Result<u64> {
    let (made, found) = (folder.join("made").join(target), folder.join("found").join(target));
    std::fs::create_dir_all(&made)?;
    std::fs::create_dir_all(&found)?;
    let mut command = Command::new(folder.join(HOST).join("release").join(target));
    command.arg(&made).arg(fuzz.join("corpus").join(target)).args(["-print_final_stats=1", "-timeout=60", "-rss_limit_mb=4096"]);
    command.arg(format!("-max_total_time={seconds}")).arg(format!("-artifact_prefix={}/", found.display()));
    let output = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        let last: Vec<&str> = said.lines().rev().take(30).collect();
        bail!("an input failed; it is in {}:\n{}", found.display(), last.into_iter().rev().collect::<Vec<_>>().join("\n"));
    }
    let count = said.lines().find_map(|line| line.strip_prefix("stat::number_of_executed_units:")).context("libFuzzer gave no count")?;
    Ok(count.trim().parse()?)
}
