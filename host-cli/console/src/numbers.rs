//! Parsers for typed numbers, with their error messages, and the names of typed choices.

use clap::ValueEnum;
use std::fmt::Display;
use std::str::FromStr;

/// Parses whole numbers in a range. The error says what to give.
pub fn between<T: FromStr + PartialOrd + Display + Copy>(least: T, most: T) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let number: Option<T> = text.trim().parse().ok();
        number.filter(|number| (least..=most).contains(number)).ok_or_else(|| format!("give a whole number from {least} to {most}"))
    }
}

/// A seed.
///
/// # Errors
/// The error says what to give.
pub fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("give a whole number from 0 to {}", u64::MAX))
}

/// A cost in steps: a number above 0, or `inf`.
///
/// # Errors
/// The error says what to give.
pub fn cost(text: &str) -> Result<f32, String> {
    let number: Option<f32> = text.trim().parse().ok();
    number.filter(|&number| number > 0.0).ok_or_else(|| "give a number of steps above 0, such as 4, or inf for never".to_owned())
}

/// The share of wrong answers: below one half.
///
/// # Errors
/// The error says what to give.
pub fn wrong_share(text: &str) -> Result<f32, String> {
    let number: Option<f32> = text.trim().parse().ok();
    number.filter(|number| (0.0..0.5).contains(number)).ok_or_else(|| "give a share from 0 to less than 0.5, such as 0.05".to_owned())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_is_above_nothing_and_a_wrong_answer_is_rarer_than_a_right_one() {
        assert_eq!([cost("4"), cost("inf")], [Ok(4.0), Ok(f32::INFINITY)]);
        for wrong in ["-1", "0", "NaN", "many"] {
            assert!(cost(wrong).unwrap_err().contains("above 0"), "{wrong}");
        }
        assert_eq!([clear("0.5"), clear("0.95")], [Ok(0.5), Ok(0.95)]);
        assert!(clear("1").is_err() && clear("0.4").is_err());
        assert_eq!(wrong_share("0.05"), Ok(0.05));
        for wrong in ["-1", "0.5", "NaN"] {
            assert!(wrong_share(wrong).unwrap_err().contains("less than 0.5"), "{wrong}");
        }
    }
}
