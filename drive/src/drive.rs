//! The wheel speeds that carry out an action: turn on the spot, then follow the line between the centres of two cells. A robot that is off
//! that line after a failed action first returns to the centre of its cell, which clears the posts of a door.

use crate::error::DriveError;
use crate::grid::{Grid, direction};
use crate::pose::{Pose, wrapped};
use core::f32::consts::{FRAC_PI_2, PI};
use goodbot::home::Cell;
use goodbot::oomdp::Action;
use micromath::F32Ext;

/// The largest error of heading at which the robot drives on, radians.
const FACING: f32 = 0.06;
/// A driving robot stops and turns if its error of heading is larger than this, radians.
const ASTRAY: f32 = 0.5;
/// The distance from the centre of a cell at which the cell is reached, as a share of its side.
const NEAR: f32 = 0.03;
/// A robot farther off the line than this share of a cell first returns to the centre.
const OFF: f32 = 0.1;
/// The speed of a turn for each radian of error of heading, 1/s.
const TURN_GAIN: f32 = 5.0;
/// The angle towards the line for each metre off the line, radians.
const LINE_GAIN: f32 = 6.0;
/// Braking begins a little early: the square root is approximate, and wheels slip.
const BRAKES: f32 = 0.8;

/// The limits of the robot's wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The distance between the wheels, metres.
    pub track: f32,
    /// The highest speed, metres per second.
    pub speed: f32,
    /// The fastest turn, radians per second.
    pub turn: f32,
    /// The largest change of a wheel's speed, metres per second per second.
    pub acceleration: f32,
    /// The share of the highest speed for a robot that is not sure at all; above 0, at most 1.
    pub slowest: f32,
    /// The robot stops after this time without a call of [`Drive::heard`], seconds.
    pub silence: f32,
    /// The time after which an action has failed, seconds.
    pub patience: f32,
}

/// The speeds of the two wheels, metres per second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wheels {
    /// The left wheel.
    pub left: f32,
    /// The right wheel.
    pub right: f32,
}

/// The robot's present motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It has no action.
    Resting,
    /// It returns to the centre of its cell.
    Centring,
    /// It turns on the spot.
    Turning,
    /// It drives to the next cell.
    Driving,
    /// It has stopped in the centre of the cell.
    Arrived,
    /// It stops, because [`Drive::heard`] was not called in time, or its pose is not finite; it continues afterwards.
    Waiting,
    /// It has given up the action and stopped. Sense the cell and plan again.
    Stuck,
}

/// One step of the control loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The speeds to set the wheels to.
    pub wheels: Wheels,
    /// The robot's motion.
    pub motion: Motion,
}

/// The phase of the robot's way to the next cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Begun,
    Centring,
    Turning,
    Driving,
}

/// The robot's way to the next cell.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Leg {
    to: Cell,
    /// Cells to the east and to the north.
    along: (f32, f32),
    heading: f32,
    /// The share of the highest speed.
    pace: f32,
    taken: f32,
    phase: Phase,
}

/// The value limited to the range from -`most` to `most`. The standard library's own function panics if its bounds are not numbers.
fn within(value: f32, most: f32) -> f32 {
    value.min(most).max(-most)
}

/// Drives the robot from cell to cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    limits: Limits,
    wheels: Wheels,
    leg: Option<Leg>,
    unheard: f32,
}

impl Drive {
    /// A robot at rest.
    ///
    /// # Errors
    /// [`DriveError::Limit`].
    pub fn new(limits: Limits) -> Result<Self, DriveError> {
        let Limits { track, speed, turn, acceleration, slowest, silence, patience } = limits;
        let named = [
            ("track", track),
            ("speed", speed),
            ("turn", turn),
            ("acceleration", acceleration),
            ("slowest", slowest),
            ("silence", silence),
            ("patience", patience),
        ];
        let wrong = |&(name, value): &(&str, f32)| !(value > 0.0 && value.is_finite()) || (name == "slowest" && value > 1.0);
        match named.into_iter().find(wrong) {
            Some((name, value)) => Err(DriveError::Limit { name, value }),
            None => Ok(Self { limits, wheels: Wheels::default(), leg: None, unheard: 0.0 }),
        }
    }

    /// The limits of the robot's wheels.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Begins an action from the robot's cell. `certainty` is the probability of its task, from 0 to 1: the speed grows with it, from the
    /// slowest to the highest.
    ///
    /// # Errors
    /// [`DriveError::NoNeighbour`] for an action that is not north, south, east or west.
    pub fn go(&mut self, from: Cell, action: Action, certainty: f32) -> Result<(), DriveError> {
        let (east, north) = direction(action).ok_or(DriveError::NoNeighbour(action))?;
        let heading = match (east, north) {
            (0, 1) => FRAC_PI_2,
            (0, _) => -FRAC_PI_2,
            (1, _) => 0.0,
            _ => PI,
        };
        // A certainty that is not a number counts as none.
        let sure = if certainty > 0.0 { certainty.min(1.0) } else { 0.0 };
        let pace = self.limits.slowest + (1.0 - self.limits.slowest) * sure;
        let to = Cell::new(from.x.saturating_add(east), from.y.saturating_add(north));
        self.leg = Some(Leg { to, along: (east as f32, north as f32), heading, pace, taken: 0.0, phase: Phase::Begun });
        Ok(())
    }

    /// Gives up the action; the robot stops.
    pub fn halt(&mut self) {
        self.leg = None;
    }

    /// Reports that the trainer, or another person who watches the robot, is still there.
    pub fn heard(&mut self) {
        self.unheard = 0.0;
    }

    /// Reports that a bumper is pressed, or something is close ahead. A robot that rolls ahead stops at once, and its action has failed:
    /// the next step is [`Motion::Stuck`]. A robot that turns or backs off continues.
    pub fn bumped(&mut self) {
        if self.wheels.left + self.wheels.right > 0.0 {
            self.wheels = Wheels::default();
            if let Some(leg) = &mut self.leg {
                leg.taken = f32::INFINITY;
            }
        }
    }

    /// The wheel speeds for the next `seconds`, with the robot at `pose`. A pose that is not finite stops the robot.
    pub fn step(&mut self, grid: &Grid, pose: Pose, seconds: f32) -> Step {
        self.unheard += seconds;
        let Some(mut leg) = self.leg else { return self.stand(Motion::Resting, seconds) };
        let blind = ![pose.x, pose.y, pose.heading].into_iter().all(f32::is_finite);
        if blind || self.unheard > self.limits.silence {
            return self.stand(Motion::Waiting, seconds);
        }
        leg.taken += seconds;
        if leg.taken > self.limits.patience {
            self.leg = None;
            return self.stand(Motion::Stuck, seconds);
        }
        let to = grid.centre(leg.to);
        let (x, y) = (to.x - pose.x, to.y - pose.y);
        let remaining = x * leg.along.0 + y * leg.along.1;
        // To the left of the line is positive.
        let aside = x * leg.along.1 - y * leg.along.0;
        let near = NEAR * grid.size();
        leg.phase = match leg.phase {
            Phase::Begun if F32Ext::abs(aside) > OFF * grid.size() => Phase::Centring,
            Phase::Centring if F32Ext::abs(aside) > near => Phase::Centring,
            Phase::Begun | Phase::Centring => Phase::Turning,
            phase => phase,
        };
        if leg.phase == Phase::Centring {
            self.leg = Some(leg);
            return self.centre(pose, &leg, aside, seconds);
        }
        if remaining <= near {
            let step = self.stand(Motion::Arrived, seconds);
            let stands = step.wheels == Wheels::default();
            self.leg = if stands { None } else { Some(leg) };
            return if stands { step } else { Step { motion: Motion::Driving, ..step } };
        }
        let line = wrapped(leg.heading - pose.heading);
        let most = if leg.phase == Phase::Turning { FACING } else { ASTRAY };
        leg.phase = if F32Ext::abs(line) > most { Phase::Turning } else { Phase::Driving };
        self.leg = Some(leg);
        if leg.phase == Phase::Turning {
            return self.set(Motion::Turning, 0.0, line, leg.pace, seconds);
        }
        let towards = line - (LINE_GAIN * aside).clamp(-ASTRAY / 2.0, ASTRAY / 2.0);
        self.set(Motion::Driving, self.speed(&leg, remaining), towards, leg.pace, seconds)
    }

    /// Drives across to the line, forwards or backwards, whichever needs less turning. The robot is `aside` to the left of the line.
    fn centre(&mut self, pose: Pose, leg: &Leg, aside: f32, seconds: f32) -> Step {
        let right = wrapped(leg.heading - FRAC_PI_2 - pose.heading);
        let backwards = F32Ext::abs(right) > FRAC_PI_2;
        let off = if backwards { wrapped(right + PI) } else { right };
        if F32Ext::abs(off) > FACING {
            return self.set(Motion::Centring, 0.0, off, leg.pace, seconds);
        }
        let speed = self.speed(leg, F32Ext::abs(aside));
        let ahead = if backwards == (aside < 0.0) { speed } else { -speed };
        self.set(Motion::Centring, ahead, off, leg.pace, seconds)
    }

    /// The highest speed at which the robot can still brake in time.
    fn speed(&self, leg: &Leg, remaining: f32) -> f32 {
        (leg.pace * self.limits.speed).min(BRAKES * F32Ext::sqrt(2.0 * self.limits.acceleration * remaining))
    }

    /// Brakes.
    fn stand(&mut self, motion: Motion, seconds: f32) -> Step {
        self.set(motion, 0.0, 0.0, 1.0, seconds)
    }

    /// Changes the wheel speeds towards this speed ahead, while the robot turns by `off`, its error of heading.
    fn set(&mut self, motion: Motion, speed: f32, off: f32, pace: f32, seconds: f32) -> Step {
        let fastest = pace * self.limits.turn;
        let rim = within(TURN_GAIN * off, fastest) * self.limits.track / 2.0;
        let most = self.limits.acceleration * seconds.max(0.0);
        let nearer = |now: f32, wanted: f32| now + within(wanted - now, most);
        self.wheels = Wheels { left: nearer(self.wheels.left, speed - rim), right: nearer(self.wheels.right, speed + rim) };
        Step { wheels: self.wheels, motion }
    }
}
