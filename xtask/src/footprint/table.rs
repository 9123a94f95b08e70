//! The numbers for people.

use super::measures::{BYTES, CALLS, Footprint, INSTRUCTIONS, Kept, WHOLE};

const HEAD: &str = "\
# What it costs

Written by `cargo xtask footprint`, which renews the figures of the compiler that it builds with and keeps the others';
`cargo xtask footprint --check` compares those of the same compiler, and fails where an instruction count has risen by more than 5 %. Rustup's
compiler is used where it has the targets (`CROSS_TOOLCHAIN_MODE=rustup`), else Debian's (`CROSS_TOOLCHAIN_MODE=build-std`).

Everything is measured on emulated boards while the paper's whole course runs: seven lessons with a simulated trainer, then five commands in a
home with two blocks, which are all understood. The firmware is in `firmware/`.

## Bytes

Flash is code, constants and the interrupt table, the course's own texts and homes among them. The deepest stack is measured by painting.

";

const PROGRAMS: &str = "
## Other programs

Whole programs on the Cortex-M4F, with their texts, their output and the start-up code; instructions are those from the beginning to the end, with
all lessons. In C, newlib's small `printf` is among them. `cargo xtask library --features table` makes a library without homes.

";

const AIMS: &str = "
## What was aimed at

";

/// Images, the bytes of flash that were aimed at, and where they stand.
const AIMED: [(&str, u64, &str); 4] = [
    ("the course, small", 64 * 1024, "mps2-an386 (Cortex-M4F), small"),
    ("C, every function, all features", 96 * 1024, "C, every function, all features"),
    ("C, a table robot alone", 48 * 1024, "C, a table robot (capi/examples/lift.c), `--features table`"),
    ("Rust, an arm of one's own", 36 * 1024, "Rust, an arm of one's own (firmware/src/arm.rs)"),
];

const WHY: &str = "
None of these is met. Only what is used is linked; what is used has grown since the aims were set. The course's default learner, the role model
with its forgetting and its kinds of tasks, is nearly as large as planning, and planning in homes is three searches: rows of bits, states
one by one for other goals, and the approximate one for what does not fit the memory. An arm or a lift needs none of the rows, so it is smaller,
but it hears, learns, forgets and reports how full its tables are as any other robot does.

What can be done: `opt-level = \"z\"` in one's own profile takes a ninth off the course and costs a third more instructions, so the firmware here
and the C library for controllers have \"s\", with which the compiler also sees that nothing panics. Homes and tables are one domain in C, so all that works on a domain is linked once. Features
leave out questions, ways, letters beyond ASCII (whose lower case takes 12 KB with a compiler whose tables are large), and the kind of robot
that is not used.
";

const BETWEEN: &str = "
## Instructions

Counted by the emulator, the same in every run. Each number is the dearest of its kind in the whole course: for hearing a command, one of
the tests, which have the most tasks and are not acted on. They are instructions, not cycles.

";

const LONGEST: &str = "
## The longest calls

Hearing, planning, ending a session and learning go in parts. These are the most instructions that one call took, with the smallest budgets
that the firmware's fixed tick uses; beginning to hear a command, and to end a session, counts as a call.

";

const PLANS: &str = "
## Plans

Instructions of the first plan in each of the course's environments, for all its tasks at once. A to C have rooms alone, D to F a block
that can be pushed: up to 1,681 states. In the tests' home with two blocks, commands are heard and not acted on.

";

/// The file.
pub fn markdown(kept: &Kept) -> String {
    let bytes = BYTES.map(|(name, title)| (name, title.to_owned()));
    let instructions = INSTRUCTIONS.map(|(name, title)| (name, title.to_owned()));
    let calls = CALLS.map(|(name, title)| (name, title.to_owned()));
    let plans: Vec<_> = Footprint::plans().map(|name| (name, name.trim_start_matches("plan-").to_uppercase())).collect();
    let mut text = HEAD.to_owned();
    text += &for_each(kept, |footprint| table(footprint, &bytes, Some(("statics", "stack"))));
    text += PROGRAMS;
    text += &for_each(kept, programs);
    text.push('\n');
    text += &for_each(kept, ways);
    text += AIMS;
    text += &aims(kept);
    text += WHY;
    text += BETWEEN;
    text += &for_each(kept, |footprint| table(footprint, &instructions, None));
    text += LONGEST;
    text += &for_each(kept, |footprint| table(footprint, &calls, None));
    text += PLANS;
    text += &for_each(kept, |footprint| table(footprint, &plans, None));
    text
}

/// The few numbers that the README has: those of one compiler.
pub fn brief(kept: &Kept) -> String {
    let columns = [("flash", "flash"), ("hear", "hearing a command"), ("hear-plan-act", "from a command to the first action")];
    let [flash, rest @ ..] = columns.map(|(name, title)| (name, title.to_owned()));
    let Some((_, footprint)) = kept.iter().next() else { return String::new() };
    // The first column stands before the sum, the others after it.
    let (bytes, instructions) = (table(footprint, &[flash], Some(("statics", "stack"))), table(footprint, &rest, None));
    let mut text = String::new();
    for (left, right) in bytes.lines().zip(instructions.lines()) {
        let (_, right) = right.trim_start_matches('|').split_once('|').unwrap_or(("", right));
        text += &format!("{left}{right}\n");
    }
    text
}

/// A part for each compiler, under its name.
fn for_each(kept: &Kept, part: impl Fn(&Footprint) -> String) -> String {
    let named = |(compiler, footprint): (&str, &Footprint)| format!("{compiler}:\n\n{}", part(footprint));
    kept.iter().map(named).collect::<Vec<_>>().join("\n")
}

/// The programs that are no course.
fn programs(footprint: &Footprint) -> String {
    let mut text = "| program |".to_owned() + &WHOLE.map(|(_, title)| format!(" {title} |")).concat();
    text += &format!("\n|---|{}\n", "---:|".repeat(WHOLE.len()));
    for (program, numbers) in footprint.programs() {
        let cell = |(name, _): (&str, _)| format!(" {} |", numbers.get(name).map_or("-".to_owned(), |&number| grouped(number)));
        text += &format!("| {program} |{}\n", WHOLE.map(cell).concat());
    }
    text
}

/// What tasks with ways take to plan for.
fn ways(footprint: &Footprint) -> String {
    let found =
        footprint.programs().find_map(|(_, numbers)| Some((numbers.get("tasks")?, numbers.get("hear")?, numbers.get("first-plan")?)));
    let Some((tasks, hear, plan)) = found else { return String::new() };
    format!(
        "In the home of three storeys, a command is heard in {} instructions, and the first plan for all {tasks} tasks, most of them with a\n\
         [way](ways.md), takes {}.\n",
        grouped(*hear),
        grouped(*plan)
    )
}

/// What was aimed at beside what is.
fn aims(kept: &Kept) -> String {
    let mut text = "| image, Cortex-M4F | aim |".to_owned();
    let mut line = "|---|---:|".to_owned();
    for (compiler, _) in kept.iter() {
        text += &format!(" {compiler} |");
        line += "---:|";
    }
    text += &format!("\n{line}\n");
    for (image, aim, row) in AIMED {
        text += &format!("| {image} | {} |", grouped(aim));
        for (_, footprint) in kept.iter() {
            let of_program =
                footprint.programs().find(|(program, _)| *program == row).and_then(|(_, numbers)| numbers.get("flash").copied());
            text += &format!(" {} |", grouped(of_program.unwrap_or_else(|| footprint.number(row, "flash"))));
        }
        text.push('\n');
    }
    text
}

/// One table; the sum of two columns after them, where one is asked for.
fn table(footprint: &Footprint, columns: &[(&str, String)], sum: Option<(&str, &str)>) -> String {
    let mut head = "| board, preset |".to_owned();
    let mut line = "|---|".to_owned();
    for (_, title) in columns {
        head += &format!(" {title} |");
        line += "---:|";
    }
    if sum.is_some() {
        head += " RAM in all |";
        line += "---:|";
    }
    let mut text = format!("{head}\n{line}\n");
    for row in footprint.rows() {
        text += &format!("| {row} |");
        for (name, _) in columns {
            text += &format!(" {} |", grouped(footprint.number(row, name)));
        }
        if let Some((one, other)) = sum {
            text += &format!(" {} |", grouped(footprint.number(row, one) + footprint.number(row, other)));
        }
        text.push('\n');
    }
    text
}

/// `1234567` as `1,234,567`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (position, digit) in digits.chars().enumerate() {
        if position > 0 && (digits.len() - position).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brief_table_has_the_sum_of_the_memory_between_bytes_and_instructions() {
        let row = r#"{"flash":50000,"statics":12000,"stack":3000,"hear":70000,"hear-plan-act":90000}"#;
        let json = format!(r#"{{"version":2,"compilers":{{"rustc 1":{{"rows":{{"board":{row}}},"programs":{{}}}}}}}}"#);
        let expected = "\
            | board, preset | flash | RAM in all | hearing a command | from a command to the first action |\n\
            |---|---:|---:|---:|---:|\n\
            | board | 50,000 | 15,000 | 70,000 | 90,000 |\n";
        assert_eq!(brief(&Kept::from_json(&json).unwrap()), expected);
    }

    #[test]
    fn numbers_are_grouped_by_thousands() {
        assert_eq!([7, 999, 1_000, 1_234_567].map(grouped), ["7", "999", "1,000", "1,234,567"]);
    }
}
