//! Running other programs.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

fn start(command: &mut Command) -> Result<Child> {
    command.spawn().with_context(|| format!("`{}` could not be started", shown(command)))
}

/// Runs a program, its output shown as it comes. It is an error if the program fails.
pub fn run(command: &mut Command) -> Result<()> {
    let status = start(command)?.wait()?;
    if !status.success() {
        bail!("`{}` failed ({status})", shown(command));
    }
    Ok(())
}

/// Runs a program and returns what it prints. It is an error if the program fails, with what it says of that.
pub fn capture(command: &mut Command) -> Result<String> {
    let output = start(command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()))?.wait_with_output()?;
    if !output.status.success() {
        bail!("`{}` failed ({}): {}", shown(command), output.status, String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The same, with the program's messages shown as they come.
pub fn capture_output(command: &mut Command) -> Result<String> {
    let output = start(command.stdin(Stdio::null()).stdout(Stdio::piped()))?.wait_with_output()?;
    if !output.status.success() {
        bail!("`{}` failed ({})", shown(command), output.status);
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Runs a program, shows its output and hands over every line of it. It is an error if the program fails.
pub fn run_with_lines(command: &mut Command, mut each: impl FnMut(&str)) -> Result<()> {
    let (reader, writer) = std::io::pipe()?;
    let mut child = start(command.stdout(writer.try_clone()?).stderr(writer))?;
    // The command holds the pipe's other ends, and reading ends when they are closed.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let (mut reader, mut bytes) = (BufReader::new(reader), Vec::new());
    while reader.read_until(b'\n', &mut bytes)? > 0 {
        let text = String::from_utf8_lossy(&bytes);
        print!("{text}");
        each(text.trim_end());
        bytes.clear();
    }
    let status = child.wait()?;
    if !status.success() {
        bail!("`{}` failed ({status})", shown(command));
    }
    Ok(())
}

/// Runs a program that is stopped when `limit` has passed, and returns its exit code and what it prints to its standard output.
pub fn capture_within(command: &mut Command, limit: Duration) -> Result<(i32, String)> {
    let mut child = start(command.stdin(Stdio::null()).stdout(Stdio::piped()))?;
    let said = reader(child.stdout.take().context("no standard output")?);
    let start = Instant::now();
    while start.elapsed() < limit {
        if let Some(status) = child.try_wait()? {
            let code = status.code().with_context(|| format!("`{}` was stopped ({status})", shown(command)))?;
            return Ok((code, said.join().unwrap_or_default()));
        }
        thread::sleep(Duration::from_millis(20));
    }
    child.kill()?;
    child.wait()?;
    bail!("`{}` did not end within {} s; so far it said: {}", shown(command), limit.as_secs(), said.join().unwrap_or_default())
}

fn reader(mut from: impl Read + Send + 'static) -> JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        // What was read before a failure is still worth showing.
        let _ = from.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Where on the `PATH` a program is, if it is there.
pub fn find_program(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX))).find(|file| file.is_file())
}

/// A command as one would type it.
fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let mut line = lossy(program.file_name().unwrap_or(program.as_os_str()));
    for argument in command.get_args() {
        let argument = lossy(argument);
        line.push(' ');
        if argument.is_empty() || argument.contains(char::is_whitespace) {
            line.push_str(&format!("'{argument}'"));
        } else {
            line.push_str(&argument);
        }
    }
    line
}

fn lossy(text: &OsStr) -> String {
    text.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_typed() {
        let mut command = Command::new("/usr/bin/cargo");
        command.args(["test", "-p", "a b", ""]);
        assert_eq!(shown(&command), "cargo test -p 'a b' ''");
    }

    #[cfg(unix)]
    #[test]
    fn a_program_that_takes_too_long_is_stopped_and_one_that_ends_tells_its_code() {
        let error = capture_within(Command::new("sleep").arg("60"), Duration::from_millis(100)).unwrap_err();
        assert!(error.to_string().contains("did not end"), "{error}");
        let said = capture_within(Command::new("sh").args(["-c", "echo y; exit 3"]), Duration::from_secs(30)).unwrap();
        assert_eq!(said, (3, "y\n".to_owned()));
    }

    #[cfg(unix)]
    #[test]
    fn every_line_of_both_outputs_is_handed_over() {
        let mut lines = Vec::new();
        let mut command = Command::new("sh");
        command.args(["-c", "echo one; printf two >&2"]);
        run_with_lines(&mut command, |line| lines.push(line.to_owned())).unwrap();
        assert_eq!(lines, ["one", "two"]);
    }
}
