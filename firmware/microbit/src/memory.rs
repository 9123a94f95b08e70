//! The capacities of this robot.

use goodbot::Capacities;
use goodbot::memory::{AgentArrays, HomeArrays};

/// The paper's whole course, in a home with at most 41 cells.
pub const CAPACITIES: Capacities = Capacities::TINY;

goodbot::memory! {
    /// The robot's memory.
    pub struct RobotMemory = CAPACITIES;
}

/// The home's tables, lent for ever.
pub type Rooms = &'static mut HomeArrays<RobotMemory>;
/// The robot's mind.
pub type Agent = goodbot::Agent<AgentArrays<RobotMemory>>;
/// The robot's home.
pub type Home = goodbot::home::Home<Rooms>;
/// A home that is being described.
pub type Builder = goodbot::home::HomeBuilder<Rooms>;
