//! The pose of the robot, from the distance that each wheel has rolled.

use core::f32::consts::{PI, TAU};
use micromath::F32Ext;

/// The pose of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// To the east, metres.
    pub x: f32,
    /// To the north, metres.
    pub y: f32,
    /// The heading, radians: 0 is east, a quarter turn is north; from -PI to PI.
    pub heading: f32,
}

impl Pose {
    /// The pose after the wheels have rolled these distances, metres; `track` is the distance between them. The path is taken as an arc,
    /// and the robot is moved along its chord.
    #[must_use]
    pub fn rolled(self, left: f32, right: f32, track: f32) -> Self {
        let (ahead, turned) = ((left + right) / 2.0, (right - left) / track);
        let facing = self.heading + turned / 2.0;
        Self { x: self.x + ahead * F32Ext::cos(facing), y: self.y + ahead * F32Ext::sin(facing), heading: wrapped(self.heading + turned) }
    }

    /// The pose, moved towards one from another sensor: a camera, a beacon, a line on the floor. `trust` is from 0, which keeps the pose,
    /// to 1, which takes the sensed one. A pose that is not finite is ignored.
    #[must_use]
    pub fn corrected(self, sensed: Self, trust: f32) -> Self {
        let towards = |from: f32, to: f32| from + trust.clamp(0.0, 1.0) * (to - from);
        let turn = wrapped(sensed.heading - self.heading);
        let corrected =
            Self { x: towards(self.x, sensed.x), y: towards(self.y, sensed.y), heading: wrapped(self.heading + towards(0.0, turn)) };
        if [corrected.x, corrected.y, corrected.heading].into_iter().all(f32::is_finite) { corrected } else { self }
    }
}

/// The same angle, from -PI to PI.
pub fn wrapped(angle: f32) -> f32 {
    let turns = F32Ext::floor(angle / TAU);
    let rest = angle - turns * TAU;
    if rest > PI { rest - TAU } else { rest }
}
