//! The robot's actions in words.

use super::{Phase, Visit};
use crate::teach::plain_names::{action_words, percent};
use crate::teach::pupil::{Meaning, Reaction};
use goodbot::feedback::Feedback;
use goodbot::planning::OptimalSet;
use goodbot::talk::Hypothesis;

/// From this probability on, a step counts as right for all guesses, and a guess as the only one.
const ALL: f32 = 0.995;

/// The message for words without anything to do.
pub fn declined(heard: &Reaction) -> String {
    match heard {
        Reaction::Command => String::new(),
        Reaction::Done(words) => format!("That is done already: \"{words}\". Say it once more, and it tries."),
        Reaction::Nothing(Hypothesis::Negated) => "It takes that for a prohibition, and waits. Say what it shall do.".to_owned(),
        Reaction::Nothing(taken_for) => format!("It takes that for {taken_for}, and waits. Say it once more, and it tries."),
    }
}

impl Visit {
    /// Whether several tasks may still be meant.
    fn is_undecided(&self) -> bool {
        self.classroom.pupil.meanings().first().is_some_and(|best| best.probability < ALL)
    }

    /// The robot's last action, and the feedback to it.
    pub fn told(&self) -> String {
        // The task that it followed, which may no longer be the likeliest after feedback.
        let followed = |task| self.classroom.pupil.meanings().into_iter().find(|meaning| meaning.position == task);
        match (self.phase, self.acted()) {
            (Phase::Idle, _) => self.stop().map_or_else(String::new, |stop| stop.hint().to_owned()),
            (Phase::Learning, _) => String::new(),
            (_, None) if self.phase == Phase::Planning => "It is making its plan …".to_owned(),
            (_, None) => "It waits.".to_owned(),
            (_, Some(acted)) => {
                let sure = percent(acted.confidence);
                let why = match acted.plan {
                    OptimalSet::Goal => followed(acted.task)
                        .map_or_else(String::new, |Meaning { words, .. }| format!("It thinks that it is done: \"{words}\".")),
                    OptimalSet::DeadEnd(_) => "It cannot do what it thinks is meant any more, so it stays.".to_owned(),
                    OptimalSet::Unknown => "This home is too large for its plan, so it stays.".to_owned(),
                    OptimalSet::Approximate(_) => format!("It {}: not the shortest way, perhaps.", action_words(&acted.action)),
                    OptimalSet::Toward(_) if acted.confidence > ALL && self.is_undecided() => {
                        format!("It {}: that is right whichever of its guesses you mean.", action_words(&acted.action))
                    }
                    OptimalSet::Toward(_) => format!("It {}, and is {sure} sure that this is right.", action_words(&acted.action)),
                };
                let who = if self.auto { "The simulated trainer" } else { "You" };
                let said = match acted.judged {
                    Some(Feedback::Reward) => format!(" {who} said: good."),
                    Some(Feedback::Punish) => format!(" {who} said: bad."),
                    _ if self.tested.is_none() && self.wait(acted).is_none() => " Good or bad?".to_owned(),
                    _ => String::new(),
                };
                format!("{why}{said}")
            }
        }
    }
}
