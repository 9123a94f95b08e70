//! One robot, one home, and the session under way. All that this command asks of the core is asked here.
//!
//! [`Trainer::hear`], then over and over [`Trainer::plan`] until it is done, [`Trainer::act`], [`Trainer::judge`], [`Trainer::go_on`]; at the
//! end [`Trainer::finish`] and [`Trainer::learn`] until it is done, or [`Trainer::forget`].
//!
//! What the trainer says counts at once, and of several words to one step the last one counts. To take a word or a step back, the session
//! is walked again up to there: the same actions and the same feedback give the same belief.
//!
//! - [`mind`]: the robot's mind and its home in memory; [`thoughts`]: what the robot thinks.

mod mind;
mod thoughts;

pub use thoughts::{Idea, Meaning, WordSupport};

use crate::lessons::restored::room_for;
use crate::teach::scene::{Scene, scene};
use crate::teach::session::{Judged, Session, Step, Verdict};
use goodbot::feedback::{Feedback, SimulatedTrainer, Strategy};
use goodbot::home::{Home, HomeState};
use goodbot::oomdp::{Action, action_name, action_named, apply};
use goodbot::planning::{OptimalSet, Progress};
use goodbot::snapshot::Contents;
use goodbot::{Agent, Capacities};
use goodbot_course::exercise::Intention;
use goodbot_course::generator;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use mind::{Mind, Rooms, build, new_mind};
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

fn refused(error: impl fmt::Display) -> Refusal {
    Refusal(error.to_string())
}

fn no_session() -> Refusal {
    Refusal("no session is under way; give a command first".to_owned())
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
    /// What the plan says for the task that it followed: `toward`, `goal`, `dead end` or `unknown`.
    pub plan: &'static str,
    /// What was said to it.
    pub judged: Option<Feedback>,
    /// The action for the core.
    action_id: Action,
    /// Where everything was before it.
    before: Option<HomeState>,
}

/// One robot, one home, and the session under way.
pub struct Trainer {
    mind: Mind,
    rooms: Rooms,
    start: HomeState,
    state: HomeState,
    session: Option<Session>,
    acted: Option<Acted>,
    random: Pcg32,
}

const fn plan_word(plan: &OptimalSet) -> &'static str {
    match plan {
        OptimalSet::Toward(_) => "toward",
        OptimalSet::Goal => "goal",
        OptimalSet::DeadEnd(_) => "dead end",
        OptimalSet::Unknown => "unknown",
    }
}

impl Trainer {
    /// A robot that has learned nothing yet, in a home. `seed` decides its draws among what is equally good.
    pub fn new(file: &EnvironmentFile, seed: u64) -> Result<Self, Refusal> {
        let (rooms, start) = build(file)?;
        let mind = new_mind(&Capacities::STANDARD)?;
        Ok(Self { mind, rooms, start, state: start, session: None, acted: None, random: generator(seed) })
    }

    /// Replaces what the robot has learned by a model file. A session under way ends unlearned.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let contents = Contents::read(bytes).map_err(refused)?;
        let mut mind = new_mind(&room_for(&contents))?;
        mind.with_dependent_mut(|_, agent| agent.restore(bytes).map(|()| agent.learn_fully())).map_err(refused)?;
        self.forget();
        self.mind = mind;
        Ok(())
    }

    /// A new robot, which has learned nothing, in the same home. A session under way ends unlearned.
    pub fn start_anew(&mut self) -> Result<(), Refusal> {
        self.forget();
        self.mind = new_mind(&Capacities::STANDARD)?;
        Ok(())
    }

    /// What the robot has learned, as the bytes of a model file. It must not be learning.
    pub fn save(&self) -> Result<Vec<u8>, Refusal> {
        let agent = self.agent();
        let mut bytes = vec![0; agent.saved_bytes().map_err(refused)?];
        let length = agent.save(&mut bytes).map_err(refused)?;
        bytes.truncate(length);
        Ok(bytes)
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

    fn agent(&self) -> &Agent<'_> {
        self.mind.borrow_dependent()
    }

    fn home(&self) -> &Home<'_> {
        self.rooms.borrow_dependent()
    }

    /// The home as it is now.
    pub fn scene(&self) -> Scene {
        scene(self.home(), &self.state)
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
        self.agent().language().bitext().sessions()
    }

    /// Hears a command where everything is now. A session under way ends unlearned. `intention` is what the trainer means, where that is
    /// known: it is written down, and never learned from.
    pub fn hear(&mut self, command: &str, id: Option<String>, intention: Option<&Intention>) -> Result<(), Refusal> {
        self.forget();
        let environment = self.scene().environment;
        let Self { mind, rooms, state, .. } = self;
        mind.with_dependent_mut(|_, agent| agent.hear(rooms.borrow_dependent(), state, command)).map_err(refused)?;
        let intended = intention.and_then(|intention| intention.find(self.agent(), self.home()));
        self.session = Some(Session::new(id, command, environment, intended, self.state));
        Ok(())
    }

    /// Goes on planning for where everything is now, with at most about `budget` looks. Gives whether the robot can act.
    pub fn plan(&mut self, budget: u32) -> Result<bool, Refusal> {
        let session = self.session.as_mut().ok_or_else(no_session)?;
        let Self { mind, rooms, state, .. } = self;
        let progress = mind.with_dependent_mut(|_, agent| agent.plan(rooms.borrow_dependent(), state, budget)).map_err(refused)?;
        if progress == Progress::Working {
            return Ok(false);
        }
        let Some(step) = session.again.pop_front() else { return Ok(true) };
        let (action, feedback, last) = (step.action, step.feedback, session.again.is_empty());
        self.perform(&action)?;
        self.judge(feedback)?;
        if last {
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
        let Self { mind, random, .. } = self;
        let decision = mind.with_dependent_mut(|_, agent| agent.decide(Some(random))).map_err(refused)?;
        let name = action_name(self.home(), decision.action).to_owned();
        self.perform(&name)?;
        self.acted.as_mut().map_or_else(
            || Err(no_session()),
            |acted| {
                acted.task = decision.task;
                acted.plan = plan_word(&decision.plan);
                Ok(&*acted)
            },
        )
    }

    /// Does the action of this name, for the most likely task.
    fn perform(&mut self, name: &str) -> Result<(), Refusal> {
        let action = action_named(self.home(), name).ok_or_else(|| Refusal(format!("{name} is no action here")))?;
        let agent = self.agent();
        let task = agent.most_likely::<Pcg32>(None).ok_or_else(no_session)?;
        let agrees = |position: usize| {
            let right = agent.search().optimal(position).actions().is_some_and(|actions| actions.contains(action));
            if right { agent.belief().probability(position) } else { 0.0 }
        };
        let acted = Acted {
            action: name.to_owned(),
            task,
            confidence: (0..agent.tasks().len()).map(agrees).sum::<f32>().clamp(0.0, 1.0),
            plan: plan_word(&agent.search().optimal(task)),
            judged: None,
            action_id: action,
            before: Some(self.state),
        };
        self.state = apply(self.home(), &self.state, action).unwrap_or(self.state);
        self.acted = Some(acted);
        Ok(())
    }

    /// Takes in what the trainer says to the last step. Where something was said to it before, that is taken back: [`plan`](Self::plan)
    /// until it is done.
    pub fn judge(&mut self, feedback: Feedback) -> Result<Judged, Refusal> {
        let nothing_done = || Refusal("there is no step to judge yet; let the robot go first".to_owned());
        let (Some(acted), Some(session)) = (self.acted.as_mut(), self.session.as_mut()) else { return Err(nothing_done()) };
        if acted.judged == Some(feedback) {
            return Ok(Judged::AsBefore);
        }
        if acted.judged.is_some() {
            let mut steps = session.steps();
            if let Some(last) = steps.last_mut() {
                last.feedback = feedback;
            }
            self.walk_again(steps)?;
            return Ok(Judged::WalkingAgain);
        }
        let action = acted.action_id;
        let agent = self.mind.borrow_dependent();
        let verdict = |position: usize| match agent.search().optimal(position).actions() {
            Some(actions) if actions.contains(action) => Verdict::Right,
            Some(_) => Verdict::Wrong,
            None => Verdict::Unknown,
        };
        let verdicts = (0..agent.tasks().len()).map(verdict).collect();
        let counted = self.mind.with_dependent_mut(|_, agent| agent.feedback(action, feedback)).map_err(refused)?;
        acted.judged = Some(feedback);
        session.judged(Step { action: acted.action.clone(), feedback, verdicts });
        Ok(if counted { Judged::Counted } else { Judged::Impossible })
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
        if let Some(Acted { judged: None, before: Some(before), .. }) = self.acted {
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
        mind.with_dependent_mut(|_, agent| agent.hear(rooms.borrow_dependent(), state, &session.command)).map_err(refused)
    }

    /// What a simulated trainer who means the intended task says to the last step; `None` where nothing is intended or done.
    pub fn simulated_word(&mut self) -> Option<Feedback> {
        let intended = self.session.as_ref()?.intended?;
        let action = self.acted.as_ref()?.action_id;
        let right = self.agent().search().optimal(intended).actions().is_some_and(|actions| actions.contains(action));
        Some(SimulatedTrainer { strategy: Strategy::BALANCED }.feedback(right, &mut self.random))
    }

    /// What the plan says for the intended task, as [`Acted::plan`] does.
    pub fn intended_plan(&self) -> Option<&'static str> {
        Some(plan_word(&self.agent().search().optimal(self.session.as_ref()?.intended?)))
    }

    /// Ends the session and begins to learn from it. Gives its record. A step to which nothing was said is left out.
    pub fn finish(&mut self) -> Result<RecordedSession, Refusal> {
        self.plan_again()?;
        let record = self.record(true)?;
        let Self { mind, rooms, .. } = self;
        let ended = mind.with_dependent_mut(|_, agent| agent.finish(rooms.borrow_dependent()));
        (self.session, self.acted) = (None, None);
        ended.map_err(refused)?;
        Ok(record)
    }

    /// Goes on learning, with at most about `budget` table cells of work. Gives whether it is done.
    pub fn learn(&mut self, budget: u32) -> bool {
        self.mind.with_dependent_mut(|_, agent| agent.learn(budget)) == Progress::Done
    }

    /// Ends the session, if one is under way, without learning from it. Gives its record where anything was judged.
    pub fn forget(&mut self) -> Option<RecordedSession> {
        let record = self.record(false).ok().filter(|record| !record.steps.is_empty());
        self.acted = None;
        if self.session.take().is_some() {
            self.mind.with_dependent_mut(|_, agent| agent.forget());
        }
        record
    }

    fn record(&self, learn: bool) -> Result<RecordedSession, Refusal> {
        let session = self.session.as_ref().ok_or_else(no_session)?;
        let intended = session.intended.and_then(|position| self.name_of(position)).map(|name| name.atoms().to_vec());
        Ok(session.record(intended, learn))
    }
}
