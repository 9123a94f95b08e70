//! The settings of an experiment: all combinations of the sweeps' values.

use super::options::PaperOptions;
use super::sweep::{MOST, Parameter, Sweep};
use super::trainer::{TrainerChoice, name};
use goodbot::feedback::Strategy;
use goodbot_course::CourseTrainer;

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
