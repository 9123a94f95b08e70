//! Sweeps: a number of the trainer, or of the trainer that the agent expects, taken through a range; and all combinations of several.

use super::options::{PaperOptions, TrainerChoice, name};
use goodbot::feedback::Strategy;
use goodbot_course::CourseTrainer;
use std::str::FromStr;

/// The most values of a sweep, and the most settings of all sweeps together.
pub(super) const MOST: usize = 1_000;

/// The swept number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parameter {
    MuPlus,
    MuMinus,
    Epsilon,
}

/// A number and its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The name as it is typed: `mu-plus`, or `believed-mu-plus`.
    pub name: String,
    pub(super) parameter: Parameter,
    /// Whether the number is of the expected trainer, and not of the trainer itself.
    pub(super) believed: bool,
    /// The values, in order.
    pub values: Vec<f32>,
}

const HELP: &str = "write PARAMETER=FROM..TO:STEP such as mu-plus=0.1..0.9:0.2; parameters are mu-plus, mu-minus and epsilon of the trainer, \
                    and believed-mu-plus, believed-mu-minus and believed-epsilon of what the agent thinks";

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refused = |message: &str| format!("{message}; {HELP}");
        let (name, range) = text.split_once('=').ok_or_else(|| refused("there is no ="))?;
        let name = name.trim();
        let parameter = match name.strip_prefix("believed-").unwrap_or(name) {
            "mu-plus" => Parameter::MuPlus,
            "mu-minus" => Parameter::MuMinus,
            "epsilon" => Parameter::Epsilon,
            _ => return Err(refused("no number has this name")),
        };
        let (from, rest) = range.split_once("..").ok_or_else(|| refused("there is no .."))?;
        let (to, step) = rest.split_once(':').ok_or_else(|| refused("there is no step after a :"))?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let (Some(from), Some(to), Some(step)) = (number(from), number(to), number(step)) else {
            return Err(refused("one of the three is no number"));
        };
        if !(0.0..=1.0).contains(&from) || !(from..=1.0).contains(&to) || step <= 0.0 {
            return Err(refused("the range must go up within 0 to 1, by a step above 0"));
        }
        let count = ((to - from) / step + 1e-6).floor() + 1.0;
        if count > MOST as f64 {
            return Err(refused(&format!("more than {MOST} values")));
        }
        // Rounded, so that 0.1 + 2 * 0.1 is 0.3, as typed.
        let value = |position: usize| ((from + step * position as f64) * 1e6).round() / 1e6;
        let values = (0..count as usize).map(|position| value(position) as f32).collect();
        Ok(Self { name: name.to_owned(), parameter, believed: name.starts_with("believed-"), values })
    }
}

/// One setting of all sweeps: the options, and each sweep's value.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The options, as if they had been typed.
    pub options: PaperOptions,
    /// The sweeps' values, in their order.
    pub values: Vec<f32>,
}

/// All combinations of the sweeps' values; without sweeps, the options alone.
///
/// # Errors
/// A message if there are too many.
pub fn settings(options: &PaperOptions) -> Result<Vec<Setting>, String> {
    let count = options.sweep.iter().try_fold(1_usize, |product, sweep| product.checked_mul(sweep.values.len()));
    if count.is_none_or(|count| count > MOST) {
        return Err(format!("the sweeps together have more than {MOST} settings; take larger steps"));
    }
    let mut settings = vec![Setting { options: options.clone(), values: vec![] }];
    for sweep in &options.sweep {
        let with = |setting: &Setting, value: f32| Setting {
            options: moved(&setting.options, sweep, value),
            values: setting.values.iter().copied().chain([value]).collect(),
        };
        settings = settings.iter().flat_map(|setting| sweep.values.iter().map(|&value| with(setting, value)).collect::<Vec<_>>()).collect();
    }
    Ok(settings)
}

/// The options with one number changed. The expected trainer changes with the trainer, unless it was given or is swept itself.
fn moved(options: &PaperOptions, sweep: &Sweep, value: f32) -> PaperOptions {
    let mut options = options.clone();
    if sweep.believed {
        options.believes = Some(TrainerChoice::of(changed(options.believed().trainer.strategy, sweep.parameter, value)));
    } else {
        let CourseTrainer { strategy, rewards, punishes } = options.trainer.trainer;
        let strategy = changed(strategy, sweep.parameter, value);
        let held = match (rewards, punishes) {
            (false, _) => ", never rewards",
            (_, false) => ", never punishes",
            _ => "",
        };
        options.trainer =
            TrainerChoice { name: format!("{}{held}", name(strategy)), trainer: CourseTrainer { strategy, rewards, punishes } };
    }
    options
}

fn changed(strategy: Strategy, parameter: Parameter, value: f32) -> Strategy {
    let (mut mu_plus, mut mu_minus, mut epsilon) = (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon());
    *match parameter {
        Parameter::MuPlus => &mut mu_plus,
        Parameter::MuMinus => &mut mu_minus,
        Parameter::Epsilon => &mut epsilon,
    } = value;
    Strategy::new(mu_plus, mu_minus, epsilon).unwrap_or(strategy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_has_both_its_ends() {
        let sweep: Sweep = "mu-plus=0.1..0.9:0.2".parse().unwrap();
        assert_eq!(sweep.values, [0.1, 0.3, 0.5, 0.7, 0.9]);
    }

    #[test]
    fn what_is_no_range_is_refused_with_an_example() {
        for text in [
            "mu-plus",
            "mu-plus=0.1",
            "mu-plus=0.1..0.9",
            "mu=0..1:.1",
            "epsilon=0..1:0",
            "epsilon=0..2:.1",
            "epsilon=0..1:1e-9",
            "epsilon=0..NaN:1",
        ] {
            let error = text.parse::<Sweep>().unwrap_err();
            assert!(error.contains("mu-plus=0.1..0.9:0.2"), "{text}: {error}");
        }
    }
}
