//! The numbers of each row, and the file that keeps them for the check.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::programs;
use crate::firmware::Trial;
use crate::toolchain;

/// Per cent by which a number may rise before the table has to be renewed: toolchains differ in the sizes that they come to.
const INSTRUCTIONS_MAY_RISE: u64 = 5;
const BYTES_MAY_RISE: u64 = 8;
/// What a compiler that is not in the table may add to either.
const FOR_ANOTHER_COMPILER: u64 = 12;

/// What is counted in bytes.
pub const BYTES: [(&str, &str); 3] = [("flash", "flash"), ("statics", "static RAM"), ("stack", "deepest stack")];

/// What is counted in instructions, in the order of the table.
pub const INSTRUCTIONS: [(&str, &str); 6] = [
    ("hear", "hearing a command"),
    ("act", "one action with feedback"),
    ("hear-plan-act", "from a command to the first action"),
    ("finish", "ending a session"),
    ("round", "one EM round"),
    ("kinds", "learning the kind of task"),
];

/// The longest calls of a control loop, in the order of the table.
pub const CALLS: [(&str, &str); 5] = [
    ("longest-hear-call", "`hear_on`, 1 cell"),
    ("longest-plan-call", "`plan`, 8 expansions"),
    ("longest-act-call", "an action with feedback"),
    ("longest-finish-call", "`finish_on`, 1 cell"),
    ("longest-learn-call", "`learn`, 16 cells"),
];

/// The lesson whose first plan is shown for each environment, by position; the first two lessons share one.
const ENVIRONMENTS: [(&str, usize); 6] = [("plan-a", 0), ("plan-b", 2), ("plan-c", 3), ("plan-d", 4), ("plan-e", 5), ("plan-f", 6)];

/// What whole programs take: bytes, and instructions from the beginning to the end.
pub const WHOLE: [(&str, &str); 4] =
    [("flash", "flash"), ("statics", "static RAM"), ("stack", "deepest stack"), ("instructions", "instructions")];

/// Numbers by name, for each board and preset, or for each program.
type Rows = BTreeMap<String, BTreeMap<String, u64>>;

/// What one compiler's work costs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    /// The course, for each board and preset.
    rows: Rows,
    /// Other programs.
    programs: Rows,
}

/// What each compiler's work costs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Kept(BTreeMap<String, Footprint>);

impl Kept {
    /// Reads what [`to_json`](Self::to_json) wrote.
    pub fn from_json(text: &str) -> Result<Self> {
        let value: Value = serde_json::from_str(text)?;
        let compilers = value["compilers"].as_object().context("`compilers` is missing")?;
        let read = |(name, footprint): (&String, &Value)| Ok((name.clone(), Footprint::from_json(footprint)?));
        Ok(Self(compilers.iter().map(read).collect::<Result<_>>()?))
    }

    /// As a file.
    pub fn to_json(&self) -> Result<String> {
        let compilers: BTreeMap<_, _> = self.0.iter().map(|(name, footprint)| (name, footprint.to_json())).collect();
        Ok(format!("{}\n", serde_json::to_string_pretty(&json!({ "version": 2, "compilers": compilers }))?))
    }

    /// Every compiler with its numbers.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Footprint)> {
        self.0.iter().map(|(name, footprint)| (name.as_str(), footprint))
    }

    /// Keeps the numbers of this compiler, and no longer those of its other versions.
    pub fn renew(&mut self, compiler: &str, footprint: Footprint) {
        let kind = |name: &str| name.rsplit_once(' ').map(|(kind, _)| kind.to_owned());
        self.0.retain(|name, _| kind(name) != kind(compiler));
        self.0.insert(compiler.to_owned(), footprint);
    }

    /// What is higher, built by this compiler, than it was by the same one, or by any where it is not known.
    pub fn against(&self, compiler: &str, found: &Footprint) -> Vec<String> {
        match self.0.get(compiler) {
            Some(kept) => found.against(kept, 0),
            None => {
                let complaints = self.0.values().map(|kept| found.against(kept, FOR_ANOTHER_COMPILER));
                complaints.min_by_key(Vec::len).unwrap_or_else(|| vec!["the table is empty".to_owned()])
            }
        }
    }
}

/// The compiler whose work is measured.
pub fn compiler() -> Result<String> {
    toolchain::compiler()
}

impl Footprint {
    /// From what was built and run. What takes long to build is left out of a check.
    pub fn measure(trials: &[Trial], is_check: bool) -> Result<Self> {
        let mut rows = BTreeMap::new();
        for trial in trials {
            let (board, preset) = (trial.image.board, trial.image.preset);
            let mut row = BTreeMap::from([("flash".to_owned(), trial.image.flash("course")?)]);
            for name in ["statics", "stack", "hear", "act", "hear-plan-act", "finish", "round", "kinds"] {
                row.insert(name.to_owned(), trial.course.number(name)?);
            }
            for (name, _) in CALLS {
                let work = name.trim_start_matches("longest-").trim_end_matches("-call");
                row.insert(name.to_owned(), trial.tick.number(work)?);
            }
            let plans = trial.course.all("first-plan");
            for (name, lesson) in ENVIRONMENTS {
                row.insert(name.to_owned(), *plans.get(lesson).context("a lesson's plan is missing")?);
            }
            rows.insert(format!("{} ({}), {}", board.name(), board.processor(), preset.name()), row);
        }
        Ok(Self { rows, programs: programs::measure(is_check)? })
    }

    fn from_json(value: &Value) -> Result<Self> {
        let rows = |key: &str| {
            let mut rows = BTreeMap::new();
            for (name, row) in value[key].as_object().with_context(|| format!("`{key}` is missing"))? {
                let numbers = row.as_object().context("a row is no object")?;
                let number = |(name, number): (&String, &Value)| Some((name.clone(), number.as_u64()?));
                rows.insert(name.clone(), numbers.iter().filter_map(number).collect());
            }
            Ok::<Rows, anyhow::Error>(rows)
        };
        Ok(Self { rows: rows("rows")?, programs: rows("programs")? })
    }

    fn to_json(&self) -> Value {
        json!({ "rows": self.rows, "programs": self.programs })
    }

    /// The names of the rows.
    pub fn rows(&self) -> impl Iterator<Item = &str> {
        self.rows.keys().map(String::as_str)
    }

    /// One number.
    pub fn number(&self, row: &str, name: &str) -> u64 {
        self.rows.get(row).and_then(|row| row.get(name)).copied().unwrap_or(0)
    }

    /// The names of the plans, by environment.
    pub fn plans() -> impl Iterator<Item = &'static str> {
        ENVIRONMENTS.iter().map(|&(name, _)| name)
    }

    /// The other programs, with their numbers by name.
    pub fn programs(&self) -> impl Iterator<Item = (&str, &BTreeMap<String, u64>)> {
        self.programs.iter().map(|(program, numbers)| (program.as_str(), numbers))
    }

    /// What is higher here than it was, by more than it may be and so many per cent more.
    fn against(&self, kept: &Self, more: u64) -> Vec<String> {
        let mut complaints = Vec::new();
        for (now, before) in [(&self.rows, &kept.rows), (&self.programs, &kept.programs)] {
            for (row, numbers) in now {
                for (name, &found) in numbers {
                    let Some(&was) = before.get(row).and_then(|row| row.get(name)) else {
                        complaints.push(format!("{row}: {name} is {found}, and the table does not have it"));
                        continue;
                    };
                    let may_rise = more + if BYTES.iter().any(|(of, _)| of == name) { BYTES_MAY_RISE } else { INSTRUCTIONS_MAY_RISE };
                    if found * 100 > was * (100 + may_rise) {
                        complaints.push(format!("{row}: {name} is {found} and was {was}: more than {may_rise} % higher"));
                    }
                }
            }
        }
        complaints
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, number: u64) -> Footprint {
        let rows = BTreeMap::from([("board".to_owned(), BTreeMap::from([(name.to_owned(), number)]))]);
        Footprint { rows, ..Footprint::default() }
    }

    fn kept(name: &str, number: u64) -> Kept {
        Kept(BTreeMap::from([("rustc 1".to_owned(), of(name, number))]))
    }

    fn against(found: &Footprint, kept: &Kept) -> Vec<String> {
        kept.against("rustc 1", found)
    }

    #[test]
    fn a_rise_of_more_than_five_per_cent_is_complained_of() {
        assert!(against(&of("hear", 1050), &kept("hear", 1000)).is_empty());
        let complaints = against(&of("hear", 1051), &kept("hear", 1000));
        assert_eq!(complaints, ["board: hear is 1051 and was 1000: more than 5 % higher"]);
        assert!(against(&of("hear", 500), &kept("hear", 1000)).is_empty());
    }

    #[test]
    fn sizes_may_differ_by_a_little_more() {
        assert!(against(&of("flash", 1080), &kept("flash", 1000)).is_empty());
        assert_eq!(against(&of("flash", 1081), &kept("flash", 1000)).len(), 1);
    }

    #[test]
    fn a_number_that_the_table_does_not_have_is_complained_of() {
        assert_eq!(against(&of("act", 1), &kept("hear", 1)).len(), 1);
        assert_eq!(Kept::default().against("rustc 1", &of("act", 1)), ["the table is empty"]);
    }

    #[test]
    fn a_compiler_that_is_not_in_the_table_may_come_to_more_and_not_to_much_more() {
        assert!(kept("hear", 1000).against("rustc 2", &of("hear", 1170)).is_empty());
        assert_eq!(kept("hear", 1000).against("rustc 2", &of("hear", 1171)).len(), 1);
    }

    #[test]
    fn a_new_version_of_a_compiler_takes_the_place_of_the_old_one() {
        let mut kept = kept("hear", 1000);
        kept.renew("rustc 2", of("hear", 900));
        kept.renew("another rustc 1", of("hear", 800));
        assert_eq!(kept.iter().map(|(name, _)| name).collect::<Vec<_>>(), ["another rustc 1", "rustc 2"]);
    }

    #[test]
    fn the_file_keeps_every_number() {
        let mut all = kept("hear", 1234);
        let rows = of("flash", 7).rows;
        all.renew("another 1", Footprint { programs: rows, ..Footprint::default() });
        assert_eq!(Kept::from_json(&all.to_json().unwrap()).unwrap(), all);
    }
}
