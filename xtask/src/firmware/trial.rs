//! Everything that is built and run for the emulated boards, once in a run of this program.

use std::fmt;
use std::sync::OnceLock;

use anyhow::{Context, Result, anyhow, bail};

use super::board::{Board, Preset, emulate};
use super::image::Image;
use crate::programs::QEMU;

/// The firmware that is measured.
const ROWS: [(Board, Preset); 4] =
    [(Board::An386, Preset::Small), (Board::An386, Preset::Tiny), (Board::An385, Preset::Small), (Board::Microbit, Preset::Tiny)];

/// What a firmware ends with that the processor stopped by a fault.
const FAULT: i32 = 102;

/// What a binary said: lines of a name and a number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report(Vec<(String, u64)>);

impl Report {
    /// Reads what a binary said.
    pub fn read(text: &str) -> Self {
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

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<_> = self.0.iter().map(|(name, number)| format!("{name} {number}")).collect();
        f.write_str(&lines.join(", "))
    }
}

/// One firmware, built and run.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What was linked.
    pub image: Image,
    /// What the course cost.
    pub course: Report,
    /// What the loop with a fixed tick cost.
    pub tick: Report,
}

impl Trial {
    fn run(image: &Image) -> Result<Self> {
        let board = image.board;
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
        eprintln!("{}: {} of {} tests", image.name(), course.number("passed")?, course.number("tests")?);
        Ok(Self { image: image.clone(), course, tick })
    }
}

/// All firmware, built.
pub fn images() -> Result<&'static [Image]> {
    static DONE: OnceLock<Vec<Image>> = OnceLock::new();
    if let Some(done) = DONE.get() {
        return Ok(done);
    }
    let built: Result<Vec<_>> = ROWS.into_iter().map(|(board, preset)| Image::build(board, preset)).collect();
    let built = built?;
    Ok(DONE.get_or_init(|| built))
}

/// All firmware, built and run, two at a time. A binary that does not end with 0 is an error.
pub fn trials() -> Result<&'static [Trial]> {
    static DONE: OnceLock<Vec<Trial>> = OnceLock::new();
    if let Some(done) = DONE.get() {
        return Ok(done);
    }
    QEMU.path()?;
    let mut trials = Vec::new();
    for pair in images()?.chunks(2) {
        let ran: Vec<Result<Trial>> = std::thread::scope(|scope| {
            let threads: Vec<_> = pair.iter().map(|image| scope.spawn(|| Trial::run(image))).collect();
            let failed = |_| Err(anyhow!("a run in the emulator could not be followed"));
            threads.into_iter().map(|thread| thread.join().unwrap_or_else(failed)).collect()
        });
        trials.extend(ran.into_iter().collect::<Result<Vec<_>>>()?);
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
