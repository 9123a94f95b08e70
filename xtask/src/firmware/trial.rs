//! Everything that is built and run for the emulated boards, once in a run of this program.

use std::sync::OnceLock;

use anyhow::{Context, Result, bail};

use super::board::{Board, Preset, emulate};
use super::image::Image;

/// The firmware that is measured.
const ROWS: [(Board, Preset); 5] = [
    (Board::An386, Preset::Small),
    (Board::An386, Preset::Tiny),
    (Board::An385, Preset::Small),
    (Board::An385, Preset::Tiny),
    (Board::Microbit, Preset::Tiny),
];

/// What a firmware ends with that the processor stopped by a fault.
const FAULT: i32 = 102;

/// What a binary said: lines of a name and a number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report(Vec<(String, u64)>);

impl Report {
    fn read(text: &str) -> Self {
        let line = |line: &str| {
            let (name, number) = line.split_once(' ')?;
            Some((name.to_owned(), number.trim().parse().ok()?))
        };
        Self(text.lines().filter_map(line).collect())
    }

    /// All numbers of a name, in order.
    pub fn all(&self, name: &str) -> Vec<u64> {
        self.0.iter().filter(|(of, _)| of == name).map(|&(_, number)| number).collect()
    }

    /// The number of a name.
    pub fn number(&self, name: &str) -> Result<u64> {
        self.all(name).first().copied().with_context(|| format!("the firmware did not report `{name}`"))
    }
}

/// One firmware, built and run.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The board.
    pub board: Board,
    /// The preset.
    pub preset: Preset,
    /// What was linked.
    pub image: Image,
    /// What the course cost.
    pub course: Report,
    /// What the loop with a fixed tick cost.
    pub tick: Report,
}

impl Trial {
    /// Its name in tables.
    pub fn name(&self) -> String {
        format!("{} {}", self.board.name(), self.preset.name())
    }

    fn run(board: Board, preset: Preset) -> Result<Self> {
        let image = Image::build(board, preset)?;
        let report = |binary: &str| {
            let (code, said) = emulate(board, &image.binary(binary))?;
            if code != 0 {
                bail!("`{binary}` ended with {code} on {}; it said:\n{said}", board.name());
            }
            Ok(Report::read(&said))
        };
        // Otherwise what follows would prove nothing: a stack that runs over could change the numbers that are measured.
        let (code, said) = emulate(board, &image.binary("overflow"))?;
        if code != FAULT {
            bail!("no fault stops a stack that runs over on {}: `overflow` ended with {code} and said:\n{said}", board.name());
        }
        let (course, tick) = (report("course")?, report("tick")?);
        Ok(Self { board, preset, image, course, tick })
    }
}

/// All of them. A binary that does not end with 0 is an error.
pub fn trials() -> Result<&'static [Trial]> {
    static DONE: OnceLock<Vec<Trial>> = OnceLock::new();
    if let Some(done) = DONE.get() {
        return Ok(done);
    }
    let mut trials = Vec::new();
    for (board, preset) in ROWS {
        let trial = Trial::run(board, preset)?;
        eprintln!("{}: {} of {} tests", trial.name(), trial.course.number("passed")?, trial.course.number("tests")?);
        trials.push(trial);
    }
    Ok(DONE.get_or_init(|| trials))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_names_and_numbers() {
        let report = Report::read("stack 4268\nplan 1\nplan 2\nerror: no room\n");
        assert_eq!(report.number("stack").unwrap(), 4268);
        assert_eq!(report.all("plan"), [1, 2]);
        assert!(report.number("statics").unwrap_err().to_string().contains("statics"));
    }
}
