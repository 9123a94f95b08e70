//! A session of a log, once more: the same command in the same home, the same actions and the same feedback teach the same.
//!
//! A log may say more than the page itself does: the tasks' prior, the trainer strategies, a session that goes on from the one before, and
//! demonstrations.

use goodbot::feedback::Strategy;
use goodbot::oomdp::{action_named, apply};
use goodbot::task::GroundedTask;
use goodbot_formats::session::{Kind, RecordedSession};

use crate::log::Step;
use crate::world::{Refusal, World};

impl World {
    /// Replaces the trainer strategies: for each its mu+, its mu-, its epsilon and how probable it is. A session under way ends unlearned.
    ///
    /// # Errors
    /// What is no probability.
    pub fn set_strategies(&mut self, numbers: &[f32]) -> Result<(), Refusal> {
        let mut strategies = Vec::new();
        for strategy in numbers.as_chunks().0 {
            let &[mu_plus, mu_minus, epsilon, prior] = strategy;
            strategies.push((Strategy::new(mu_plus, mu_minus, epsilon).map_err(Refusal::from)?, prior));
        }
        self.forget();
        self.mind.set_strategies(&strategies).map_err(Refusal::from)
    }

    /// Hears the command under way once more, with a prior for each task in the order of the belief's, instead of what the words say.
    ///
    /// # Errors
    /// Where no command was heard, or the numbers are no probabilities.
    pub fn set_prior(&mut self, prior: &[f32]) -> Result<(), Refusal> {
        let recording = self.recording.take().ok_or_else(|| Refusal("no session is under way".to_owned()))?;
        let Self { mind, rooms, state, .. } = self;
        let tasks: Vec<GroundedTask> = mind.tasks().to_vec();
        let of = |task: &GroundedTask| tasks.iter().position(|known| known == task).and_then(|at| prior.get(at).copied()).unwrap_or(0.0);
        mind.hear_with_prior(rooms, state, &recording.command, |task, _| of(task)).map_err(Refusal::from)?;
        self.recording = Some(recording);
        Ok(())
    }

    /// Puts everything back, and takes up the last command again: what was believed goes on.
    ///
    /// # Errors
    /// Where the last session was not one of this command in this home.
    pub fn hear_again(&mut self, command: &str) -> Result<(), Refusal> {
        self.reset();
        let Self { mind, rooms, state, .. } = self;
        mind.hear_again(rooms, state).map_err(Refusal::from)?;
        self.record(command, true)
    }

    /// Takes in that the trainer did the action of this name to show the way, and does it. The plan must be done.
    ///
    /// # Errors
    /// As [`act_as`](Self::act_as).
    pub fn demonstrate(&mut self, action: &str) -> Result<(), Refusal> {
        self.check_judged()?;
        let done = action_named(self.home(), action).ok_or_else(|| Refusal(format!("{action} is no action here")))?;
        let Self { mind, rooms, state, .. } = self;
        let _ = mind.demonstrated(rooms, state, done).map_err(Refusal::from)?;
        *state = apply(rooms, state, done).unwrap_or(*state);
        if let Some(recording) = &mut self.recording {
            recording.kind = "demonstration";
            recording.steps.push(Step::new(action.to_owned(), None));
        }
        Ok(())
    }

    /// Goes through a recorded session and learns from it to the end, if it is to be learned from. The robot is then where the session
    /// ended.
    ///
    /// # Errors
    /// Why the session cannot be gone through; what was learned before is kept.
    pub fn replay(&mut self, session: &RecordedSession) -> Result<(), Refusal> {
        let header = &session.header;
        if header.kind == Kind::Labelled {
            return Err(Refusal("a labelled session has no steps to go through; learn from it with goodbot learn".to_owned()));
        }
        if header.continues {
            self.hear_again(&header.command)?;
        } else {
            self.set_pulls(header.action_names().any(|name| name == "pull"))?;
            self.set_environment(&header.environment.to_json_line())?;
            if let Some(records) = &header.strategies {
                let numbers = records.iter().flat_map(|record| [record.mu_plus, record.mu_minus, record.epsilon, record.prior]);
                self.set_strategies(&numbers.map(|number| number as f32).collect::<Vec<_>>())?;
            }
            self.hear(&header.command)?;
        }
        for (_, step) in &session.steps {
            while !self.plan(u32::MAX)? {}
            match step.feedback {
                None => self.demonstrate(&step.action)?,
                Some(feedback) => {
                    self.act_as(&step.action)?;
                    self.judge(feedback.as_str())?;
                }
            }
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
