//! The commands and options of the command line.

use crate::ask::AskOptions;
use crate::check::CheckArgs;
use crate::convert::ConvertArgs;
use crate::diff::DiffArgs;
use crate::doctor::DoctorArgs;
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
use clap::{Parser, Subcommand, ValueEnum};
use goodbot_lab::acts::ActsOptions;
use goodbot_lab::evaluate::EvaluateOptions;
use goodbot_lab::fit_trainers::FitOptions;
use goodbot_lab::questions::QuestionsOptions;
use goodbot_lab::study::StudyOptions;
use goodbot_lab::ways::WaysOptions;

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
    /// Simulate sessions with questions and without: what they cost and what they save
    Questions(QuestionsOptions),
    /// Simulate how the robot learns commands with a way: through a room, or around it
    Ways(WaysOptions),
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
    Doctor(DoctorArgs),
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
