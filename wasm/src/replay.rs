//! A session of a log, once more: the same command in the same home, the same actions and the same feedback teach the same.
//!
//! A log may say more than the page itself does: the tasks' prior, the trainer strategies, a session that goes on from the one before, and
//! demonstrations.

use std::cell::RefCell;

use goodbot::feedback::Strategy;
use goodbot::oomdp::{action_named, apply};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet};
use goodbot_formats::session::{Kind, RecordedSession, StrategyRecord};

use crate::log::{AnswerLine, Line, Step};
use crate::training::task_name;
use crate::world::{Refusal, World};

impl World {
    /// Takes the trainer strategies of a log, each with how probable it is, in any unit. Where they are what is believed already, to the last
    /// bit, nothing changes: a log of this robot's own teaches it the same again. A session under way ends unlearned.
    ///
    /// # Errors
    /// What is no probability.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), Refusal> {
        self.forget();
        let belief = self.agent().belief();
        let known = belief.strategies().iter().enumerate().map(|(at, (strategy, _))| (*strategy, belief.strategy_probability(at)));
        if known.eq(strategies.iter().copied()) {
            return Ok(());
        }
        // The largest is 1, so that single precision never makes all of them 0.
        let largest = strategies.iter().map(|(_, prior)| *prior).fold(0.0, f32::max);
        let scaled: Vec<_> = strategies.iter().map(|(strategy, prior)| (*strategy, prior / largest)).collect();
        self.mind.set_strategies(&scaled).map_err(Refusal::from)
    }

    /// Hears a command with a prior for each task by its name in logs, instead of what the words say; 0 for the tasks that are not named. A
    /// session under way ends unlearned.
    ///
    /// # Errors
    /// As [`hear`](Self::hear); a name that is no task's, and numbers that are no probabilities.
    pub fn hear_with_prior<'n>(&mut self, command: &str, prior: impl Iterator<Item = (&'n str, f32)> + Clone) -> Result<(), Refusal> {
        self.forget();
        let Self { mind, rooms, state, .. } = self;
        let known = RefCell::new(Vec::new());
        let of = |task: &GroundedTask, lifted: &LiftedTask| {
            let name = task_name(rooms, lifted, task);
            let found = prior.clone().find(|(named, _)| *named == name);
            known.borrow_mut().push(name);
            found.map_or(0.0, |(_, prior)| prior)
        };
        let heard = mind.hear_with_prior(rooms, state, command, of).map_err(Refusal::from);
        let known = known.into_inner();
        let strange = prior.map(|(name, _)| name).find(|&name| !known.is_empty() && known.iter().all(|known| known != name));
        if let Some(name) = strange {
            self.mind.forget();
            return Err(Refusal(format!("“prior” names {name}, which is no task of this page")));
        }
        heard?;
        self.record(command, false)
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
            recording.steps.push(Line::Step(Step::new(action.to_owned(), None)));
        }
        Ok(())
    }

    /// Takes in an answer that is told in full, as a log has it: whether what is meant is among the tasks of these names, how often that is
    /// wrong, and how many other answers there were.
    ///
    /// # Errors
    /// A name that is no task's; what [`Agent::answered`](goodbot::Agent::answered) refuses.
    pub fn answer_as(&mut self, names: Vec<String>, yes: bool, eta: f32, others: u8) -> Result<(), Refusal> {
        let known = self.belief().tasks;
        let position =
            |name: &String| known.iter().position(|task| task.name == *name).ok_or_else(|| Refusal(format!("{name} is no task here")));
        let tasks = names.iter().map(position).collect::<Result<TaskSet, Refusal>>()?;
        let _ = self.mind.answered(tasks, yes, eta, others).map_err(Refusal::from)?;
        if let Some(recording) = &mut self.recording {
            recording.steps.push(Line::Answer(AnswerLine::new(names, yes, eta, others)));
        }
        Ok(())
    }

    /// Takes in the answers of a recorded session that stand behind so many steps.
    fn take_recorded_answers(&mut self, session: &RecordedSession, steps: usize) -> Result<(), Refusal> {
        for recorded in session.answers_after(steps) {
            let answer = &recorded.answer;
            let names = answer.tasks.iter().map(ToString::to_string).collect();
            self.answer_as(names, answer.yes, answer.eta as f32, answer.others)?;
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
                let strategy = |record: &StrategyRecord| -> Result<(Strategy, f32), Refusal> {
                    let strategy = Strategy::new(record.mu_plus as f32, record.mu_minus as f32, record.epsilon as f32);
                    let lags = record.lags.map_or(Strategy::NO_LAG, |lags| lags.map(|lag| lag as f32));
                    let strategy = strategy.and_then(|strategy| strategy.with_lags(lags)).map_err(Refusal::from)?;
                    Ok((strategy, record.prior as f32))
                };
                self.set_strategies(&records.iter().map(strategy).collect::<Result<Vec<_>, Refusal>>()?)?;
            }
            match &header.prior {
                None => self.hear(&header.command)?,
                Some(prior) => {
                    // In any unit: the largest is 1, so that single precision never makes all of them 0.
                    let largest = prior.iter().map(|(_, prior)| *prior).fold(0.0, f64::max);
                    let prior: Vec<(String, f32)> =
                        prior.iter().map(|(task, prior)| (task.to_string(), (prior / largest) as f32)).collect();
                    self.hear_with_prior(&header.command, prior.iter().map(|(task, prior)| (task.as_str(), *prior)))?;
                }
            }
        }
        for (done, (_, step)) in session.steps.iter().enumerate() {
            self.take_recorded_answers(session, done)?;
            while !self.plan(u32::MAX)? {}
            match step.feedback {
                None => self.demonstrate(&step.action)?,
                Some(feedback) => {
                    self.act_as(&step.action)?;
                    self.judge(feedback.as_str())?;
                }
            }
        }
        self.take_recorded_answers(session, session.steps.len())?;
        if session.learn {
            self.finish()?;
            while !self.learn(u32::MAX) {}
        } else {
            self.set_aside();
        }
        Ok(())
    }
}
