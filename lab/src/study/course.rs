//! The courses: lessons, then tests, each a command in a home of its own.

use goodbot::Capacities;
use goodbot::home::{Area, Cell};
use goodbot::memory::HomeHeap;
use goodbot::random::below;
use goodbot_course::layout::{BlockPlan, solvable::is_solvable};
use goodbot_course::{CourseError, HomeName, Homes, Intention, LESSONS, Layout, TESTS, generator};
use rand_pcg::Pcg32;

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
