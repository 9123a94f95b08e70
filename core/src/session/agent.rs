//! The robot's mind: Algorithm 1.
//!
//! [`Agent::hear`] a command, [`Agent::plan`] from the robot's state, [`Agent::decide`] on an action, do it and report it with
//! [`Agent::acted`], and pass on the trainer's word with [`Agent::feedback`]. Repeat until [`Agent::finish`]. Planning and learning run in
//! parts: `plan` and `learn` take a budget and return whether they are done. The trainer may speak while the next plan is being made.

use super::candidates::{CandidateCount, CandidatesRef};
use super::done::LastDone;
use super::error::AgentError;
use super::gave_way::GaveWay;
use super::options::Options;
use super::phase::{Phase, Progressed};
#[cfg(feature = "asking")]
use crate::asking::Asked;
use crate::capacity::{Capacities, Capacity, CapacityError, LIFTED_TASKS};
use crate::feedback::{Belief, BeliefCount, BeliefRef, Ending, Feedback, Judged, LAGS, Moment, Strategy, Words};
use crate::language::forgetting::with_free_part;
use crate::language::model::LanguageState;
use crate::language::{LanguageMut, LanguageRef, Sentence};
use crate::memory::{AgentMemory, AgentTables, SessionTablesRef};
use crate::oomdp::{Action, ActionSet, Domain, DomainFlaw, StateKey, apply, digest};
use crate::planning::{Judgement, OptimalSet, Plan, PlanTables, Planner, Progress, Ways};
use crate::probability::Scaled;
use crate::random::below;
use crate::symbols::Symbol;
#[cfg(feature = "talk")]
use crate::talk::Conversation;
use crate::task::{GroundedTask, LiftedTask, TaskSet, TaskText};
use core::fmt;
use heapless::Vec;
use rand_core::Rng;

/// Less probable tasks are not planned: their optimal sets are unknown, and no evidence counts for or against them.
const NEGLIGIBLE: f32 = 1e-9;

/// From this probability on, a task gets the planner's full effort, however many tasks there are.
#[cfg(feature = "bounds")]
const LIKELY: f32 = 0.01;

/// The agent's next action, and its task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Decision {
    /// The action.
    pub action: Action,
    /// The task that it follows: the most likely one.
    pub task: usize,
    /// The plan's result for that task, and whether it is exact. If the goal cannot be reached or the result is unknown, the action is to
    /// do nothing.
    pub plan: OptimalSet,
}

/// What happened to a piece of evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use]
pub enum Evidence {
    /// It changed the belief.
    Used,
    /// It is uninformative: no task's optimal set is known exactly in the state of the action. The belief is unchanged.
    Uninformative,
    /// It is impossible under every task and strategy, and is ignored.
    Impossible,
}

impl Evidence {
    /// A short name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Used => "used",
            Self::Uninformative => "says nothing",
            Self::Impossible => "impossible",
        }
    }
}

/// Observes that the session ends, or goes on, in the state of this plan.
#[cfg(feature = "learning")]
#[inline(never)]
fn observe_end(belief: &mut Belief<'_>, ending: &Ending, plan: Plan<'_>, moment: Moment, ends: bool) -> bool {
    let possible = belief.observe(&|_, task| {
        let plan = plan.optimal(task);
        plan.exact().map(|_| ending.probability(ends, plan == OptimalSet::Goal, moment))
    });
    belief.settle();
    possible
}

/// The robot's mind, in memory that it owns or borrows: see [`memory`](mod@crate::memory).
///
/// Functions that take any agent say `agent: &mut Agent<impl AgentMemory>`.
pub struct Agent<M> {
    pub(crate) memory: M,
    pub(crate) options: Options,
    pub(crate) language: LanguageState,
    pub(crate) lifted: Vec<LiftedTask, LIFTED_TASKS>,
    pub(crate) task_count: usize,
    pub(super) candidates: CandidateCount,
    pub(crate) belief: BeliefCount,
    pub(super) planner: Planner,
    pub(crate) sentence: Sentence,
    pub(crate) progressed: Progressed,
    pub(super) gave_way: GaveWay,
    pub(crate) start: Option<StateKey>,
    /// The digest of the domain that the session began in.
    pub(super) domain: u32,
    /// The state of the last plan, and the state that the action done there leads to.
    pub(crate) planned: Option<StateKey>,
    pub(crate) expected: Option<StateKey>,
    /// Tasks known to be dead ends in the state of the last plan.
    pub(crate) dead: TaskSet,
    pub(crate) done: LastDone,
    pub(crate) followed: Option<usize>,
    /// The most entries that each table has held.
    most: Capacities,
    #[cfg(feature = "asking")]
    pub(crate) asked: Asked,
    #[cfg(feature = "talk")]
    pub(crate) conversation: Conversation,
}

impl<M> fmt::Debug for Agent<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Agent").field("options", &self.options).field("tasks", &self.task_count).finish_non_exhaustive()
    }
}

impl<M> Agent<M> {
    /// Creates an agent without tasks, for a static: call [`set_tasks`](Self::set_tasks) before the first command.
    ///
    /// ```
    /// use goodbot::{Agent, home, memory::AgentArrays};
    /// goodbot::memory! { struct Memory = goodbot::Capacities::TINY; }
    /// static AGENT: std::sync::Mutex<Agent<AgentArrays<Memory>>> = std::sync::Mutex::new(Agent::without_tasks(Memory::new().agent));
    /// AGENT.lock().unwrap().set_tasks(&home::paper_tasks()?, goodbot::Options::PAPER)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn without_tasks(memory: M) -> Self {
        Self {
            memory,
            options: Options::DEFAULT,
            language: LanguageState::new(Options::DEFAULT.language),
            lifted: Vec::new(),
            task_count: 0,
            candidates: CandidateCount::NONE,
            belief: BeliefCount::NONE,
            planner: Planner::new(),
            sentence: Sentence::new(),
            progressed: Progressed::Idle,
            gave_way: GaveWay::NONE,
            start: None,
            domain: 0,
            planned: None,
            expected: None,
            dead: TaskSet::EMPTY,
            done: LastDone::NOTHING,
            followed: None,
            most: Capacities::NONE,
            #[cfg(feature = "asking")]
            asked: Asked::NOTHING,
            #[cfg(feature = "talk")]
            conversation: Conversation::NEW,
        }
    }

    /// Returns the memory, for other use.
    pub fn into_memory(self) -> M {
        self.memory
    }

    /// The options.
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// The lifted tasks.
    pub fn lifted(&self) -> &[LiftedTask] {
        &self.lifted
    }

    /// The words of the command.
    pub fn sentence(&self) -> &[Option<Symbol>] {
        &self.sentence
    }

    /// The agent's phase. Calls of another phase are refused with [`AgentError::NotNow`](crate::AgentError::NotNow).
    ///
    /// ```
    /// use goodbot::{Agent, HeapMemory, Options, home, session::Phase};
    /// let memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// assert_eq!(agent.phase(), Phase::Idle);
    /// assert_eq!(agent.phase().to_string(), "no session is under way; give a command first");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn phase(&self) -> Phase {
        self.progressed.phase(self.language.is_training())
    }

    /// Ends the session; it can be resumed if it has a start state.
    pub(super) const fn set_ended(&mut self) {
        self.progressed = if self.start.is_some() { Progressed::Ended } else { Progressed::Idle };
    }
}

impl<M: AgentMemory> Agent<M> {
    /// Creates an agent that has learned nothing yet, in `memory.agent`, `&mut memory.agent` or any other [`AgentMemory`]. `lifted` are the
    /// tasks that commands may mean, at most [`LIFTED_TASKS`].
    ///
    /// # Errors
    /// [`AgentError::Capacity`] if there are more, or no room for a trainer strategy, [`AgentError::SameTask`] if one is given twice, and
    /// [`AgentError::Setting`] if an option is out of range.
    #[inline(never)]
    pub fn new(memory: M, lifted: &[LiftedTask], options: Options) -> Result<Self, AgentError> {
        let mut agent = Self::without_tasks(memory);
        agent.set_tasks(lifted, options)?;
        Ok(agent)
    }

    /// Sets the tasks that commands may mean, and the options. All that was learned and the session under way are forgotten; the trainer is
    /// the paper's balanced one.
    ///
    /// # Errors
    /// As [`new`](Self::new); the agent is then unchanged.
    pub fn set_tasks(&mut self, lifted: &[LiftedTask], options: Options) -> Result<(), AgentError> {
        options.check()?;
        let too_many = CapacityError::new(Capacity::LiftedTasks, LIFTED_TASKS, lifted.len());
        if lifted.len() > LIFTED_TASKS {
            return Err(too_many.into());
        }
        for (second, task) in lifted.iter().enumerate() {
            if let Some(first) = lifted.iter().take(second).position(|other| other == task) {
                return Err(AgentError::SameTask { first: first as u8, second: second as u8 });
            }
        }
        self.belief_mut().set_strategies(&[(Strategy::BALANCED, 1.0)])?;
        self.end_session();
        self.lifted = Vec::from_slice(lifted).map_err(|_| too_many)?;
        (self.options, self.language) = (options, LanguageState::new(options.language));
        self.language_mut().forget_tasks();
        Ok(())
    }

    pub(crate) fn belief_mut(&mut self) -> Belief<'_> {
        Belief::new(self.memory.lend().session.belief, &mut self.belief)
    }

    pub(crate) fn language_mut(&mut self) -> LanguageMut<'_> {
        let tables = self.memory.lend();
        self.language.with(tables.language, tables.workspace)
    }

    /// Replaces the trainer strategies and their probabilities, which are renormalised. A session under way ends unlearned.
    ///
    /// # Errors
    /// [`AgentError::Strategy`] or [`AgentError::Capacity`]; the strategies are then unchanged.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), AgentError> {
        self.belief_mut().set_strategies(strategies)?;
        self.complete_joining();
        (self.start, self.progressed) = (None, Progressed::Idle);
        Ok(())
    }

    /// Replaces the options except those of the language model, on which the training data depend. A session under way ends unlearned.
    ///
    /// # Errors
    /// [`AgentError::Setting`] if an option is out of range; the options are then unchanged.
    pub fn set_options(&mut self, options: Options) -> Result<(), AgentError> {
        let options = Options { language: self.options.language, ..options };
        options.check()?;
        self.options = options;
        self.complete_joining();
        (self.start, self.progressed) = (None, Progressed::Idle);
        Ok(())
    }

    /// The language model.
    pub fn language(&self) -> LanguageRef<'_> {
        let tables = self.memory.read();
        self.language.read(tables.language, tables.workspace.len())
    }

    /// The belief over tasks and strategies.
    pub fn belief(&self) -> BeliefRef<'_> {
        BeliefRef::new(self.memory.read().session.belief, self.belief)
    }

    /// The tasks of this session.
    pub fn tasks(&self) -> &[GroundedTask] {
        self.memory.read().session.tasks.get(..self.task_count).unwrap_or(&[])
    }

    /// A task of this session as text, for people and files: `blockInRoom(block0,room1)`. `None` if there is no such task.
    ///
    /// ```
    /// use goodbot::{Agent, HeapMemory, Options, home::{self, Area, Cell, HomeBuilder, Moves}};
    /// let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let mut builder = HomeBuilder::new(&mut memory.home);
    /// builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// builder.room("room1", Area::new(0, 4, 8, 8), "green")?;
    /// builder.agent("agent0", Cell::new(4, 2))?;
    /// let (home, state) = builder.build(Moves::Push)?;
    /// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// agent.hear(&home, &state, "go to the green room")?;
    /// assert_eq!(agent.task_text(&home, 0).ok_or("no task")?.to_string(), "agentInRoom(agent0,room1)");
    /// assert!(agent.task_text(&home, 1).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn task_text<'a, D: Domain>(&'a self, domain: &'a D, task: usize) -> Option<TaskText<'a>> {
        let task = self.tasks().get(task)?;
        Some(TaskText::new(task, self.lifted.get(usize::from(task.lifted))?, domain.world()))
    }

    /// The position of this session's task with this text, as [`task_text`](Self::task_text) writes it; spaces do not matter. `None` if
    /// there is no such task.
    ///
    /// ```
    /// use goodbot::{Agent, HeapMemory, Options, home::{self, Area, Cell, HomeBuilder, Moves}};
    /// let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let mut builder = HomeBuilder::new(&mut memory.home);
    /// builder.room("room0", Area::new(0, 0, 4, 4), "red")?;
    /// builder.room("room1", Area::new(0, 4, 4, 8), "green")?;
    /// builder.room("room2", Area::new(0, 8, 4, 12), "blue")?;
    /// builder.door("door0", Area::new(2, 4, 2, 4))?;
    /// builder.door("door1", Area::new(2, 8, 2, 8))?;
    /// builder.agent("agent0", Cell::new(2, 2))?;
    /// let (home, state) = builder.build(Moves::Push)?;
    /// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// agent.hear(&home, &state, "go to the blue room")?;
    /// assert_eq!(agent.task_named(&home, "agentInRoom(agent0, room2)"), Some(1));
    /// assert_eq!(agent.task_named(&home, "agentInRoom(agent0, room3)"), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn task_named<D: Domain>(&self, domain: &D, text: &str) -> Option<usize> {
        (0..self.task_count).find(|&task| self.task_text(domain, task).is_some_and(|known| known == *text))
    }

    /// The machine commands of this session.
    pub fn candidates(&self) -> CandidatesRef<'_> {
        CandidatesRef::new(self.memory.read().session.candidates, self.candidates)
    }

    /// The plan of each task, for the state that was last planned.
    pub fn planned(&self) -> Plan<'_> {
        let plan = self.memory.read().session.plan;
        self.planner.plan(plan.optimal, plan.distances)
    }

    /// Checks that a session is under way.
    pub(crate) fn check_under_way(&self) -> Result<(), AgentError> {
        match self.phase() {
            Phase::Ready => Ok(()),
            phase => Err(AgentError::NotNow(phase)),
        }
    }

    /// Checks that a session is under way in this domain.
    pub(crate) fn check_session<D: Domain>(&self, domain: &D) -> Result<(), AgentError> {
        self.check_under_way()?;
        if self.domain == digest(domain) { Ok(()) } else { Err(AgentError::OtherDomain) }
    }

    pub(crate) fn check_planned<D: Domain>(&self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        self.check_session(domain)?;
        let planned = self.planned == Some(domain.key(state)) && self.planner.is_done();
        if planned { Ok(()) } else { Err(AgentError::NotPlanned) }
    }

    /// Ends a session under way and forgets its tasks.
    pub(crate) fn end_session(&mut self) {
        self.complete_joining();
        (self.start, self.followed, self.progressed) = (None, None, Progressed::Idle);
        self.forget_plan();
        self.forget_questions();
        self.task_count = 0;
        self.candidates = CandidateCount::NONE;
        self.sentence.clear();
    }

    /// Forgets the plan and the last actions.
    pub(super) fn forget_plan(&mut self) {
        (self.planned, self.expected, self.done) = (None, None, LastDone::NOTHING);
        self.dead = TaskSet::EMPTY;
        #[cfg(feature = "asking")]
        self.asked.close();
    }

    /// Forgets the questions of the previous session.
    pub(super) fn forget_questions(&mut self) {
        #[cfg(feature = "asking")]
        {
            self.asked = Asked::NOTHING;
        }
    }

    /// Makes the planner plan for the first `count` tasks.
    pub(crate) fn plan_for<D: Domain>(&mut self, domain: &D, count: usize) -> Result<(), CapacityError> {
        let AgentTables { session, workspace, .. } = self.memory.lend();
        let tasks = session.tasks.get(..count).unwrap_or(&[]);
        let mut tables = PlanTables::new(session.goals, session.plan, workspace);
        self.planner.set_tasks(&mut tables, domain, &self.lifted, tasks)
    }

    /// Plans for `state`, with at most about `budget` node expansions. Call until done; a different state starts a new plan.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::OtherDomain`] if the session was begun in another domain, [`AgentError::StateNumber`], or
    /// [`AgentError::Domain`] if an action leads to a state whose number is not below the domain's `state_count`. The last is detected only
    /// if all states have room; [`check`](crate::oomdp::check) always detects it.
    #[inline(never)]
    pub fn plan<D: Domain>(&mut self, domain: &D, state: &D::State, budget: u32) -> Result<Progress, AgentError> {
        self.check_session(domain)?;
        let key = domain.key(state);
        if self.planned != Some(key) {
            if domain.number(state) >= domain.state_count() {
                return Err(AgentError::StateNumber);
            }
            self.begin_plan(domain, state, key);
        }
        let AgentTables { session, workspace, .. } = self.memory.lend();
        let ways = Ways { lifted: &self.lifted, tasks: session.tasks.get(..self.task_count).unwrap_or(&[]) };
        let mut tables = PlanTables::new(session.goals, session.plan, workspace).with_ways(ways);
        let progress = self.planner.advance(&mut tables, domain, state, budget);
        if let Some(stray) = self.planner.stray() {
            let (number, count) = (stray.number, domain.state_count());
            return Err(DomainFlaw::Number { number, count, from: Some(stray.from) }.into());
        }
        if progress == Progress::Done {
            self.dead = self.dead.union(self.planned().dead());
        }
        Ok(progress)
    }

    /// A separate function, like every step that needs much stack: the stack of one step is free for the next.
    #[inline(never)]
    fn begin_plan<D: Domain>(&mut self, domain: &D, state: &D::State, key: StateKey) {
        // If others have moved things, goals that could not be reached may be reachable again.
        if self.expected != Some(key) {
            self.dead = TaskSet::EMPTY;
        }
        // Ways advance here: every state that the robot reaches is planned before the next action. The expected state may never be reached.
        self.follow_ways(domain, state);
        (self.planned, self.expected) = (Some(key), None);
        self.planner.begin(self.at_least(NEGLIGIBLE), self.dead);
        #[cfg(feature = "bounds")]
        self.planner.expect(self.at_least(LIKELY));
    }

    /// Ends the plan, because training needs the workspace. The two never run at the same time: no command is heard while learning, and
    /// learning begins when the session is over.
    pub(crate) fn workspace_to_training(&mut self) {
        self.hear_words_to_the_end();
        #[cfg(feature = "ways")]
        self.describe_anew();
        self.planned = None;
        self.planner.release_marks();
    }

    /// The tasks of at least this probability.
    fn at_least(&self, probability: f32) -> TaskSet {
        let belief = self.belief();
        let least = belief.whole().scaled_by(probability);
        (0..self.task_count).filter(|&task| !least.exceeds(belief.weight(task))).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// The most likely task: the largest posterior. On a tie, the task being followed stays, else the first in order is taken.
    pub fn most_likely(&self) -> Option<usize> {
        self.likeliest(&mut |_| 0)
    }

    /// The most likely task: the largest posterior. On a tie, the task being followed stays, else the generator draws.
    pub fn most_likely_with<R: Rng + ?Sized>(&self, random: &mut R) -> Option<usize> {
        self.likeliest(&mut |count| below(count, random))
    }

    fn likeliest(&self, draw: &mut dyn FnMut(usize) -> usize) -> Option<usize> {
        let belief = self.belief();
        let weight = |task: usize| belief.weight(task);
        let mut best = Scaled::ZERO;
        for task in 0..self.task_count {
            if weight(task).exceeds(best) {
                best = weight(task);
            }
        }
        let tied = || (0..self.task_count).filter(|&task| !best.exceeds(weight(task)));
        if let Some(followed) = self.followed.filter(|&followed| tied().any(|task| task == followed)) {
            return Some(followed);
        }
        tied().nth(draw(tied().count()))
    }

    /// Decides on an action in `state`, which must have been planned: the first of those that lead towards the goal of the most likely
    /// task. At the goal, in a dead end, and if no plan is known, the action is to do nothing.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::OtherDomain`], or [`AgentError::NotPlanned`] if the plan for this state is not done.
    pub fn decide<D: Domain>(&mut self, domain: &D, state: &D::State) -> Result<Decision, AgentError> {
        self.decide_choosing(domain, state, &mut |_| 0)
    }

    /// As [`decide`](Self::decide), but the generator draws among equally likely tasks, and among actions that lead towards the goal.
    ///
    /// # Errors
    /// As [`decide`](Self::decide).
    pub fn decide_with<D, R>(&mut self, domain: &D, state: &D::State, random: &mut R) -> Result<Decision, AgentError>
    where
        D: Domain,
        R: Rng + ?Sized,
    {
        self.decide_choosing(domain, state, &mut |count| below(count, random))
    }

    fn decide_choosing<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        draw: &mut dyn FnMut(usize) -> usize,
    ) -> Result<Decision, AgentError> {
        self.check_planned(domain, state)?;
        let task = self.likeliest(draw).ok_or(AgentError::NotNow(Phase::Idle))?;
        let plan = self.planned().optimal(task);
        let words = self.words_expected();
        let action = self.onward(task, words.as_ref(), draw);
        // Even if the domain changes unnoticed, no inapplicable action is chosen.
        apply(domain, state, action).ok_or(AgentError::NotPlanned)?;
        self.followed = Some(task);
        Ok(Decision { action, task, plan })
    }

    /// A model of the trainer's words, if actions are chosen by expected information.
    fn words_expected(&self) -> Option<Words> {
        (cfg!(feature = "asking") && self.options.telling).then(|| Words::expected(self.belief()))
    }

    /// The action that leads towards a task's goal in the planned state; `draw` chooses among several. With `words`, the last action is
    /// repeated if it leads there too; otherwise the choice is among the actions with the highest expected information of the feedback.
    pub(crate) fn onward(&self, task: usize, words: Option<&Words>, draw: &mut dyn FnMut(usize) -> usize) -> Action {
        let Some(mut actions) = self.planned().optimal(task).onward() else { return Action::NOOP };
        if let Some(words) = words.filter(|_| actions.len() > 1) {
            // An unnecessary change of action would make a late word count for the wrong action.
            #[cfg(feature = "asking")]
            if let Some(last) = self.done.last().filter(|&last| actions.contains(last)) {
                return last;
            }
            let (mut most, mut telling) = (0.0, ActionSet::EMPTY);
            for (action, right) in actions.iter().zip(self.right(actions)) {
                let told = words.information(right);
                if told > most {
                    (most, telling) = (told, ActionSet::EMPTY);
                }
                if told >= most {
                    telling = telling.with(action);
                }
            }
            actions = telling;
        }
        actions.iter().nth(draw(actions.len())).unwrap_or(Action::NOOP)
    }

    /// The probability that each of these actions is right in the planned state, in order, over the tasks for which that is known; 0 if it is
    /// known for none.
    pub(crate) fn right(&self, actions: ActionSet) -> impl Iterator<Item = f32> {
        let (plan, belief) = (self.planned(), self.belief());
        let mut sums = [[Scaled::ZERO; 2]; ActionSet::MOST];
        // Each task is weighed once for all actions.
        for task in 0..self.task_count {
            let optimal = plan.optimal(task);
            if optimal.exact().is_none() {
                continue;
            }
            let weight = belief.weight(task);
            for (action, [right, wrong]) in actions.iter().zip(&mut sums) {
                let sum = if optimal.judge(action) == Judgement::Correct { right } else { wrong };
                *sum = sum.plus(weight);
            }
        }
        sums.into_iter().map(|[right, wrong]| right.over(right.plus(wrong)))
    }

    /// Records that `action` was done in `state`, which must have been planned. Returns the state that it leads to. Pass on the trainer's
    /// word about it with [`feedback`](Self::feedback), at any time until the next action is done.
    ///
    /// # Errors
    /// As [`decide`](Self::decide), and [`AgentError::NotApplicable`] if the action cannot be done in this state.
    pub fn acted<D: Domain>(&mut self, domain: &D, state: &D::State, action: Action) -> Result<D::State, AgentError> {
        self.check_planned(domain, state)?;
        let next = apply(domain, state, action).ok_or(AgentError::NotApplicable)?;
        #[cfg(feature = "learning")]
        self.await_a_word(domain, &next, action);
        self.expected = Some(domain.key(&next));
        Ok(next)
    }

    /// Plans to the end.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub fn plan_fully<D: Domain>(&mut self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        while self.plan(domain, state, u32::MAX)? == Progress::Working {}
        Ok(())
    }
}

#[cfg(feature = "learning")]
impl<M: AgentMemory> Agent<M> {
    /// Records an action that the trainer may judge.
    fn await_a_word<D: Domain>(&mut self, domain: &D, next: &D::State, action: Action) {
        let session = self.memory.lend().session;
        let plan = self.planner.plan(session.plan.optimal, session.plan.distances);
        let mut belief = Belief::new(session.belief, &mut self.belief);
        belief.settle();
        // A trainer who judges could have ended the session in this state, and did not.
        if self.done.is_judged() && self.options.ending.is_evidence() {
            let _ = observe_end(&mut belief, &self.options.ending, plan, self.done.moment(), false);
        }
        let at_goal = if action == Action::NOOP { TaskSet::EMPTY } else { plan.at_goal() };
        let inside = self.planner.satisfied(session.goals.read(), domain, next, at_goal);
        self.done.add(plan, action, inside);
    }

    /// Updates the belief by the trainer's word about the last action, or about one of the two before it: see [`Strategy::lags`]. Of
    /// several words the last counts.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], or [`AgentError::NothingDone`] if no action was done since the command.
    pub fn feedback(&mut self, feedback: Feedback) -> Result<Evidence, AgentError> {
        self.check_under_way()?;
        if !self.done.is_something() {
            return Err(AgentError::NothingDone);
        }
        self.done.hear(feedback);
        let done = self.done;
        if !done.says_something(self.belief().strategies()) {
            return Ok(Evidence::Uninformative);
        }
        let possible = self.belief_mut().observe_feedback(feedback, |task| done.judged(task));
        Ok(if possible { Evidence::Used } else { Evidence::Impossible })
    }

    /// How a task judges the last actions, the last one first: the trainer's next word is about one of them.
    pub fn judged(&self, task: usize) -> [Judged; LAGS] {
        self.done.judged(task)
    }

    /// Updates the belief by the fact that the trainer ended the session in `state`, which must have been planned, after judging actions:
    /// trainers do so more often when the task is done (see [`Options::ending`]). Call it before the session is finished or forgotten. It
    /// does nothing if the options say that an end is no evidence.
    ///
    /// # Errors
    /// As [`decide`](Self::decide), and [`AgentError::NothingDone`] if no action was done since the command.
    pub fn trainer_ended<D: Domain>(&mut self, domain: &D, state: &D::State) -> Result<Evidence, AgentError> {
        self.check_planned(domain, state)?;
        if !self.done.is_something() {
            return Err(AgentError::NothingDone);
        }
        let session = self.memory.lend().session;
        let plan = self.planner.plan(session.plan.optimal, session.plan.distances);
        if !self.options.ending.is_evidence() || (0..self.task_count).all(|task| plan.optimal(task).exact().is_none()) {
            return Ok(Evidence::Uninformative);
        }
        let mut belief = Belief::new(session.belief, &mut self.belief);
        belief.settle();
        let possible = observe_end(&mut belief, &self.options.ending, plan, self.done.moment(), true);
        // A word after the end is about no action.
        self.done = LastDone::NOTHING;
        Ok(if possible { Evidence::Used } else { Evidence::Impossible })
    }

    /// Updates the belief by a demonstration: the trainer did `action` in `state`, which must have been planned. The action is in the
    /// optimal set with probability 1 - epsilon, uniform over that set, and otherwise uniform over the other applicable actions.
    ///
    /// # Errors
    /// As [`acted`](Self::acted).
    pub fn demonstrated<D: Domain>(&mut self, domain: &D, state: &D::State, action: Action) -> Result<Evidence, AgentError> {
        self.acted(domain, state, action)?;
        // Nobody judges the trainer's own action.
        self.done = LastDone::NOTHING;
        if (0..self.task_count).all(|task| self.planned().optimal(task).exact().is_none()) {
            return Ok(Evidence::Uninformative);
        }
        let session = self.memory.lend().session;
        let plan = self.planner.plan(session.plan.optimal, session.plan.distances);
        let possible = Belief::new(session.belief, &mut self.belief).observe(&|strategy, task| {
            let optimal = plan.optimal(task).exact()?;
            let others = plan.applicable().without(optimal);
            if others.is_empty() {
                return Some(1.0 / optimal.len().max(1) as f32);
            }
            Some(if optimal.contains(action) {
                (1.0 - strategy.epsilon()) / optimal.len().max(1) as f32
            } else {
                strategy.epsilon() / others.len().max(1) as f32
            })
        });
        Ok(if possible { Evidence::Used } else { Evidence::Impossible })
    }
}

impl<M: AgentMemory> Agent<M> {
    /// The size of each of its tables. Those of a home are 0.
    pub fn capacities(&self) -> Capacities {
        let SessionTablesRef { tasks, candidates, belief, goals, plan } = self.memory.read().session;
        Capacities {
            tasks: tasks.len(),
            strategies: belief.strategies.len(),
            beliefs: belief.joint.len(),
            candidates: candidates.candidates.len(),
            candidate_tokens: candidates.candidate_tokens.len(),
            ground_propositions: goals.goal_parts.len(),
            goal_entries: goals.goal_entries.len(),
            // Groups of 64 states: see `Capacities::search_words`.
            states: (plan.search_words.len().saturating_mul(64) / (11 * 64 + 3)).saturating_mul(64),
            hashed_states: plan.hashed.len(),
            ..self.language().rooms()
        }
    }

    /// The number of used entries in each of its tables. Those of a home and of the searches are 0: planning reports its needs by a
    /// [`CapacityError`].
    pub fn usage(&self) -> Capacities {
        let belief = self.belief();
        let mut used = Capacities {
            tasks: self.task_count,
            strategies: belief.strategies().len(),
            beliefs: belief.strategies().len().saturating_mul(belief.tasks()),
            candidates: self.candidates().entries().len(),
            candidate_tokens: self.candidates().all_tokens().len(),
            ground_propositions: self.planner.ground_propositions(),
            ..Capacities::NONE
        };
        self.language().usage(&mut used);
        used
    }

    /// The most entries that each of its tables held, at the end of a heard command or of a learned session. See also
    /// [`needed`](Self::needed). Without the feature `learning`, the current number.
    pub fn most_used(&self) -> Capacities {
        self.most.at_least(self.usage())
    }

    /// Capacities with room for the same experience again: [`most_used`](Self::most_used), an eighth of the vocabulary free, and exact
    /// plans for the last command's tasks. If the memory has too few states for these plans, the result keeps the memory's own states.
    pub fn needed<D: Domain>(&mut self, domain: &D) -> Capacities {
        let (most, rooms) = (self.most_used(), self.capacities());
        let mut session = self.memory.lend().session;
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let planned = Planner::needs(&mut session.goals, domain, &self.lifted, tasks).ok();
        let states = planned.map(|(_, states)| states).filter(|&states| states <= rooms.states);
        Capacities {
            states: states.unwrap_or(rooms.states),
            hashed_states: if states.is_some() { 0 } else { rooms.hashed_states },
            words: with_free_part(most.words),
            word_bytes: with_free_part(most.word_bytes),
            tokens: with_free_part(most.tokens),
            token_bytes: with_free_part(most.token_bytes),
            ..most
        }
    }

    /// Records how full the tables are.
    pub(super) fn take_usage(&mut self) {
        if cfg!(feature = "learning") {
            self.most = self.most_used();
        }
    }
}
