//! Steps that run in parallel with the others, those of each lane in a process of their own. The process's output is shown line by line; a
//! file reports how its steps ended.

use super::step::{End, Outcome, Step, Tally};
use crate::process::{shell, target_dir};
use anyhow::{Context, Result, anyhow, ensure};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;

pub struct ParallelSteps {
    child: Child,
    report: PathBuf,
    shown: JoinHandle<()>,
}

impl ParallelSteps {
    pub fn start(lane: usize, steps: &[Step], all_boards: bool) -> Result<Self> {
        let report = target_dir().join(format!("parallel-steps-{lane}.json"));
        shell()?.remove_path(&report)?;
        let (reader, writer) = std::io::pipe()?;
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["test", "--report"]).arg(&report).args(steps.iter().flat_map(|step| ["--only".to_owned(), step.name()]));
        command.args(all_boards.then_some("--all-boards"));
        let child = command.stdin(Stdio::null()).stdout(writer.try_clone()?).stderr(writer).spawn().context("the parallel steps")?;
        // The reader ends when nobody holds the writer any more.
        drop(command);
        let shown = std::thread::spawn(|| {
            for line in BufReader::new(reader).split(b'\n').map_while(Result::ok) {
                println!("| {}", String::from_utf8_lossy(&line));
            }
        });
        Ok(Self { child, report, shown })
    }

    /// Whether it has ended with a failed step, or too early.
    pub fn has_failed(&mut self) -> bool {
        let Ok(Some(status)) = self.child.try_wait() else { return false };
        !status.success() || read(&self.report).map_or(true, |(ends, _)| ends.iter().any(|(_, _, outcome)| *outcome == Outcome::Failed))
    }

    /// Waits for its end, or stops it if `at_once`. Returns how its steps ended so far, and the tests that they counted.
    pub fn end(mut self, at_once: bool) -> Result<(Vec<End>, Tally)> {
        if at_once && self.child.try_wait()?.is_none() {
            self.child.kill()?;
            self.child.wait()?;
            return Ok(read(&self.report).unwrap_or_default());
        }
        let status = self.child.wait()?;
        // A process stopped from outside may have reported its first steps, all passed.
        ensure!(status.success(), "the parallel steps did not come to their end ({status})");
        self.shown.join().map_err(|_| anyhow!("the parallel steps could not be shown"))?;
        read(&self.report)
    }
}

/// Writes how steps ended, and the tests that they counted.
pub fn report(file: &Path, ends: &[End], tally: Tally) -> Result<()> {
    Ok(shell()?.write_file(file, serde_json::to_string(&(ends, tally))?)?)
}

fn read(file: &Path) -> Result<(Vec<End>, Tally)> {
    let text = shell()?.read_file(file).context("the parallel steps did not come to their end")?;
    Ok(serde_json::from_str(&text)?)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn what_is_written_of_steps_is_read_as_it_was() {
        let sh = shell().unwrap();
        let folder = sh.create_temp_dir().unwrap();
        let file = folder.path().join("report.json");
        let time = Duration::from_millis(1_500);
        let ends = [
            (Step::Portable, time, Outcome::Passed),
            (Step::CHost, time, Outcome::LeftOut("no gcc".to_owned())),
            (Step::Guide, time, Outcome::Failed),
        ];
        let tally = Tally { passed: 7, failed: 1, skipped: 2 };
        report(&file, &ends, tally).unwrap();
        assert_eq!(read(&file).unwrap(), (ends.to_vec(), tally));
        assert!(read(&folder.path().join("none")).unwrap_err().to_string().contains("did not come to their end"));
    }
}
