//! One lesson: the agent hears a command and acts; a simulated trainer who knows the intended task says "good bot", "bad bot" or nothing,
//! and ends the lesson.

use crate::error::CourseError;
use crate::exercise::Exercise;
use crate::trainer::Trainer;
use goodbot::Agent;
use goodbot::feedback::Feedback;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::{OptimalSet, Plan};
use goodbot::session::{Decision, Evidence};
use goodbot::task::TaskSet;
use rand_core::Rng;

/// Rests in a row at the intended goal after which the trainer ends the lesson.
pub const RESTS: u8 = 3;
/// Steps after which the trainer gives up.
pub const MOST_STEPS: u16 = 300;

/// Why a lesson ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The agent rests at the intended goal.
    AtGoal,
    /// The intended task can no longer be done.
    DeadEnd,
    /// It took too long.
    TooLong,
}

impl Ending {
    /// Its name in output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AtGoal => "goal",
            Self::DeadEnd => "dead end",
            Self::TooLong => "too long",
        }
    }
}

/// The number of words of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeedbackCounts {
    /// "Good bot."
    pub reward: u32,
    /// "Bad bot."
    pub punish: u32,
    /// Nothing.
    pub neutral: u32,
}

impl FeedbackCounts {
    /// Counts one word.
    pub fn count(&mut self, feedback: Feedback) {
        let counter = match feedback {
            Feedback::Reward => &mut self.reward,
            Feedback::Punish => &mut self.punish,
            Feedback::Neutral => &mut self.neutral,
        };
        *counter = counter.saturating_add(1);
    }

    /// The sum of both.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            reward: self.reward.saturating_add(other.reward),
            punish: self.punish.saturating_add(other.punish),
            neutral: self.neutral.saturating_add(other.neutral),
        }
    }
}

/// One step of a lesson.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The agent's action, and its task.
    pub decision: Decision,
    /// Whether that was right for the intended task.
    pub correct: bool,
    /// The trainer's feedback.
    pub feedback: Feedback,
    /// Its effect.
    pub evidence: Evidence,
}

/// The result of one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// The agent acted.
    Acted(Step),
    /// The trainer has ended the lesson.
    Ended(Ending),
}

/// A lesson under way.
#[derive(Clone, Copy, Debug)]
pub struct Lesson<S> {
    state: S,
    intended: usize,
    understood: Option<bool>,
    rests: u8,
    steps: u16,
    feedback: FeedbackCounts,
}

/// The result of a lesson.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LessonReport {
    /// Whether the agent set out for the intended task on hearing the command, before any feedback.
    pub understood: bool,
    /// Why it ended.
    pub ending: Ending,
    /// The number of steps.
    pub steps: u16,
    /// The trainer's feedback.
    pub feedback: FeedbackCounts,
}

impl<S: Copy + PartialEq> Lesson<S> {
    /// A lesson whose command the agent has heard already.
    ///
    /// # Errors
    /// [`CourseError::NotPosed`] if the intended task is not possible in `start`.
    pub fn heard<D>(agent: &Agent<impl AgentMemory>, domain: &D, start: &S, exercise: &Exercise) -> Result<Self, CourseError>
    where
        D: Domain<State = S>,
    {
        let intended = exercise.intention.find(agent, domain).ok_or(CourseError::NotPosed)?;
        Ok(Self::meaning(start, intended))
    }

    /// A lesson whose command the agent has heard already, with the intended task by its position in the session: for commands that are no
    /// exercise of the course.
    pub fn meaning(start: &S, intended: usize) -> Self {
        Self { state: *start, intended, understood: None, rests: 0, steps: 0, feedback: FeedbackCounts::default() }
    }

    /// The present state.
    pub fn state(&self) -> &S {
        &self.state
    }

    /// The intended task, by its position among those of the agent's session.
    pub fn intended(&self) -> usize {
        self.intended
    }

    /// The result of the lesson, if it ended now in this way.
    pub fn report(&self, ending: Ending) -> LessonReport {
        LessonReport { understood: self.understood.unwrap_or(false), ending, steps: self.steps, feedback: self.feedback }
    }

    /// One turn, with a complete plan.
    ///
    /// # Errors
    /// [`CourseError`].
    pub fn step<D, R>(
        &mut self,
        agent: &mut Agent<impl AgentMemory>,
        domain: &D,
        trainer: &impl Trainer,
        random: &mut R,
    ) -> Result<Turn, CourseError>
    where
        D: Domain<State = S>,
        R: Rng + ?Sized,
    {
        agent.plan_fully(domain, &self.state)?;
        self.act(agent, domain, trainer, random)
    }

    /// One turn, for a caller who has planned for [`state`](Self::state) in parts.
    ///
    /// # Errors
    /// [`CourseError`].
    pub fn act<D, R>(
        &mut self,
        agent: &mut Agent<impl AgentMemory>,
        domain: &D,
        trainer: &impl Trainer,
        random: &mut R,
    ) -> Result<Turn, CourseError>
    where
        D: Domain<State = S>,
        R: Rng + ?Sized,
    {
        let (right, intended) = (agent.planned().optimal(self.intended), self.intended);
        self.turn(agent, domain, trainer, random, right, |task| task == intended)
    }

    /// As [`act`](Self::act), where each of several tasks will do.
    ///
    /// # Errors
    /// [`CourseError`].
    pub fn act_for_any<D, R>(
        &mut self,
        agent: &mut Agent<impl AgentMemory>,
        domain: &D,
        meant: TaskSet,
        trainer: &impl Trainer,
        random: &mut R,
    ) -> Result<Turn, CourseError>
    where
        D: Domain<State = S>,
        R: Rng + ?Sized,
    {
        let right = right_for_any(&agent.planned(), meant);
        self.turn(agent, domain, trainer, random, right, |task| meant.contains(task))
    }

    /// One turn in which `right` is right, and `is_meant` says whether a task is.
    fn turn<D, R>(
        &mut self,
        agent: &mut Agent<impl AgentMemory>,
        domain: &D,
        trainer: &impl Trainer,
        random: &mut R,
        right: OptimalSet,
        is_meant: impl FnOnce(usize) -> bool,
    ) -> Result<Turn, CourseError>
    where
        D: Domain<State = S>,
        R: Rng + ?Sized,
    {
        if let Some(ending) = self.ending(right) {
            return Ok(Turn::Ended(ending));
        }
        let decision = agent.decide_with(domain, &self.state, random)?;
        self.understood.get_or_insert(is_meant(decision.task));
        // The trainer takes a way that only seems shortest for a shortest one.
        let correct = right.exact().or(right.onward()).is_some_and(|actions| actions.contains(decision.action));
        let next = agent.acted(domain, &self.state, decision.action)?;
        let feedback = trainer.feedback(correct, random);
        let evidence = agent.feedback(feedback)?;
        self.feedback.count(feedback);
        self.rests = if right == OptimalSet::Goal && decision.action == Action::NOOP { self.rests.saturating_add(1) } else { 0 };
        self.steps = self.steps.saturating_add(1);
        self.state = next;
        Ok(Turn::Acted(Step { decision, correct, feedback, evidence }))
    }

    /// Returns why the trainer ends the lesson, if the intended task's optimal set is `right` and it does.
    fn ending(&self, right: OptimalSet) -> Option<Ending> {
        if self.rests >= RESTS {
            Some(Ending::AtGoal)
        } else if matches!(right, OptimalSet::DeadEnd(_)) {
            Some(Ending::DeadEnd)
        } else if self.steps >= MOST_STEPS {
            Some(Ending::TooLong)
        } else {
            None
        }
    }
}

/// What is right where each of these tasks will do: a step of a shortest way to any of them, and to rest at a goal. Not to the nearest
/// alone: which one that is changes as the robot goes, so a robot that turns round when it is blamed would be blamed for ever.
fn right_for_any(plan: &Plan<'_>, meant: TaskSet) -> OptimalSet {
    let sets = meant.iter().map(|task| plan.optimal(task));
    let any = sets.reduce(|one, other| match (one.onward(), other.onward()) {
        _ if one == OptimalSet::Goal || other == OptimalSet::Goal => OptimalSet::Goal,
        (Some(actions), Some(others)) => OptimalSet::Toward(actions.union(others)),
        (None, Some(_)) => other,
        (None, None) if matches!(one, OptimalSet::DeadEnd(_)) => other,
        _ => one,
    });
    any.unwrap_or(OptimalSet::Unknown)
}

/// One lesson from the command to the end, learned from. `on_step` is called for every step with the agent, the state before it and the
/// lesson.
///
/// # Errors
/// [`CourseError`].
pub fn run_lesson<D, R, M>(
    agent: &mut Agent<M>,
    domain: &D,
    start: &D::State,
    exercise: &Exercise,
    trainer: &impl Trainer,
    random: &mut R,
    mut on_step: impl FnMut(&Agent<M>, &D::State, &Lesson<D::State>, Option<&Step>),
) -> Result<LessonReport, CourseError>
where
    D: Domain,
    R: Rng + ?Sized,
    M: AgentMemory,
{
    agent.hear(domain, start, exercise.command)?;
    let mut lesson = Lesson::heard(agent, domain, start, exercise)?;
    on_step(agent, start, &lesson, None);
    loop {
        let before = *lesson.state();
        match lesson.step(agent, domain, trainer, random)? {
            Turn::Acted(step) => on_step(agent, &before, &lesson, Some(&step)),
            Turn::Ended(ending) => {
                let _ = agent.finish(domain)?;
                agent.learn_fully();
                return Ok(lesson.report(ending));
            }
        }
    }
}
