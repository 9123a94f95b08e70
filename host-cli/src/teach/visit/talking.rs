//! What is said: the text field takes commands, and everything that is said to a robot on its way; the robot's actions are told in words.

use super::{Phase, Visit};
use crate::teach::pupil::{Meaning, Reaction};
use crate::words::{action_words, percent};
use goodbot::feedback::Feedback;
use goodbot::planning::OptimalSet;
use goodbot::session::Evidence;
use goodbot::talk::{Class, Hypothesis, Said};
use goodbot_console::Failure;
use std::time::Duration;

impl Visit {
    /// Says the written text.
    pub(super) fn say(&mut self, now: Duration) -> Result<(), Failure> {
        let words = self.prompt.text().trim().to_owned();
        let in_session = self.classroom.pupil.lesson.is_under_way();
        if words.is_empty() {
            (self.message, self.typing) =
                if in_session { (String::new(), false) } else { ("Write what it shall do, such as: go to the red room".to_owned(), true) };
            return Ok(());
        }
        let said = self.classroom.pupil.said(&words)?;
        if matches!(said, Said::Command | Said::Again) && self.classroom.doubts(&words)? {
            // The words stay written, and the robot waits.
            let under_way = self.classroom.pupil.lesson.command().unwrap_or_default();
            self.message = format!("It asks: leave \"{under_way}\" unlearned, for these words? Enter once more: yes. Esc: go on with it.");
            return Ok(());
        }
        if said == Said::Command {
            return self.command(&words);
        }
        self.prompt.said();
        // The words were about the robot on its way, so it continues.
        self.typing = !in_session;
        match said {
            Said::Judgement(feedback) => self.judge(feedback, now),
            Said::Finish => {
                self.judge(Feedback::Reward, now)?;
                self.finish()
            }
            Said::Answer(answer) => self.answer(answer),
            Said::Correction => self.correct(&words),
            Said::Stop => self.stop_it(),
            Said::Undo => self.undo(),
            Said::Again => match self.classroom.last.clone() {
                Some(command) => self.command(&command),
                None => {
                    self.message = "Nothing was said yet that it could do again.".to_owned();
                    Ok(())
                }
            },
            Said::Nothing(class) => {
                self.message = match class {
                    Class::Praise | Class::Blame | Class::Yes | Class::No => "There is no step to judge yet.".to_owned(),
                    Class::Back => "There is nothing to change yet.".to_owned(),
                    class => format!("It takes that for {}, and there is nothing to do.", class.name()),
                };
                Ok(())
            }
            Said::Command => Ok(()),
        }
    }

    /// Corrects the robot by words.
    fn correct(&mut self, words: &str) -> Result<(), Failure> {
        if self.tested.is_some() {
            self.message = "This is a test: it hears no words. Enter goes on.".to_owned();
            return Ok(());
        }
        let evidence = self.classroom.pupil.correct(words)?;
        let best = self.classroom.pupil.meanings().into_iter().next().map(|meaning| meaning.words).unwrap_or_default();
        self.message = match evidence {
            Evidence::Used => format!("It thinks again: \"{best}\"."),
            Evidence::Impossible | Evidence::Uninformative => "That tells it nothing.".to_owned(),
        };
        // A robot that waited at its goal continues.
        if let (Phase::Waiting(None), false) = (self.phase, self.paused) {
            self.go_on()?;
        }
        Ok(())
    }

    /// "Stop" pauses the robot. If it is paused already, it ends the session.
    fn stop_it(&mut self) -> Result<(), Failure> {
        if !self.classroom.pupil.lesson.is_under_way() {
            self.message = "It is doing nothing.".to_owned();
        } else if self.paused {
            self.classroom.forget()?;
            self.idle("Finished without learning: it knows what it knew before.".to_owned());
        } else {
            self.paused = true;
            self.message = "It waits. p goes on, o takes one step, stop once more ends this without learning.".to_owned();
        }
        Ok(())
    }

    /// Begins the next part of the utterance, and tells this result of the part before. Returns `false` if there is none.
    pub(super) fn go_on_with_the_rest(&mut self, result: &str) -> Result<bool, Failure> {
        let rest = self.classroom.pupil.lesson.rest().map(str::to_owned);
        let (Some(rest), Some(heard)) = (rest, self.classroom.hear_rest()?) else { return Ok(false) };
        if heard == Reaction::Command {
            self.begin()?;
            self.message = format!("{result} Now: \"{}\".", self.classroom.pupil.lesson.command().unwrap_or(&rest));
        } else {
            self.idle(format!("{result} {}", declined(&heard)));
        }
        Ok(true)
    }
}

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
