//! The world "lift", written by `goodbot table --rust`. Its description was checked.
//!
//! A state is a number, from 0 to 7. It says what holds:
//!
//! - `liftAtFloor(lift0,floor0): state / 1 % 4 == 0`
//! - `liftAtFloor(lift0,floor1): state / 1 % 4 == 1`
//! - `liftAtFloor(lift0,floor2): state / 1 % 4 == 2`
//! - `liftAtFloor(lift0,floor3): state / 1 % 4 == 3`
//! - `doorOpen(lift0): state / 4 % 2 == 1`

use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectError, ObjectSet, ObjectTables, Objects, OneByOne,
    Proposition, Schema, World,
};
use goodbot::task::{LiftedTask, TaskTextError};

goodbot::memory! {
    /// Memory for the robot and its agent: every lesson is kept, and every plan is exact.
    pub struct RobotMemory = goodbot::Capacities {
        objects: 5,
        names: 9,
        name_bytes: 49,
        cells: 0,
        tasks: 4,
        strategies: 3,
        beliefs: 12,
        candidates: 4,
        candidate_tokens: 48,
        ground_propositions: 4,
        goal_entries: 0,
        states: 8,
        hashed_states: 0,
        words: 54,
        word_bytes: 658,
        tokens: 5,
        token_bytes: 53,
        commands: 24,
        command_tokens: 288,
        sessions: 6,
        sentence_words: 48,
        pairs: 24,
        translations: 288,
        alignments: 545,
        length_pairs: 0,
    };
}

/// The vocabulary.
pub const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("lift"), Class::new("floor")],
    attributes: &[
        Attribute::new("name", &[Carrier::new(ClassId::new(1), "floorName")]),
    ],
    propositions: &[
        Proposition::new("liftAtFloor", &[ClassId::new(0), ClassId::new(1)]),
        Proposition::new("doorOpen", &[ClassId::new(0)]),
        Proposition::new("above", &[ClassId::new(1), ClassId::new(1)]),
    ],
};

const ACTIONS: [ActionKind<'static>; 4] = [
    ActionKind::new("up", 1),
    ActionKind::new("down", 1),
    ActionKind::new("open", 1),
    ActionKind::new("close", 1),
];

/// The kinds of task.
pub const TASKS: [&str; 1] = [
    "liftAtFloor(?l,?f)",
];

/// Each object: its class, its name, and its values.
const OBJECTS: [(u8, &str, [&str; 1]); 5] = [
    (0, "lift0", [""]),
    (1, "floor0", ["garage"]),
    (1, "floor1", ["shop"]),
    (1, "floor2", ["office"]),
    (1, "floor3", ["roof"]),
];

/// Facts: a proposition of these objects holds where `state / unit % values == value`, given as `[unit, values, value]`.
const FACTS: [(u8, [u8; 3], [u32; 3]); 8] = [
    (0, [0, 1, 0], [1, 4, 0]),
    (0, [0, 2, 0], [1, 4, 1]),
    (0, [0, 3, 0], [1, 4, 2]),
    (0, [0, 4, 0], [1, 4, 3]),
    (1, [0, 0, 0], [4, 2, 1]),
    (2, [2, 1, 0], [1, 1, 0]),
    (2, [3, 2, 0], [1, 1, 0]),
    (2, [4, 3, 0], [1, 1, 0]),
];

/// A part of an action's rule: a condition or an effect; digits as in `FACTS`.
enum Part {
    /// A rule begins.
    Begin,
    /// A digit must have a value.
    Has([u32; 3]),
    /// A digit must have another value.
    #[allow(dead_code)]
    HasNot([u32; 3]),
    /// A digit takes a value.
    Takes([u32; 3]),
}

/// The rules of all actions, by the action's number: the first rule of an action that fits applies.
const PARTS: [(usize, Part); 30] = [
    (0, Part::Begin),
    (0, Part::Has([1, 4, 0])),
    (0, Part::HasNot([4, 2, 1])),
    (0, Part::Takes([1, 4, 1])),
    (0, Part::Begin),
    (0, Part::Has([1, 4, 1])),
    (0, Part::HasNot([4, 2, 1])),
    (0, Part::Takes([1, 4, 2])),
    (0, Part::Begin),
    (0, Part::Has([1, 4, 2])),
    (0, Part::HasNot([4, 2, 1])),
    (0, Part::Takes([1, 4, 3])),
    (1, Part::Begin),
    (1, Part::Has([1, 4, 1])),
    (1, Part::HasNot([4, 2, 1])),
    (1, Part::Takes([1, 4, 0])),
    (1, Part::Begin),
    (1, Part::Has([1, 4, 2])),
    (1, Part::HasNot([4, 2, 1])),
    (1, Part::Takes([1, 4, 1])),
    (1, Part::Begin),
    (1, Part::Has([1, 4, 3])),
    (1, Part::HasNot([4, 2, 1])),
    (1, Part::Takes([1, 4, 2])),
    (2, Part::Begin),
    (2, Part::HasNot([4, 2, 1])),
    (2, Part::Takes([4, 2, 1])),
    (3, Part::Begin),
    (3, Part::Has([4, 2, 1])),
    (3, Part::Takes([4, 2, 0])),
];

/// The initial state.
pub const START: u32 = 1;
/// The number of states.
pub const STATES: u32 = 8;

/// The robot. Its objects are in memory that the caller lends: `memory.home.lend().objects`.
pub struct Robot<'m> {
    objects: Objects<'m>,
}

impl<'m> Robot<'m> {
    /// The robot and its world.
    ///
    /// # Errors
    /// An error if the memory is smaller than `RobotMemory`.
    pub fn new(memory: ObjectTables<'m>) -> Result<Self, ObjectError> {
        let mut objects = ObjectSet::new(memory);
        for (class, name, values) in OBJECTS {
            objects.add(ClassId::new(class), name, &values)?;
        }
        Ok(Self { objects: objects.into_objects() })
    }

    /// The kinds of task that commands may mean.
    ///
    /// # Errors
    /// None: the texts were checked.
    pub fn tasks() -> Result<[LiftedTask; TASKS.len()], TaskTextError> {
        let mut tasks = [const { None }; TASKS.len()];
        for (slot, text) in tasks.iter_mut().zip(TASKS) {
            *slot = Some(LiftedTask::parse(text, &SCHEMA)?);
        }
        Ok(tasks.map(|task| task.unwrap_or_else(|| unreachable!())))
    }
}

fn has(state: u32, [unit, values, value]: [u32; 3]) -> bool {
    state / unit % values == value
}

impl Domain for Robot<'_> {
    type State = u32;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    fn step(&self, state: &u32, action: Action) -> Option<u32> {
        let (mut after, mut fits) = (*state, false);
        for (_, part) in PARTS.iter().filter(|(of, _)| *of == action.index()) {
            match *part {
                Part::Begin if fits => break,
                Part::Begin => (after, fits) = (*state, true),
                Part::Has(digit) => fits &= has(*state, digit),
                Part::HasNot(digit) => fits &= !has(*state, digit),
                Part::Takes([unit, values, value]) => after = after - after / unit % values * unit + value * unit,
            }
        }
        fits.then_some(after)
    }

    fn holds(&self, proposition: &GroundProposition, state: &u32) -> bool {
        let count = SCHEMA.parameters(proposition.proposition).len();
        let same = |arguments: &[u8; 3]| arguments.iter().zip(proposition.arguments).take(count).all(|(&known, given)| usize::from(known) == given.index());
        FACTS.iter().any(|(of, arguments, digit)| usize::from(*of) == proposition.proposition.index() && same(arguments) && has(*state, *digit))
    }

    fn state_count(&self) -> u64 {
        u64::from(STATES)
    }

    fn number(&self, state: &u32) -> u64 {
        u64::from(*state)
    }

    fn numbered(&self, number: u64) -> u32 {
        number as u32
    }
}
