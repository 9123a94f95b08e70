//! The courses: lessons, then tests, each a command in a home of its own. A [`Place`] has the command's possible tasks, their facts, and the right
//! actions for each task in each state.
//!
//! The plans come from goodbot's exact planner, once for each state. Trainers judge by them, and every agent that acts for a task may use them.

use goodbot::home::{AGENT_IN_ROOM, Area, COLOR, Cell, Home, HomeState, SHAPE, paper_tasks};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{Action, ActionSet, Domain, apply};
use goodbot::planning::OptimalSet;
use goodbot::random::below;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, Capacities, Options};
use goodbot_course::layout::{BlockPlan, is_solvable};
use goodbot_course::{CourseError, HomeName, Homes, Intention, LESSONS, Layout, TESTS, generator};
use goodbot_lesson::first_words::heard;
use rand_pcg::Pcg32;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// A controller's memory, but with room for every state of its largest home: all agents are compared by exact plans.
pub const CAPACITIES: Capacities = Capacities { states: 64 * 64 * 64, ..Capacities::SMALL };

/// A command with its intended task, in a home.
#[derive(Clone, Debug, PartialEq)]
pub struct Exercise {
    /// The command.
    pub command: String,
    /// The intended task.
    pub intention: Intention,
    /// The home.
    pub layout: Layout,
}

/// The courses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// The paper's, in random homes.
    Paper,
    /// Random tasks in random homes, in words that are not the paper's.
    Free,
    /// A course with the same possible tasks in each lesson, so that only feedback tells which is intended.
    Told,
}

/// The trainers of all courses: two teachers and three controls.
pub const COMPARED: [&str; 5] = ["balanced", "population", "mute", "contrary", "shuffled"];

/// The colours of rooms and of blocks.
const COLORS: [&str; 4] = ["red", "green", "blue", "yellow"];
/// The shapes of blocks.
const SHAPES: [&str; 4] = ["chair", "bag", "basket", "box"];

/// Commands to go somewhere, none of them the paper's. `ROOM` is replaced by a colour.
const GO: [&str; 6] = [
    "walk over to the ROOM area",
    "please enter the ROOM room",
    "move to where it is ROOM",
    "ROOM room now",
    "head into the ROOM place",
    "i want you inside the ROOM room",
];
/// Commands to take a block somewhere, none of them the paper's.
const TAKE: [&str; 6] = [
    "push the COLOR SHAPE into the ROOM room",
    "put the SHAPE in the ROOM area",
    "bring COLOR SHAPE over to the ROOM place",
    "the COLOR SHAPE belongs in the ROOM room",
    "please get the SHAPE to where it is ROOM",
    "ROOM room is where the COLOR SHAPE should be",
];
/// The number of lessons with random commands: more than the paper's, because they have more words.
const FREE_LESSONS: usize = 10;

/// The lessons in which only feedback tells the task. A purple block is always a chair, an orange one always a bag.
const TOLD_LESSONS: [Intention; 7] = [
    Intention::go("green"),
    Intention::go("red"),
    Intention::go("blue"),
    Intention::take("purple", "chair", "red"),
    Intention::take("orange", "bag", "green"),
    Intention::take("purple", "chair", "blue"),
    Intention::take("orange", "bag", "red"),
];
/// The tests of that course. The first two are new commands, as in the paper.
const TOLD_TESTS: [Intention; 5] = [
    Intention::take("purple", "chair", "green"),
    Intention::take("orange", "bag", "blue"),
    Intention::go("green"),
    Intention::go("red"),
    Intention::go("blue"),
];

impl Course {
    /// All courses, in the order of the tables.
    pub const ALL: [Self; 3] = [Self::Paper, Self::Free, Self::Told];

    /// Its name, as it is typed.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Free => "free",
            Self::Told => "told",
        }
    }

    /// Its description, in a few words.
    pub const fn is(self) -> &'static str {
        match self {
            Self::Paper => "the paper's seven lessons and five tests, in random homes",
            Self::Free => "ten lessons and five tests of random tasks, in words that are not the paper's",
            Self::Told => "seven lessons and five tests with the same possible tasks each time, so that only feedback tells which is meant",
        }
    }

    /// Whether a trainer of this name teaches it: all teach the paper's course, those of [`COMPARED`] the others.
    pub fn has(self, trainer: &str) -> bool {
        self == Self::Paper || COMPARED.contains(&trainer)
    }

    /// The lessons and the tests of a seed.
    ///
    /// # Errors
    /// [`CourseError::Home`] if a home could not be built.
    pub fn exercises(self, seed: u64) -> Result<[Vec<Exercise>; 2], CourseError> {
        let mut random = generator(seed);
        let mut memory = HomeHeap::new(&CAPACITIES);
        match self {
            Self::Paper => {
                let homes = Homes::random(&mut random, &mut memory);
                let exercise = |known: &goodbot_course::Exercise| Exercise {
                    command: known.command.to_owned(),
                    intention: known.intention,
                    layout: *homes.layout(known.home),
                };
                Ok([LESSONS.iter().map(exercise).collect(), TESTS.iter().map(exercise).collect()])
            }
            Self::Free => {
                let mut some = |count: usize| (0..count).map(|_| free(&mut random, &mut memory)).collect::<Result<Vec<_>, _>>();
                Ok([some(FREE_LESSONS)?, some(TESTS.len())?])
            }
            Self::Told => {
                let mut in_one_home = |intentions: &[Intention]| {
                    let layout = told(&mut random, &mut memory)?;
                    let exercise = |&intention: &Intention| Exercise { command: intention.to_string(), intention, layout };
                    Ok::<_, CourseError>(intentions.iter().map(exercise).collect())
                };
                Ok([in_one_home(&TOLD_LESSONS)?, in_one_home(&TOLD_TESTS)?])
            }
        }
    }
}

fn one_of<T: Copy>(all: &[T], random: &mut Pcg32) -> T {
    all[below(all.len(), random)]
}

/// A random task in a random home, in one of several wordings.
fn free(random: &mut Pcg32, memory: &mut HomeHeap) -> Result<Exercise, CourseError> {
    let name = one_of(&[HomeName::A, HomeName::D, HomeName::Test, HomeName::Test], random);
    let mut layout = Layout::random(name, random, memory);
    // The blocks of a home have different shapes, because a command may leave the colour out.
    let first = below(SHAPES.len(), random);
    for (position, block) in layout.blocks.iter_mut().flatten().enumerate() {
        block.color = one_of(&COLORS, random);
        block.shape = SHAPES[(first + position) % SHAPES.len()];
    }
    let teachable: Vec<Intention> = layout.teachable().collect();
    let (home, start) = layout.build(memory)?;
    loop {
        let intention = one_of(&teachable, random);
        if is_solvable(&home, &start, &intention) {
            let said = match intention.block {
                Some((color, shape)) => one_of(&TAKE, random).replace("COLOR", color).replace("SHAPE", shape),
                None => one_of(&GO, random).to_owned(),
            };
            return Ok(Exercise { command: said.replace("ROOM", intention.room), intention, layout });
        }
    }
}

/// A home with the same tasks as all others: the robot and both blocks are in the yellow room, with doors to a red, a green and a blue
/// room.
fn told(random: &mut Pcg32, memory: &mut HomeHeap) -> Result<Layout, CourseError> {
    let [mut one, mut two, mut three] = ["red", "green", "blue"];
    if below(2, random) == 0 {
        (one, two) = (two, one);
    }
    match below(3, random) {
        0 => (one, three) = (three, one),
        1 => (two, three) = (three, two),
        _ => {}
    }
    let between = |first: i32, count: usize, random: &mut Pcg32| first + below(count, random) as i32;
    loop {
        // A block in the middle row can be pushed in all directions.
        let block = |color, shape, random: &mut Pcg32| Some(BlockPlan { cell: Cell::new(between(2, 5, random), 6), color, shape });
        let layout = Layout {
            rooms: [
                Some((Area::new(0, 4, 8, 8), "yellow")),
                Some((Area::new(0, 8, 4, 12), one)),
                Some((Area::new(4, 8, 8, 12), two)),
                Some((Area::new(2, 0, 6, 4), three)),
            ],
            doors: [Some(Cell::new(2, 8)), Some(Cell::new(6, 8)), Some(Cell::new(4, 4)), None],
            blocks: [block("purple", "chair", random), block("orange", "bag", random)],
            agent: Cell::new(between(1, 7, random), between(5, 3, random)),
        };
        let Ok((home, start)) = layout.build(&mut *memory) else { continue };
        if layout.teachable().all(|intention| is_solvable(&home, &start, &intention)) {
            return Ok(layout);
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_only_feedback_can_tell_the_same_tasks_are_possible_in_all_homes() {
        for seed in 0..20 {
            let [lessons, tests] = Course::Told.exercises(seed).expect("exercises");
            for exercise in lessons.iter().chain(&tests) {
                let mut tasks: Vec<String> = exercise.layout.teachable().map(|task| task.to_string()).collect();
                tasks.sort();
                let known = ["bag to the blue", "bag to the green", "bag to the red"].map(|end| format!("take the orange {end} room"));
                assert_eq!((tasks.len(), &tasks[3..6]), (9, &known[..]), "{tasks:?}");
                assert!(tasks.contains(&exercise.command));
            }
        }
    }

    #[test]
    fn random_commands_are_none_of_the_papers() {
        for seed in 0..20 {
            let [lessons, tests] = Course::Free.exercises(seed).expect("exercises");
            assert_eq!((lessons.len(), tests.len()), (FREE_LESSONS, 5));
            assert!(lessons.iter().chain(&tests).all(|exercise| exercise.command != exercise.intention.to_string()));
        }
    }
}
