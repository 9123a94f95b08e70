//! The numbers of each row, and the file that keeps them for the check.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use crate::firmware::Trial;

/// Per cent by which a number may rise before the table has to be renewed: toolchains differ in the sizes that they come to.
const INSTRUCTIONS_MAY_RISE: u64 = 5;
const BYTES_MAY_RISE: u64 = 8;

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
    ("longest-plan-call", "`plan`, 50 expansions"),
    ("longest-act-call", "an action with feedback"),
    ("longest-finish-call", "`finish_on`, 1 cell"),
    ("longest-learn-call", "`learn`, 100 cells"),
];

/// The lesson whose first plan is shown for each environment, by position; the first two lessons share one.
const ENVIRONMENTS: [(&str, usize); 6] = [("plan-a", 0), ("plan-b", 2), ("plan-c", 3), ("plan-d", 4), ("plan-e", 5), ("plan-f", 6)];

/// The rows: for each board and preset, its numbers by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    rows: BTreeMap<String, BTreeMap<String, u64>>,
}

impl Footprint {
    /// From what was built and run.
    pub fn measure(trials: &[Trial]) -> Result<Self> {
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
        Ok(Self { rows })
    }

    /// Reads what [`to_json`](Self::to_json) wrote.
    pub fn from_json(text: &str) -> Result<Self> {
        let value: Value = serde_json::from_str(text)?;
        let mut rows = BTreeMap::new();
        for (name, row) in value["rows"].as_object().context("`rows` is missing")? {
            let numbers = row.as_object().context("a row is no object")?;
            let number = |(name, number): (&String, &Value)| Some((name.clone(), number.as_u64()?));
            rows.insert(name.clone(), numbers.iter().filter_map(number).collect());
        }
        Ok(Self { rows })
    }

    /// As a file.
    pub fn to_json(&self) -> Result<String> {
        Ok(format!("{}\n", serde_json::to_string_pretty(&json!({ "version": 1, "rows": self.rows }))?))
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

    /// What is higher here than it was, by more than it may be.
    pub fn against(&self, kept: &Self) -> Vec<String> {
        let mut complaints = Vec::new();
        for (row, numbers) in &self.rows {
            for (name, &found) in numbers {
                let Some(&was) = kept.rows.get(row).and_then(|row| row.get(name)) else {
                    complaints.push(format!("{row}: {name} is {found}, and the table does not have it"));
                    continue;
                };
                let may_rise = if BYTES.iter().any(|(of, _)| of == name) { BYTES_MAY_RISE } else { INSTRUCTIONS_MAY_RISE };
                if found * 100 > was * (100 + may_rise) {
                    complaints.push(format!("{row}: {name} is {found} and was {was}: more than {may_rise} % higher"));
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
        Footprint { rows: BTreeMap::from([("board".to_owned(), BTreeMap::from([(name.to_owned(), number)]))]) }
    }

    #[test]
    fn a_rise_of_more_than_five_per_cent_is_complained_of() {
        assert!(of("hear", 1050).against(&of("hear", 1000)).is_empty());
        assert_eq!(of("hear", 1051).against(&of("hear", 1000)), ["board: hear is 1051 and was 1000: more than 5 % higher"]);
        assert!(of("hear", 500).against(&of("hear", 1000)).is_empty());
    }

    #[test]
    fn sizes_may_differ_as_toolchains_do() {
        assert!(of("flash", 1080).against(&of("flash", 1000)).is_empty());
        assert_eq!(of("flash", 1081).against(&of("flash", 1000)).len(), 1);
    }

    #[test]
    fn a_number_that_the_table_does_not_have_is_complained_of() {
        assert_eq!(of("act", 1).against(&of("hear", 1)).len(), 1);
    }

    #[test]
    fn the_file_keeps_every_number() {
        let footprint = of("hear", 1234);
        assert_eq!(Footprint::from_json(&footprint.to_json().unwrap()).unwrap(), footprint);
    }
}
