//! The commands and options of the command line, their help in groups, and errors of typing in plain words.

use crate::ask::AskOptions;
use crate::check::CheckArgs;
use crate::convert::ConvertArgs;
use crate::diff::DiffArgs;
use crate::example::Example;
use crate::inspect::InspectOptions;
use crate::learn::LearnOptions;
use crate::merge::MergeArgs;
use crate::microbit::MicrobitOptions;
use crate::migrate::MigrateArgs;
use crate::paper::options::PaperOptions;
use crate::parameters::ParametersArgs;
use crate::replay::ReplayArgs;
use crate::size::SizeOptions;
use crate::table::TableOptions;
use crate::teach::TeachOptions;
use crate::unlearn::UnlearnArgs;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, CommandFactory, Parser, Subcommand, ValueEnum};
use goodbot_console::messages;
use goodbot_console::printed::printable;
use goodbot_lab::acts::ActsOptions;
use goodbot_lab::evaluate::EvaluateOptions;
use goodbot_lab::fit_trainers::FitOptions;
use goodbot_lab::study::StudyOptions;
use std::borrow::Cow;
use std::ffi::OsString;

const EXAMPLES: &str = "\
Examples:
  goodbot                              one agent learns and is tested, told as a story
  goodbot --trainer punish-only        a trainer who only ever says \"bad bot\"
  goodbot --runs 200 --json | tail -1  how often each command is understood, for programs
  goodbot teach --tour                 the same lessons, key by key: you are the trainer
  goodbot check home.json log.jsonl    the faults of your own files
  goodbot help ask                     the options and examples of a command

Exit codes: 0 all well, 1 a result that failed, 2 bad use or bad input.";

/// A robot that learns what your words mean from reward and punishment.
///
/// Without a command, this runs the paper's experiment, with the options of `goodbot paper`.
#[derive(Debug, Parser)]
#[command(name = "goodbot", version, after_help = EXAMPLES, args_conflicts_with_subcommands = true, max_term_width = 110)]
pub struct Cli {
    /// Print only errors on standard error: no progress, no remarks
    #[arg(long, short = 'q', global = true)]
    pub quiet: bool,
    /// When to use colours: auto, which is usual (on a terminal, unless NO_COLOR is set), always or never
    #[arg(long, value_enum, value_name = "WHEN", default_value_t, global = true, hide_possible_values = true, hide_default_value = true)]
    pub color: Color,
    /// The command
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The options of `goodbot paper`
    #[command(flatten)]
    pub paper: PaperOptions,
}

/// When to use colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Color {
    /// On a terminal, unless NO_COLOR is set
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run the paper's experiment: seven lessons with a simulated trainer, then five tests
    #[command(after_help = crate::paper::options::EXAMPLES)]
    Paper(PaperOptions),
    /// Train the robot yourself: tell it what to do, and say good or bad while it tries
    Teach(TeachOptions),
    /// Learn from recorded sessions, and write a model
    Learn(LearnOptions),
    /// Ask a model what a command means in an environment
    Ask(AskOptions),
    /// Print the words that a model knows, and what they mean to it
    Inspect(InspectOptions),
    /// Train on recorded sessions, ask for those left out, and count right answers
    Evaluate(EvaluateOptions),
    Replay(ReplayArgs),
    /// Fit trainer strategies to the words of real trainers
    FitTrainers(FitOptions),
    /// Train the model that decides whether a robot acts on what was said
    Acts(ActsOptions),
    Check(CheckArgs),
    /// Print the memory that a robot needs for homes and lessons, as source for a controller
    Size(SizeOptions),
    Table(TableOptions),
    Convert(ConvertArgs),
    /// Write a file for a BBC micro:bit with a model
    Microbit(MicrobitOptions),
    Parameters(ParametersArgs),
    Merge(MergeArgs),
    Migrate(MigrateArgs),
    Diff(DiffArgs),
    Unlearn(UnlearnArgs),
    /// Find faults of the terminal and of your robots, and how to mend them
    #[command(
        after_help = "It changes nothing. goodbot check names the faults of files.\n\nExit codes: 0 nothing is wrong, 1 something is."
    )]
    Doctor,
    Study(StudyOptions),
    /// Print a home or a session log to begin with
    #[command(arg_required_else_help = true)]
    Example {
        /// The example
        #[arg(value_enum)]
        what: Example,
    },
    /// Print a script that completes commands and options in your shell
    #[command(
        arg_required_else_help = true,
        after_help = "Example:\n  goodbot completions bash > ~/.local/share/bash-completion/completions/goodbot"
    )]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page
    #[command(after_help = "Example:\n  goodbot man > ~/.local/share/man/man1/goodbot.1")]
    Man,
}

/// The commands for most people.
const EVERYDAY: [&str; 10] = ["teach", "learn", "ask", "inspect", "replay", "diff", "merge", "unlearn", "check", "example"];
/// The commands for controllers.
const BOARDS: [&str; 6] = ["size", "table", "convert", "microbit", "parameters", "migrate"];
/// The commands about the program itself.
const ITSELF: [&str; 4] = ["doctor", "completions", "man", "help"];

/// The command line, with help in groups. Commands in no list belong to the laboratory.
pub fn arguments() -> clap::Command {
    let cli = Cli::command();
    let style = cli.get_styles().get_header();
    let headed = |heading: &str, has: &dyn Fn(&str) -> bool| format!("{style}{heading}:{style:#}\n{}\n", group(has).ansi());
    let is_of_laboratory = |name: &str| !EVERYDAY.contains(&name) && !BOARDS.contains(&name) && !ITSELF.contains(&name);
    let groups = [
        headed("Commands", &|name| EVERYDAY.contains(&name)),
        headed("For controllers", &|name| BOARDS.contains(&name)),
        headed("The laboratory", &is_of_laboratory),
        headed("This program", &|name| ITSELF.contains(&name)),
    ]
    .concat();
    let template =
        format!("{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}{style}Options:{style:#}\n{{options}}{{after-help}}");
    // The options of `goodbot paper` work here too; its own help lists them.
    let of_all_commands = cli.mut_args(|arg| if arg.is_global_set() { arg } else { arg.hide(true) });
    take_negative_numbers(of_all_commands.help_template(template))
}

/// Lets every option take a number below 0, so that the option's own error names the range. clap would call it an unknown option.
fn take_negative_numbers(command: clap::Command) -> clap::Command {
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
