//! A live session: the robot hears a command, goes step by step, and the trainer judges each step.
//!
//! Call [`Lesson::hear`]. Then repeat [`Lesson::plan`] until it is done, [`Lesson::act`], [`Lesson::judge`] and [`Lesson::go_on`]. At the
//! end call [`Lesson::finish`] or [`Lesson::forget`].
//!
//! Feedback counts at once; the last feedback to a step replaces earlier ones. To take a step back, the session is replayed up to there:
//! the same steps and the same feedback give the same belief.

mod listening;
mod voice;

pub use voice::Voice;

use crate::asking::Restraint;
use crate::closed_words::CLOSED_WORDS;
use crate::name::task_name;
use crate::place::Place;
use crate::replay::{Event, Replay, ReplayError, Rules, expect_ends};
use crate::walk::{SessionAnswer, Step, Walk};
use goodbot::asking::Answer;
use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::Home;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{Action, Domain, action_name, action_named};
use goodbot::planning::{Judgement, OptimalSet, Progress};
use goodbot::session::{Evidence, Finished};
use goodbot::task::{GroundedTask, TaskSet};
use goodbot::{Agent, AgentError};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::quoted;
use goodbot_formats::session::Kind;
use goodbot_formats::task_text::GroundTaskText;
use rand_core::Rng;

/// The calls that a session refuses now.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LiveError {
    /// No command was heard.
    #[error("no session is under way; give a command first")]
    NoSession,
    /// The last step is not over: call [`Lesson::go_on`] first.
    #[error("the last step waits for a word, or for silence")]
    StepNotOver,
    /// No step waits for feedback.
    #[error("there is no step to judge yet; let the robot go first")]
    NoStep,
    /// No conversation has this name.
    #[error("no conversation in this home is called {}; {}", quoted(.id), match &.known[..] {
        [] => "none has begun yet: give a command first".to_owned(),
        known => format!("known are {}", known.join(", ")),
    })]
    NoConversation {
        /// The name.
        id: String,
        /// The names of all conversations here.
        known: Vec<String>,
    },
    /// The home has no action of this name.
    #[error("{0} is no action here")]
    NoAction(String),
    /// The agent's error.
    #[error(transparent)]
    Agent(#[from] AgentError),
}

impl From<ReplayError> for LiveError {
    fn from(ReplayError { error, .. }: ReplayError) -> Self {
        Self::Agent(error)
    }
}

/// The robot's last step.
#[derive(Clone, Debug, PartialEq)]
pub struct Acted {
    /// The action's name.
    pub action: String,
    /// The position of the task that it was for.
    pub task: usize,
    /// The total probability of the tasks for which it is right.
    pub confidence: f32,
    /// How far the plan toward the task's goal is known.
    pub plan: OptimalSet,
    /// For each task, by position, whether the step is right.
    pub judgements: Vec<Judgement>,
    /// The feedback; `None` before the first.
    pub judged: Option<Feedback>,
}

impl Acted {
    /// Whether the step was right for a task; `None` if that is not known.
    pub fn is_right(&self, task: usize) -> Option<bool> {
        match self.judgements.get(task)? {
            Judgement::Correct => Some(true),
            Judgement::Incorrect => Some(false),
            Judgement::Unknown => None,
        }
    }
}

/// The data of a session besides its walk.
#[derive(Clone, Debug)]
pub struct Session<R = EnvironmentFile> {
    /// The home, or the facts of another world, at the time of the command.
    pub environment: R,
    /// The trainer strategies expected then, each with its probability.
    pub strategies: Vec<(Strategy, f32)>,
    /// The task of the command before, if the utterance has several commands and this is a later one.
    pub after: Option<GroundedTask>,
    /// For each step taken, and each task, whether the step was right.
    judgements: Vec<Vec<Judgement>>,
    /// The replay, while the session is replayed after a step was taken back.
    again: Option<Replay>,
}

impl<R> Session<R> {
    const fn new(environment: R, strategies: Vec<(Strategy, f32)>) -> Self {
        Self { environment, strategies, after: None, judgements: Vec::new(), again: None }
    }

    /// The strategies that a log must name; `None` for the paper's single strategy, which every robot begins with.
    pub fn named_strategies(&self) -> Option<&[(Strategy, f32)]> {
        let is_paper = matches!(self.strategies.as_slice(), [] | [(Strategy::BALANCED, _)]);
        (!is_paper).then_some(&self.strategies)
    }
}

/// A robot in a home or another [place](Place), with the session under way.
///
/// ```
/// use goodbot::feedback::Feedback;
/// use goodbot::home::{Moves, paper_tasks};
/// use goodbot::memory::AgentHeap;
/// use goodbot::{Agent, Capacities, Options};
/// use goodbot_lesson::{home, live::Lesson};
///
/// let rooms = home::parse("home", "#########\n#rrr#ggg#\n#r@r+ggg#\n#rrr#ggg#\n#########\n").unwrap();
/// let (place, start) = home::build(&rooms, Moves::Push, home::memory()).unwrap();
/// let agent = Agent::new(AgentHeap::new(&Capacities::SMALL), &paper_tasks().unwrap(), Options::DEFAULT)?;
/// let mut lesson = Lesson::new(agent, place, start);
/// let mut random = rand_pcg::Pcg32::new(1, 1);
/// lesson.hear("go to the green room", rooms)?;
/// while !lesson.plan(10_000)? {}
/// let toward_green = lesson.act(&mut random)?.action == "east";
/// let _ = lesson.judge(if toward_green { Feedback::Reward } else { Feedback::Punish })?;
/// let recorded = lesson.recorded(true).unwrap();
/// let _ = lesson.finish()?;
/// lesson.agent.learn_fully();
/// assert_eq!((recorded.steps.len(), lesson.agent.language().bitext().sessions()), (1, 1));
/// # Ok::<(), goodbot_lesson::live::LiveError>(())
/// ```
#[derive(Debug)]
pub struct Lesson<D: Place = Home<HomeHeap>> {
    /// The robot.
    pub agent: Agent<AgentHeap>,
    walk: Walk<D>,
    state: D::State,
    session: Option<Session<D::Record>>,
    /// The last step, and the state before it.
    acted: Option<(Acted, Step<D::State>)>,
    restraint: Restraint,
    ahead: Option<listening::Ahead>,
    conversations: listening::Conversations,
    /// The closed words.
    pub closed: goodbot::talk::ClosedWords<'static>,
    /// The words said along with the feedback buttons.
    pub voice: Voice,
    /// The last words, if there was nothing to do for them.
    declined: Option<String>,
    /// The words that would have ended the session under way, if nothing else happened since.
    doubted: Option<String>,
}

impl Lesson {
    /// The names of the robot's actions, if a log must name them: if the robot does more than move.
    pub fn named_actions(&self) -> Option<impl Iterator<Item = &str>> {
        crate::place::named_actions(self.home())
    }
}

impl<D: Place> Lesson<D> {
    /// A robot in a home or another world. No session is under way.
    pub fn new(agent: Agent<AgentHeap>, home: D, start: D::State) -> Self {
        let walk = Walk::new(home, start, Kind::Feedback);
        Self {
            agent,
            walk,
            state: start,
            session: None,
            acted: None,
            restraint: Restraint::NEW,
            ahead: None,
            conversations: listening::Conversations::default(),
            closed: CLOSED_WORDS,
            voice: Voice::default(),
            declined: None,
            doubted: None,
        }
    }

    /// The home.
    pub const fn home(&self) -> &D {
        &self.walk.home
    }

    /// The present state.
    pub const fn state(&self) -> &D::State {
        &self.state
    }

    /// The robot, the home and the present state, for calls of the robot that need all three.
    pub const fn parts(&mut self) -> (&mut Agent<AgentHeap>, &D, &D::State) {
        (&mut self.agent, &self.walk.home, &self.state)
    }

    /// Moves everything to a state. The session under way is forgotten.
    pub fn put(&mut self, state: D::State) {
        self.forget();
        self.state = state;
        self.end_conversations();
    }

    /// Goes into another home. The session under way is forgotten.
    pub fn enter(&mut self, home: D, start: D::State) {
        self.forget();
        self.walk = Walk::new(home, start, Kind::Feedback);
        self.state = start;
        self.end_conversations();
    }

    /// Replaces the robot by another agent. The session under way is forgotten.
    pub fn replace_agent(&mut self, agent: Agent<AgentHeap>) {
        self.forget();
        self.restraint = Restraint::NEW;
        self.agent = agent;
    }

    /// Whether a session is under way.
    pub const fn is_under_way(&self) -> bool {
        self.session.is_some()
    }

    /// The walk of the session under way so far, and its other data.
    pub fn session(&self) -> Option<(&Walk<D>, &Session<D::Record>)> {
        self.session.as_ref().map(|session| (&self.walk, session))
    }

    /// The command of the session under way.
    pub fn command(&self) -> Option<&str> {
        self.session.as_ref().map(|_| self.walk.command.as_str())
    }

    /// The last step, until the robot goes on.
    pub const fn acted(&self) -> Option<&Acted> {
        match &self.acted {
            Some((acted, _)) => Some(acted),
            None => None,
        }
    }

    /// The number of steps of the session, including those that are yet to be replayed.
    pub fn steps(&self) -> usize {
        if self.is_under_way() { self.walk.steps.len() } else { 0 }
    }

    /// The feedback to each judged step, and for each task, by position, whether the step was right.
    pub fn done(&self) -> impl ExactSizeIterator<Item = (Feedback, &[Judgement])> {
        let judgements = self.session.as_ref().map_or(&[][..], |session| &session.judgements);
        self.walk.steps.iter().zip(judgements).map(|(step, judgements)| (step.feedback, judgements.as_slice()))
    }

    /// The name of a task, by its position.
    pub fn name_of(&self, position: usize) -> Option<GroundTaskText> {
        self.name_of_task(self.agent.tasks().get(position)?)
    }

    pub(crate) fn name_of_task(&self, task: &goodbot::task::GroundedTask) -> Option<GroundTaskText> {
        task_name(self.home(), self.agent.lifted().get(usize::from(task.lifted))?, task).ok()
    }

    /// Begins a session: the robot hears a command. `environment` is the [place](Place) as it is now, for the record. A session under way is
    /// forgotten.
    ///
    /// # Errors
    /// The errors of [`Agent::hear`].
    pub fn hear(&mut self, command: &str, environment: D::Record) -> Result<(), LiveError> {
        self.forget();
        expect_ends(&mut self.agent)?;
        // A robot that does not listen has no conversation.
        self.agent.resume(goodbot::talk::Conversation::NEW);
        self.agent.hear(&self.walk.home, &self.state, command)?;
        let strategies = self.agent.belief().strategies().to_vec();
        self.walk.listening = None;
        self.begin(command.to_owned(), Session::new(environment, strategies));
        Ok(())
    }

    /// Begins a session whose command the agent has heard.
    fn begin(&mut self, command: String, session: Session<D::Record>) {
        (self.walk.command, self.walk.start) = (command, self.state);
        self.walk.closed = self.closed;
        self.walk.steps.clear();
        self.walk.answers.clear();
        self.restraint.begin();
        self.doubted = None;
        self.session = Some(session);
    }

    /// Plans with a budget of about `budget` node expansions, and returns whether the plan is done. While the session is replayed, each
    /// call continues the replay; the plan is done when the last step is replayed.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::plan`].
    pub fn plan(&mut self, budget: u32) -> Result<bool, LiveError> {
        let session = self.session.as_mut().ok_or(LiveError::NoSession)?;
        let Some(again) = session.again.as_mut() else {
            return Ok(self.agent.plan(&self.walk.home, &self.state, budget)? == Progress::Done);
        };
        match again.advance(&mut self.agent, &self.walk, budget)? {
            Event::Planned(Some(&step)) => self.acted = Some((acted(&self.agent, &self.walk.home, step.action)?, step)),
            Event::Took(step, _) => {
                if let Some((acted, _)) = &mut self.acted {
                    acted.judged = Some(step.feedback);
                    session.judgements.push(acted.judgements.clone());
                }
                self.state = step.after(&self.walk.home);
            }
            Event::Ended => {
                session.again = None;
                // Without any step, the first one is still to be planned.
                return Ok(self.acted.is_some());
            }
            Event::Working | Event::Heard | Event::Answered(_) | Event::Planned(None) | Event::Closed(_) => {}
        }
        Ok(false)
    }

    /// Whether steps are still to be replayed.
    pub fn is_walking_again(&self) -> bool {
        self.session.as_ref().is_some_and(|session| session.again.is_some())
    }

    /// Replays all remaining steps at once.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub fn walk_on(&mut self) -> Result<(), LiveError> {
        while self.is_walking_again() {
            self.plan(u32::MAX)?;
        }
        Ok(())
    }

    /// The robot acts on its plan, which must be done. The last step must be over.
    ///
    /// # Errors
    /// [`LiveError::StepNotOver`], or the errors of [`Agent::decide_with`].
    pub fn act(&mut self, random: &mut impl Rng) -> Result<&Acted, LiveError> {
        self.doubted = None;
        self.check_over()?;
        let decision = self.agent.decide_with(&self.walk.home, &self.state, random)?;
        self.perform(decision.action, Some(decision.task))
    }

    /// The robot takes a step that somebody else chose, by the action's name.
    ///
    /// # Errors
    /// [`LiveError::NoAction`], or the errors of [`act`](Self::act).
    pub fn act_as(&mut self, action: &str) -> Result<&Acted, LiveError> {
        self.check_over()?;
        let action = action_named(self.home(), action).ok_or_else(|| LiveError::NoAction(action.to_owned()))?;
        self.perform(action, None)
    }

    fn check_over(&self) -> Result<(), LiveError> {
        if !self.is_under_way() {
            return Err(LiveError::NoSession);
        }
        if self.acted.is_some() { Err(LiveError::StepNotOver) } else { Ok(()) }
    }

    fn perform(&mut self, action: Action, task: Option<usize>) -> Result<&Acted, LiveError> {
        let home = &self.walk.home;
        let after = self.agent.acted(home, &self.state, action)?;
        let step = Step::new(self.state, action, after);
        let mut acted = acted(&self.agent, home, action)?;
        if let Some(task) = task {
            (acted.task, acted.plan) = (task, self.agent.planned().optimal(task));
        }
        self.state = after;
        Ok(&self.acted.insert((acted, step)).0)
    }

    /// The trainer gives feedback to the last step; [`Feedback::Neutral`] is silence. The last feedback to a step counts.
    ///
    /// # Errors
    /// [`LiveError::NoStep`], or the errors of [`Agent::feedback`].
    pub fn judge(&mut self, feedback: Feedback) -> Result<Evidence, LiveError> {
        let (Some((acted, step)), Some(session)) = (&mut self.acted, &mut self.session) else { return Err(LiveError::NoStep) };
        let evidence = self.agent.feedback(feedback)?;
        self.doubted = None;
        if acted.judged.replace(feedback).is_none() {
            self.walk.steps.push(*step);
            session.judgements.push(acted.judgements.clone());
        }
        if let Some(last) = self.walk.steps.last_mut() {
            last.feedback = feedback;
        }
        Ok(evidence)
    }

    /// The last step is over. Without feedback, silence counts.
    ///
    /// # Errors
    /// As [`judge`](Self::judge).
    pub fn go_on(&mut self) -> Result<(), LiveError> {
        if self.acted().is_some_and(|acted| acted.judged.is_none()) {
            let _ = self.judge(Feedback::Neutral)?;
        }
        self.acted = None;
        Ok(())
    }

    /// The last step is over. Without feedback, it is left out of the session: this is not silence.
    pub fn leave_unjudged(&mut self) {
        self.acted = None;
    }

    /// Takes the answer to the last question.
    ///
    /// # Errors
    /// The errors of [`Agent::answer`].
    pub fn answer(&mut self, answer: Answer) -> Result<Evidence, LiveError> {
        let question = self.agent.open_question().copied();
        self.restraint.expect(&self.agent, answer);
        let evidence = self.agent.answer(answer)?;
        if let Some((question, (tasks, yes, others))) = question.and_then(|question| Some((question, question.meaning(answer)?))) {
            self.note_answer(SessionAnswer { tasks, yes, others, ..SessionAnswer::of(question.eta) });
        }
        Ok(evidence)
    }

    /// Takes an answer without a question: whether the intended task is among these tasks, the probability that the answer is wrong, and
    /// how many other answers were possible.
    ///
    /// # Errors
    /// The errors of [`Agent::answered`].
    pub fn answered(&mut self, tasks: TaskSet, yes: bool, eta: f32, others: u8) -> Result<Evidence, LiveError> {
        let evidence = self.agent.answered(tasks, yes, eta, others)?;
        self.note_answer(SessionAnswer { tasks, yes, others, ..SessionAnswer::of(eta) });
        Ok(evidence)
    }

    fn note_answer(&mut self, answer: SessionAnswer) {
        self.doubted = None;
        if self.is_under_way() {
            // The answer comes before a step that waits for its feedback.
            let after = self.walk.steps.len();
            self.walk.answers.push(SessionAnswer { after, ..answer });
        }
    }

    /// Takes the last step back. [`plan`](Self::plan) then replays the session up to there. A step without feedback is only undone.
    /// Returns whether there was a step.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::hear`].
    pub fn take_back(&mut self) -> Result<bool, LiveError> {
        let session = self.session.as_mut().ok_or(LiveError::NoSession)?;
        if let Some((Acted { judged: None, .. }, step)) = &self.acted {
            self.state = step.before;
            self.acted = None;
            return Ok(true);
        }
        if self.walk.steps.pop().is_none() {
            return Ok(false);
        }
        let steps = self.walk.steps.len();
        self.walk.answers.retain(|answer| answer.after <= steps);
        session.judgements.clear();
        let mut again = Replay::new(Rules::UNDER_WAY);
        (self.state, self.acted) = (self.walk.start, None);
        self.agent.forget_evidence();
        let _ = again.advance(&mut self.agent, &self.walk, u32::MAX)?;
        session.again = Some(again);
        Ok(true)
    }

    /// Tells the agent that the trainer ends the session here, if the end is evidence. A last step without feedback is not part of the
    /// session, and the end after it is no evidence.
    fn take_end(&mut self) -> Result<(), LiveError> {
        if !self.agent.options().ending.is_evidence() || self.acted().is_some_and(|acted| acted.judged.is_none()) {
            return Ok(());
        }
        self.agent.plan_fully(&self.walk.home, &self.state)?;
        match self.agent.trainer_ended(&self.walk.home, &self.state) {
            // In a session of answers alone, the trainer chose no end.
            Ok(_) | Err(AgentError::NothingDone) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    /// Ends the session by the trainer's choice; the language model is to learn from it.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::plan`] at the end of the session: the session then continues. The errors of
    /// [`Agent::finish`]: the session has ended then.
    pub fn finish(&mut self) -> Result<Finished, LiveError> {
        self.walk_on()?;
        if self.is_under_way() {
            self.take_end()?;
        }
        self.restraint.end();
        self.remember_session();
        self.session.take().ok_or(LiveError::NoSession)?;
        self.acted = None;
        self.end_part();
        Ok(self.agent.finish(&self.walk.home)?)
    }

    /// Whether the session under way has anything to learn from besides its command: a step that is over or judged, or an answer. What the
    /// robot makes of a command alone it knows already.
    pub fn has_evidence(&self) -> bool {
        self.steps() > 0 || self.acted.as_ref().is_some_and(|(acted, _)| acted.judged.is_some()) || !self.walk.answers.is_empty()
    }

    /// Ends the session, and learns nothing from it. The rest of the utterance is still to come.
    pub fn pass_over(&mut self) {
        self.acted = None;
        self.remember_if_done();
        if self.session.take().is_some() {
            self.end_part();
            self.agent.forget();
        }
    }

    /// Ends the session, and learns nothing from it. The rest of the utterance is dropped.
    pub fn forget(&mut self) {
        self.acted = None;
        self.remember_if_done();
        self.ahead = None;
        if self.session.take().is_some() {
            self.agent.forget();
        }
    }
}

/// A step as an agent with a complete plan judges it.
fn acted<D: Domain>(agent: &Agent<AgentHeap>, home: &D, action: Action) -> Result<Acted, LiveError> {
    let (plan, belief) = (agent.planned(), agent.belief());
    let task = agent.most_likely().ok_or(LiveError::NoSession)?;
    let tasks = 0..agent.tasks().len();
    let agrees = |&task: &usize| {
        let plan = plan.optimal(task);
        plan.exact().or(plan.onward()).is_some_and(|actions| actions.contains(action))
    };
    let confidence: f32 = tasks.clone().filter(agrees).map(|task| belief.probability(task)).sum();
    Ok(Acted {
        action: action_name(home, action).to_owned(),
        task,
        confidence: confidence.clamp(0.0, 1.0),
        plan: plan.optimal(task),
        judgements: tasks.map(|task| plan.judge(task, action)).collect(),
        judged: None,
    })
}
