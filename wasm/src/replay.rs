//! A session of a log, once more: the same command in the same home, the same actions and the same feedback teach the same.

use goodbot::feedback::Strategy;
use goodbot_formats::session::RecordedSession;

use crate::world::{Refusal, World};

impl World {
    /// Goes through a recorded session of feedback and learns from it to the end, if it is to be learned from. The robot is then where
    /// the session ended.
    ///
    /// # Errors
    /// Why the session cannot be gone through; what was learned before is kept.
    pub fn replay(&mut self, session: &RecordedSession) -> Result<(), Refusal> {
        self.set_environment(&session.header.environment.to_json_line())?;
        if let Some(records) = &session.header.strategies {
            let mut strategies = Vec::new();
            for record in records {
                let strategy = Strategy::new(record.mu_plus as f32, record.mu_minus as f32, record.epsilon as f32);
                strategies.push((strategy.map_err(Refusal::from)?, record.prior as f32));
            }
            self.mind.with_dependent_mut(|_, agent| agent.set_strategies(&strategies)).map_err(Refusal::from)?;
        }
        self.hear(&session.header.command)?;
        for (_, step) in &session.steps {
            let feedback = step.feedback.ok_or_else(|| Refusal("a demonstration is not feedback".to_owned()))?;
            while !self.plan(u32::MAX)? {}
            self.act_as(&step.action)?;
            self.judge(feedback.as_str())?;
        }
        if session.learn {
            self.finish()?;
            while !self.learn(u32::MAX) {}
        } else {
            self.forget();
        }
        Ok(())
    }
}
