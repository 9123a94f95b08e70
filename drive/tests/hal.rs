//! A robot on the pins of a simulated board: motors that lag and differ, counters of 16 bits that wrap around, and a sensor that sees a wall.

use embedded_hal::{digital, pwm};
use goodbot::home::Cell;
use goodbot_drive::hal::{HalError, Motor, Rover};
use goodbot_drive::{Drive, EAST, Encoder, Gains, Grid, Limits, Motion, NORTH, Pose, SpeedControl};
use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

const LIMITS: Limits = Limits { track: 0.12, speed: 0.3, turn: 3.0, acceleration: 1.0, slowest: 0.25, silence: 0.5, patience: 8.0 };
const GAINS: Gains = Gains { ahead: 2.0, proportional: 2.0, integral: 20.0 };
const TICKS: f32 = 100_000.0;
const TURN: f32 = 0.01;
const HERE: Cell = Cell::new(0, 0);

/// The true state of the robot.
struct Truth {
    pose: Pose,
    duties: [f32; 2],
    speeds: [f32; 2],
    rolled: [f32; 2],
    backwards: [bool; 2],
    /// The x of a wall to the east, metres.
    wall: f32,
    pins_are_broken: bool,
}

impl Truth {
    /// The encoders' counters after the next turn.
    fn pass(&mut self) -> [u32; 2] {
        for wheel in 0..2 {
            // Both motors are weaker than the controls assume.
            let top = [0.45, 0.38][wheel] * if self.backwards[wheel] { -1.0 } else { 1.0 };
            self.speeds[wheel] += (top * self.duties[wheel] - self.speeds[wheel]) * TURN / 0.05;
            self.rolled[wheel] += self.speeds[wheel] * TURN;
        }
        self.pose = self.pose.rolled(self.speeds[0] * TURN, self.speeds[1] * TURN, LIMITS.track);
        self.rolled.map(|metres| (metres * TICKS) as i32 as u32 & 0xFFFF)
    }
}

/// One pin or PWM of a wheel.
#[derive(Clone)]
struct Pin(Rc<RefCell<Truth>>, usize);

#[derive(Debug)]
struct Broken;

impl digital::Error for Broken {
    fn kind(&self) -> digital::ErrorKind {
        digital::ErrorKind::Other
    }
}

impl digital::ErrorType for Pin {
    type Error = Broken;
}

impl digital::OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Broken> {
        self.0.borrow_mut().backwards[self.1] = false;
        if self.0.borrow().pins_are_broken { Err(Broken) } else { Ok(()) }
    }

    fn set_high(&mut self) -> Result<(), Broken> {
        self.0.borrow_mut().backwards[self.1] = true;
        Ok(())
    }
}

impl digital::InputPin for Pin {
    fn is_high(&mut self) -> Result<bool, Broken> {
        let truth = self.0.borrow();
        Ok(truth.pose.x + 0.1 < truth.wall || truth.pose.heading.abs() > 0.5)
    }

    fn is_low(&mut self) -> Result<bool, Broken> {
        self.is_high().map(|high| !high)
    }
}

impl pwm::ErrorType for Pin {
    type Error = Infallible;
}

impl pwm::SetDutyCycle for Pin {
    fn max_duty_cycle(&self) -> u16 {
        999
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        assert!(duty <= 999, "{duty}");
        self.0.borrow_mut().duties[self.1] = f32::from(duty) / 999.0;
        Ok(())
    }
}

fn rover(wall: f32) -> (Rover<Pin, Pin, Pin>, Rc<RefCell<Truth>>) {
    let grid = Grid::new(0.3, 0.1).unwrap();
    let pose = grid.centre(HERE);
    let (stand, ahead) = ([0.0; 2], [false; 2]);
    let truth = Truth { pose, duties: stand, speeds: stand, rolled: stand, backwards: ahead, wall, pins_are_broken: false };
    let truth = Rc::new(RefCell::new(truth));
    let motor = |wheel| Motor {
        pwm: Pin(Rc::clone(&truth), wheel),
        backwards: Pin(Rc::clone(&truth), wheel),
        control: SpeedControl::new(GAINS).unwrap(),
        encoder: Encoder::new(TICKS, 16, 0).unwrap(),
    };
    let (motors, free) = ([motor(0), motor(1)], Pin(Rc::clone(&truth), 0));
    (Rover { motors, free, drive: Drive::new(LIMITS).unwrap(), grid, pose, cell: HERE }, truth)
}

/// Carries out an action, and returns how it ended.
fn act(rover: &mut Rover<Pin, Pin, Pin>, truth: &Rc<RefCell<Truth>>, action: goodbot::oomdp::Action) -> Motion {
    rover.drive.go(rover.cell, action, 1.0).unwrap();
    for _ in 0..1000 {
        rover.drive.heard();
        let counts = truth.borrow_mut().pass();
        let motion = rover.turn(counts, TURN).unwrap();
        if [Motion::Arrived, Motion::Stuck].contains(&motion) {
            return motion;
        }
    }
    panic!("it never ended");
}

#[test]
fn a_robot_on_pins_comes_to_the_cells_that_it_is_sent_to() {
    let (mut rover, truth) = rover(f32::INFINITY);
    for action in [EAST, EAST, NORTH, EAST] {
        assert_eq!(act(&mut rover, &truth, action), Motion::Arrived);
    }
    let (truth, there) = (truth.borrow(), rover.grid.centre(Cell::new(3, 1)));
    assert_eq!(rover.cell, Cell::new(3, 1));
    assert!((truth.pose.x - there.x).abs() < 0.02 && (truth.pose.y - there.y).abs() < 0.02, "{:?}", truth.pose);
    assert!(truth.rolled[1] * TICKS > f32::from(u16::MAX), "the counter never wrapped around");
}

#[test]
fn a_robot_on_pins_stops_where_its_sensor_sees_a_wall_and_goes_another_way() {
    let (mut rover, truth) = rover(0.25);
    assert_eq!(act(&mut rover, &truth, EAST), Motion::Stuck);
    assert_eq!(truth.borrow().duties, [0.0; 2]);
    assert!(truth.borrow().pose.x < 0.2, "{:?}", truth.borrow().pose);
    assert_eq!(act(&mut rover, &truth, NORTH), Motion::Arrived);
    assert_eq!(rover.cell, Cell::new(0, 1));
}

#[test]
fn a_pin_that_fails_stops_both_motors_and_is_told() {
    let (mut rover, truth) = rover(f32::INFINITY);
    rover.drive.go(HERE, EAST, 1.0).unwrap();
    for _ in 0..20 {
        let counts = truth.borrow_mut().pass();
        rover.turn(counts, TURN).unwrap();
    }
    assert!(truth.borrow().duties.iter().all(|duty| *duty > 0.0));
    truth.borrow_mut().pins_are_broken = true;
    let counts = truth.borrow_mut().pass();
    let error = rover.turn(counts, TURN).unwrap_err();
    assert_eq!((error, truth.borrow().duties), (HalError::Pin(digital::ErrorKind::Other), [0.0; 2]));
    assert!(error.to_string().starts_with("a pin cannot be used, so the motors are stopped"));
}
