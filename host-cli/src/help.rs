//! The help of the whole program. Its commands are in groups, because one list would be too long.

use crate::cli::Cli;
use clap::builder::StyledStr;
use clap::{Arg, Command, CommandFactory};

/// The commands for most people.
const EVERYDAY: [&str; 10] = ["teach", "learn", "ask", "inspect", "replay", "diff", "merge", "unlearn", "check", "example"];
/// The commands for controllers.
const BOARDS: [&str; 6] = ["size", "table", "convert", "microbit", "parameters", "migrate"];
/// The commands about the program itself.
const ITSELF: [&str; 4] = ["doctor", "completions", "man", "help"];

/// The command line, with help in groups. Commands in no list belong to the laboratory.
pub fn arguments() -> Command {
    let everyday = group(|name| EVERYDAY.contains(&name));
    let boards = group(|name| BOARDS.contains(&name));
    let laboratory = group(|name| !EVERYDAY.contains(&name) && !BOARDS.contains(&name) && !ITSELF.contains(&name));
    let itself = group(|name| ITSELF.contains(&name));
    let cli = Cli::command();
    let heading = |text: &str| {
        let style = cli.get_styles().get_header();
        format!("{style}{text}:{style:#}")
    };
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{{options}}{{after-help}}",
        heading("Commands"),
        everyday.ansi(),
        heading("For controllers"),
        boards.ansi(),
        heading("The laboratory"),
        laboratory.ansi(),
        heading("This program"),
        itself.ansi(),
        heading("Options"),
    );
    // The options of `goodbot paper` work here too; its own help lists them.
    let of_all_commands = cli.mut_args(|arg| if arg.is_global_set() { arg } else { arg.hide(true) });
    take_negative_numbers(of_all_commands.help_template(template))
}

/// Lets every option take a number below 0, so that the option's own error names the range. clap would call it an unknown option.
fn take_negative_numbers(command: Command) -> Command {
    let takes_one = |arg: &Arg| !arg.is_positional() && arg.get_action().takes_values();
    command.mut_args(|arg| if takes_one(&arg) { arg.allow_negative_numbers(true) } else { arg }).mut_subcommands(take_negative_numbers)
}

/// The help lines of a group of commands, as clap writes them.
fn group(has: impl Fn(&str) -> bool) -> StyledStr {
    // clap adds this command by itself.
    let is_help_hidden = !has("help");
    Cli::command()
        .mut_subcommands(|command| {
            let is_hidden = !has(command.get_name());
            command.hide(is_hidden)
        })
        .disable_help_subcommand(is_help_hidden)
        .help_template("{subcommands}")
        .render_help()
}
