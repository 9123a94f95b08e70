//! Random homes of three storeys, and commands with ways.

use goodbot::Agent;
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeError, HomeState, Moves};
use goodbot::memory::{AgentMemory, HomeHeap};
use goodbot::oomdp::ObjectId;
use goodbot::random::below;
use goodbot::task::{Part, Way};
use rand_core::Rng;

/// The colors of the rooms.
const COLORS: [&str; 5] = ["red", "green", "blue", "yellow", "pink"];
/// The rooms of the middle storey.
const MIDDLE: [usize; 3] = [1, 2, 3];
const TOP: usize = 4;
/// The least width or height of a room, walls included; it is less than the sum of both numbers.
const SIDE: i32 = 4;
const MORE: usize = 3;

/// A home of three storeys: the robot's room below, three rooms in the middle, each with a door to both others, and one room above.
#[derive(Debug)]
pub struct ThreeStoreys<'m> {
    /// The home.
    pub home: Home<&'m mut HomeHeap>,
    /// The initial state: the robot somewhere in the room below.
    pub start: HomeState,
    rooms: [ObjectId; COLORS.len()],
    colors: [&'static str; COLORS.len()],
}

impl<'m> ThreeStoreys<'m> {
    /// A home with random sizes, doors, colors and robot.
    ///
    /// # Errors
    /// An error if the home does not fit into the memory.
    pub fn random(memory: &'m mut HomeHeap, random: &mut impl Rng) -> Result<Self, HomeError> {
        let mut colors = COLORS;
        for last in (1..colors.len()).rev() {
            colors.swap(last, below(last + 1, random));
        }
        let mut side = |least: i32| least + below(MORE, random) as i32;
        let (low, high) = (side(SIDE), side(SIDE));
        let (low, middle, high) = (low, low + side(SIDE), low + SIDE + MORE as i32 + high);
        let first = side(SIDE);
        let second = first + side(SIDE);
        let right = second + side(SIDE);
        let edges = [0, first, second, right];
        let mut builder = HomeBuilder::new(memory);
        let mut rooms = [ObjectId::new(0); COLORS.len()];
        let areas = [
            Area::new(0, 0, right, low),
            Area::new(0, low, first, middle),
            Area::new(first, low, second, middle),
            Area::new(second, low, right, middle),
            Area::new(0, middle, right, high),
        ];
        for (number, ((slot, area), color)) in rooms.iter_mut().zip(areas).zip(colors).enumerate() {
            *slot = builder.room(&format!("room{number}"), area, color)?;
        }
        for (storey, wall) in [low, middle].into_iter().enumerate() {
            for (between, (left, right)) in edges.into_iter().zip(edges.into_iter().skip(1)).enumerate() {
                let x = left + 1 + below((right - left - 1) as usize, random) as i32;
                builder.door(&format!("door{}", storey * MIDDLE.len() + between), Area::new(x, wall, x, wall))?;
            }
        }
        let inside = |wide: i32, random: &mut _| 1 + below((wide - 1) as usize, random) as i32;
        builder.agent("agent0", Cell::new(inside(right, random), inside(low, random)))?;
        let (home, start) = builder.build(Moves::Push)?;
        Ok(Self { home, start, rooms, colors })
    }

    fn color(&self, room: usize) -> &'static str {
        self.colors.get(room).copied().unwrap_or("")
    }

    fn room(&self, room: usize) -> ObjectId {
        self.rooms.get(room).copied().unwrap_or(ObjectId::new(0))
    }
}

/// The way that a command asks for beside its goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// Nothing.
    Any,
    /// To go through this room.
    Through(usize),
    /// To go through one of these two.
    Either(usize, usize),
    /// To avoid this room.
    Avoiding(usize),
}

/// A command and its meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exercise {
    /// The command.
    pub command: String,
    goal: usize,
    how: How,
}

impl Exercise {
    /// Draws a meaning, with equal probability for each kind, and words for it. Ways lead to the room above, past the rooms in the middle.
    pub fn random(home: &ThreeStoreys<'_>, random: &mut impl Rng) -> Self {
        let [first, second, third] = MIDDLE;
        let one = MIDDLE.get(below(MIDDLE.len(), random)).copied().unwrap_or(first);
        let (how, goal) = match below(4, random) {
            0 => (How::Any, 1 + below(TOP, random)),
            1 => (How::Through(one), TOP),
            2 if one == first => (How::Either(second, third), TOP),
            2 if one == second => (How::Either(first, third), TOP),
            2 => (How::Either(first, second), TOP),
            _ => (How::Avoiding(one), TOP),
        };
        Self { command: words(home, goal, how, random), goal, how }
    }

    /// The position of the intended task among those of the agent's session.
    pub fn find(&self, agent: &Agent<impl AgentMemory>, home: &ThreeStoreys<'_>) -> Option<usize> {
        let mut wanted: Vec<(Part, ObjectId)> = match self.how {
            How::Any => vec![],
            How::Through(room) => vec![(Part::Through(0), home.room(room))],
            How::Either(one, other) => vec![(Part::Through(0), home.room(one)), (Part::Through(0), home.room(other))],
            How::Avoiding(room) => vec![(Part::Avoiding, home.room(room))],
        };
        wanted.insert(0, (Part::Goal, home.room(self.goal)));
        agent.tasks().iter().position(|task| {
            let Some(lifted) = agent.lifted().get(usize::from(task.lifted)) else { return false };
            let goal = task.propositions(lifted).map(|part| (Part::Goal, part));
            let parts: Vec<_> = goal.chain(Way::of(task, lifted).parts()).map(|(part, it)| (part, it.arguments[1])).collect();
            parts == wanted
        })
    }
}

/// Words a meaning in one of several ways.
fn words(home: &ThreeStoreys<'_>, goal: usize, how: How, random: &mut impl Rng) -> String {
    let goal = home.color(goal);
    let said = match how {
        How::Any => [
            format!("go to the {goal} room"),
            format!("enter the {goal} room"),
            format!("move into the {goal} room"),
            format!("go into the {goal} room"),
        ],
        How::Through(via) => {
            let via = home.color(via);
            [
                format!("go through the {via} room to the {goal} room"),
                format!("go to the {goal} room via the {via} room"),
                format!("move through the {via} room into the {goal} room"),
                format!("enter the {goal} room by going through the {via} room"),
            ]
        }
        How::Either(one, other) => {
            let (one, other) = (home.color(one), home.color(other));
            [
                format!("go through the {one} or {other} room to the {goal} room"),
                format!("go to the {goal} room via the {one} or the {other} room"),
                format!("move through the {other} or {one} room into the {goal} room"),
                format!("enter the {goal} room by going through the {other} or {one} room"),
            ]
        }
        How::Avoiding(not) => {
            let not = home.color(not);
            [
                format!("go to the {goal} room without entering the {not} room"),
                format!("go to the {goal} room but avoid the {not} room"),
                format!("avoid the {not} room and enter the {goal} room"),
                format!("move into the {goal} room but do not go through the {not} room"),
            ]
        }
    };
    said.into_iter().nth(below(4, random)).unwrap_or_default()
}
