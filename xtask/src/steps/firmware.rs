//! The robot on a microcontroller, in the emulator.

use anyhow::{Result, bail};

use super::{Run, Step, WORKSPACE};
use crate::firmware::image::{BINARIES, panics};
use crate::firmware::{Alone, digests, images, microbit, trials};
use crate::programs::QEMU;
use crate::{footprint, process, project};

/// What the course may take on the Cortex-M4F with the small preset: RAM with the stack, flash, and the instructions to hear a command and to
/// choose an action once it is planned.
const MOST_RAM: u64 = 32 * 1024;
const MOST_FLASH: u64 = 100 * 1024;
const MOST_TO_ACT: u64 = 1_000_000;
/// Instructions that the first plan for the 50 tasks of a home of three storeys may take there.
const MOST_TO_PLAN_WAYS: u64 = 3_000_000;
/// The micro:bit's RAM, and its flash and instructions: its floats are made of them.
const MICROBIT_RAM: u64 = 16 * 1024;
const MICROBIT_FLASH: u64 = 104 * 1024;
const MICROBIT_TO_ACT: u64 = 2_000_000;
/// A tick of 10 ms has room for so many calls, whichever they are.
const CALLS_IN_A_TICK: u64 = 4;

/// The calls that a control loop makes.
const CALLS: [&str; 5] = ["hear", "plan", "act", "finish", "learn"];

const NEXT: &str = "run the binary that failed: `cargo xtask footprint` shows what each costs; the firmware is in firmware/";

/// The course, all tests of it, on every board; and its bounds.
pub const COURSE: Step = Step::new("firmware", "the paper's course passes on emulated Cortex-M4F, M3 and M0, in its bounds", course, NEXT);

/// Budgets hold.
pub const TICK: Step = Step::new("tick", "a control loop with a fixed tick misses none while the robot learns", tick, NEXT);

/// The micro:bit's own file.
pub const MICROBIT: Step = Step::new(
    "microbit",
    "the micro:bit's file learns by serial line and buttons on an emulated board, and outlives a torn store; so among embassy's tasks",
    in_hand,
    "the tests are in tests/tests/microbit, the firmware in firmware/microbit and firmware/embassy",
);

/// Equal digests.
pub const SAME_BITS: Step = Step::new(
    "same-bits",
    "this machine, WebAssembly and every board come to the same posteriors, bit for bit",
    same_bits,
    "look for what is not + - * / on f32, or depends on the width of usize",
);

/// No panic machinery.
pub const NO_PANIC: Step = Step::new(
    "no-panic",
    "the linked firmware has nothing in it that panics",
    no_panic,
    "`arm-none-eabi-objdump -dC` on the binary shows who calls the symbols that are listed",
);

/// The table is as checked in.
pub const FOOTPRINT: Step = Step::new(
    "footprint",
    "nothing costs more than docs/footprint.md says",
    |_| footprint::check(),
    "make it cheaper, or renew the table on purpose: `cargo xtask footprint`",
);

fn course(_: &mut Run) -> Result<()> {
    for trial in trials()? {
        let (ram, flash) = (footprint::ram(trial)?, trial.image.flash("course")?);
        let to_act = trial.course.number("hear")? + trial.course.number("act")?;
        println!(
            "{}: {ram} bytes of RAM, {flash} of flash, {to_act} instructions to hear a command and choose an action",
            trial.image.name()
        );
        let bounds = match trial.image.name().as_str() {
            "mps2-an386 small" => [("RAM", ram, MOST_RAM), ("flash", flash, MOST_FLASH), ("instructions to act", to_act, MOST_TO_ACT)],
            "microbit tiny" => {
                [("RAM", ram, MICROBIT_RAM), ("flash", flash, MICROBIT_FLASH), ("instructions to act", to_act, MICROBIT_TO_ACT)]
            }
            _ => continue,
        };
        for (what, found, most) in bounds {
            if found > most {
                bail!("{}: {what}: {found}, and {most} are the most", trial.image.name());
            }
        }
    }
    let planned = Alone::Ways.run()?;
    let (ram, to_plan) = (planned.number("statics")? + planned.number("stack")?, planned.number("first-plan")?);
    println!(
        "three storeys: {ram} bytes of RAM, {to_plan} instructions for the first plan of {} tasks, most of them with a way",
        planned.number("tasks")?
    );
    if to_plan > MOST_TO_PLAN_WAYS {
        bail!("three storeys: instructions for the first plan: {to_plan}, and {MOST_TO_PLAN_WAYS} are the most");
    }
    println!("an arm: {}", Alone::Arm.run()?);
    println!("the lessons on wheels: {}", Alone::Wheels.run()?);
    Ok(())
}

fn tick(_: &mut Run) -> Result<()> {
    for trial in trials()? {
        let number = |name| trial.tick.number(name);
        let tick = number("tick")?;
        let longest = CALLS.map(|call| Ok((call, number(call)?))).into_iter().collect::<Result<Vec<_>>>()?;
        let listed: Vec<String> = longest.iter().map(|(call, instructions)| format!("{instructions} to {call}")).collect();
        println!("{}: a tick of {tick} instructions; longest calls: {}", trial.image.name(), listed.join(", "));
        if number("missed")? > 0 {
            bail!("{}: {} ticks were missed", trial.image.name(), number("missed")?);
        }
        let most = tick / CALLS_IN_A_TICK;
        if let Some((call, _)) = longest.iter().find(|(_, instructions)| *instructions > most) {
            bail!("{}: one call to {call} took more than {most} instructions", trial.image.name());
        }
    }
    Ok(())
}

fn in_hand(run: &mut Run) -> Result<()> {
    // What is tried is the file itself.
    let hex = microbit::deliver()?;
    process::run(project::cargo().args(["build", "--quiet"]).args(WORKSPACE).args(["--bin", "goodbot"]))?;
    let goodbot = project::target_dir().join("debug").join(format!("goodbot{}", std::env::consts::EXE_SUFFIX));
    let mut tests = project::cargo();
    tests.arg("test").args(WORKSPACE).args(["--test", "microbit"]);
    tests.env("GOODBOT_MICROBIT", hex).env("GOODBOT_EMBASSY", microbit::among_tasks()?);
    run.count(tests.env("GOODBOT_QEMU", QEMU.path()?).env("GOODBOT_CLI", goodbot))?;
    // A stack that runs over must stop at its end, and is never to come near.
    let found = panics(&microbit::program())?;
    if !found.is_empty() {
        bail!("the micro:bit's program has what panics in it: {}", found.join(", "));
    }
    Ok(())
}

fn same_bits(_: &mut Run) -> Result<()> {
    let host = digests::host()?;
    let mut all = vec![("this machine".to_owned(), host), ("WebAssembly".to_owned(), digests::wasm()?)];
    for trial in trials()? {
        all.push((trial.image.name(), trial.course.number("digest")?));
        all.push((format!("{}, in parts", trial.image.name()), trial.tick.number("digest")?));
    }
    for (place, digest) in &all {
        println!("{digest:08x} {place}");
    }
    match all.iter().find(|(_, digest)| *digest != host) {
        Some((place, _)) => bail!("{place} comes to other posteriors than this machine"),
        None => Ok(()),
    }
}

fn no_panic(_: &mut Run) -> Result<()> {
    let mut found = 0_usize;
    for image in images()? {
        for binary in BINARIES {
            for symbol in panics(&image.binary(binary))? {
                println!("{}: {binary}: {symbol}", image.name());
                found += 1;
            }
        }
    }
    for alone in Alone::ALL {
        for symbol in panics(&alone.build()?)? {
            println!("{}: {symbol}", alone.name());
            found += 1;
        }
    }
    if found > 0 {
        bail!("{found} symbols are there to panic");
    }
    println!("no symbol of {} binaries is there to panic", images()?.len() * BINARIES.len() + Alone::ALL.len());
    Ok(())
}
