//! The numbers for people.

use super::measures::{BYTES, CALLS, Footprint, INSTRUCTIONS};

const HEAD: &str = "\
# What it costs

Written by `cargo xtask footprint`; `cargo xtask footprint --check` compares, and fails where an instruction count has risen by more than
5 %. Everything is measured on emulated boards while the paper's whole course runs: seven lessons with a simulated trainer, then five
commands in a home with two blocks, which are all understood. The firmware is in `firmware/`.

## Bytes

Flash is code, constants and the interrupt table, the course's own texts and homes among them. The deepest stack is measured by painting.

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
pub fn markdown(footprint: &Footprint) -> String {
    let bytes = BYTES.map(|(name, title)| (name, title.to_owned()));
    let instructions = INSTRUCTIONS.map(|(name, title)| (name, title.to_owned()));
    let calls = CALLS.map(|(name, title)| (name, title.to_owned()));
    let plans: Vec<_> = Footprint::plans().map(|name| (name, name.trim_start_matches("plan-").to_uppercase())).collect();
    let mut text = HEAD.to_owned();
    text += &table(footprint, &bytes, Some(("statics", "stack")));
    text += BETWEEN;
    text += &table(footprint, &instructions, None);
    text += LONGEST;
    text += &table(footprint, &calls, None);
    text += PLANS;
    text += &table(footprint, &plans, None);
    text
}

/// The few numbers that the README has.
pub fn brief(footprint: &Footprint) -> String {
    let columns = [("flash", "flash"), ("hear", "hearing a command"), ("hear-plan-act", "from a command to the first action")];
    let [flash, rest @ ..] = columns.map(|(name, title)| (name, title.to_owned()));
    // The first column stands before the sum, the others after it.
    let (bytes, instructions) = (table(footprint, &[flash], Some(("statics", "stack"))), table(footprint, &rest, None));
    let mut text = String::new();
    for (left, right) in bytes.lines().zip(instructions.lines()) {
        let (_, right) = right.trim_start_matches('|').split_once('|').unwrap_or(("", right));
        text += &format!("{left}{right}\n");
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
        let json = r#"{"version":1,"rows":{"board":{"flash":50000,"statics":12000,"stack":3000,"hear":70000,"hear-plan-act":90000}}}"#;
        let expected = "\
            | board, preset | flash | RAM in all | hearing a command | from a command to the first action |\n\
            |---|---:|---:|---:|---:|\n\
            | board | 50,000 | 15,000 | 70,000 | 90,000 |\n";
        assert_eq!(brief(&Footprint::from_json(json).unwrap()), expected);
    }

    #[test]
    fn numbers_are_grouped_by_thousands() {
        assert_eq!([7, 999, 1_000, 1_234_567].map(grouped), ["7", "999", "1,000", "1,234,567"]);
    }
}
