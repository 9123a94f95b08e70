//! One robot, one home, and the session under way. All that this command asks of the core is asked here.
//!
//! [`Trainer::hear`], then over and over [`Trainer::plan`] until it is done, [`Trainer::act`], [`Trainer::judge`], [`Trainer::go_on`]; at the
//! end [`Trainer::finish`] and [`Trainer::learn`] until it is done, or [`Trainer::forget`].
//!
//! What the trainer says counts at once, and of several words to one step the last one counts. To take a step back, the session is walked
//! again up to there: the same actions and the same feedback give the same belief.
//!
//! - [`asking`]: what the robot asks; [`mind`]: the robot's mind and its home in memory; [`thoughts`]: what the robot thinks.

mod asking;
mod mind;
mod thoughts;

pub use thoughts::{Idea, Meaning, WordSupport};

use crate::ask::meanings::FEW_LESSONS;
use crate::lessons::restored::room_for;
use crate::replay::believes::Believes;
use crate::teach::scene::{Scene, scene};
use crate::teach::session::{Judged, Session, Step};
use goodbot::feedback::{Feedback, SimulatedTrainer, Strategy};
use goodbot::home::{Home, HomeState};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{action_name, action_named};
use goodbot::planning::{Judgement, OptimalSet, Progress};
use goodbot::session::{Evidence, Finished};
use goodbot::snapshot::Contents;
use goodbot::talk::{ClosedWords, Hypothesis, Verdict};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities};
use goodbot_course::exercise::Intention;
use goodbot_course::generator;
use goodbot_course::next_lesson::times_heard;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use mind::{build, expect, new_mind};
use rand_pcg::Pcg32;
use std::fmt;

/// Why something was refused, in words for the trainer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal(pub String);

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// An error of the core as a refusal.
pub fn refused(error: impl fmt::Display) -> Refusal {
    Refusal(error.to_string())
}

fn no_session() -> Refusal {
    Refusal("no session is under way; give a command first".to_owned())
}

/// What came of words to the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heard {
    /// A session has begun.
    Command,
    /// The task that is meant, in words, is done already. No session has begun.
    Done(String),
    /// The words are taken for something that the robot does not do. No session has begun.
    Nothing(Hypothesis),
}

/// What the robot did last.
#[derive(Clone, Debug, PartialEq)]
pub struct Acted {
    /// The action's name.
    pub action: String,
    /// The position of the task that it followed.
    pub task: usize,
    /// How probable it is that the action is right: the tasks for which it is optimal, together.
    pub confidence: f32,
    /// What the plan says for the task that it followed.
    pub plan: OptimalSet,
    /// What was said to it.
    pub judged: Option<Feedback>,
    /// How the action is judged for each task, by position.
    judgements: Vec<Judgement>,
    /// Where everything was before it.
    before: HomeState,
}

impl Acted {
    /// Whether the step was right for a task, by its position; `None` where no plan says so exactly.
    pub fn is_right(&self, task: usize) -> Option<bool> {
        match self.judgements.get(task)? {
            Judgement::Correct => Some(true),
            Judgement::Incorrect => Some(false),
            Judgement::Unknown => None,
        }
    }
}

/// One robot, one home, and the session under way.
pub struct Trainer {
    mind: Agent<AgentHeap>,
    rooms: Home<HomeHeap>,
    start: HomeState,
    state: HomeState,
    session: Option<Session>,
    acted: Option<Acted>,
    random: Pcg32,
    /// What it expects of its trainer, where that was told.
    believes: Option<Believes>,
    /// The words for which there was nothing to do, if they were the last.
    declined: Option<String>,
}

impl Trainer {
    /// A robot that has learned nothing yet, in a home. `seed` decides its draws among what is equally good, `ways` whether commands may mean
    /// ways too, and `believes` what it expects of its trainer, where that is not what real people do.
    pub fn new(file: &EnvironmentFile, seed: u64, ways: bool, believes: Option<Believes>) -> Result<Self, Refusal> {
        let (rooms, start) = build(file)?;
        let mind = new_mind(&Capacities::STANDARD, ways, believes.as_ref())?;
        Ok(Self { mind, rooms, start, state: start, session: None, acted: None, random: generator(seed), believes, declined: None })
    }

    /// Whether commands may mean ways too.
    fn has_ways(&self) -> bool {
        self.mind.lifted().iter().any(LiftedTask::has_way)
    }

    /// Replaces what the robot has learned by a model file. A session under way ends unlearned.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let contents = Contents::read(bytes).map_err(refused)?;
        let mut mind = new_mind(&room_for(&contents), self.has_ways(), self.believes.as_ref())?;
        mind.restore(bytes).map_err(refused)?;
        if self.believes.is_some() {
            expect(&mut mind, self.believes.as_ref())?;
        }
        mind.learn_fully();
        self.forget();
        self.mind = mind;
        Ok(())
    }

    /// A new robot, which has learned nothing, in the same home. A session under way ends unlearned.
    pub fn start_anew(&mut self) -> Result<(), Refusal> {
        self.forget();
        self.mind = new_mind(&Capacities::STANDARD, self.has_ways(), self.believes.as_ref())?;
        Ok(())
    }

    /// What the robot has learned, as the bytes of a model file. It must not be learning.
    pub fn save(&self) -> Result<Vec<u8>, Refusal> {
        self.mind.saved().map_err(refused)
    }

    /// Moves the robot to another home. A session under way ends unlearned.
    pub fn enter(&mut self, file: &EnvironmentFile) -> Result<(), Refusal> {
        let (rooms, start) = build(file)?;
        self.forget();
        (self.rooms, self.start, self.state) = (rooms, start, start);
        Ok(())
    }

    /// Puts everything back to where it was when the home was entered. A session under way ends unlearned.
    pub fn put_back(&mut self) {
        self.forget();
        self.state = self.start;
    }

    /// The home as it is now.
    pub fn scene(&self) -> Scene {
        scene(&self.rooms, &self.state)
    }

    /// The session under way.
    pub fn session(&self) -> Option<&Session> {
        self.session.as_ref()
    }

    /// What the robot did last, if it has not gone on since.
    pub fn acted(&self) -> Option<&Acted> {
        self.acted.as_ref()
    }

    /// How many sessions the robot has learned from.
    pub fn lessons_learned(&self) -> usize {
        self.mind.language().bitext().sessions()
    }

    /// In how many of the sessions that it has learned from the robot heard a word.
    pub fn times_heard(&self, word: &str) -> u32 {
        times_heard(&self.mind, word)
    }

    /// Hears a command where everything is now. A session under way ends unlearned. `intention` is what the trainer means, where that is
    /// known: it is written down, and never learned from.
    ///
    /// With some lessons, the robot first asks itself whether there is anything to do. Said once more, the words are a command all the same, unless
    /// they say what shall not be.
    pub fn hear(&mut self, command: &str, id: Option<String>, intention: Option<&Intention>) -> Result<Heard, Refusal> {
        self.forget();
        let is_again = self.declined.take().is_some_and(|declined| declined == command);
        let heard = if intention.is_some() { Heard::Command } else { self.listen(command)? };
        if heard != Heard::Command && (!is_again || heard == Heard::Nothing(Hypothesis::Negated)) {
            self.declined = Some(command.to_owned());
            return Ok(heard);
        }
        let environment = self.scene().environment;
        self.mind.hear(&self.rooms, &self.state, command).map_err(refused)?;
        let intended = intention.and_then(|intention| intention.find(&self.mind, &self.rooms));
        let mut session = Session::new(id, command, environment, intended, self.state);
        session.strategies = self.mind.belief().strategies().to_vec();
        self.session = Some(session);
        Ok(Heard::Command)
    }

    /// What the words are taken for.
    fn listen(&mut self, words: &str) -> Result<Heard, Refusal> {
        if self.lessons_learned() < FEW_LESSONS || self.mind.options().language.model != Model::Roles {
            return Ok(Heard::Command);
        }
        let listened = self.mind.listen(&self.rooms, &self.state, words, ClosedWords::EUROPEAN).map_err(refused)?;
        let task = self.words_of(listened.task).unwrap_or_default();
        self.mind.forget();
        Ok(match (listened.verdict, listened.hypothesis) {
            (_, Hypothesis::Negated) => Heard::Nothing(Hypothesis::Negated),
            (Verdict::Done, _) => Heard::Done(task),
            // A thing that nobody has named is perhaps to be learned.
            (_, Hypothesis::Command | Hypothesis::Absent | Hypothesis::About) => Heard::Command,
            (_, taken_for) => Heard::Nothing(taken_for),
        })
    }

    /// Goes on planning for where everything is now, with at most about `budget` looks. Gives whether the robot can act.
    pub fn plan(&mut self, budget: u32) -> Result<bool, Refusal> {
        let session = self.session.as_mut().ok_or_else(no_session)?;
        if self.mind.plan(&self.rooms, &self.state, budget).map_err(refused)? == Progress::Working {
            return Ok(false);
        }
        let step = session.again.pop_front();
        self.answer_again()?;
        let (Some(step), Some(session)) = (step, self.session.as_ref()) else { return Ok(true) };
        let (action, feedback, last) = (step.action, step.feedback, session.again.is_empty());
        self.perform(&action)?;
        self.judge(feedback)?;
        if last {
            self.answer_again()?;
            return Ok(true);
        }
        self.acted = None;
        Ok(false)
    }

    /// Plans to the end.
    pub fn plan_fully(&mut self) -> Result<(), Refusal> {
        while !self.plan(u32::MAX)? {}
        Ok(())
    }

    /// Where something was taken back, walks the session again to the end.
    pub fn plan_again(&mut self) -> Result<(), Refusal> {
        while self.is_walking_again() {
            self.plan(u32::MAX)?;
        }
        Ok(())
    }

    /// Whether a session is being walked again, after something was taken back.
    pub fn is_walking_again(&self) -> bool {
        self.session.as_ref().is_some_and(|session| !session.again.is_empty())
    }

    /// Decides on an action and does it. The plan must be done, and what was done before must be over: [`go_on`](Self::go_on).
    pub fn act(&mut self) -> Result<&Acted, Refusal> {
        if self.acted.is_some() {
            return Err(Refusal("the last step is not over yet".to_owned()));
        }
        let decision = self.mind.decide_by(&self.rooms, &self.state, &mut self.random).map_err(refused)?;
        let name = action_name(&self.rooms, decision.action).to_owned();
        self.perform(&name)?;
        self.acted.as_mut().map_or_else(
            || Err(no_session()),
            |acted| {
                acted.task = decision.task;
                acted.plan = decision.plan;
                Ok(&*acted)
            },
        )
    }

    /// Does the action of this name, for the most likely task. The plan must be done.
    fn perform(&mut self, name: &str) -> Result<(), Refusal> {
        let action = action_named(&self.rooms, name).ok_or_else(|| Refusal(format!("{name} is no action here")))?;
        let next = self.mind.acted(&self.rooms, &self.state, action).map_err(refused)?;
        let (plan, belief) = (self.mind.planned(), self.mind.belief());
        let task = self.mind.most_likely().ok_or_else(no_session)?;
        let tasks = 0..self.mind.tasks().len();
        let agrees = |&task: &usize| {
            let plan = plan.optimal(task);
            plan.exact().or(plan.onward()).is_some_and(|actions| actions.contains(action))
        };
        let confidence = tasks.clone().filter(agrees).map(|task| belief.probability(task)).sum::<f32>();
        self.acted = Some(Acted {
            action: name.to_owned(),
            task,
            confidence: confidence.clamp(0.0, 1.0),
            plan: plan.optimal(task),
            judged: None,
            judgements: tasks.map(|task| plan.judge(task, action)).collect(),
            before: self.state,
        });
        self.state = next;
        Ok(())
    }

    /// Takes in what the trainer says to the last step. It replaces what was said to it before.
    pub fn judge(&mut self, feedback: Feedback) -> Result<Judged, Refusal> {
        let nothing_done = || Refusal("there is no step to judge yet; let the robot go first".to_owned());
        let (Some(acted), Some(session)) = (self.acted.as_mut(), self.session.as_mut()) else { return Err(nothing_done()) };
        if acted.judged == Some(feedback) {
            return Ok(Judged::AsBefore);
        }
        let evidence = self.mind.feedback(feedback).map_err(refused)?;
        match acted.judged.replace(feedback) {
            None => session.judged(Step { action: acted.action.clone(), feedback, judgements: acted.judgements.clone() }),
            Some(_) => session.judged_anew(feedback),
        }
        Ok(match evidence {
            Evidence::Used => Judged::Counted,
            Evidence::SaysNothing => Judged::SaysNothing,
            Evidence::Impossible => Judged::Impossible,
        })
    }

    /// The last step is over: where nothing was said to it, that was silence.
    pub fn go_on(&mut self) -> Result<(), Refusal> {
        if self.acted.as_ref().is_some_and(|acted| acted.judged.is_none()) {
            self.judge(Feedback::Neutral)?;
        }
        self.acted = None;
        Ok(())
    }

    /// Takes back the last step, and what was said to it. [`plan`](Self::plan) until that is done. Gives `false` where there is none.
    pub fn take_back(&mut self) -> Result<bool, Refusal> {
        let session = self.session.as_mut().ok_or_else(no_session)?;
        if let Some(Acted { judged: None, before, .. }) = self.acted {
            self.state = before;
            self.acted = None;
            return Ok(true);
        }
        let mut steps = session.steps();
        if steps.pop().is_none() {
            return Ok(false);
        }
        self.walk_again(steps)?;
        Ok(true)
    }

    fn walk_again(&mut self, steps: Vec<Step>) -> Result<(), Refusal> {
        let Self { mind, rooms, session, state, acted, .. } = self;
        let session = session.as_mut().ok_or_else(no_session)?;
        (*state, *acted) = (session.begun, None);
        session.walk_again(steps);
        mind.forget_evidence();
        mind.hear(rooms, state, &session.command).map_err(refused)
    }

    /// What a simulated trainer who means the intended task says to the last step; `None` where nothing is intended or done.
    pub fn simulated_word(&mut self) -> Option<Feedback> {
        let intended = self.session.as_ref()?.intended?;
        let right = self.acted.as_ref()?.judgements.get(intended) == Some(&Judgement::Correct);
        Some(SimulatedTrainer { strategy: Strategy::BALANCED }.feedback(right, &mut self.random))
    }

    /// What the plan says for the intended task, as [`Acted::plan`] does.
    pub fn intended_plan(&self) -> Option<OptimalSet> {
        Some(self.mind.planned().optimal(self.session.as_ref()?.intended?))
    }

    /// Takes in that the trainer ends the session here. A step to which nothing was said is not part of it, nor the end after that.
    fn take_end(&mut self) -> Result<(), Refusal> {
        if self.acted.as_ref().is_some_and(|acted| acted.judged.is_none()) {
            return Ok(());
        }
        self.mind.plan_fully(&self.rooms, &self.state).map_err(refused)?;
        match self.mind.trainer_ended(&self.rooms, &self.state) {
            // What was only answered has no end that the trainer chose.
            Ok(_) | Err(AgentError::NothingDone) => Ok(()),
            Err(error) => Err(refused(error)),
        }
    }

    /// Ends the session and begins to learn from it. Gives its record, and which older sessions gave way because memory was full. A step
    /// to which nothing was said is left out.
    pub fn finish(&mut self) -> Result<(RecordedSession, Finished), Refusal> {
        self.plan_again()?;
        let record = self.record(true)?;
        self.take_end()?;
        let finished = self.mind.finish(&self.rooms);
        (self.session, self.acted) = (None, None);
        Ok((record, finished.map_err(refused)?))
    }

    /// Goes on learning, with at most about `budget` table cells of work. Gives whether it is done.
    pub fn learn(&mut self, budget: u32) -> bool {
        self.mind.learn(budget) == Progress::Done
    }

    /// Ends the session, if one is under way, without learning from it. Gives its record where anything was judged.
    pub fn forget(&mut self) -> Option<RecordedSession> {
        let record = self.record(false).ok().filter(|record| !record.steps.is_empty() || !record.answers.is_empty());
        self.acted = None;
        if self.session.take().is_some() {
            self.mind.forget();
        }
        record
    }

    fn record(&self, learn: bool) -> Result<RecordedSession, Refusal> {
        let session = self.session.as_ref().ok_or_else(no_session)?;
        let intended = session.intended.and_then(|position| self.name_of(position));
        Ok(session.record(intended.as_ref(), learn, |position| self.name_of(position)))
    }
}
