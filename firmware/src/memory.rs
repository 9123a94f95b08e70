//! The robot's memory, of the chosen preset.

#[cfg(not(feature = "tiny"))]
goodbot::memory! {
    /// For controllers.
    pub struct RobotMemory = goodbot::Capacities::SMALL;
}

#[cfg(feature = "tiny")]
goodbot::memory! {
    /// For the smallest controllers.
    pub struct RobotMemory = goodbot::Capacities::TINY;
}
