//! The robot's questions in a session.

use super::{Lesson, LiveError};
use crate::place::Place;
use goodbot::asking::{Asking, Considered, Question};

impl<D: Place> Lesson<D> {
    /// The question to ask here, if it teaches the robot more than its next steps do. The plan must be done.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::question`](goodbot::Agent::question).
    pub fn ask(&mut self, asking: &Asking) -> Result<Option<Question>, LiveError> {
        loop {
            match self.consider(asking, u32::MAX)? {
                Considered::Working => {}
                Considered::Act => return Ok(None),
                Considered::Ask(question) => return Ok(Some(question)),
            }
        }
    }

    /// As [`ask`](Self::ask), but in parts: see [`Agent::consider`](goodbot::Agent::consider).
    ///
    /// # Errors
    /// As [`ask`](Self::ask).
    pub fn consider(&mut self, asking: &Asking, budget: u32) -> Result<Considered, LiveError> {
        let listened = self.session().ok_or(LiveError::NoSession)?.0.listening.is_some();
        let (agent, home, state) = (&mut self.agent, &self.walk.home, &self.state);
        Ok(self.restraint.consider(agent, home, state, asking, listened, budget)?)
    }
}
