//! The library's language models.

use super::Speak;
use crate::study::agent::whole::ROOM;
use crate::study::fault::StudyError;
use crate::study::place::Place;
use goodbot::home::paper_tasks;
use goodbot::memory::AgentHeap;
use goodbot::session::Weights;
use goodbot::{Agent, Options};
use goodbot_course::CourseError;

/// An agent that hears and learns, and never acts.
#[derive(Debug)]
pub struct Core(Agent<AgentHeap>);

impl Core {
    /// An agent without words.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn new(options: Options) -> Result<Self, StudyError> {
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        // With the paper's weights, a session would be weighed by its own evidence, and the given posterior would not count.
        Ok(Self(Agent::new(AgentHeap::new(&ROOM), &lifted, Options { weights: Weights::Belief, ..options })?))
    }
}

impl Speak for Core {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        self.0.hear(&place.home, &place.start, &place.command)?;
        Ok((0..place.tasks.len()).map(|task| self.0.belief().probability(task)).collect())
    }

    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError> {
        let share = |task: &_| place.position(task).map_or(0.0, |task| posterior[task]);
        self.0.hear_with_prior(&place.home, &place.start, &place.command, |task, _| share(task))?;
        let _ = self.0.finish(&place.home)?;
        self.0.learn_fully();
        Ok(())
    }
}
