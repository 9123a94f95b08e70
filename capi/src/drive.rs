//! From wheels to cells and back: the crate `goodbot-drive` for C. It works without a `goodbot` robot.

use crate::status::GoodbotStatus;
use core::mem::MaybeUninit;
use goodbot::home::Cell;
use goodbot::oomdp::Action;
use goodbot_drive::{Calibration, Drive, DriveError, Encoder, Gains, Grid, Limits, Motion, Pose, SpeedControl};

const MAGIC: u32 = 0x6472_6976;

/// Words of 32 bits that a `goodbot_drive` takes beside its first.
pub const GOODBOT_DRIVE_WORDS: usize = 24;

/// Dimensions and limits of a robot with two wheels. Lengths are metres, angles radians, times seconds.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotLimits {
    /// The distance between the wheels.
    pub track: f32,
    /// The highest speed, metres a second.
    pub speed: f32,
    /// The fastest turn, radians a second.
    pub turn: f32,
    /// The most by which a wheel's speed may change, metres a second each second.
    pub acceleration: f32,
    /// The share of the highest speed that a robot drives with certainty 0; above 0, at most 1.
    pub slowest: f32,
    /// The robot stops after this long without `goodbot_drive_heard`.
    pub silence: f32,
    /// An action that takes longer than this has failed.
    pub patience: f32,
    /// The side of a cell.
    pub cell: f32,
    /// The share of a cell by which the robot must be beyond a border before the cell changes; from 0 to below 0.5.
    pub hysteresis: f32,
}

/// Where the robot is: metres to the east and to the north, and where it faces, radians; 0 is east, a quarter turn is north.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoodbotPose {
    /// To the east.
    pub x: f32,
    /// To the north.
    pub y: f32,
    /// Where it faces.
    pub heading: f32,
}

/// What the robot is doing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotMotion {
    /// It has nothing to do.
    Resting = 0,
    /// It goes back to the middle of its cell.
    Centring = 1,
    /// It turns on the spot.
    Turning = 2,
    /// It drives to the next cell.
    Driving = 3,
    /// It has stopped in the middle of the cell.
    Arrived = 4,
    /// It stops, because nothing was heard or the pose is not a number; it goes on when that is over.
    Waiting = 5,
    /// It has given up the action and stopped. Sense the cell and plan again.
    Stuck = 6,
}

/// The result of one step of the control loop: the speeds for the wheels, in metres per second, and the state of the motion.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoodbotWheels {
    /// The left wheel.
    pub left: f32,
    /// The right wheel.
    pub right: f32,
    /// The state of the motion.
    pub motion: GoodbotMotion,
}

/// A wheel's encoder: a counter of `bits` bits, which may overflow at any time. `ticks_per_metre` is below 0 if it counts down as the
/// wheel rolls ahead, and 1 for distances in ticks. Set `last` to the first count.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotEncoder {
    /// Ticks for each metre.
    pub ticks_per_metre: f32,
    /// From 2 to 32.
    pub bits: u32,
    /// The last count.
    pub last: u32,
}

/// A controller of a wheel's speed: gains of 0 or more, and `sum`, which is 0 at first. `ahead` is the duty for each metre a second wanted,
/// `proportional` the duty for each metre a second that the wheel is too slow, `integral` the same for each second that this lasts.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotSpeed {
    /// 1 divided by the speed at full duty.
    pub ahead: f32,
    /// The gain of the error.
    pub proportional: f32,
    /// The gain of the error over time.
    pub integral: f32,
    /// The integral part of the duty.
    pub sum: f32,
}

/// The result of two measured runs.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoodbotCalibration {
    /// The left wheel's ticks for each metre.
    pub left: f32,
    /// The right wheel's.
    pub right: f32,
    /// The distance between the wheels, metres.
    pub track: f32,
}

/// A drive from cell to cell, in memory of the caller's; `goodbot_drive_init` sets it up.
#[repr(C)]
#[derive(Debug)]
pub struct GoodbotDrive {
    magic: u32,
    state: [MaybeUninit<u32>; GOODBOT_DRIVE_WORDS],
}

type State = (Grid, Drive);
const _: () = assert!(size_of::<State>() <= 4 * GOODBOT_DRIVE_WORDS && align_of::<State>() <= 4);

impl From<DriveError> for GoodbotStatus {
    fn from(error: DriveError) -> Self {
        if let DriveError::NoNeighbour(_) = error { Self::NotApplicable } else { Self::Number }
    }
}

fn status(done: Result<(), GoodbotStatus>) -> GoodbotStatus {
    done.err().unwrap_or(GoodbotStatus::Ok)
}

/// The value that the caller points to.
///
/// # Safety
/// `at` is null or points to a value of the caller's that nothing else uses now.
unsafe fn of<'a, T>(at: *mut T) -> Result<&'a mut T, GoodbotStatus> {
    // SAFETY: the caller's promise.
    unsafe { at.as_mut() }.ok_or(GoodbotStatus::Null)
}

/// # Safety
/// As for `of`.
unsafe fn state<'a>(drive: *mut GoodbotDrive) -> Result<&'a mut State, GoodbotStatus> {
    // SAFETY: the caller's promise. The magic word is set once the state is.
    unsafe {
        let drive = of(drive)?;
        if drive.magic == MAGIC { Ok(&mut *drive.state.as_mut_ptr().cast()) } else { Err(GoodbotStatus::BadHandle) }
    }
}

fn pose(GoodbotPose { x, y, heading }: GoodbotPose) -> Pose {
    Pose { x, y, heading }
}

/// Sets up a robot at rest. `NUMBER` if a limit is not above 0, or out of its range.
///
/// # Safety
/// `drive` and `limits` are null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_init(drive: *mut GoodbotDrive, limits: *const GoodbotLimits) -> GoodbotStatus {
    // SAFETY: the caller's promise; the state has room, as is asserted above.
    status(unsafe {
        of(drive).and_then(|drive| {
            let GoodbotLimits { track, speed, turn, acceleration, slowest, silence, patience, cell, hysteresis } = *of(limits.cast_mut())?;
            let limits = Limits { track, speed, turn, acceleration, slowest, silence, patience };
            let made: State = (Grid::new(cell, hysteresis)?, Drive::new(limits)?);
            drive.state.as_mut_ptr().cast::<State>().write(made);
            drive.magic = MAGIC;
            Ok(())
        })
    })
}

/// Begins an action, 0 to 3 for north, south, east and west, from the robot's cell. The speed grows with `certainty`, the probability of the task.
/// `NOT_APPLICABLE` for an action that leads to no neighbour.
///
/// # Safety
/// `drive` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_go(drive: *mut GoodbotDrive, x: i32, y: i32, action: u8, certainty: f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe { state(drive) }.and_then(|(_, drive)| Ok(drive.go(Cell::new(x, y), Action::new(action), certainty)?)))
}

/// Computes the wheels' speeds for the next `seconds`, for a robot at `at`. A pose that is not a number stops the robot.
///
/// # Safety
/// Each pointer is null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_step(
    drive: *mut GoodbotDrive,
    at: *const GoodbotPose,
    seconds: f32,
    wheels: *mut GoodbotWheels,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        state(drive).and_then(|(grid, drive)| {
            let (at, wheels) = (*of(at.cast_mut())?, of(wheels)?);
            let step = drive.step(grid, pose(at), seconds);
            let motion = match step.motion {
                Motion::Resting => GoodbotMotion::Resting,
                Motion::Centring => GoodbotMotion::Centring,
                Motion::Turning => GoodbotMotion::Turning,
                Motion::Driving => GoodbotMotion::Driving,
                Motion::Arrived => GoodbotMotion::Arrived,
                Motion::Waiting => GoodbotMotion::Waiting,
                Motion::Stuck => GoodbotMotion::Stuck,
            };
            *wheels = GoodbotWheels { left: step.wheels.left, right: step.wheels.right, motion };
            Ok(())
        })
    })
}

/// Reports that the trainer, or whoever watches the robot, is still there.
///
/// # Safety
/// `drive` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_heard(drive: *mut GoodbotDrive) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe { state(drive) }.map(|(_, drive)| drive.heard()))
}

/// Reports that a bumper is pressed, or that something is close ahead. A robot that rolls ahead stops at once, and the next step is
/// `GOODBOT_MOTION_STUCK`; one that turns or backs off goes on.
///
/// # Safety
/// `drive` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_bumped(drive: *mut GoodbotDrive) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe { state(drive) }.map(|(_, drive)| drive.bumped()))
}

/// Gives up the action; the robot stops.
///
/// # Safety
/// `drive` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_halt(drive: *mut GoodbotDrive) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe { state(drive) }.map(|(_, drive)| drive.halt()))
}

/// The cell of a pose. `x` and `y` hold the previous cell, and receive the new one.
///
/// # Safety
/// Each pointer is null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_drive_cell(drive: *mut GoodbotDrive, at: *const GoodbotPose, x: *mut i32, y: *mut i32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        state(drive).and_then(|(grid, _)| {
            let (at, x, y) = (*of(at.cast_mut())?, of(x)?, of(y)?);
            let cell = grid.cell(pose(at), Cell::new(*x, *y));
            (*x, *y) = (cell.x, cell.y);
            Ok(())
        })
    })
}

/// Moves a pose as the wheels have rolled, metres; `track` is the distance between them.
///
/// # Safety
/// `at` is null or points to a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_pose_rolled(at: *mut GoodbotPose, left: f32, right: f32, track: f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe { of(at) }.map(|at| {
        let Pose { x, y, heading } = pose(*at).rolled(left, right, track);
        *at = GoodbotPose { x, y, heading };
    }))
}

/// Moves a pose towards one from another sensor: a camera, a beacon, a line on the floor. `trust` is from 0 to 1.
///
/// # Safety
/// `at` and `sensed` are null or point to poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_pose_corrected(at: *mut GoodbotPose, sensed: *const GoodbotPose, trust: f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        of(at).and_then(|at| {
            let Pose { x, y, heading } = pose(*at).corrected(pose(*of(sensed.cast_mut())?), trust);
            *at = GoodbotPose { x, y, heading };
            Ok(())
        })
    })
}

/// Metres that a wheel has rolled since the last call; they must be less than half of the counter's range. `NUMBER` if `bits` or
/// `ticks_per_metre` is out of range.
///
/// # Safety
/// `encoder` and `metres` are null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_encoder_rolled(encoder: *mut GoodbotEncoder, count: u32, metres: *mut f32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        of(encoder).and_then(|encoder| {
            let metres = of(metres)?;
            *metres = Encoder::new(encoder.ticks_per_metre, encoder.bits, encoder.last)?.rolled(count);
            encoder.last = count;
            Ok(())
        })
    })
}

/// The motor's duty for the next `seconds`, from -1 to 1. It is 0, and so is then `sum`, if `wanted` is 0 or a speed is not a number.
/// `NUMBER` for a wrong gain.
///
/// # Safety
/// `speed` and `duty` are null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_speed_duty(
    speed: *mut GoodbotSpeed,
    wanted: f32,
    measured: f32,
    seconds: f32,
    duty: *mut f32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        of(speed).and_then(|speed| {
            let (&mut GoodbotSpeed { ahead, proportional, integral, sum }, duty) = (&mut *speed, of(duty)?);
            let mut control = SpeedControl::new(Gains { ahead, proportional, integral })?;
            control.sum = sum;
            *duty = control.duty(wanted, measured, seconds);
            speed.sum = control.sum;
            Ok(())
        })
    })
}

/// Calibrates a robot from the ticks of the left and the right wheel: `straight` while it was pushed ahead along a line of `metres`, `spun` while
/// it made `turns` turns on the spot, to the left. `NUMBER` if a run gives no usable number.
///
/// # Safety
/// Each pointer is null or valid; `straight` and `spun` point to 2 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_calibrate(
    straight: *const f32,
    metres: f32,
    spun: *const f32,
    turns: f32,
    calibration: *mut GoodbotCalibration,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    status(unsafe {
        of(calibration).and_then(|calibration| {
            let (straight, spun) = (*of(straight.cast_mut().cast())?, *of(spun.cast_mut().cast())?);
            let Calibration { left, right, track } = Calibration::measured(straight, metres, spun, turns)?;
            *calibration = GoodbotCalibration { left, right, track };
            Ok(())
        })
    })
}
