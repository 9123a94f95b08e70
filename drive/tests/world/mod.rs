//! A robot with two wheels in a home: its wheels slip, its encoders and its camera are noisy, and now and then something holds it up.

use goodbot::home::{Cell, Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, ObjectId};
use goodbot_drive::{Drive, Grid, Limits, Motion, Pose};
use rand_core::Rng;
use rand_pcg::Pcg32;

const LIMITS: Limits = Limits { track: 0.12, speed: 0.3, turn: 3.0, acceleration: 1.0, slowest: 0.3, silence: 0.5, patience: 8.0 };
/// Seconds of one turn of the control loop.
const TURN: f32 = 0.01;
/// The robot is round.
const RADIUS: f32 = 0.09;
/// How far the middle of a block is from the robot's while it is pushed.
const CONTACT: f32 = 0.25;

pub struct World {
    grid: Grid,
    drive: Drive,
    free: Vec<Cell>,
    agent: ObjectId,
    truth: Pose,
    believed: Pose,
    cell: Cell,
    /// Each block, where it is, and the cell it is taken to be in.
    blocks: Vec<(ObjectId, (f32, f32), Cell)>,
    pub walls_hit: u32,
}

/// From -1 to 1, most often near 0.
fn noise(random: &mut Pcg32) -> f32 {
    let uniform = |random: &mut Pcg32| random.next_u32() as f32 / u32::MAX as f32;
    (uniform(random) + uniform(random) + uniform(random)) / 1.5 - 1.0
}

impl World {
    pub fn new(home: &Home<impl HomeMemory>, state: &HomeState) -> Self {
        let grid = Grid::new(0.3, 0.1).unwrap();
        let cell = home.agent_cell(state);
        let truth = grid.centre(cell);
        let block = |&block: &ObjectId| {
            let cell = home.block_cell(state, block).unwrap();
            let middle = grid.centre(cell);
            (block, (middle.x, middle.y), cell)
        };
        Self {
            grid,
            drive: Drive::new(LIMITS).unwrap(),
            free: home.places().iter().map(|place| place.cell()).collect(),
            agent: home.agent(),
            truth,
            believed: truth,
            cell,
            blocks: home.blocks().iter().map(block).collect(),
            walls_hit: 0,
        }
    }

    /// Carries an action out, or as much of it as the world lets the robot.
    pub fn act(&mut self, action: Action, certainty: f32, random: &mut Pcg32) {
        self.drive.go(self.cell, action, certainty).unwrap();
        // One action in ten is held up: somebody stands in the way, the robot gives up, and goes back to the middle of its cell.
        let held_up = random.next_u32().is_multiple_of(10);
        for turn in 0.. {
            self.drive.heard();
            let step = self.drive.step(&self.grid, self.believed, TURN);
            match step.motion {
                Motion::Arrived | Motion::Stuck | Motion::Resting if step.wheels == goodbot_drive::Wheels::default() => break,
                _ => {}
            }
            if held_up && turn == 100 {
                self.drive.halt();
            }
            let slip = |random: &mut Pcg32| 1.0 + 0.1 * noise(random);
            let (left, right) = (step.wheels.left * TURN, step.wheels.right * TURN);
            self.truth = self.truth.rolled(left * slip(random), right * slip(random), LIMITS.track);
            self.push();
            let encoder = |rolled: f32, random: &mut Pcg32| rolled * (1.0 + 0.02 * noise(random));
            let (left, right) = (encoder(left, random), encoder(right, random));
            self.believed = self.believed.rolled(left, right, LIMITS.track);
            if turn % 10 == 0 {
                let Pose { x, y, heading } = self.truth;
                let seen = Pose { x: x + 0.01 * noise(random), y: y + 0.01 * noise(random), heading: heading + 0.05 * noise(random) };
                self.believed = self.believed.corrected(seen, 0.3);
            }
            self.cell = self.grid.cell(self.believed, self.cell);
            self.walls_hit += u32::from(self.touches_a_wall());
        }
    }

    /// A block that the robot runs into is pushed ahead of it.
    fn push(&mut self) {
        for (_, (x, y), _) in &mut self.blocks {
            let (away_x, away_y) = (*x - self.truth.x, *y - self.truth.y);
            let (ahead_x, ahead_y) = (self.truth.heading.cos(), self.truth.heading.sin());
            let (ahead, aside) = (away_x * ahead_x + away_y * ahead_y, away_y * ahead_x - away_x * ahead_y);
            if ahead > 0.0 && ahead < CONTACT && aside.abs() < CONTACT / 2.0 {
                // Along the one of the axes that the robot faces.
                if ahead_x.abs() > ahead_y.abs() {
                    *x = self.truth.x + CONTACT * ahead_x.signum()
                } else {
                    *y = self.truth.y + CONTACT * ahead_y.signum()
                }
            }
        }
    }

    fn touches_a_wall(&self) -> bool {
        let size = self.grid.size();
        let here = Cell::new((self.truth.x / size).round() as i32, (self.truth.y / size).round() as i32);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| Cell::new(here.x + x, here.y + y)));
        around.filter(|cell| !self.free.contains(cell)).any(|wall| {
            let beyond = |at: f32, wall: i32| ((at - wall as f32 * size).abs() - size / 2.0).max(0.0);
            beyond(self.truth.x, wall.x).hypot(beyond(self.truth.y, wall.y)) < RADIUS
        })
    }

    /// Where the robot and the blocks are, as its sensors tell.
    pub fn sensed(&mut self, home: &Home<impl HomeMemory>, before: &HomeState) -> HomeState {
        let mut things = vec![(self.agent, self.cell)];
        for (block, (x, y), cell) in &mut self.blocks {
            *cell = self.grid.cell(Pose { x: *x, y: *y, heading: 0.0 }, *cell);
            things.push((*block, *cell));
        }
        home.placed(before, &things).unwrap_or_else(|| {
            // A block that was pushed half way is on the robot's own cell: the robot counts as still behind it.
            self.cell = home.agent_cell(before);
            *before
        })
    }
}
