//! A command in a home: the tasks that it may mean, what they are about, and what is right for each in each state.
//!
//! The plans are those of goodbot's exact planner, made once for each state: trainers judge by them, and every agent that acts for a task
//! may use them.

use goodbot::home::{AGENT_IN_ROOM, COLOR, Home, HomeState, SHAPE, paper_tasks};
use goodbot::language::for_each_word;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{ActionSet, Domain};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, Capacities, Options};
use goodbot_course::{CourseError, Exercise};
use std::collections::HashMap;
use std::rc::Rc;

/// A home of the study.
pub type StudyHome<'m> = Home<&'m mut HomeHeap>;

/// All of it fits a controller's memory.
pub const CAPACITIES: Capacities = Capacities::SMALL;

/// Knows the tasks of a home and plans for them; it never learns.
#[derive(Debug)]
pub struct Umpire(Agent<AgentHeap>);

impl Umpire {
    /// One that has seen no home yet.
    ///
    /// # Errors
    /// [`CourseError`].
    pub fn new() -> Result<Self, CourseError> {
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        Ok(Self(Agent::new(AgentHeap::new(&CAPACITIES), &lifted, Options::PAPER)?))
    }
}

/// What is right in one state.
#[derive(Debug)]
pub struct Outlook {
    /// The actions that can be done, doing nothing included.
    pub applicable: ActionSet,
    /// What planning says for each task.
    pub optimal: Vec<OptimalSet>,
}

impl Outlook {
    /// The actions that are right for a task; none where that is not known.
    pub fn right(&self, task: usize) -> ActionSet {
        self.optimal.get(task).and_then(|set| set.exact()).unwrap_or(ActionSet::EMPTY)
    }
}

/// A command that is given in a home.
#[derive(Debug)]
pub struct Place<'m, 'u> {
    /// The home.
    pub home: StudyHome<'m>,
    /// Where things stand at the beginning.
    pub start: HomeState,
    /// What is said and meant.
    pub exercise: &'static Exercise,
    /// The words of the command, in lower case.
    pub words: Vec<String>,
    /// For each task what it is about: its kind, the colour of its room, the colour and the shape of its block.
    pub facts: Vec<Vec<String>>,
    /// For each task its kind: the position of its lifted task.
    pub kinds: Vec<u8>,
    /// The task that is meant.
    pub intended: usize,
    umpire: &'u mut Umpire,
    outlooks: HashMap<u64, Rc<Outlook>>,
}

impl<'m, 'u> Place<'m, 'u> {
    /// A command in its home.
    ///
    /// # Errors
    /// [`CourseError::NotPosed`] where what is meant cannot be done here.
    pub fn new(home: StudyHome<'m>, start: HomeState, exercise: &'static Exercise, umpire: &'u mut Umpire) -> Result<Self, CourseError> {
        let intended = exercise.pose(&mut umpire.0, &home, &start)?.ok_or(CourseError::NotPosed)?;
        let lifted = umpire.0.lifted();
        let facts = umpire.0.tasks().iter().map(|task| facts(&home, &lifted[usize::from(task.lifted)], task)).collect();
        let kinds = umpire.0.tasks().iter().map(|task| task.lifted).collect();
        let mut words = Vec::new();
        let heard = for_each_word(exercise.command, |word| {
            words.push(word.to_string());
            Ok(())
        });
        heard.map_err(|error| CourseError::Agent(error.into()))?;
        Ok(Self { home, start, exercise, words, facts, kinds, intended, umpire, outlooks: HashMap::new() })
    }

    /// What is right in a state.
    ///
    /// # Errors
    /// [`CourseError::Agent`] where planning was refused.
    pub fn outlook(&mut self, state: &HomeState) -> Result<Rc<Outlook>, CourseError> {
        let number = self.home.number(state);
        if let Some(known) = self.outlooks.get(&number) {
            return Ok(known.clone());
        }
        self.umpire.0.plan_fully(&self.home, state)?;
        let plan = self.umpire.0.planned();
        let optimal = (0..self.facts.len()).map(|task| plan.optimal(task)).collect();
        let outlook = Rc::new(Outlook { applicable: plan.applicable(), optimal });
        self.outlooks.insert(number, outlook.clone());
        Ok(outlook)
    }
}

fn facts(home: &StudyHome<'_>, lifted: &LiftedTask, task: &GroundedTask) -> Vec<String> {
    let world = home.world();
    let value = |object, attribute| world.objects.value(object, attribute);
    let mut facts = Vec::new();
    for part in task.propositions(lifted) {
        let [subject, room, _] = part.arguments;
        facts.push(world.schema.propositions[part.proposition.index()].name.to_owned());
        facts.push(format!("room {}", value(room, COLOR)));
        if part.proposition != AGENT_IN_ROOM {
            facts.push(format!("block {}", value(subject, COLOR)));
            facts.push(value(subject, SHAPE).to_owned());
        }
    }
    facts
}
