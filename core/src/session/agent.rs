//! The robot's mind: Algorithm 1.
//!
//! [`Agent::hear`] a command, [`Agent::plan`] from the state the robot is in, [`Agent::decide`] on an action, do it, and tell what the
//! trainer said with [`Agent::feedback`]; over and over, until [`Agent::finish`]. Planning and learning go in parts: `plan` and `learn`
//! take a budget and say whether they are done.

use super::candidates::Candidates;
use super::error::AgentError;
use super::options::{AgentMemory, Options};
use crate::capacity::{Capacity, CapacityError, LIFTED_TASKS};
use crate::feedback::simulated::below;
use crate::feedback::{Belief, Feedback, Judgement, Strategy};
use crate::language::{LanguageModel, Sentence};
use crate::oomdp::{Action, ActionSet, Domain};
use crate::planning::{GoalTable, OptimalSet, Planner, Progress, Search};
use crate::probability::Scaled;
use crate::task::{GroundedTask, LiftedTask, TaskSet};
use heapless::Vec;
use rand_core::Rng;

/// Below this probability a task is not planned: its optimal set is unknown, and what happens is no evidence for or against it.
pub const NEGLIGIBLE: f32 = 1e-9;

/// What the agent does next, and for which task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decision {
    /// The action.
    pub action: Action,
    /// The task that it follows: the most likely one.
    pub task: usize,
    /// What the plan says for that task. Where it is a dead end or unknown, the action is to do nothing.
    pub plan: OptimalSet,
}

/// The robot's mind.
#[derive(Debug)]
pub struct Agent<'m> {
    pub(crate) options: Options,
    pub(crate) language: LanguageModel<'m>,
    pub(super) lifted: Vec<LiftedTask, LIFTED_TASKS>,
    pub(super) tasks: &'m mut [GroundedTask],
    pub(super) task_count: usize,
    pub(super) candidates: Candidates<'m>,
    pub(crate) belief: Belief<'m>,
    pub(super) goals: GoalTable<'m>,
    pub(super) planner: Planner<'m>,
    pub(super) sentence: Sentence,
    pub(super) start: Option<u64>,
    pub(super) ended: bool,
    pub(super) planned: Option<u64>,
    pub(super) dead: TaskSet,
    pub(super) followed: Option<usize>,
}

impl<'m> Agent<'m> {
    /// An agent that has learned nothing yet. `lifted` are the tasks that commands may mean, as many as [`LIFTED_TASKS`] at most.
    ///
    /// # Errors
    /// [`AgentError::Capacity`] where there are more, [`AgentError::Setting`] where an option is none to learn with.
    #[inline(never)]
    pub fn new(memory: AgentMemory<'m>, lifted: &[LiftedTask], options: Options) -> Result<Self, AgentError> {
        options.check()?;
        let AgentMemory { language, session } = memory;
        let mut language = LanguageModel::new(language, options.language)?;
        let workspace = language.lend_workspace();
        Ok(Self {
            options,
            language,
            lifted: Vec::from_slice(lifted).map_err(|_| CapacityError::new(Capacity::LiftedTasks, LIFTED_TASKS, lifted.len()))?,
            tasks: session.tasks,
            task_count: 0,
            candidates: Candidates::new(session.candidates),
            belief: Belief::new(session.belief),
            goals: GoalTable::new(session.goals),
            planner: Planner::new(session.plan, workspace),
            sentence: Sentence::new(),
            start: None,
            ended: false,
            planned: None,
            dead: TaskSet::EMPTY,
            followed: None,
        })
    }

    /// Replaces the trainer strategies and their probabilities, which are renormalised. A session under way ends unlearned.
    ///
    /// # Errors
    /// [`AgentError::NotAProbability`] or [`AgentError::Capacity`]; the strategies are then as before.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), AgentError> {
        self.belief.set_strategies(strategies)?;
        self.start = None;
        Ok(())
    }

    /// The language model.
    pub fn language(&self) -> &LanguageModel<'m> {
        &self.language
    }

    /// The belief over tasks and strategies.
    pub fn belief(&self) -> &Belief<'m> {
        &self.belief
    }

    /// How it understands and learns.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The lifted tasks.
    pub fn lifted(&self) -> &[LiftedTask] {
        &self.lifted
    }

    /// The tasks of this session.
    pub fn tasks(&self) -> &[GroundedTask] {
        self.tasks.get(..self.task_count).unwrap_or(&[])
    }

    /// The machine commands of this session.
    pub fn candidates(&self) -> &Candidates<'m> {
        &self.candidates
    }

    /// The plan.
    pub fn search(&self) -> &Search<'m> {
        self.planner.search()
    }

    /// The words of the command.
    pub fn sentence(&self) -> &Sentence {
        &self.sentence
    }

    pub(super) fn check_under_way(&self) -> Result<(), AgentError> {
        if self.start.is_none() || self.ended { Err(AgentError::NoSession) } else { Ok(()) }
    }

    /// Ends a session under way, and forgets which tasks it had.
    pub(crate) fn end_session(&mut self) {
        (self.start, self.planned, self.followed) = (None, None, None);
        self.dead = TaskSet::EMPTY;
        self.task_count = 0;
        self.candidates.clear();
        self.sentence.clear();
    }

    /// Plans for `state`, expanding at most `budget` states of the search. Call until done; a different state begins anew.
    ///
    /// # Errors
    /// [`AgentError::NoSession`].
    #[inline(never)]
    pub fn plan<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, budget: u32) -> Result<Progress, AgentError> {
        self.check_under_way()?;
        let number = domain.number(state);
        if self.planned != Some(number) {
            self.planned = Some(number);
            self.begin_plan(domain, state);
        }
        let progress = self.planner.advance(domain, &self.goals, state, budget);
        if progress == Progress::Done {
            self.dead = self.dead.union(self.search().dead());
        }
        Ok(progress)
    }

    /// By itself, like every part of the work that takes much of the stack: parts that follow each other then take it in turn.
    #[inline(never)]
    fn begin_plan<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) {
        self.workspace_to_planner();
        let wanted = self.worth_planning();
        self.planner.begin(domain, &self.goals, state, wanted, self.dead);
    }

    /// Lends the workspace to the planner, unless training has it. The two never work at one time: no command is heard before all is learned,
    /// and learning begins when the session is over.
    fn workspace_to_planner(&mut self) {
        if !self.language.is_training() {
            let workspace = self.language.lend_workspace();
            if !workspace.is_empty() {
                self.planner.take_workspace(workspace);
            }
        }
    }

    /// Lends the workspace to a training that is about to begin. What is planned is over.
    pub(crate) fn workspace_to_training(&mut self) {
        let workspace = self.planner.lend_workspace();
        if !workspace.is_empty() {
            self.planned = None;
            self.language.take_workspace(workspace);
        }
    }

    /// The tasks whose probability still matters: [`NEGLIGIBLE`] or more.
    fn worth_planning(&self) -> TaskSet {
        let least = self.belief.whole().scaled_by(NEGLIGIBLE);
        let matters = |&task: &usize| !least.exceeds(self.belief.weight(task));
        (0..self.task_count).filter(matters).fold(TaskSet::EMPTY, |set, task| set.union(TaskSet::of(task)))
    }

    /// The most likely task: the largest posterior. On a tie the task that is followed stays; otherwise the generator draws, and without
    /// one the first in order is taken.
    pub fn most_likely<R: Rng + ?Sized>(&self, random: Option<&mut R>) -> Option<usize> {
        let weight = |task: usize| self.belief.weight(task);
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
        let draw = random.map_or(0, |random| below(tied().count(), random));
        tied().nth(draw)
    }

    /// Decides on an action in the state that was planned for: one of the optimal set of the most likely task, which `random` draws (the
    /// first in order without it). At the task's goal, in a dead end, and where the set is unknown, the action is to do nothing.
    ///
    /// # Errors
    /// [`AgentError::NoSession`] or [`AgentError::NotPlanned`].
    pub fn decide<R: Rng + ?Sized>(&mut self, mut random: Option<&mut R>) -> Result<Decision, AgentError> {
        self.check_planned()?;
        let task = self.most_likely(random.as_deref_mut()).ok_or(AgentError::NoSession)?;
        self.followed = Some(task);
        let plan = self.search().optimal(task);
        let action = match plan {
            OptimalSet::Toward(actions) => {
                let draw = random.map_or(0, |random| below(actions.len(), random));
                actions.iter().nth(draw).unwrap_or(Action::NOOP)
            }
            OptimalSet::Goal | OptimalSet::DeadEnd(_) | OptimalSet::Unknown => Action::NOOP,
        };
        Ok(Decision { action, task, plan })
    }

    fn check_planned(&self) -> Result<(), AgentError> {
        self.check_under_way()?;
        if self.planned.is_none() || !self.planner.is_done() { Err(AgentError::NotPlanned) } else { Ok(()) }
    }

    fn check_applicable(&self, action: Action) -> Result<(), AgentError> {
        self.check_planned()?;
        if self.search().applicable().contains(action) { Ok(()) } else { Err(AgentError::NotApplicable) }
    }

    /// Takes in the trainer's feedback to `action`, done in the state that was planned for. Gives `false` where the feedback is impossible
    /// under every task and strategy, and was ignored.
    ///
    /// # Errors
    /// [`AgentError::NoSession`], [`AgentError::NotPlanned`] or [`AgentError::NotApplicable`].
    pub fn feedback(&mut self, action: Action, feedback: Feedback) -> Result<bool, AgentError> {
        self.check_applicable(action)?;
        let search = self.planner.search();
        Ok(self.belief.observe_feedback(feedback, |task| match search.optimal(task).actions() {
            Some(actions) if actions.contains(action) => Judgement::Correct,
            Some(_) => Judgement::Incorrect,
            None => Judgement::Unknown,
        }))
    }

    /// Takes in that the trainer did `action` to show the way, in the state that was planned for: it is in the optimal set with
    /// probability 1 - epsilon, spread evenly over that set, else spread evenly over the other applicable actions.
    ///
    /// # Errors
    /// As [`feedback`](Self::feedback).
    pub fn demonstration(&mut self, action: Action) -> Result<bool, AgentError> {
        self.check_applicable(action)?;
        let search = self.planner.search();
        let applicable = search.applicable();
        Ok(self.belief.observe(|strategy, task| {
            let optimal = search.optimal(task).actions()?;
            let others = ActionSet(applicable.0 & !optimal.0);
            if others.is_empty() {
                return Some(1.0 / optimal.len().max(1) as f32);
            }
            Some(if optimal.contains(action) {
                (1.0 - strategy.epsilon()) / optimal.len().max(1) as f32
            } else {
                strategy.epsilon() / others.len().max(1) as f32
            })
        }))
    }

    /// Plans to the end.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub fn plan_fully<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        while self.plan(domain, state, u32::MAX)? == Progress::Working {}
        Ok(())
    }
}
