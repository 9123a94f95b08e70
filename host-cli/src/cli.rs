//! What can be typed.

use crate::ask::AskOptions;
use crate::check::CheckArgs;
use crate::evaluate::EvaluateOptions;
use crate::inspect::InspectOptions;
use crate::learn::LearnOptions;
use crate::merge::MergeArgs;
use crate::model::Model;
use crate::paper::trainer::TrainerChoice;
use crate::replay::ReplayArgs;
use crate::teach::TeachOptions;
use crate::whole_file::new_file;
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  goodbot                              one agent learns and is tested, told as a story
  goodbot --seed 7 --layouts random    another agent, in other homes
  goodbot --trainer punish-only        a trainer who only says \"bad bot\"
  goodbot --runs 200                   how often each command is understood
  goodbot --runs 200 --json | tail -1  the same, for programs
  goodbot check home.json log.jsonl    what is wrong with files of your own
  goodbot learn log.jsonl --out words.goodbot
                                       a model from recorded sessions
  goodbot ask --model words.goodbot --environment home.json \"go to the red room\"
                                       what that model takes a command to mean

What you see: the robot hears a command in words that it may not know. For every task that is \
possible in the home it holds a belief, acts for the most likely one, and changes its mind as the \
trainer says \"good bot\", \"bad bot\" or nothing. After each lesson it learns what the words mean. \
In the tests it hears new commands and gets no feedback: the most likely task must be the one that \
is meant.

Exit codes: 0 all well, 1 a result that failed, 2 bad use or bad input.";

/// A robot that learns what your words mean from reward and punishment.
///
/// Without a command, this runs the paper's experiment: `goodbot` is `goodbot paper`.
#[derive(Debug, Parser)]
#[command(name = "goodbot", version, after_help = EXAMPLES, args_conflicts_with_subcommands = true, max_term_width = 110)]
pub struct Cli {
    /// What to do
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The options of `goodbot paper`
    #[command(flatten)]
    pub paper: PaperOptions,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run the paper's experiment: seven lessons with a simulated trainer, then five tests
    #[command(after_help = PAPER_EXAMPLES)]
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
    Check(CheckArgs),
    Merge(MergeArgs),
    /// Print a script that completes commands and options in your shell
    #[command(after_help = "Example:\n  goodbot completions bash > ~/.local/share/bash-completion/completions/goodbot")]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

const PAPER_EXAMPLES: &str = "\
Trainers: each is three probabilities, MU_PLUS,MU_MINUS,EPSILON: of silence after a right action, \
of silence after a wrong one, and of taking one for the other.
  balanced     0.7,0.7,0.1    silent seven times out of ten
  punish-only  0.7,0.05,0.1   punishes nearly every wrong action
  reward-only  0.05,0.7,0.1   rewards nearly every right action

With --json there is one line for each run, and a last line for all together:
  train_right     shares of runs in which a lesson's command was understood before any feedback
  test_right      shares of runs in which the most likely task was the one meant, for each test
  test_all_right  share of runs in which all tests were right
  translations    mean probability of a word given a machine token
  feedback        how often the trainers said what, all runs together

Examples:
  goodbot paper --seed 3 --layouts random
  goodbot paper --runs 200 --seed 1 --layouts fixed --plot shares.svg
  goodbot paper --trainer 0.6,0.2,0.05 --runs 50 --json";

/// The options of the experiment.
#[derive(Clone, Debug, Args)]
pub struct PaperOptions {
    /// Trainer: balanced, punish-only, reward-only, or three probabilities
    #[arg(long, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON", default_value = "balanced", allow_hyphen_values = true)]
    pub trainer: TrainerChoice,
    /// How many agents to train, each with a seed of its own, counted up from --seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub runs: u32,
    /// Seed of the first run: the same seed gives the same run everywhere
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub seed: u64,
    /// The homes: drawn ones, or random ones for each seed [default: fixed for one run as a story, else random]
    #[arg(long, value_enum)]
    pub layouts: Option<Layouts>,
    /// How machine commands are weighted when the agent learns
    #[arg(long, value_enum, default_value_t = WeightsChoice::Paper)]
    pub weights: WeightsChoice,
    /// The model of language and learning
    #[arg(long, value_enum, default_value_t)]
    pub model: Model,
    /// Print JSON lines: one for each run, and a summary at the end
    #[arg(long)]
    pub json: bool,
    /// Write a picture: learned words for one run, shares of right answers for several
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath, value_parser = new_file)]
    pub plot: Option<PathBuf>,
    /// Write no picture [default: the story of one run writes goodbot-paper.svg]
    #[arg(long, conflicts_with = "plot")]
    pub no_plot: bool,
}

/// Which homes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Layouts {
    /// The same drawn homes in every run
    Fixed,
    /// Other homes for every seed
    Random,
}

impl Layouts {
    /// Its name in output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Random => "random",
        }
    }
}

/// How machine commands are weighted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WeightsChoice {
    /// By their own explanation of the command too (the paper's Algorithm 1)
    Paper,
    /// By the belief over tasks alone (the authors' later program)
    Belief,
}

impl PaperOptions {
    /// Whether one run is told as a story.
    pub fn is_story(&self) -> bool {
        self.runs == 1 && !self.json
    }

    /// Which homes, where that was not said.
    pub fn homes(&self) -> Layouts {
        self.layouts.unwrap_or(if self.is_story() { Layouts::Fixed } else { Layouts::Random })
    }
}
