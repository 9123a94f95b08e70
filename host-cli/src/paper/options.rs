//! The options of `goodbot paper`, with trainers by name or numbers.

use clap::{Args, ValueEnum, ValueHint};
use goodbot::feedback::Strategy;
use goodbot::session::Weights;
use goodbot_console::{Learner, typed};
use goodbot_course::CourseTrainer;
use std::path::PathBuf;
use std::str::FromStr;

/// The end of the help.
pub const EXAMPLES: &str = "\
Trainers: each is three probabilities, MU_PLUS,MU_MINUS,EPSILON: of silence after a right action, \
of silence after a wrong one, and of taking one for the other.
  balanced     0.7,0.7,0.1    silent seven times out of ten
  punish-only  0.7,0.05,0.1   punishes nearly every wrong action, and never rewards
  reward-only  0.05,0.7,0.1   rewards nearly every right action, and never punishes
--believes sets the trainer that the agent expects: by default the same three numbers, \
as in the paper. The agent then expects rewards from the second trainer, too.

With --json there is one line for each run, and a last line for all together:
  train_right     shares of runs in which a lesson's command was understood before any feedback
  test_right      shares of runs in which the most likely task was the one meant, for each test
  test_all_right  share of runs in which all tests were right
  translations    mean probability of a word given a machine token
  feedback        how often the trainers rewarded, punished or were silent, all runs together
  paper           the paper's results for its one agent
With --csv there is a line of names, and one of values.

What you see: the robot hears a command in words that it may not know. For every task that is \
possible in the home it holds a belief, acts for the most likely one, and changes its mind as the \
trainer says \"good bot\", \"bad bot\" or nothing. After each lesson it learns what the words mean. \
The five tests are in a new home, without feedback: three repeat a lesson's command word for word, \
two are new. A test is right if the most likely task is the intended one.

Examples:
  goodbot paper --seed 3 --layouts random
  goodbot paper --runs 200 --seed 1 --layouts fixed
  goodbot paper --trainer 0.6,0.2,0.05 --believes balanced --runs 50 --json
  for mu in 0.1 0.5 0.9; do goodbot paper --runs 100 --trainer $mu,0.7,0.1 --csv | tail -1; done";

/// The options of the experiment.
#[derive(Clone, Debug, Args)]
pub struct PaperOptions {
    /// How the trainer judges: balanced, punish-only, reward-only, or three probabilities
    #[arg(long, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON", default_value = "balanced", allow_hyphen_values = true)]
    pub trainer: TrainerChoice,
    /// How the agent expects to be judged [default: the paper's numbers for this trainer]
    #[arg(long, value_name = "NAME|MU_PLUS,MU_MINUS,EPSILON", allow_hyphen_values = true)]
    pub believes: Option<TrainerChoice>,
    /// Number of agents to train, 1 to 100000; their seeds count up from --seed
    #[arg(long, short = 'n', value_name = "N", default_value = "1", value_parser = typed::between(1_u32, 100_000))]
    pub runs: u32,
    /// Seed of the first run: the same seed gives the same run everywhere
    #[arg(long, short = 's', value_name = "S", default_value = "1", value_parser = typed::between(0, u64::MAX))]
    pub seed: u64,
    /// The homes: drawn ones, or random ones for each seed [default: fixed for one run, random for several]
    #[arg(long, value_enum)]
    pub layouts: Option<Layouts>,
    /// How machine commands are weighted when the agent learns
    #[arg(long, value_enum, default_value_t = WeightsChoice::Paper)]
    pub weights: WeightsChoice,
    /// The learner
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Learner::Roles)]
    pub learner: Learner,
    /// Print JSON lines: one for each run, and a summary at the end
    #[arg(long)]
    pub json: bool,
    /// Print comma-separated values: a line of names, and one of values
    #[arg(long, conflicts_with = "json")]
    pub csv: bool,
    /// Write a picture of the words that one robot learned; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    pub plot: Option<PathBuf>,
    /// Replace a file that is no picture of goodbot's
    #[arg(long, requires = "plot")]
    pub force: bool,
}

/// The homes of the experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Layouts {
    /// The same drawn homes in every run
    Fixed,
    /// Other homes for every seed
    Random,
}

/// The weights of machine commands in learning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WeightsChoice {
    /// By their own explanation of the command too (the paper's Algorithm 1)
    Paper,
    /// By the belief over tasks alone (the authors' later program)
    Belief,
}

impl From<WeightsChoice> for Weights {
    fn from(choice: WeightsChoice) -> Self {
        match choice {
            WeightsChoice::Paper => Self::Paper,
            WeightsChoice::Belief => Self::Belief,
        }
    }
}

impl PaperOptions {
    /// Whether a single run is told as a story.
    pub fn is_story(&self) -> bool {
        self.runs == 1 && !self.json && !self.csv
    }

    /// The homes; by default fixed for a single run, random for several, however results are shown.
    pub fn homes(&self) -> Layouts {
        self.layouts.unwrap_or(if self.runs == 1 { Layouts::Fixed } else { Layouts::Random })
    }

    /// The trainer that the agent expects; by default the trainer itself. Only its strategy counts: the agent does not expect that it never
    /// rewards or never punishes.
    pub fn believed(&self) -> &TrainerChoice {
        self.believes.as_ref().unwrap_or(&self.trainer)
    }
}

/// A trainer: a name, or three probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainerChoice {
    /// Its name in output.
    pub name: String,
    /// Its strategy, and whether it rewards and punishes.
    pub trainer: CourseTrainer,
}

const HELP: &str = "give balanced, punish-only, reward-only, or three probabilities MU_PLUS,MU_MINUS,EPSILON such as 0.7,0.7,0.1";

impl FromStr for TrainerChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match CourseTrainer::NAMED.into_iter().find(|(name, _)| *name == text) {
            Some((name, trainer)) => Ok(Self { name: name.to_owned(), trainer }),
            None => Ok(Self::of(numbers(text)?)),
        }
    }
}

impl TrainerChoice {
    /// A trainer who both rewards and punishes, named by its numbers.
    pub fn of(strategy: Strategy) -> Self {
        Self { name: name(strategy), trainer: CourseTrainer::of(strategy) }
    }

    /// The feedback that it never gives, as the end of a sentence.
    pub fn withheld(&self) -> &'static str {
        match (self.trainer.rewards, self.trainer.punishes) {
            (false, _) => " (never rewards)",
            (_, false) => " (never punishes)",
            _ => "",
        }
    }
}

/// A strategy by its three numbers.
pub fn name(strategy: Strategy) -> String {
    format!("{},{},{}", strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon())
}

fn numbers(text: &str) -> Result<Strategy, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [mu_plus, mu_minus, epsilon] = parts.as_slice() else {
        return Err(match parts.len() {
            1 => format!("no trainer has this name; {HELP}"),
            count => format!("{count} numbers where three are needed; {HELP}"),
        });
    };
    let number = |what: &str, text: &str| text.parse::<f32>().map_err(|_| format!("{what} is {text:?}, which is no number; {HELP}"));
    Strategy::new(number("MU_PLUS", mu_plus)?, number("MU_MINUS", mu_minus)?, number("EPSILON", epsilon)?)
        .map_err(|error| format!("{error}; {HELP}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_numbers_make_a_trainer_who_withholds_nothing_and_name_it() {
        let trainer: TrainerChoice = "0.70, 0.05,0.1".parse().unwrap();
        assert_eq!(trainer, TrainerChoice { name: "0.7,0.05,0.1".to_owned(), trainer: CourseTrainer::of(Strategy::PUNISH_ONLY) });
    }

    #[test]
    fn the_trainer_who_never_rewards_has_a_strategy_that_does_as_in_the_paper() {
        let CourseTrainer { strategy, rewards, .. } = "punish-only".parse::<TrainerChoice>().unwrap().trainer;
        assert_eq!((strategy, rewards), (Strategy::new(0.7, 0.05, 0.1).unwrap(), false));
    }
}
