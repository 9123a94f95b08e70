//! Remarks and progress on standard error. `--quiet` suppresses them.

use crate::printed::Printed;
use goodbot_lesson::Fault;
use indicatif::{ProgressBar, ProgressStyle};
use std::borrow::Cow;
use std::collections::HashMap;
use std::hash::Hash;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The time between two updates of a spinner.
const BEAT: Duration = Duration::from_millis(250);

static QUIET: AtomicBool = AtomicBool::new(false);
static COLORED: AtomicBool = AtomicBool::new(false);

/// Sets whether standard output may have colours.
pub fn set_colored(colored: bool) {
    COLORED.store(colored, Ordering::Relaxed);
}

/// Whether standard output may have colours.
pub fn is_colored() -> bool {
    COLORED.load(Ordering::Relaxed)
}

/// From now on, only failures are told.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether only failures are told.
pub fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Writes a remark to standard error, unless `--quiet` was given.
#[macro_export]
macro_rules! say {
    ($($text:tt)*) => {
        if !$crate::messages::is_quiet() {
            $crate::messages::tell(&format!($($text)*));
        }
    };
}
pub use crate::say;

/// Writes a line to standard error. Where it cannot be written, as on a full disk, the work goes on.
pub fn tell(line: &str) {
    let mut out = Printed::stderr();
    let _ = writeln!(out, "{line}").and_then(|()| out.flush());
}

/// A count with its noun: "1 session", "2 sessions".
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// A spinner on standard error, for work of unknown length. It shows on a terminal only.
pub fn working(what: impl Into<Cow<'static, str>>) -> ProgressBar {
    if is_quiet() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{spinner} {msg} {elapsed}").unwrap_or_else(|_| ProgressStyle::default_spinner());
    let working = ProgressBar::new_spinner().with_style(style).with_message(what);
    working.enable_steady_tick(BEAT);
    working
}

/// A spinner with a count, on standard error. It shows on a terminal only.
pub fn counting(what: &'static str) -> ProgressBar {
    let counting = working(what);
    let style = ProgressStyle::with_template("{spinner} {msg}: {human_pos} {elapsed}").unwrap_or_else(|_| ProgressStyle::default_spinner());
    counting.with_style(style)
}

/// Faults as lines of text. Faults that differ in numbers only are summed: the first one, with their count.
pub fn summed(faults: &[Fault]) -> Vec<String> {
    // Numbers differ between lines.
    let text = |fault: &Fault| fault.message.chars().filter(|letter| !letter.is_ascii_digit()).collect::<String>();
    summed_by(faults, |fault| (fault.file.clone(), fault.field.clone(), text(fault)))
}

/// Faults as lines of text. Faults with the same key are summed: the first one, with their count.
pub fn summed_by<K: Eq + Hash>(faults: &[Fault], key: impl Fn(&Fault) -> K) -> Vec<String> {
    let mut same: HashMap<K, usize> = HashMap::new();
    let mut told: Vec<(&Fault, usize)> = Vec::new();
    for fault in faults {
        let at = *same.entry(key(fault)).or_insert(told.len());
        match told.get_mut(at) {
            Some((_, more)) => *more += 1,
            None => told.push((fault, 0)),
        }
    }
    let line = |(fault, more): (&Fault, usize)| match more {
        0 => fault.to_string(),
        more => format!("{fault}; and {} like it", counted(more, "line")),
    };
    told.into_iter().map(line).collect()
}

/// A progress bar on standard error. It shows on a terminal only.
pub fn bar(length: usize, what: &'static str) -> ProgressBar {
    if is_quiet() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{msg} {bar:30} {pos}/{len} {elapsed}, {eta} left");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length as u64).with_style(style).with_message(what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_many_lines_is_told_once_with_their_count() {
        let fault = |line, message: &str| Fault::on_line("log", line, message);
        let faults = [fault(1, "the sum is 0.9"), fault(2, "no end"), fault(3, "the sum is 0.8"), fault(5, "the sum is 0.7")];
        assert_eq!(summed(&faults), ["log:1: the sum is 0.9; and 2 lines like it", "log:2: no end"]);
    }
}
