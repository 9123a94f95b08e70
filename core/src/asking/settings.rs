//! The cost of a question, and the probability of a wrong answer.

use crate::language::SettingError;

/// The most meanings that a question offers to choose from.
pub const CHOICES: usize = 3;

/// The conditions for a question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asking {
    /// The cost of a question, in steps; more than 0. [`f32::INFINITY`]: never ask.
    pub kappa: f32,
    /// The probability that an answer is wrong, from 0 to less than 0.5.
    pub eta: f32,
    /// A robot that gives a task this probability is sure, and does not ask.
    pub sure: f32,
    /// The trainer's patience, in steps. If the questions until it is sure would cost more, the robot does not ask the first one.
    pub patience: f32,
    /// The most meanings that a question offers to choose from, at most [`CHOICES`]; with less than 2, all questions are of yes and no.
    pub choices: u8,
}

impl Asking {
    /// A question costs eight steps, one answer in twenty is wrong, and the trainer has patience for eighty steps.
    pub const DEFAULT: Self = Self { kappa: 8.0, eta: 0.05, sure: 0.95, patience: 80.0, choices: CHOICES as u8 };

    /// Never ask.
    pub const NEVER: Self = Self { kappa: f32::INFINITY, ..Self::DEFAULT };

    /// Checks that every setting is in its range.
    ///
    /// # Errors
    /// A [`SettingError`] that names the first setting out of range.
    pub fn check(&self) -> Result<(), SettingError> {
        let sound = |sound: bool, error| if sound { Ok(()) } else { Err(error) };
        sound(self.kappa > 0.0, SettingError::Kappa(self.kappa))?;
        sound((0.0..0.5).contains(&self.eta), SettingError::Eta(self.eta))?;
        sound((0.0..=1.0).contains(&self.sure), SettingError::Sure(self.sure))?;
        sound(self.patience >= 0.0, SettingError::Patience(self.patience))
    }
}
