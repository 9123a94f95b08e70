//! Errors of the command line, in plain words.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use goodbot_console::messages;
use goodbot_console::printed::printable;
use std::borrow::Cow;
use std::ffi::OsString;

/// Common names for commands that have another name here.
const OTHER_NAMES: [(&[&str], &str); 6] = [
    (&["train", "fit"], "learn, or goodbot teach"),
    (&["test", "eval", "score", "validate"], "evaluate"),
    (&["show", "words", "dump", "view", "plot"], "inspect"),
    (&["say", "command", "query", "predict", "tell"], "ask"),
    (&["run", "experiment", "demo", "simulate"], "paper"),
    (&["lint", "verify"], "check"),
];

/// Reports the error, and returns the exit code.
pub fn tell(error: &clap::Error, typed: &[OsString]) -> u8 {
    match in_words(error) {
        Some(message) => messages::tell(&format!("error: {message}\n\nFor more information, try 'goodbot --help'.")),
        // The command line may have control characters. The error then has no colours.
        None if typed.iter().any(|typed| matches!(printable(&typed.to_string_lossy()), Cow::Owned(_))) => {
            messages::tell(error.render().to_string().trim_end());
        }
        // Help is no error, and neither is a reader who stops early.
        None => drop(error.print()),
    }
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// The error in plainer words than clap's; `None` if clap's are good.
fn in_words(error: &clap::Error) -> Option<String> {
    let typed = |context: ContextKind| match error.get(context) {
        Some(ContextValue::String(typed)) => Some(typed.as_str()),
        _ => None,
    };
    let meant = |typed: &str| OTHER_NAMES.iter().find(|(names, _)| names.contains(&typed)).map(|(_, command)| *command);
    let no_command = |typed: &str, meant: &str| format!("there is no command {typed:?}; did you mean goodbot {meant}?");
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let typed = typed(ContextKind::InvalidSubcommand)?;
            let alike = match error.get(ContextKind::SuggestedSubcommand) {
                Some(ContextValue::Strings(names)) => names.last().map(String::as_str),
                _ => None,
            };
            Some(match meant(typed).or(alike) {
                Some(command) => no_command(typed, command),
                None => format!("there is no command {typed:?}; goodbot --help names all"),
            })
        }
        ErrorKind::UnknownArgument => match typed(ContextKind::InvalidArg)? {
            "--model" => Some(
                "--model names the robot's file in goodbot teach; choose the learner with --learner, and a model to ask with --with; \
                 other commands take the model's file without an option"
                    .to_owned(),
            ),
            typed => meant(typed).map(|command| no_command(typed, command)),
        },
        ErrorKind::ArgumentConflict => {
            let before = match error.get(ContextKind::PriorArg)? {
                ContextValue::String(option) => option.clone(),
                ContextValue::Strings(options) => options.join(" "),
                _ => return None,
            };
            Some(format!("options go after the command: goodbot {} {before}", typed(ContextKind::InvalidSubcommand)?))
        }
        _ => None,
    }
}
