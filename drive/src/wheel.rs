//! One wheel: the distance rolled, from an encoder that wraps around, and the motor's duty for a speed.

use crate::error::DriveError;
use core::f32::consts::TAU;
use micromath::F32Ext;

/// Reads a wheel's encoder. The counter may begin anywhere and overflow at any time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    ticks_per_metre: f32,
    /// The bits that the counter has less than 32.
    spare: u32,
    last: u32,
}

impl Encoder {
    /// A counter of `bits` bits, now at `count`. If it counts down when the wheel rolls ahead, `ticks_per_metre` is below 0. With 1,
    /// distances are ticks: use this to calibrate a robot.
    ///
    /// # Errors
    /// [`DriveError::Encoder`].
    pub fn new(ticks_per_metre: f32, bits: u32, count: u32) -> Result<Self, DriveError> {
        let spare = 32_u32.checked_sub(bits).filter(|&spare| spare < 31);
        match spare {
            Some(spare) if ticks_per_metre.is_finite() && ticks_per_metre != 0.0 => Ok(Self { ticks_per_metre, spare, last: count }),
            _ => Err(DriveError::Encoder { ticks_per_metre, bits }),
        }
    }

    /// Metres that the wheel has rolled since the last call: less than half of the counter's range.
    pub fn rolled(&mut self, count: u32) -> f32 {
        // The missing high bits are shifted out, and the counter's highest bit becomes the sign.
        let ticks = (count.wrapping_sub(self.last) << self.spare) as i32 >> self.spare;
        self.last = count;
        ticks as f32 / self.ticks_per_metre
    }
}

/// The calibration of a robot from two measured runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// The left wheel's ticks per metre.
    pub left: f32,
    /// The right wheel's ticks per metre.
    pub right: f32,
    /// The distance between the wheels, metres.
    pub track: f32,
}

impl Calibration {
    /// Computes it from the ticks of the left and the right wheel while the robot was pushed ahead along a line of `metres`, and while it
    /// made `turns` turns on the spot, to the left.
    ///
    /// # Errors
    /// [`DriveError::Run`] names the unusable run.
    pub fn measured(straight: [f32; 2], metres: f32, spun: [f32; 2], turns: f32) -> Result<Self, DriveError> {
        let [left, right] = straight.map(|ticks| ticks / metres);
        if ![left, right].into_iter().all(|ticks| ticks.is_finite() && ticks != 0.0) {
            return Err(DriveError::Run { name: "straight", ticks: straight });
        }
        let track = (spun[1] / right - spun[0] / left) / (turns * TAU);
        let is_track = track > 0.0 && track.is_finite();
        if is_track { Ok(Self { left, right, track }) } else { Err(DriveError::Run { name: "spun", ticks: spun }) }
    }
}

/// The gains of the speed control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    /// The duty per metre per second of wanted speed: 1 divided by the measured speed at full duty.
    pub ahead: f32,
    /// The duty per metre per second of missing speed.
    pub proportional: f32,
    /// The same, for each second that the error lasts.
    pub integral: f32,
}

/// Holds the speed of one wheel, whatever its load and the battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedControl {
    gains: Gains,
    /// The integral part of the duty.
    pub sum: f32,
}

impl SpeedControl {
    /// A wheel at rest.
    ///
    /// # Errors
    /// [`DriveError::Gain`] for a gain that is below 0 or not a number.
    pub fn new(gains: Gains) -> Result<Self, DriveError> {
        let named = [("ahead", gains.ahead), ("proportional", gains.proportional), ("integral", gains.integral)];
        match named.into_iter().find(|&(_, gain)| !(gain >= 0.0 && gain.is_finite())) {
            Some((name, value)) => Err(DriveError::Gain { name, value }),
            None => Ok(Self { gains, sum: 0.0 }),
        }
    }

    /// The motor's duty for the next `seconds`, from -1 to 1. It is 0 for a wheel that must stop or whose measured speed is not a number;
    /// the integral part is then reset.
    pub fn duty(&mut self, wanted: f32, measured: f32, seconds: f32) -> f32 {
        let error = wanted - measured;
        if wanted == 0.0 || !error.is_finite() {
            self.sum = 0.0;
            return 0.0;
        }
        let added = self.gains.integral * error * seconds.max(0.0);
        let sum = self.sum + added;
        let duty = self.gains.ahead * wanted + self.gains.proportional * error + sum;
        // The integral stops at full duty, or it would first have to run down again.
        if F32Ext::abs(duty) <= 1.0 || duty * added < 0.0 {
            self.sum = sum;
        }
        duty.clamp(-1.0, 1.0)
    }
}
