//! Remarks and progress on standard error. `--quiet` leaves them out.

use indicatif::{ProgressBar, ProgressStyle};
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};

static QUIET: AtomicBool = AtomicBool::new(false);
static COLORED: AtomicBool = AtomicBool::new(false);

/// Says whether standard output may have colours.
pub fn set_colored(colored: bool) {
    COLORED.store(colored, Ordering::Relaxed);
}

/// Whether standard output may have colours.
pub fn is_colored() -> bool {
    COLORED.load(Ordering::Relaxed)
}

/// From now on nothing is told but failures.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether nothing is told but failures.
pub fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Tells a remark on standard error, unless it is to be quiet.
#[macro_export]
macro_rules! say {
    ($($text:tt)*) => {
        if !$crate::messages::is_quiet() {
            eprintln!("{}", $crate::messages::printable(&format!($($text)*)));
        }
    };
}
pub use crate::say;

/// A text for a terminal: control characters, which names of files and texts of logs may have, are shown and not obeyed. Lines and tabs stay.
pub fn printable(text: &str) -> Cow<'_, str> {
    let obeyed = |letter: char| letter.is_control() && !matches!(letter, '\n' | '\t');
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if obeyed(letter) { shown.extend(letter.escape_default()) } else { shown.push(letter) }
    }
    Cow::Owned(shown)
}

/// A count with its noun: "1 session", "2 sessions".
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// A progress bar on standard error, where that is a terminal.
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
    fn control_characters_are_shown_and_not_obeyed() {
        assert_eq!(printable("a\u{1b}[31mred.json:1: no\n\tthing\r\u{9b}2J"), "a\\u{1b}[31mred.json:1: no\n\tthing\\r\\u{9b}2J");
        assert_eq!(printable("grüner Raum"), "grüner Raum");
    }
}
