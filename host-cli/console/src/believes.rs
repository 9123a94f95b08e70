//! The command-line option for the trainers that a robot expects in recorded sessions.

use goodbot::Options;
use goodbot::feedback::{LAGS, RESTS, Strategy, population};
use std::str::FromStr;

/// The trainers that a robot expects.
#[derive(Clone, Debug, PartialEq)]
pub enum Believes {
    /// The strategies of real people.
    Population,
    /// The strategies that each session names.
    Logged,
    /// The paper's balanced strategy, or the strategy that was typed.
    One([(Strategy, f32); 1]),
}

const HELP: &str = "give population, logged, paper, or three, six or ten probabilities MU_PLUS,MU_MINUS,EPSILON[,three lags[,four about rests]] such as \
                    0.9,0.85,0.2,0.8,0.15,0.05";

impl Believes {
    /// The strategies; `None` for each session's own.
    pub fn strategies(&self) -> Option<&[(Strategy, f32)]> {
        match self {
            Self::Population => Some(&population::STRATEGIES),
            Self::Logged => None,
            Self::One(strategy) => Some(strategy),
        }
    }

    /// The options of a robot that expects these trainers.
    pub const fn options(&self, options: Options) -> Options {
        if matches!(self, Self::Population) { options.for_people().with_ends() } else { options }
    }
}

impl FromStr for Believes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "population" => return Ok(Self::Population),
            "logged" => return Ok(Self::Logged),
            "paper" => return Ok(Self::One([(Strategy::BALANCED, 1.0)])),
            _ => {}
        }
        let number = |part: &str| part.trim().parse::<f32>().map_err(|_| format!("{part:?} is no number; {HELP}"));
        let numbers = text.split(',').map(number).collect::<Result<Vec<f32>, String>>()?;
        let wrong = || format!("{} numbers where 3, {} or {} are needed; {HELP}", numbers.len(), 3 + LAGS, 3 + LAGS + RESTS);
        let ([mu_plus, mu_minus, epsilon], more) = numbers.split_first_chunk().ok_or_else(wrong)?;
        let mut strategy = Strategy::new(*mu_plus, *mu_minus, *epsilon);
        if !more.is_empty() {
            let (lags, rests) = more.split_first_chunk().ok_or_else(wrong)?;
            strategy = strategy.and_then(|strategy| strategy.with_lags(*lags));
            if !rests.is_empty() {
                let rests = <[f32; RESTS]>::try_from(rests).map_err(|_| wrong())?;
                strategy = strategy.and_then(|strategy| strategy.with_rests(rests));
            }
        }
        Ok(Self::One([(strategy.map_err(|error| format!("{error}; {HELP}"))?, 1.0)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_numbers_are_a_strategy_three_more_its_lags_and_four_more_its_rests() {
        let strategy = Strategy::new(0.9, 0.8, 0.2).unwrap();
        assert_eq!("0.9,0.8,0.2".parse(), Ok(Believes::One([(strategy, 1.0)])));
        let late = strategy.with_lags([0.5, 0.25, 0.25]).unwrap();
        assert_eq!("0.9, 0.8, 0.2, 0.5, 0.25, 0.25".parse(), Ok(Believes::One([(late, 1.0)])));
        let patient = late.with_rests([0.7, 0.95, 0.1, 1.0]).unwrap();
        assert_eq!("0.9,0.8,0.2,0.5,0.25,0.25,0.7,0.95,0.1,1".parse(), Ok(Believes::One([(patient, 1.0)])));
    }

    #[test]
    fn what_is_no_expectation_is_refused_with_what_to_give() {
        for (text, message) in [
            ("kind", "\"kind\" is no number"),
            ("0.7,0.7", "2 numbers where 3, 6 or 10 are needed"),
            ("0.7,0.7,0.1,1,0,0,0.5", "7 numbers where 3, 6 or 10 are needed"),
            ("0.7,1.7,0.1", "mu- must be a number from 0 to 1"),
            ("0.7,0.7,0.1,0.5,0.1,0.1", "the lags must be three numbers from 0 to 1 that sum to 1"),
        ] {
            let refused = text.parse::<Believes>().unwrap_err();
            assert!(refused.starts_with(message) && refused.contains("population, logged, paper"), "{refused}");
        }
    }
}
