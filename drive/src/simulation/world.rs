//! A robot with two wheels in a home: its wheels slip, its encoders and its camera are noisy, and some actions are interrupted.

use crate::{Drive, DriveError, Grid, Limits, Motion, Pose, Wheels};
use goodbot::capacity::BLOCKS;
use goodbot::home::{Cell, Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, ObjectId};
use heapless::Vec;
use micromath::F32Ext;
use rand_core::Rng;

/// The limits of the simulated robot: a track of 12 cm, 30 cm per second.
pub const LIMITS: Limits = Limits { track: 0.12, speed: 0.3, turn: 3.0, acceleration: 1.0, slowest: 0.3, silence: 0.5, patience: 8.0 };
/// Seconds of one turn of the control loop.
const TURN: f32 = 0.01;
/// The radius of the robot, which is round.
const RADIUS: f32 = 0.09;
/// The distance between the centres of the robot and of a block that it pushes.
const CONTACT: f32 = 0.25;

/// One action in this many is interrupted.
const HELD_UP: u32 = 10;

/// A home and the robot in it: the true state, and the state by the robot's sensors.
#[derive(Debug)]
pub struct World {
    grid: Grid,
    drive: Drive,
    agent: ObjectId,
    truth: Pose,
    believed: Pose,
    cell: Cell,
    /// Each block, its true place, and its sensed cell.
    blocks: Vec<(ObjectId, (f32, f32), Cell), BLOCKS>,
    /// Turns of the control loop in which the robot touched a wall.
    pub walls_hit: u32,
}

/// A random number from -1 to 1, most often near 0.
fn noise<R: Rng>(random: &mut R) -> f32 {
    let uniform = |random: &mut R| random.next_u32() as f32 / u32::MAX as f32;
    (uniform(random) + uniform(random) + uniform(random)) / 1.5 - 1.0
}

impl World {
    /// A world in this state.
    ///
    /// # Errors
    /// None: its cell size and limits are valid.
    pub fn new(home: &Home<impl HomeMemory>, state: &HomeState) -> Result<Self, DriveError> {
        let grid = Grid::new(0.3, 0.1)?;
        let cell = home.agent_cell(state);
        let truth = grid.centre(cell);
        let block = |&block: &ObjectId| {
            let cell = home.block_cell(state, block)?;
            let middle = grid.centre(cell);
            Some((block, (middle.x, middle.y), cell))
        };
        Ok(Self {
            grid,
            drive: Drive::new(LIMITS)?,
            agent: home.agent(),
            truth,
            believed: truth,
            cell,
            blocks: home.blocks().iter().filter_map(block).take(BLOCKS).collect(),
            walls_hit: 0,
        })
    }

    /// Carries out an action, as far as the world permits. `certainty` is from 0 to 1.
    ///
    /// # Errors
    /// [`DriveError::NoNeighbour`] if the action leads to no neighbour cell.
    pub fn act<R: Rng>(&mut self, home: &Home<impl HomeMemory>, action: Action, certainty: f32, random: &mut R) -> Result<(), DriveError> {
        self.drive.go(self.cell, action, certainty)?;
        // A person is in the way, so the robot gives up; its next action begins with a return to the centre of its cell.
        let held_up = random.next_u32().is_multiple_of(HELD_UP);
        for turn in 0.. {
            self.drive.heard();
            let step = self.drive.step(&self.grid, self.believed, TURN);
            match step.motion {
                Motion::Arrived | Motion::Stuck | Motion::Resting if step.wheels == Wheels::default() => break,
                _ => {}
            }
            if held_up && turn == 100 {
                self.drive.halt();
            }
            let slip = |random: &mut R| 1.0 + 0.1 * noise(random);
            let (left, right) = (step.wheels.left * TURN, step.wheels.right * TURN);
            self.truth = self.truth.rolled(left * slip(random), right * slip(random), LIMITS.track);
            self.push();
            let encoder = |rolled: f32, random: &mut R| rolled * (1.0 + 0.02 * noise(random));
            let (left, right) = (encoder(left, random), encoder(right, random));
            self.believed = self.believed.rolled(left, right, LIMITS.track);
            if turn % 10 == 0 {
                let Pose { x, y, heading } = self.truth;
                let seen = Pose { x: x + 0.01 * noise(random), y: y + 0.01 * noise(random), heading: heading + 0.05 * noise(random) };
                self.believed = self.believed.corrected(seen, 0.3);
            }
            self.cell = self.grid.cell(self.believed, self.cell);
            self.walls_hit = self.walls_hit.saturating_add(u32::from(self.touches_a_wall(home)));
        }
        Ok(())
    }

    /// Pushes a block that the robot runs into.
    fn push(&mut self) {
        for (_, (x, y), _) in &mut self.blocks {
            let (away_x, away_y) = (*x - self.truth.x, *y - self.truth.y);
            let (ahead_x, ahead_y) = (F32Ext::cos(self.truth.heading), F32Ext::sin(self.truth.heading));
            let (ahead, aside) = (away_x * ahead_x + away_y * ahead_y, away_y * ahead_x - away_x * ahead_y);
            if ahead > 0.0 && ahead < CONTACT && F32Ext::abs(aside) < CONTACT / 2.0 {
                // Along the axis that the robot faces.
                if F32Ext::abs(ahead_x) > F32Ext::abs(ahead_y) {
                    *x = self.truth.x + CONTACT * F32Ext::signum(ahead_x)
                } else {
                    *y = self.truth.y + CONTACT * F32Ext::signum(ahead_y)
                }
            }
        }
    }

    fn touches_a_wall(&self, home: &Home<impl HomeMemory>) -> bool {
        let size = self.grid.size();
        let here = Cell::new(F32Ext::round(self.truth.x / size) as i32, F32Ext::round(self.truth.y / size) as i32);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| Cell::new(here.x.saturating_add(x), here.y.saturating_add(y))));
        let is_wall = |cell: &Cell| home.places().iter().all(|place| place.cell() != *cell);
        // Compares squares of distances, to avoid the root.
        let beyond = |at: f32, wall: i32| (F32Ext::abs(at - wall as f32 * size) - size / 2.0).max(0.0);
        let squared = |wall: Cell| {
            beyond(self.truth.x, wall.x) * beyond(self.truth.x, wall.x) + beyond(self.truth.y, wall.y) * beyond(self.truth.y, wall.y)
        };
        around.filter(is_wall).any(|wall| squared(wall) < RADIUS * RADIUS)
    }

    /// The cells of the robot and the blocks, by its sensors.
    pub fn sensed(&mut self, home: &Home<impl HomeMemory>, before: &HomeState) -> HomeState {
        let mut things: Vec<(ObjectId, Cell), { BLOCKS + 1 }> = Vec::new();
        // There are no more than pieces, so they fit.
        let _ = things.push((self.agent, self.cell));
        for (block, (x, y), cell) in &mut self.blocks {
            *cell = self.grid.cell(Pose { x: *x, y: *y, heading: 0.0 }, *cell);
            let _ = things.push((*block, *cell));
        }
        home.placed(before, &things).unwrap_or_else(|| {
            // A block pushed half way is still in the robot's own cell: then the robot counts as one cell further back.
            self.cell = home.agent_cell(before);
            *before
        })
    }
}
