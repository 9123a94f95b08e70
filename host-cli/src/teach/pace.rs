//! How long the robot waits for feedback after each step.

use clap::ValueEnum;
use std::time::Duration;

/// How fast the robot goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Pace {
    /// Only when it is told to
    Step,
    /// 2.6 seconds a step
    Slow,
    /// 1.4 seconds a step
    #[default]
    Normal,
    /// 0.4 seconds a step
    Fast,
    /// At once: for a simulated trainer
    Once,
    /// 0.35 to 3.25 seconds: the less sure it is that its step is right, the longer it waits
    Confidence,
}

impl Pace {
    /// Its name on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Step => "step by step",
            Self::Slow => "slow",
            Self::Normal => "normal",
            Self::Fast => "fast",
            Self::Once => "at once",
            Self::Confidence => "by confidence",
        }
    }

    /// The wait after a step with this confidence; `None` for no limit.
    pub fn wait(self, confidence: f32) -> Option<Duration> {
        let milliseconds = match self {
            Self::Step => return None,
            Self::Slow => 2_600,
            Self::Normal => 1_400,
            Self::Fast => 400,
            Self::Once => 40,
            Self::Confidence => 350 + (2_900.0 * (1.0 - confidence.clamp(0.0, 1.0))) as u64,
        };
        Some(Duration::from_millis(milliseconds))
    }

    /// The next pace; the first one follows the last.
    #[must_use]
    pub fn next(self) -> Self {
        let all = Self::value_variants();
        all.iter().cycle().skip_while(|&&pace| pace != self).nth(1).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_less_sure_the_longer_the_wait() {
        let wait = |confidence| Pace::Confidence.wait(confidence).unwrap().as_millis();
        assert_eq!([wait(1.0), wait(0.0)], [350, 3_250]);
        assert!(wait(0.3) > wait(0.6));
        assert_eq!(Pace::Step.wait(1.0), None);
    }

    #[test]
    fn every_pace_comes_round() {
        assert_eq!(Pace::Confidence.next(), Pace::Step);
        assert_eq!(Pace::Step.next(), Pace::Slow);
    }
}
