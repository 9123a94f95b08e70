//! The data that the page draws. Each struct has the fields of a JSON text of the surface.

use serde::Serialize;
use tsify::Tsify;

/// A box of cells, its edge included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Extent {
    /// The westernmost cells.
    pub left: i32,
    /// The southernmost cells.
    pub bottom: i32,
    /// The easternmost cells.
    pub right: i32,
    /// The northernmost cells.
    pub top: i32,
}

/// A room or a door.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Its box; a room's border is wall.
    #[serde(flatten)]
    pub extent: Extent,
    /// A room's colour; empty for a door.
    pub color: String,
}

/// The agent or a block.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Thing {
    /// Its name.
    pub name: String,
    /// Its cell, east.
    pub x: i32,
    /// Its cell, north.
    pub y: i32,
    /// A block's colour.
    pub color: String,
    /// A block's shape.
    pub shape: String,
}

/// The home as it is now.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Scene {
    /// The box of all rooms.
    pub bounds: Extent,
    /// The rooms.
    pub rooms: Vec<Place>,
    /// The doors.
    pub doors: Vec<Place>,
    /// The blocks.
    pub blocks: Vec<Thing>,
    /// The robot.
    pub agent: Thing,
    /// The home as text, north up, a line for each row; `#` is wall.
    pub map: String,
}

/// A task that the command may mean.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Task {
    /// As logs write it: `agentInRoom(agent0,room1)`.
    pub name: String,
    /// How probable it is now.
    pub probability: f32,
}

/// How the trainer uses reward and punishment, as far as the robot knows: probabilities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Tsify)]
pub struct TrainerStyle {
    /// Whether the robot learns it; else it expects the paper's balanced trainer for certain.
    pub learned: bool,
    /// How often something is said to a right step.
    pub good: f32,
    /// How often something is said to a wrong step.
    pub bad: f32,
    /// How often a step is taken for the wrong kind.
    pub mistakes: f32,
    /// How often a word is meant for a step before the last one.
    pub late: f32,
}

/// The robot's belief.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Belief {
    /// The tasks, in an order that stays for the session.
    pub tasks: Vec<Task>,
    /// How the trainer uses reward and punishment.
    pub trainer: TrainerStyle,
}

/// The robot's next action.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Decided {
    /// The action's name.
    pub action: String,
    /// The task that it follows, by position.
    pub task: usize,
    /// How probable it is that this action is right: the tasks for which it is optimal, together.
    pub confidence: f32,
    /// The kind of plan for each task: `goal`, `toward`, `dead end`, `approximate` or `unknown`.
    pub plans: Vec<&'static str>,
}

/// The evidence of one step's feedback for each task.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Evidence {
    /// The action that was judged.
    pub action: String,
    /// The feedback to it.
    pub feedback: &'static str,
    /// Its effect: `used`, `says nothing` if no task's plan is known exactly, or `impossible` under every task and strategy.
    pub outcome: &'static str,
    /// For each task whether the action was `right`, `wrong` or `unknown`.
    pub judgements: Vec<&'static str>,
    /// The tasks' probabilities before.
    pub before: Vec<f32>,
    /// The tasks' probabilities after.
    pub after: Vec<f32>,
}

/// The effect of words to the robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Reaction {
    /// Whether a session has begun.
    pub begun: bool,
    /// The verdict on the words: `sure`, `unsure`, `done` or `none`.
    pub verdict: &'static str,
    /// The most likely task, by its name; empty if the robot took everything for a command.
    pub task: String,
    /// Whether it is negated: about something that shall not be.
    pub negated: bool,
    /// The session's command: the first of several commands; the next of a command for all things.
    pub command: String,
}

/// What a question is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
pub enum About {
    /// Whether this room or block is meant.
    Object,
    /// Whether something is to be carried.
    Carrying,
    /// Whether the robot itself is to go somewhere.
    Moving,
    /// Whether this task is meant.
    Task,
    /// Which of these rooms or blocks is meant.
    WhichObject,
    /// Which of these tasks is meant.
    WhichTask,
}

/// A question of the robot's. The answer is yes or no; for a question about which of several, one of them or none.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Question {
    /// What it is about.
    pub about: About,
    /// The way of a kind of task that it is about, if commands may mean ways: `any`, `through`, `either` or `avoiding`; else empty.
    pub way: &'static str,
    /// The names of the rooms or blocks that it is about.
    pub objects: Vec<String>,
    /// The tasks that it is about, by position.
    pub choices: Vec<usize>,
    /// The tasks for which the answer is yes; if there are choices, the tasks of all of them.
    pub tasks: Vec<usize>,
    /// The expected information of an answer, in bits.
    pub information: f32,
}

/// A lesson that is worth teaching next, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct NextLesson {
    /// Its position among those that could be taught.
    pub lesson: usize,
    /// Its wanted word that was heard least.
    pub word: String,
    /// How many of the wanted commands have that word.
    pub needed: u32,
    /// In how many sessions the robot has heard it.
    pub heard: u32,
    /// Whether that is often enough to leave little to teach.
    pub known: bool,
}

/// The evidence of an answer for each task.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct AnswerEvidence {
    /// Its effect: `used`, `says nothing`, or `impossible` under every task.
    pub outcome: &'static str,
    /// The tasks' probabilities before.
    pub before: Vec<f32>,
    /// The tasks' probabilities after.
    pub after: Vec<f32>,
}

/// Which word speaks for which task.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Support {
    /// The words of the command.
    pub words: Vec<String>,
    /// For each word whether the robot has learned from it, or from one that it treats as the same.
    pub known: Vec<bool>,
    /// For each word, each task's share of it; a row sums to 1.
    pub tasks: Vec<Vec<f32>>,
}

/// The translation table: how probable each word is, given a machine token.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Heat {
    /// The words learned so far, one a column.
    pub words: Vec<String>,
    /// The machine tokens learned so far, one a row.
    pub tokens: Vec<String>,
    /// Row by row.
    pub cells: Vec<f32>,
    /// How probable each word is where it speaks of no machine token: IBM Model 2's empty position.
    pub idle: Vec<f32>,
    /// The number of letters kept of a word; 0 keeps all.
    pub letters: usize,
}

/// The route to a task's goal.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Tsify)]
pub struct Route {
    /// The robot's cells from now on; the first is its current one.
    pub cells: Vec<[i32; 2]>,
    /// The home at the end.
    pub end: Vec<Thing>,
}
