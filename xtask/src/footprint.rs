//! `cargo xtask footprint`: the robot's memory and instructions on each board, as committed tables.

use std::collections::BTreeMap;

use anyhow::{Context, Result, ensure};
use clap::Args;
use serde_json::{Value, json};
use xshell::Shell;

use crate::capi::{EVERY_FUNCTION, EVERY_FUNCTION_OF_BOARDS, EVERY_FUNCTION_OF_LEARNERS, HOME, LIFT, LIFT_ALONE, OBEY, TALK};
use crate::firmware::{FLASH, STATICS, Trial, alone, bytes, full, obeying, run_alone, trials};
use crate::process::shell;
use crate::toolchain::compiler;

/// The files of the numbers: for the check, and for people.
const NUMBERS: &str = "docs/footprint.json";
const PAGE: &str = "docs/footprint.md";
/// The deepest stack of the course, which `goodbot size` names.
const STACK: &str = "host-cli/src/size/stack.txt";

/// Per cent by which a number may rise before the tables must be renewed. Sizes may rise more, because they differ between toolchains.
const INSTRUCTIONS_MAY_RISE: u64 = 5;
const BYTES_MAY_RISE: u64 = 8;
/// Additional per cent for a compiler that is not in the tables.
const FOR_ANOTHER_COMPILER: u64 = 12;

/// Names of numbers, and their titles. Names joined by `+` stand for their sum.
type Columns = [(&'static str, &'static str)];

/// The page's tables, for each compiler.
const BYTES: [(&str, &str); 4] =
    [("flash", "flash"), ("statics", "static RAM"), ("stack", "deepest stack"), ("statics+stack", "RAM in all")];
const PROGRAMS: [(&str, &str); 3] = [("flash", "flash"), ("statics", "static RAM"), ("stack", "deepest stack")];
/// The first words of programs that only the check needs, because nobody's program calls every function.
const EVERY: &str = "C, every function,";
const INSTRUCTIONS: [(&str, &str); 4] =
    [("hear", "hearing a command"), ("act", "one action with feedback"), ("round", "one EM round"), ("kinds", "learning the kind of task")];
/// The other works of the course, which only the check needs.
const OTHER_WORKS: [&str; 2] = ["hear-plan-act", "finish"];
const CALLS: [(&str, &str); 5] = [
    ("longest-hear-call", "`hear_on`, 1 cell"),
    ("longest-plan-call", "`plan`, 8 expansions"),
    ("longest-act-call", "an action with feedback"),
    ("longest-finish-call", "`finish_on`, 1 cell"),
    ("longest-learn-call", "`learn`, 16 cells"),
];
/// The calls with full tables, on one board.
const FULL: [(&str, &str); 10] = [
    ("build", "`find_cells`, 1 cell, and `build`"),
    ("begin-hearing", "`begin_hearing`"),
    ("hear", "`hear_on`, 1 cell"),
    ("plan", "`plan`, 8 expansions"),
    ("decide", "`decide`"),
    ("act", "`acted`, `feedback`"),
    ("finish", "`finish_on`, 1 cell"),
    ("learn", "`learn`, 16 cells"),
    ("save", "`save_on`, 1 byte"),
    ("restore", "`restore_on`, 1 entry"),
];
/// The longest calls that `cargo xtask worst` found, with their stack, and the flash that each adds.
const WORST: [(&str, &str); 4] =
    [("instructions", "instructions"), ("instructions-m0", "on a Cortex-M0"), ("stack", "deepest stack"), ("flash", "flash")];
/// The first plans of the lessons' homes, which only the check needs.
const PLANS: [&str; 6] = ["plan-a", "plan-b", "plan-c", "plan-d", "plan-e", "plan-f"];
/// The lessons of those plans; the first two lessons share an environment.
const LESSONS: [usize; 6] = [0, 2, 3, 4, 5, 6];

/// What to do with the tables.
#[derive(Args)]
pub struct Options {
    /// Compares with the committed tables and writes nothing
    #[arg(long)]
    check: bool,
    /// Writes the tables again from the committed numbers, and measures nothing
    #[arg(long, conflicts_with = "check")]
    kept: bool,
}

/// Numbers by name, for each board and preset, or for each program.
type Rows = BTreeMap<String, BTreeMap<String, u64>>;
/// The numbers of one compiler: `rows` for the course, `programs` for other programs, `full` for the calls with full tables, `worst` for
/// those that a search found.
type Footprint = BTreeMap<String, Rows>;
/// The numbers of each compiler.
type Kept = BTreeMap<String, Footprint>;

/// Measures, and writes the tables or compares with them.
pub fn run(options: &Options) -> Result<()> {
    if options.check {
        return check(true);
    }
    let sh = shell()?;
    let mut kept = if options.kept { kept()? } else { kept().unwrap_or_default() };
    if !options.kept {
        renew(&mut kept, &compiler()?, measure(trials(true)?, false)?);
    }
    write(&sh, &kept)?;
    eprintln!("written: {NUMBERS}, the tables in {PAGE}, and {STACK}");
    Ok(())
}

fn write(sh: &Shell, kept: &Kept) -> Result<()> {
    sh.write_file(NUMBERS, serde_json::to_string_pretty(&json!({ "version": 2, "compilers": kept }))? + "\n")?;
    sh.write_file(PAGE, renewed(&sh.read_file(PAGE)?, kept)?)?;
    Ok(sh.write_file(STACK, deepest_stack(kept))?)
}

/// The deepest stack of the course on any board, as a line.
fn deepest_stack(kept: &Kept) -> String {
    let rows = kept.values().filter_map(|footprint| footprint.get("rows")).flat_map(Rows::values);
    format!("{}\n", rows.filter_map(|numbers| numbers.get("stack")).max().unwrap_or(&0))
}

/// Compares with the committed numbers, on all boards or on one of each set of instructions.
pub fn check(all_boards: bool) -> Result<()> {
    let kept = kept()?;
    let page = shell()?.read_file(PAGE)?;
    let says_the_same = page == renewed(&page, &kept)? && shell()?.read_file(STACK)? == deepest_stack(&kept);
    ensure!(says_the_same, "{PAGE} or {STACK} does not say what {NUMBERS} says: write them again with `cargo xtask footprint --kept`");
    let complaints = against(&kept, &compiler()?, &measure(trials(all_boards)?, true)?);
    ensure!(complaints.is_empty(), "{}\n{} numbers are higher than {PAGE} says", complaints.join("\n"), complaints.len());
    println!("every row is within what {PAGE} says");
    Ok(())
}

/// Writes the table of the longest calls that a search found: of each the numbers of its columns.
pub fn write_worst(found: impl Iterator<Item = (String, [u64; WORST.len()])>) -> Result<()> {
    let (sh, mut kept) = (shell()?, kept()?);
    let columns = WORST.map(|(name, _)| name.to_owned());
    let rows = found.map(|(call, numbers)| (call, columns.clone().into_iter().zip(numbers).collect())).collect();
    kept.entry(compiler()?).or_default().insert("worst".to_owned(), rows);
    write(&sh, &kept)
}

fn kept() -> Result<Kept> {
    let mut kept: Value = serde_json::from_str(&shell()?.read_file(NUMBERS)?)?;
    serde_json::from_value(kept.get_mut("compilers").map(Value::take).unwrap_or_default())
        .with_context(|| format!("{NUMBERS} is not what `cargo xtask footprint` writes"))
}

/// Stores the numbers of this compiler in place of those of its other versions.
fn renew(kept: &mut Kept, compiler: &str, mut footprint: Footprint) {
    let kind = |name: &str| name.rsplit_once(' ').map(|(kind, _)| kind.to_owned());
    // What a long search found stays until the next one.
    let searched = kept.iter().find(|(name, _)| kind(name) == kind(compiler)).and_then(|(_, old)| old.get("worst"));
    footprint.extend(searched.map(|rows| ("worst".to_owned(), rows.clone())));
    kept.retain(|name, _| kind(name) != kind(compiler));
    kept.insert(compiler.to_owned(), footprint);
}

/// Measures the binaries. A check leaves out the ones that take long to build.
fn measure(trials: &[Trial], is_check: bool) -> Result<Footprint> {
    let (mut rows, mut programs, mut with_full_tables) = (Rows::new(), Rows::new(), Rows::new());
    for Trial { image, course, tick } in trials {
        let mut row = BTreeMap::from([("flash".to_owned(), bytes(&image.binary("course"), &FLASH)?)]);
        for name in ["statics", "stack"].into_iter().chain(INSTRUCTIONS.map(|(name, _)| name)).chain(OTHER_WORKS) {
            row.insert(name.to_owned(), course.number(name)?);
        }
        for (name, _) in CALLS {
            row.insert(name.to_owned(), tick.number(name.trim_start_matches("longest-").trim_end_matches("-call"))?);
        }
        let plans = course.all("first-plan");
        for (name, lesson) in PLANS.into_iter().zip(LESSONS) {
            row.insert(name.to_owned(), *plans.get(lesson).context("a lesson's plan is missing")?);
        }
        rows.insert(format!("{} ({}), {}", image.board.name, image.board.processor, image.board.preset), row);
    }
    let [arm, ways] = alone()?;
    let mut binaries = vec![
        ("Rust, an arm of one's own (firmware/src/arm.rs)", arm),
        ("Rust, the arm when it only obeys (firmware/src/obey.rs)", obeying()?),
        ("Rust, three storeys with ways (firmware/src/ways.rs)", ways),
        ("C, every function, the default features and `talk`", EVERY_FUNCTION.build()?),
        ("C, every function, the default features", EVERY_FUNCTION_OF_BOARDS.build()?),
        ("C, a robot in homes (capi/examples/home.c), the default features", HOME.build()?),
        ("C, a table robot (capi/examples/lift.c), the default features", LIFT.build()?),
    ];
    if !is_check {
        let learners = EVERY_FUNCTION_OF_LEARNERS.build()?;
        binaries.push(("C, every function, `--features checks,forgetting,home,learning,table`", learners));
        binaries.push(("C, a table robot (capi/examples/lift.c), `--features checks,learning,table`", LIFT_ALONE.build()?));
        binaries.push(("C, a lift that only obeys (capi/examples/obey.c), `--features table`", OBEY.build()?));
        binaries.push(("C, a robot that is talked to (capi/examples/talk.c), the default features and `talk`", TALK.build()?));
        let report = run_alone(&full()?)?;
        let calls = FULL.iter().map(|(name, _)| Ok(((*name).to_owned(), report.number(name)?))).collect::<Result<_>>()?;
        with_full_tables.insert("mps2-an386 (Cortex-M4F)".to_owned(), calls);
    }
    for (name, binary) in binaries {
        let report = run_alone(&binary)?;
        let row = programs.entry(name.to_owned()).or_default();
        let (flash, statics) = (bytes(&binary, &FLASH)?, bytes(&binary, &STATICS)?);
        row.extend(
            [("flash", flash), ("statics", statics), ("stack", report.number("stack")?)].map(|(name, number)| (name.to_owned(), number)),
        );
        // Some programs count all their instructions, others parts of them. One that counts none could never be found to cost more.
        let counts = ["instructions", "tasks", "hear", "first-plan"].map(|name| (name, report.all(name)));
        ensure!(
            counts.iter().any(|(name, numbers)| *name != "tasks" && !numbers.is_empty()),
            "{} did not report what its work costs",
            binary.display()
        );
        row.extend(counts.iter().filter_map(|(name, numbers)| Some(((*name).to_owned(), *numbers.first()?))));
    }
    Ok([("rows", rows), ("programs", programs), ("full", with_full_tables)].map(|(kind, rows)| (kind.to_owned(), rows)).into())
}

/// Complaints about numbers that rose, compared with the same compiler's; if it is new, with those of the compiler that gives the fewest.
fn against(kept: &Kept, compiler: &str, found: &Footprint) -> Vec<String> {
    if let Some(kept) = kept.get(compiler) {
        return risen(found, kept, 0);
    }
    let complaints = kept.values().map(|kept| risen(found, kept, FOR_ANOTHER_COMPILER));
    complaints.min_by_key(Vec::len).unwrap_or_else(|| vec!["the table is empty".to_owned()])
}

/// Complaints about numbers that rose by more than their limit plus `more` per cent, or that are not in the tables.
fn risen(now: &Footprint, before: &Footprint, more: u64) -> Vec<String> {
    let mut complaints = Vec::new();
    for (kind, rows) in now {
        for (row, numbers) in rows {
            for (name, &found) in numbers {
                let may_rise = more + if BYTES.iter().any(|(of, _)| of == name) { BYTES_MAY_RISE } else { INSTRUCTIONS_MAY_RISE };
                match before.get(kind).and_then(|rows| rows.get(row)?.get(name)) {
                    None => complaints.push(format!("{row}: {name} is {found}, and the table does not have it")),
                    Some(was) if found * 100 > was * (100 + may_rise) => {
                        complaints.push(format!("{row}: {name} is {found} and was {was}: more than {may_rise} % higher"));
                    }
                    Some(_) => {}
                }
            }
        }
    }
    complaints
}

/// The page with its tables made from the numbers.
fn renewed(page: &str, kept: &Kept) -> Result<String> {
    let tables: [(&str, &str, &str, &Columns); 6] = [
        ("bytes", "rows", "board, preset", &BYTES),
        ("programs", "programs", "program", &PROGRAMS),
        ("instructions", "rows", "board, preset", &INSTRUCTIONS),
        ("calls", "rows", "board, preset", &CALLS),
        ("full", "full", "board", &FULL),
        ("worst", "worst", "call", &WORST),
    ];
    let rows = |footprint: &Footprint, kind| shown(kind, footprint.get(kind).cloned().unwrap_or_default());
    tables.into_iter().try_fold(page.to_owned(), |page, (mark, kind, head, columns)| {
        let each = kept.iter().map(|(compiler, footprint)| format!("{compiler}:\n\n{}", table(head, &rows(footprint, kind), columns)));
        with_table(&page, mark, &each.collect::<Vec<_>>().join("\n"))
    })
}

/// The rows that the page has: programs like a reader's, and of boards that run the same firmware the first.
fn shown(kind: &str, mut rows: Rows) -> Rows {
    let mut before = None;
    rows.retain(|name, numbers| {
        let is_told = before.replace(numbers.clone()).as_ref() == Some(numbers);
        match kind {
            "rows" => !is_told,
            "programs" => !name.starts_with(EVERY),
            _ => true,
        }
    });
    rows
}

/// A text whose part between the marks is replaced by this table.
fn with_table(text: &str, mark: &str, table: &str) -> Result<String> {
    let [begin, end] = [format!("<!-- {mark} -->\n"), format!("<!-- /{mark} -->")];
    let found = text.split_once(&begin).and_then(|(before, rest)| Some((before, rest.split_once(&end)?.1)));
    let (before, after) = found.with_context(|| format!("there is no line `{}` before a line `{end}`", begin.trim()))?;
    Ok(format!("{before}{begin}{table}{end}{after}"))
}

/// One table: these columns of all rows.
fn table(head: &str, rows: &Rows, columns: &Columns) -> String {
    let titles = columns.iter().map(|(_, title)| format!(" {title} |")).collect::<String>();
    let mut text = format!("| {head} |{titles}\n|---|{}\n", "---:|".repeat(columns.len()));
    for (row, numbers) in rows {
        let number = |names: &str| names.split('+').map(|name| numbers.get(name)).sum::<Option<u64>>();
        let cells = columns.iter().map(|(names, _)| format!(" {} |", number(names).map_or("-".to_owned(), grouped)));
        text += &format!("| {row} |{}\n", cells.collect::<String>());
    }
    text
}

/// `1234567` as `1,234,567`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, number: u64) -> Footprint {
        let rows = BTreeMap::from([("board".to_owned(), BTreeMap::from([(name.to_owned(), number)]))]);
        Footprint::from([("rows".to_owned(), rows)])
    }

    fn kept(name: &str, number: u64) -> Kept {
        Kept::from([("rustc 1".to_owned(), of(name, number))])
    }

    #[test]
    fn a_rise_of_more_than_five_per_cent_is_complained_of() {
        let against = |found| against(&kept("hear", 1000), "rustc 1", &of("hear", found));
        assert!(against(1050).is_empty());
        assert_eq!(against(1051), ["board: hear is 1051 and was 1000: more than 5 % higher"]);
        assert!(against(500).is_empty());
    }

    #[test]
    fn sizes_may_differ_by_a_little_more() {
        assert!(against(&kept("flash", 1000), "rustc 1", &of("flash", 1080)).is_empty());
        assert_eq!(against(&kept("flash", 1000), "rustc 1", &of("flash", 1081)).len(), 1);
    }

    #[test]
    fn a_number_that_the_table_does_not_have_is_complained_of() {
        assert_eq!(against(&kept("hear", 1), "rustc 1", &of("act", 1)).len(), 1);
        assert_eq!(against(&Kept::default(), "rustc 1", &of("act", 1)), ["the table is empty"]);
    }

    #[test]
    fn a_compiler_that_is_not_in_the_table_may_come_to_more_and_not_to_much_more() {
        assert!(against(&kept("hear", 1000), "rustc 2", &of("hear", 1170)).is_empty());
        assert_eq!(against(&kept("hear", 1000), "rustc 2", &of("hear", 1171)).len(), 1);
    }

    #[test]
    fn a_new_version_of_a_compiler_takes_the_place_of_the_old_one() {
        let mut kept = kept("hear", 1000);
        renew(&mut kept, "rustc 2", of("hear", 900));
        renew(&mut kept, "another rustc 1", of("hear", 800));
        assert_eq!(kept.keys().collect::<Vec<_>>(), ["another rustc 1", "rustc 2"]);
    }

    #[test]
    fn the_stack_that_is_told_is_the_deepest_of_all_boards() {
        let mut kept = kept("stack", 900);
        renew(&mut kept, "another rustc 1", of("stack", 1000));
        assert_eq!(deepest_stack(&kept), "1000\n");
    }

    #[test]
    fn the_table_takes_the_place_of_the_old_one_alone() {
        let readme = "# Title\n<!-- footprint -->\n| old |\n<!-- /footprint -->\nThe end.\n";
        assert_eq!(with_table(readme, "footprint", "| new |\n").unwrap(), readme.replace("old", "new"));
        assert!(with_table("# Title\n", "footprint", "").is_err());
    }

    #[test]
    fn the_page_lists_programs_like_a_readers_and_boards_with_the_same_numbers_once() {
        let rows = |numbers: [u64; 3]| -> Rows {
            let named = ["a", "b", "c"].into_iter().zip(numbers);
            named.map(|(row, number)| (row.to_owned(), BTreeMap::from([("instructions".to_owned(), number)]))).collect()
        };
        assert!(shown("rows", rows([1, 1, 2])).into_keys().eq(["a", "c"]));
        assert_eq!(shown("rows", rows([1, 2, 1])).len(), 3);
        assert_eq!(shown("programs", rows([1, 1, 1])).len(), 3);
        let every = Rows::from([(format!("{EVERY} the default features"), BTreeMap::new())]);
        assert!(shown("programs", every).is_empty());
    }

    #[test]
    fn a_table_has_numbers_grouped_by_thousands_sums_of_them_and_a_dash_where_there_is_none() {
        let rows = Rows::from([("board".to_owned(), BTreeMap::from([("statics".to_owned(), 12_000), ("stack".to_owned(), 999)]))]);
        let expected = "| preset | static | RAM in all | hearing |\n|---|---:|---:|---:|\n| board | 12,000 | 12,999 | - |\n";
        assert_eq!(table("preset", &rows, &[("statics", "static"), ("statics+stack", "RAM in all"), ("hear", "hearing")]), expected);
        assert_eq!([7, 999, 1_000, 1_234_567].map(grouped), ["7", "999", "1,000", "1,234,567"]);
    }
}
