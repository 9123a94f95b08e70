//! A trainer, by name or numbers.

use goodbot::feedback::Strategy;
use goodbot_course::CourseTrainer;
use std::str::FromStr;

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
