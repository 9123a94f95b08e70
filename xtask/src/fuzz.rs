//! Runs the fuzz targets, each for a while on all processors. The stable compiler is enough: libFuzzer only needs to see which branches are
//! taken.

use anyhow::{Context, Result, ensure};
use xshell::cmd;

use crate::process::{shell, target_dir};

#[derive(clap::Args)]
pub struct Options {
    /// Only this target.
    target: Option<String>,
    /// How long each target runs: all eleven take 22 minutes.
    #[arg(long, default_value_t = 120)]
    seconds: u32,
    /// With AddressSanitizer, which also sees reads and writes beyond a block of memory. Three times as slow.
    #[arg(long)]
    sanitize: bool,
}

/// Instrumentation for libFuzzer, and the checks of a debug build.
const FLAGS: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 -Cdebug-assertions -Coverflow-checks";
/// AddressSanitizer. The stable compiler brings it along, but lets only those use it who ask for what is unstable.
const SANITIZER: &str = "-Zsanitizer=address";
/// Named, so that the flags apply only to the fuzz targets and not to build scripts.
const HOST: &str = "x86_64-unknown-linux-gnu";

/// Builds and runs the targets. libFuzzer prints the number of inputs at the beginning of its lines.
pub fn run(options: &Options) -> Result<()> {
    let (sh, folder) = (shell()?, target_dir().join(if options.sanitize { "fuzz-sanitized" } else { "fuzz" }));
    let build =
        cmd!(sh, "cargo build --locked --release --bins --target {HOST} --manifest-path tests/fuzz/Cargo.toml --target-dir {folder}");
    let build = match options.sanitize {
        true => build.env("RUSTFLAGS", format!("{FLAGS} {SANITIZER}")).env("RUSTC_BOOTSTRAP", "1"),
        false => build.env("RUSTFLAGS", FLAGS),
    };
    build.run().context("the fuzz targets need Linux on x86-64")?;
    let files = sh.read_dir("tests/fuzz/fuzz_targets")?;
    let mut targets: Vec<_> = files.iter().filter_map(|file| file.file_stem()?.to_str()).collect();
    targets.retain(|target| options.target.as_ref().is_none_or(|only| only == target));
    ensure!(!targets.is_empty(), "there is no fuzz target of this name; see tests/fuzz/fuzz_targets");
    let processes = std::thread::available_parallelism()?.to_string();
    let limit = format!("-max_total_time={}", options.seconds);
    let mut failed = Vec::new();
    for target in targets {
        let (made, found) = (sh.create_dir(folder.join("made").join(target))?, sh.create_dir(folder.join("found").join(target))?);
        let program = cmd!(sh, "{folder}/{HOST}/release/{target} {made} tests/fuzz/corpus/{target} -fork={processes} {limit}");
        let checks = ["-timeout=60".to_owned(), "-rss_limit_mb=4096".to_owned(), format!("-artifact_prefix={}/", found.display())];
        failed.extend(program.args(checks).run().is_err().then(|| format!("{target}, with an input in {}", found.display())));
    }
    ensure!(
        failed.is_empty(),
        "{}: mend it, and keep the input in tests/fuzz/corpus with a name that says what was wrong; `fuzz_smoke` then tests it",
        failed.join("; ")
    );
    Ok(())
}
