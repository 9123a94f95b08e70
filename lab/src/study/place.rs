//! A command in a home: its possible tasks, their facts, and the right actions for each task in each state.
//!
//! The plans come from goodbot's exact planner, once for each state. Trainers judge by them, and every agent that acts for a task may use
//! them.

use crate::study::course::{CAPACITIES, Exercise};
use goodbot::home::{AGENT_IN_ROOM, COLOR, Home, HomeState, SHAPE, paper_tasks};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{Action, ActionSet, Domain, apply};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, Options};
use goodbot_course::CourseError;
use goodbot_lesson::first_words::heard;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The right actions in one state.
#[derive(Debug)]
pub struct Outlook {
    /// The possible actions, including rest.
    pub applicable: ActionSet,
    /// The plan for each task.
    pub optimal: Vec<OptimalSet>,
}

impl Outlook {
    /// The right actions for a task; empty if they are unknown.
    pub fn right(&self, task: usize) -> ActionSet {
        self.optimal.get(task).and_then(|set| set.exact()).unwrap_or(ActionSet::EMPTY)
    }
}

/// A command that is given in a home.
#[derive(Debug)]
pub struct Place {
    /// The home.
    pub home: Home<HomeHeap>,
    /// The initial state.
    pub start: HomeState,
    /// The command.
    pub command: String,
    /// The words of the command, in lower case.
    pub words: Vec<String>,
    /// The tasks that are possible.
    pub tasks: Vec<GroundedTask>,
    /// The facts of each task: its kind, the colour of its room, the colour and the shape of its block.
    pub facts: Vec<Vec<String>>,
    /// The intended task.
    pub intended: usize,
    umpire: Agent<AgentHeap>,
    outlooks: Outlooks,
}

/// The outlooks of the states so far. Commands in the same home share them.
type Outlooks = Rc<RefCell<HashMap<u64, Rc<Outlook>>>>;

impl Place {
    /// A command in its home.
    ///
    /// # Errors
    /// [`CourseError::NotPosed`] if the intended task is impossible here.
    pub fn new(exercise: &Exercise) -> Result<Self, CourseError> {
        let (home, start) = exercise.layout.build(HomeHeap::new(&CAPACITIES))?;
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        // The umpire knows the tasks and plans for them. It never learns.
        let mut umpire = Agent::new(AgentHeap::new(&CAPACITIES), &lifted, Options::PAPER)?;
        umpire.hear(&home, &start, &exercise.command)?;
        let intended = exercise.intention.find(&umpire, &home).ok_or(CourseError::NotPosed)?;
        let lifted = umpire.lifted();
        let tasks = umpire.tasks().to_vec();
        let facts = tasks.iter().map(|task| facts(&home, &lifted[usize::from(task.lifted)], task)).collect();
        let words = heard(Model::Model2, &exercise.command).map_err(|error| CourseError::Agent(error.into()))?;
        let command = exercise.command.clone();
        Ok(Self { home, start, command, words, tasks, facts, intended, umpire, outlooks: Outlooks::default() })
    }

    /// All commands of a course. Commands in the same home share their plans.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn all(exercises: &[Exercise]) -> Result<Vec<Self>, CourseError> {
        let mut places: Vec<Self> = Vec::with_capacity(exercises.len());
        for exercise in exercises {
            let mut place = Self::new(exercise)?;
            if let Some(same) = exercises.iter().zip(&places).find(|(known, _)| known.layout == exercise.layout) {
                place.outlooks = same.1.outlooks.clone();
            }
            places.push(place);
        }
        Ok(places)
    }

    /// The position of a task.
    pub fn position(&self, task: &GroundedTask) -> Option<usize> {
        self.tasks.iter().position(|known| known == task)
    }

    /// Whether a task is done after an action.
    pub fn is_done_after(&self, task: usize, state: &HomeState, action: Action) -> bool {
        let Some(next) = apply(&self.home, state, action) else { return false };
        let task = self.tasks[task];
        task.propositions(&self.umpire.lifted()[usize::from(task.lifted)]).all(|part| self.home.holds(&part, &next))
    }

    /// The right actions in a state.
    ///
    /// # Errors
    /// [`CourseError::Agent`] if planning was refused.
    pub fn outlook(&mut self, state: &HomeState) -> Result<Rc<Outlook>, CourseError> {
        let number = self.home.number(state);
        if let Some(known) = self.outlooks.borrow().get(&number) {
            return Ok(known.clone());
        }
        self.umpire.plan_fully(&self.home, state)?;
        let plan = self.umpire.planned();
        let optimal = (0..self.facts.len()).map(|task| plan.optimal(task)).collect();
        let outlook = Rc::new(Outlook { applicable: plan.applicable(), optimal });
        self.outlooks.borrow_mut().insert(number, outlook.clone());
        Ok(outlook)
    }
}

fn facts(home: &Home<HomeHeap>, lifted: &LiftedTask, task: &GroundedTask) -> Vec<String> {
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
