//! The end of a session as evidence: trainers end it more often at the goal than elsewhere. They also end it more often after a rest than
//! after a move, and after "good bot" than after "bad bot"; the ratios depend on whether the robot is at the goal.

use super::strategy::Feedback;

/// The last actions and words that predict whether a trainer ends a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moment {
    /// The number of rests in a row.
    pub rests: u8,
    /// The last word of the session that was not silence.
    pub said: Feedback,
}

impl Moment {
    /// The moment after one more action, a rest or a move.
    #[must_use]
    pub const fn acted(self, rests: bool) -> Self {
        Self { rests: if rests { self.rests.saturating_add(1) } else { 0 }, ..self }
    }

    /// The moment after a word. Silence keeps the earlier word.
    #[must_use]
    pub const fn heard(self, word: Feedback) -> Self {
        match word {
            Feedback::Neutral => self,
            said => Self { said, ..self },
        }
    }
}

/// The probability that the trainer ends the session after an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hazard {
    /// After a move, if nothing was said in the session.
    pub moved: f32,
    /// After a rest that follows a move, if nothing was said.
    pub rested: f32,
    /// After a further rest in a row, if nothing was said.
    pub resting: f32,
    /// The factor if the last word was "good bot".
    pub praised: f32,
    /// The factor if the last word was "bad bot".
    pub scolded: f32,
}

impl Hazard {
    /// The same probability at every moment.
    pub const fn of(probability: f32) -> Self {
        Self { moved: probability, rested: probability, resting: probability, praised: 1.0, scolded: 1.0 }
    }

    /// The probability that the session ends now.
    pub fn at(&self, moment: Moment) -> f32 {
        let hazard = match moment.rests {
            0 => self.moved,
            1 => self.rested,
            _ => self.resting,
        };
        match moment.said {
            Feedback::Reward => hazard * self.praised,
            Feedback::Punish => hazard * self.scolded,
            Feedback::Neutral => hazard,
        }
    }

    /// Whether it is a probability below 1 at every moment.
    fn is_sound(&self) -> bool {
        let most = if self.praised > self.scolded { self.praised } else { self.scolded };
        self.praised >= 0.0
            && self.scolded >= 0.0
            && [self.moved, self.rested, self.resting].iter().all(|&hazard| (0.0..1.0).contains(&hazard) && hazard * most < 1.0)
    }
}

/// The probability that the trainer ends the session after an action, at the goal and elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// If the task is done.
    pub at_goal: Hazard,
    /// If it is not.
    pub elsewhere: Hazard,
}

impl Ending {
    /// An end is no evidence: a robot may not know why a session ended.
    pub const NO_EVIDENCE: Self = Self { at_goal: Hazard::of(0.0), elsewhere: Hazard::of(0.0) };

    /// Whether an end is evidence.
    pub fn is_evidence(&self) -> bool {
        self.at_goal != self.elsewhere
    }

    /// Whether all hazards are probabilities below 1.
    pub(crate) fn is_sound(&self) -> bool {
        self.at_goal.is_sound() && self.elsewhere.is_sound()
    }

    /// The probability that the session ends, or goes on, in a state with the task done or not done.
    ///
    /// ```
    /// use goodbot::feedback::{Ending, Feedback, Hazard, Moment};
    /// let at_goal = Hazard { moved: 0.25, rested: 0.5, ..Hazard::of(0.5) };
    /// let ending = Ending { at_goal, elsewhere: Hazard::of(0.125) };
    /// let moved = Moment { rests: 0, said: Feedback::Neutral };
    /// assert_eq!(ending.probability(true, true, moved), 0.25);
    /// assert_eq!(ending.probability(false, false, moved), 0.875);
    /// assert_eq!(ending.probability(true, true, Moment { rests: 1, ..moved }), 0.5);
    /// ```
    pub fn probability(&self, ends: bool, at_goal: bool, moment: Moment) -> f32 {
        let ending = if at_goal { self.at_goal.at(moment) } else { self.elsewhere.at(moment) };
        if ends { ending } else { 1.0 - ending }
    }
}
