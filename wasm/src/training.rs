//! A session, from a command to a robot that has learned.
//!
//! [`World::hear`], then over and over [`World::plan`] until it is done, [`World::act`], [`World::judge`]; at the end [`World::finish`] and
//! [`World::learn`] until it is done, or [`World::forget`].

use crate::asking::support;
use crate::log::{lines, task_name};
use crate::route::Lookahead;
use crate::view::{Belief, Decided, Evidence, Heat, Route, Support, Task, TrainerStyle};
use crate::world::{ROOMS, Refusal, World, build, thing};
use goodbot::feedback::{Feedback, Strategy, population};
use goodbot::home::{Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::planning::{Judgement, Progress};
use goodbot::random::unit;
use goodbot::session::Finished;
use goodbot::talk::Conversation;
use goodbot::task::GroundedTask;
use goodbot_course::SimulatedTrainer;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::live::{Acted, LiveError};
use goodbot_lesson::replay::{expect, expects_people};
use goodbot_lesson::walk::Expected;
use rand_pcg::Pcg32;
use wasm_bindgen::prelude::*;

impl World {
    /// Sets the trainer strategies, each with its prior, in any unit. If they equal the current belief to the last bit, nothing changes. A
    /// session under way ends unlearned.
    ///
    /// # Errors
    /// Where a number is no probability.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), Refusal> {
        self.forget();
        // The largest is 1, so that single precision never makes all of them 0.
        let largest = strategies.iter().map(|(_, prior)| *prior).fold(0.0, f32::max);
        let expected = |&(strategy, recorded): &(Strategy, f32)| Expected { strategy, share: recorded / largest, recorded };
        expect(&mut self.lesson.agent, &strategies.iter().map(expected).collect::<Vec<_>>()).map_err(Refusal::from)
    }

    /// Sets whether the robot expects the feedback of real people, and learns how its trainer uses reward and punishment; else it expects
    /// the paper's balanced trainer. A session under way ends unlearned.
    ///
    /// # Errors
    /// None where the built-in strategies are sound.
    pub fn set_learns_style(&mut self, learns: bool) -> Result<(), Refusal> {
        self.forget();
        let strategies: &[(Strategy, f32)] = if learns { &population::STRATEGIES } else { &[(Strategy::BALANCED, 1.0)] };
        self.lesson.agent.set_strategies(strategies).map_err(Refusal::from)
    }

    /// Whether the robot learns how its trainer uses reward and punishment.
    pub fn learns_style(&self) -> bool {
        self.agent().belief().strategies().len() > 1
    }

    /// The strategies that the robot expected before it met its trainer, each with its prior; `None` if they are those of real people.
    pub fn expected(&self) -> Option<Vec<(Strategy, f32)>> {
        let belief = self.agent().belief();
        let expected = || belief.strategies().iter().enumerate().map(|(at, (strategy, _))| (*strategy, belief.expected(at)));
        (!expects_people(self.agent())).then(|| expected().collect())
    }

    /// The belief that the robot would have on hearing a command in this home, given as JSON. It learns nothing from that, and everything
    /// stays in place. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why the home cannot be used, or the command cannot be heard in it.
    pub fn asked(&mut self, environment: &str, command: &str) -> Result<Belief, Refusal> {
        self.forget();
        let file = EnvironmentFile::parse(environment).map_err(Refusal::from)?;
        let (home, start) = build(&file, self.moves, &ROOMS)?;
        let mind = &mut self.lesson.agent;
        mind.resume(Conversation::NEW);
        mind.hear(&home, &start, command).map_err(Refusal::from)?;
        let belief = self.belief_in(&home, self.agent().tasks());
        self.lesson.agent.forget_evidence();
        Ok(belief)
    }

    /// Whether a session is under way.
    pub fn is_listening(&self) -> bool {
        self.lesson.is_under_way()
    }

    /// Decides on an action and does it. The plan must be done; the action waits for [`judge`](Self::judge).
    ///
    /// # Errors
    /// Where no session is under way, the plan is not done, or the last action was not judged.
    pub fn act(&mut self) -> Result<Decided, Refusal> {
        let Self { lesson, random, .. } = self;
        let acted = lesson.act(random).map_err(Refusal::from)?.clone();
        Ok(self.decided(acted))
    }

    /// Does the action of this name instead, as in a log. The robot still decides, so that it goes on following the same task among equals.
    ///
    /// # Errors
    /// As [`act`](Self::act), and where there is no such action.
    pub fn act_as(&mut self, action: &str) -> Result<Decided, Refusal> {
        let (mind, rooms, state) = self.lesson.parts();
        mind.decide_with(rooms, state, &mut self.random).map_err(Refusal::from)?;
        let acted = self.lesson.act_as(action).map_err(Refusal::from)?.clone();
        Ok(self.decided(acted))
    }

    fn decided(&self, Acted { action, task, confidence, .. }: Acted) -> Decided {
        let agent = self.agent();
        let plans = (0..agent.tasks().len()).map(|task| agent.planned().optimal(task).name()).collect();
        Decided { action, task, confidence, plans }
    }

    /// Takes in the trainer's feedback to the last action: `reward`, `punish`, or anything else for silence.
    ///
    /// # Errors
    /// Where no action waits for feedback.
    pub fn judge(&mut self, feedback: &str) -> Result<Evidence, Refusal> {
        let feedback = feedback.parse().unwrap_or(Feedback::Neutral);
        let words = |judgement: &Judgement| match judgement {
            Judgement::Correct => "right",
            Judgement::Incorrect => "wrong",
            Judgement::Unknown => "unknown",
        };
        let Some(Acted { action, judgements, .. }) = self.lesson.acted().cloned() else { return Err(Refusal::from(LiveError::NoStep)) };
        let before = self.probabilities();
        let outcome = self.lesson.judge(feedback).map_err(Refusal::from)?.name();
        self.lesson.go_on().map_err(Refusal::from)?;
        let judgements = judgements.iter().map(words).collect();
        Ok(Evidence { action, feedback: feedback.name(), outcome, judgements, before, after: self.probabilities() })
    }

    /// A number from 0 to 1 of the world's own random draws.
    pub fn random(&mut self) -> f32 {
        unit(&mut self.random)
    }

    pub(crate) fn probabilities(&self) -> Vec<f32> {
        (0..self.agent().tasks().len()).map(|task| self.agent().belief().probability(task)).collect()
    }

    /// Counts the sessions that gave way to a new one, and leaves fewer sentences of the starter.
    pub(crate) fn learned(&mut self, finished: &Finished) {
        self.gave_way += finished.gave_way.count();
        self.starter.fade(&mut self.lesson.agent, finished);
    }

    /// How many older sessions this robot has forgotten for new ones, because its memory was full.
    pub fn gave_way(&self) -> usize {
        self.gave_way
    }

    /// The session under way as lines of a log, ended with or without learning.
    ///
    /// # Errors
    /// Where no session is under way.
    pub fn log(&self, learn: bool) -> Result<String, Refusal> {
        lines(&self.lesson, learn).ok_or(LiveError::NoSession).map_err(Refusal::from)
    }

    /// The robot's belief; it has no tasks if no session is under way.
    pub fn belief(&self) -> Belief {
        self.belief_in(self.home(), if self.is_listening() { self.agent().tasks() } else { &[] })
    }

    fn belief_in(&self, home: &Home<impl HomeMemory>, tasks: &[GroundedTask]) -> Belief {
        let agent = self.agent();
        let named = |(position, task): (usize, &GroundedTask)| {
            let lifted = agent.lifted().get(usize::from(task.lifted))?;
            let probability = agent.belief().probability(position);
            Some(Task { name: task_name(home, lifted, task), probability })
        };
        Belief { tasks: tasks.iter().enumerate().filter_map(named).collect(), trainer: self.trainer() }
    }

    /// The belief about the trainer, averaged over all strategies.
    fn trainer(&self) -> TrainerStyle {
        let belief = self.agent().belief();
        // The words of a command alone must not change the numbers of the trainer, not by one bit.
        let has_evidence = belief.has_evidence();
        let mut style = TrainerStyle { learned: self.learns_style(), good: 0.0, bad: 0.0, mistakes: 0.0, late: 0.0 };
        for (at, &(strategy, begun)) in belief.strategies().iter().enumerate() {
            let share = if has_evidence { belief.strategy_probability(at) } else { begun };
            let [_, late, later] = strategy.lags();
            style.good += share * (1.0 - strategy.mu_plus());
            style.bad += share * (1.0 - strategy.mu_minus());
            style.mistakes += share * strategy.epsilon();
            style.late += share * (late + later);
        }
        style
    }

    /// Goes on looking ahead, with about `budget` node expansions. Returns whether it is done, and then the route; `None` if the task leads
    /// nowhere, or the search takes too long.
    pub fn look(&mut self, budget: u32) -> (bool, Option<Route>) {
        let Self { ahead, scout, lesson, .. } = self;
        let (rooms, mind) = (lesson.home(), &lesson.agent);
        let Some(looking) = ahead else { return (true, None) };
        if looking.advance(scout, rooms, mind.lifted(), budget) == Progress::Working {
            return (false, None);
        }
        (true, ahead.take().and_then(Lookahead::states).and_then(|states| route(rooms, &states)))
    }

    /// Which word of the command speaks for which task.
    ///
    /// # Errors
    /// Where no session is under way or a table is full.
    pub fn support(&self) -> Result<Support, Refusal> {
        if !self.is_listening() {
            return Err(Refusal::from(LiveError::NoSession));
        }
        let mut support = support(self.agent(), self.home()).map_err(Refusal::from)?;
        // Whole words, not only the beginnings that are kept. If the robot listened, some words are about the command, and not part of it, or the
        // robot has put them into another order.
        let mut said = Vec::new();
        let command = self.lesson.command().unwrap_or_default();
        let take = |word: &str| {
            said.push(word.to_owned());
            Ok(())
        };
        self.agent().options().language.model.for_each_word(command, take).map_err(Refusal::from)?;
        for (at, word) in support.words.iter_mut().enumerate().filter(|(_, word)| !said.contains(word)) {
            let (before, ahead) = said.split_at(at.min(said.len()));
            if let Some(whole) = ahead.iter().chain(before).find(|whole| whole.starts_with(word.as_str())) {
                whole.clone_into(word);
            }
        }
        Ok(support)
    }

    /// The meaning of every word to the robot: the translation table as it was last learned.
    pub fn heat(&self) -> Heat {
        let language = self.agent().language();
        let tables = language.tables();
        let words: Vec<_> = language.words().iter().take(tables.words()).collect();
        let tokens: Vec<_> = language.tokens().iter().take(tables.tokens()).collect();
        let cells = tokens.iter().flat_map(|(token, _)| words.iter().map(|(word, _)| tables.translation(*word, Some(*token))));
        Heat {
            cells: cells.collect(),
            idle: words.iter().map(|(word, _)| tables.translation(*word, None)).collect(),
            words: words.iter().map(|(_, text)| (*text).to_owned()).collect(),
            tokens: tokens.iter().map(|(_, text)| (*text).to_owned()).collect(),
            letters: self.agent().options().language.letters_kept(),
        }
    }
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// The feedback to the last action of a simulated trainer, who means the given task and follows the paper's balanced strategy.
    ///
    /// # Errors
    /// Where no action waits for feedback.
    #[wasm_bindgen(js_name = simulatedFeedback)]
    pub fn simulated_feedback(&mut self, intended: usize) -> Result<String, Refusal> {
        let right = self.lesson.acted().ok_or(LiveError::NoStep).map_err(Refusal::from)?.is_right(intended) == Some(true);
        Ok(SimulatedTrainer { strategy: Strategy::BALANCED }.feedback(right, &mut self.random).name().to_owned())
    }

    /// Hears a command in the current state. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why the command cannot be heard; the training data are kept.
    pub fn hear(&mut self, command: &str) -> Result<(), Refusal> {
        self.forget();
        let environment = self.environment_now();
        self.lesson.hear(command, environment).map_err(Refusal::from)?;
        let Self { scout, lesson, .. } = self;
        scout.set_tasks(lesson.home(), lesson.agent.lifted(), lesson.agent.tasks()).map_err(Refusal::from)
    }

    /// Goes on planning for the current state, with at most about `budget` node expansions. Returns whether the plan is done.
    ///
    /// # Errors
    /// Where no session is under way.
    pub fn plan(&mut self, budget: u32) -> Result<bool, Refusal> {
        self.lesson.plan(budget).map_err(Refusal::from)
    }

    /// Leaves the last action unjudged, which is no silence either: the belief stays as it is, as in a test.
    pub fn unjudged(&mut self) {
        self.lesson.leave_unjudged();
    }

    /// Seeds the random draws of this step of the robot's next session. The same words at the same steps then give the same steps,
    /// whatever was drawn before.
    #[wasm_bindgen(js_name = drawFrom)]
    pub fn draw_from(&mut self, seed: u32, step: u32) {
        let session = u64::try_from(self.sessions()).unwrap_or(u64::MAX);
        self.random = Pcg32::new(u64::from(seed) << 32 | u64::from(step), session);
    }

    /// Ends the session and begins to learn from it. Returns the session as lines of a log.
    ///
    /// # Errors
    /// Where no session is under way or a table is full; the training data are kept.
    pub fn finish(&mut self) -> Result<String, Refusal> {
        let log = self.log(true)?;
        let finished = self.lesson.finish().map_err(Refusal::from)?;
        self.learned(&finished);
        Ok(log)
    }

    /// Goes on learning, with at most about `budget` table cells of work. Returns whether it is done.
    pub fn learn(&mut self, budget: u32) -> bool {
        self.lesson.agent.learn(budget) == Progress::Done
    }

    /// Ends the session, if one is under way, without learning from it: the belief about the trainer, too, is as before.
    pub fn forget(&mut self) {
        if self.replaying.take().is_some() || self.lesson.is_under_way() {
            self.lesson.agent.forget_evidence();
        }
        self.lesson.forget();
        self.ahead = None;
    }

    /// How many sessions the robot has learned from, without its starter.
    pub fn sessions(&self) -> usize {
        self.agent().language().bitext().sessions() - self.starter.places.count()
    }

    /// Begins to look where a task would lead from here: call [`look`](Self::look) until it is done.
    #[wasm_bindgen(js_name = lookAhead)]
    pub fn look_ahead(&mut self, task: usize) {
        self.ahead = self.lesson.agent.tasks().get(task).map(|&goal| Lookahead::new(*self.lesson.state(), task, goal));
    }
}

fn route(home: &Home<impl HomeMemory>, states: &[HomeState]) -> Option<Route> {
    let end = states.last()?;
    let moved = std::iter::once(home.agent()).chain(home.blocks().iter().copied());
    Some(Route {
        cells: states.iter().map(|state| home.agent_cell(state)).map(|cell| [cell.x, cell.y]).collect(),
        end: moved.map(|id| thing(home, end, id)).collect(),
    })
}
