//! Options that are typed: numbers, learners and the trainers that a robot expects.

use clap::{Args, ValueEnum};
use goodbot::feedback::{LAGS, RESTS, Strategy, population};
use goodbot::language::Settings;
use goodbot::memory::AgentHeap;
use goodbot::{Capacities, Options};
use std::fmt::Display;
use std::str::FromStr;

/// Parses whole numbers in a range. The error says what to give.
pub fn between<T: FromStr + PartialOrd + Display + Copy>(least: T, most: T) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let number: Option<T> = text.trim().parse().ok();
        number.filter(|number| (least..=most).contains(number)).ok_or_else(|| format!("give a whole number from {least} to {most}"))
    }
}

/// The probability above which a belief is clear: one half or more.
///
/// # Errors
/// The error says what to give.
pub fn clear(text: &str) -> Result<f32, String> {
    let number: Option<f32> = text.trim().parse().ok();
    number.filter(|number| (0.5..1.0).contains(number)).ok_or_else(|| "give a probability from 0.5 to less than 1, such as 0.9".to_owned())
}

/// The name of a choice, as it is typed.
pub fn name_of(choice: impl ValueEnum) -> String {
    choice.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The settings of the language model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Learner {
    /// The best for people's commands: the role model, and a layer above it that learns more from many sessions
    #[default]
    Default,
    /// The role model alone, as on boards, in C and on the page
    Roles,
    /// The paper's settings
    #[value(alias = "ibm2")]
    Paper,
}

impl Learner {
    /// The settings.
    pub const fn options(self) -> Options {
        match self {
            Self::Default => Options { language: Settings::LAYERED, ..Options::DEFAULT },
            Self::Roles => Options::DEFAULT,
            Self::Paper => Options::PAPER,
        }
    }
}

/// Memory for an agent with these settings. `tasks` is the number of possible tasks in all its sessions.
pub fn memory(capacities: &Capacities, settings: &Settings, tasks: usize) -> AgentHeap {
    let memory = AgentHeap::new(capacities);
    if settings.layer { goodbot_layer::above(memory, tasks) } else { memory }
}

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

/// The option for the limit.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Limit {
    /// Read only the first N sessions of a log, or of all the logs that are read together; N is 1 or more
    #[arg(long, value_name = "N", value_parser = sessions)]
    limit: Option<usize>,
}

fn sessions(text: &str) -> Result<usize, String> {
    text.trim().parse().ok().filter(|&count| count > 0).ok_or_else(|| "give a whole number of 1 or more".to_owned())
}

impl Limit {
    /// The most sessions to read.
    pub fn count(self) -> usize {
        self.limit.unwrap_or(usize::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clear_belief_is_one_half_or_more_and_no_certainty() {
        assert_eq!([clear("0.5"), clear("0.95")], [Ok(0.5), Ok(0.95)]);
        assert!(["1", "0.4", "NaN"].iter().all(|wrong| clear(wrong).is_err()));
    }

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
