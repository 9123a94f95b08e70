//! The commands of the course, each with its meaning and its home.

use core::fmt;
use goodbot::home::{AGENT_IN_ROOM, BLOCK_IN_ROOM, COLOR, SHAPE};
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, ObjectId, PropositionId};
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, AgentError};

/// The meaning of a command: a task, described by the attributes of its objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Intention {
    /// The propositional function that must hold.
    pub proposition: PropositionId,
    /// The colour and shape of the block; `None` if the agent itself must go.
    pub block: Option<(&'static str, &'static str)>,
    /// The colour of the room.
    pub room: &'static str,
}

impl Intention {
    /// The agent in the room of this colour.
    pub const fn go(room: &'static str) -> Self {
        Self { proposition: AGENT_IN_ROOM, block: None, room }
    }

    /// The block of this colour and shape in the room of that colour.
    pub const fn take(color: &'static str, shape: &'static str, room: &'static str) -> Self {
        Self { proposition: BLOCK_IN_ROOM, block: Some((color, shape)), room }
    }

    /// Whether a task is the intended one.
    pub fn is<D: Domain>(&self, domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> bool {
        let value = |object: ObjectId, attribute| domain.world().objects.value(object, attribute);
        let mut propositions = task.propositions(lifted);
        let (Some(only), None) = (propositions.next(), propositions.next()) else { return false };
        let [subject, room, _] = only.arguments;
        only.proposition == self.proposition
            && value(room, COLOR) == self.room
            && self.block.is_none_or(|(color, shape)| value(subject, COLOR) == color && value(subject, SHAPE) == shape)
    }

    /// The position of the intended task among those of the agent's session.
    pub fn find<D: Domain>(&self, agent: &Agent<impl AgentMemory>, domain: &D) -> Option<usize> {
        let lifted = |task: &GroundedTask| agent.lifted().get(usize::from(task.lifted));
        agent.tasks().iter().position(|task| lifted(task).is_some_and(|lifted| self.is(domain, lifted, task)))
    }
}

/// The command in a person's words: `take the blue chair to the green room`.
///
/// ```
/// use goodbot_course::{Intention, LESSONS};
/// assert_eq!(Intention::take("blue", "chair", "green").to_string(), "take the blue chair to the green room");
/// assert!(LESSONS.iter().all(|lesson| lesson.intention.to_string() == lesson.command));
/// ```
impl fmt::Display for Intention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.block {
            Some((color, shape)) => write!(f, "take the {color} {shape} to the {} room", self.room),
            None => write!(f, "go to the {} room", self.room),
        }
    }
}

/// The homes of the course, by the letters of the paper's drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HomeName {
    /// The first two lessons: rooms alone.
    A,
    /// The third lesson: rooms alone.
    B,
    /// The fourth lesson: rooms alone.
    C,
    /// The fifth lesson: a blue chair.
    D,
    /// The sixth lesson: a purple bag.
    E,
    /// The seventh lesson: a yellow bag.
    F,
    /// All tests: four rooms, a purple chair and a blue bag.
    Test,
}

impl HomeName {
    /// All homes.
    pub const ALL: [Self; 7] = [Self::A, Self::B, Self::C, Self::D, Self::E, Self::F, Self::Test];
}

/// A command, its meaning, and its home.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exercise {
    /// The trainer's command.
    pub command: &'static str,
    /// Its meaning.
    pub intention: Intention,
    /// Its home.
    pub home: HomeName,
}

impl Exercise {
    const fn new(command: &'static str, intention: Intention, home: HomeName) -> Self {
        Self { command, intention, home }
    }

    /// Says the command to the agent and returns the position of the intended task, `None` if it is not possible here.
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn pose<D: Domain>(&self, agent: &mut Agent<impl AgentMemory>, domain: &D, state: &D::State) -> Result<Option<usize>, AgentError> {
        agent.hear(domain, state, self.command)?;
        Ok(self.intention.find(agent, domain))
    }
}

/// The seven lessons, in order.
pub const LESSONS: [Exercise; 7] = [
    Exercise::new("go to the green room", Intention::go("green"), HomeName::A),
    Exercise::new("go to the red room", Intention::go("red"), HomeName::A),
    Exercise::new("go to the blue room", Intention::go("blue"), HomeName::B),
    Exercise::new("go to the yellow room", Intention::go("yellow"), HomeName::C),
    Exercise::new("take the blue chair to the yellow room", Intention::take("blue", "chair", "yellow"), HomeName::D),
    Exercise::new("take the purple bag to the blue room", Intention::take("purple", "bag", "blue"), HomeName::E),
    Exercise::new("take the yellow bag to the red room", Intention::take("yellow", "bag", "red"), HomeName::F),
];

/// The five tests, in order.
pub const TESTS: [Exercise; 5] = [
    Exercise::new("take the purple chair to the green room", Intention::take("purple", "chair", "green"), HomeName::Test),
    Exercise::new("take the blue bag to the yellow room", Intention::take("blue", "bag", "yellow"), HomeName::Test),
    Exercise::new("go to the green room", Intention::go("green"), HomeName::Test),
    Exercise::new("go to the red room", Intention::go("red"), HomeName::Test),
    Exercise::new("go to the blue room", Intention::go("blue"), HomeName::Test),
];
