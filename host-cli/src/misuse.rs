//! What was typed and cannot be understood, told in plain words.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::process::ExitCode;

/// What people type for a command that has another name.
const OTHER_NAMES: [(&[&str], &str); 6] = [
    (&["train", "fit", "teach"], "learn"),
    (&["test", "eval", "score", "validate"], "evaluate"),
    (&["show", "words", "dump", "view", "plot"], "inspect"),
    (&["say", "command", "query", "predict", "tell"], "ask"),
    (&["run", "experiment", "demo", "simulate"], "paper"),
    (&["lint", "verify"], "check"),
];

/// Tells what is wrong, and gives the exit code.
pub fn tell(error: &clap::Error) -> ExitCode {
    let meant = |typed: &str| OTHER_NAMES.iter().find(|(names, _)| names.contains(&typed)).map(|(_, command)| *command);
    let typed = match error.get(ContextKind::InvalidSubcommand).or_else(|| error.get(ContextKind::InvalidArg)) {
        Some(ContextValue::String(typed)) if matches!(error.kind(), ErrorKind::InvalidSubcommand | ErrorKind::UnknownArgument) => typed,
        _ => "",
    };
    if let Some(command) = meant(typed) {
        eprintln!("error: there is no command {typed:?}; did you mean goodbot {command}?\n\nFor more information, try 'goodbot --help'.");
        return ExitCode::from(2);
    }
    // A reader who leaves is no fault, and help is none either.
    let _ = error.print();
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}
