//! The events of a visit that come with time, and how long the robot waits for feedback after each step.

use super::{LEARN_BUDGET, PLAN_BUDGET, Phase, Visit, sentence};
use clap::ValueEnum;
use goodbot::planning::OptimalSet;
use goodbot_console::{Failure, counted};
use goodbot_course::lesson::{MOST_STEPS, RESTS};
use std::time::Duration;

impl Visit {
    /// Runs the events up to a time since the visit began.
    pub fn tick(&mut self, now: Duration) {
        if let Err(refusal) = self.advance(now) {
            // A session that cannot continue is ended. Earlier training stays.
            if self.phase != Phase::Idle {
                let _ = self.classroom.forget();
                self.idle(sentence(&refusal.to_string()));
            }
        }
    }

    fn advance(&mut self, now: Duration) -> Result<(), Failure> {
        match self.phase {
            Phase::Planning if self.classroom.pupil.lesson.plan(PLAN_BUDGET)? => self.act(now),
            Phase::Learning if self.classroom.learn(LEARN_BUDGET)? => {
                if self.go_on_with_the_rest("Learned.")? {
                    return Ok(());
                }
                let learned = counted(self.classroom.pupil.lessons_learned(), "session");
                let gave_way = match self.gave_way {
                    0 => "u takes the last one back".to_owned(),
                    some => format!("memory was full, and {} gave way", counted(some, "older one")),
                };
                self.idle(format!("Learned. It knows what {learned} taught it; {gave_way}."));
                Ok(())
            }
            Phase::Waiting(until) if !self.holds() => self.wait_over(until, now),
            _ => Ok(()),
        }
    }

    fn act(&mut self, now: Duration) -> Result<(), Failure> {
        if self.acted().is_none() {
            if self.holds() && !self.stepping {
                self.phase = Phase::Waiting(None);
                return Ok(());
            }
            self.ask()?;
            self.classroom.pupil.act()?;
        }
        self.stepping = false;
        let wait = self.acted().and_then(|acted| self.wait(acted));
        self.word_at = wait.filter(|_| self.auto).map(|wait| now + wait / 2);
        self.phase = Phase::Waiting(wait.map(|wait| now + wait));
        Ok(())
    }

    fn wait_over(&mut self, until: Option<Duration>, now: Duration) -> Result<(), Failure> {
        if self.word_at.is_some_and(|at| at <= now) {
            self.word_at = None;
            if let Some(word) = self.classroom.pupil.simulated_word() {
                let _ = self.classroom.pupil.lesson.judge(word)?;
            }
            return Ok(());
        }
        if until.is_none_or(|until| until > now) {
            return Ok(());
        }
        if self.tested.is_some() && self.acted().is_some_and(|acted| acted.plan.onward().is_none()) {
            return self.pass_test();
        }
        let intended = self.classroom.pupil.intended_plan();
        self.go_on()?;
        let long = self.done().len() >= usize::from(MOST_STEPS);
        let there = intended == Some(OptimalSet::Goal) && self.rests >= RESTS;
        if self.auto && (there || long || matches!(intended, Some(OptimalSet::DeadEnd(_)))) {
            return self.finish();
        }
        Ok(())
    }
}

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
