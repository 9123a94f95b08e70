//! A trainer as it is typed.

use goodbot::feedback::Strategy;
use std::str::FromStr;

/// A trainer: a name, or three probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainerChoice {
    /// As it stands in output.
    pub name: String,
    /// How it gives feedback.
    pub strategy: Strategy,
}

const NAMED: [(&str, Strategy); 3] =
    [("balanced", Strategy::BALANCED), ("punish-only", Strategy::PUNISH_ONLY), ("reward-only", Strategy::REWARD_ONLY)];

const HELP: &str = "give balanced, punish-only, reward-only, or three probabilities MU_PLUS,MU_MINUS,EPSILON such as 0.7,0.7,0.1";

impl FromStr for TrainerChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((name, strategy)) = NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(Self { name: (*name).to_owned(), strategy: *strategy });
        }
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let [mu_plus, mu_minus, epsilon] = parts.as_slice() else {
            return Err(match parts.len() {
                1 => format!("no trainer has this name; {HELP}"),
                count => format!("{count} numbers where three are needed; {HELP}"),
            });
        };
        let number = |what: &str, text: &str| text.parse::<f32>().map_err(|_| format!("{what} is {text:?}, which is no number; {HELP}"));
        let strategy = Strategy::new(number("MU_PLUS", mu_plus)?, number("MU_MINUS", mu_minus)?, number("EPSILON", epsilon)?)
            .map_err(|error| format!("{error}; {HELP}"))?;
        Ok(Self { name: format!("{},{},{}", strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon()), strategy })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_numbers_make_a_trainer_and_name_it() {
        let trainer: TrainerChoice = "0.70, 0.05,0.1".parse().unwrap();
        assert_eq!(trainer, TrainerChoice { name: "0.7,0.05,0.1".to_owned(), strategy: Strategy::PUNISH_ONLY });
    }
}
