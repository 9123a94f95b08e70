//! A robot on any board with `embedded-hal`: two motors, each with a PWM and a pin for its direction, a counter for each encoder, and a
//! distance sensor that pulls a pin low if something is close ahead.

use crate::{Drive, Encoder, Grid, Motion, Pose, SpeedControl};
use core::fmt;
use embedded_hal::digital::{self, Error as _, InputPin, OutputPin};
use embedded_hal::pwm::{self, Error as _, SetDutyCycle};
use goodbot::home::Cell;

/// A motor and its wheel.
#[derive(Clone, Copy, Debug)]
pub struct Motor<P, D> {
    /// Sets its speed.
    pub pwm: P,
    /// High while it turns backwards.
    pub backwards: D,
    /// Holds its speed.
    pub control: SpeedControl,
    /// Counts its turns.
    pub encoder: Encoder,
}

/// The error of a pin or a PWM. The motors were told to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HalError {
    /// A pin.
    Pin(digital::ErrorKind),
    /// A PWM.
    Pwm(pwm::ErrorKind),
}

impl fmt::Display for HalError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pin(kind) => write!(out, "a pin cannot be used, so the motors are stopped: {kind}"),
            Self::Pwm(kind) => write!(out, "a motor's PWM cannot be set, so the motors are stopped: {kind}"),
        }
    }
}

impl core::error::Error for HalError {}

impl<P: SetDutyCycle, D: OutputPin> Motor<P, D> {
    /// Holds a speed for the next `seconds`; the wheel `rolled` this many metres in the last ones.
    fn hold(&mut self, speed: f32, rolled: f32, seconds: f32) -> Result<(), HalError> {
        let duty = self.control.duty(speed, rolled / seconds, seconds);
        let counts = f32::from(self.pwm.max_duty_cycle()) * duty.max(-duty);
        self.backwards.set_state((duty < 0.0).into()).map_err(|error| HalError::Pin(error.kind()))?;
        self.pwm.set_duty_cycle(counts as u16).map_err(|error| HalError::Pwm(error.kind()))
    }
}

/// The robot.
#[derive(Clone, Copy, Debug)]
pub struct Rover<P, D, S> {
    /// The left motor and the right one.
    pub motors: [Motor<P, D>; 2],
    /// Low if something is close ahead.
    pub free: S,
    /// Carries out actions: call [`Drive::go`] with `cell`.
    pub drive: Drive,
    /// The cells.
    pub grid: Grid,
    /// The robot's pose; correct it by other sensors.
    pub pose: Pose,
    /// Its cell.
    pub cell: Cell,
}

impl<P: SetDutyCycle, D: OutputPin, S: InputPin> Rover<P, D, S> {
    /// One turn of the control loop, `seconds` after the last: reads the sensors and sets the motors. `counts` are the encoders' counters.
    ///
    /// # Errors
    /// [`HalError`]: both motors were told to stop.
    pub fn turn(&mut self, counts: [u32; 2], seconds: f32) -> Result<Motion, HalError> {
        let turned = self.try_turn(counts, seconds);
        if turned.is_err() {
            // Both are tried: one may work although the other failed.
            let _ = self.motors.each_mut().map(|motor| motor.pwm.set_duty_cycle_fully_off());
        }
        turned
    }

    fn try_turn(&mut self, counts: [u32; 2], seconds: f32) -> Result<Motion, HalError> {
        let ([left, right], [left_count, right_count]) = (&mut self.motors, counts);
        let rolled = [left.encoder.rolled(left_count), right.encoder.rolled(right_count)];
        self.pose = self.pose.rolled(rolled[0], rolled[1], self.drive.limits().track);
        self.cell = self.grid.cell(self.pose, self.cell);
        if self.free.is_low().map_err(|error| HalError::Pin(error.kind()))? {
            self.drive.bumped();
        }
        let step = self.drive.step(&self.grid, self.pose, seconds);
        left.hold(step.wheels.left, rolled[0], seconds)?;
        right.hold(step.wheels.right, rolled[1], seconds)?;
        Ok(step.motion)
    }
}
