//! What is told on standard error beside failures: remarks and progress. `--quiet` leaves them out.

use indicatif::{ProgressBar, ProgressStyle};
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
            eprintln!($($text)*);
        }
    };
}
pub use crate::say;

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
