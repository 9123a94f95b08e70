//! The homes in which plans are measured, with their tasks.

use goodbot::Capacities;
use goodbot::home::{Home, HomeState, Moves, SCHEMA};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::Domain;
use goodbot::planning::Plan;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, random_home};
use goodbot_tests::sweep::Sweep;
use rand_pcg::Pcg32;

/// Room for four million states, stored one by one.
pub const LARGE: Capacities = Capacities { states: 1 << 22, hashed_states: 1 << 20, ..Capacities::STANDARD };

/// The name of a home with this many rooms and blocks.
pub fn named(rooms: i32, blocks: i32) -> String {
    format!("{rooms} rooms, {blocks} block{}", if blocks == 1 { "" } else { "s" })
}

/// The size of a home with this many rooms, three cells wide and high, and this many blocks.
pub const fn size(rooms: i32, blocks: i32) -> Size {
    let columns = if rooms > 3 { rooms / 2 } else { rooms };
    Size { columns, rows: rooms / columns, side: 3, blocks }
}

/// A home with its tasks and a planner for them.
#[derive(Debug)]
pub struct Scene {
    /// The home.
    pub home: Home<HomeHeap>,
    /// The first state.
    pub start: HomeState,
    /// The lifted tasks.
    pub lifted: Vec<LiftedTask>,
    /// The tasks.
    pub tasks: Vec<GroundedTask>,
    /// The planner.
    pub planner: OwnPlanner,
}

/// The choice of a scene's tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tasks {
    /// All tasks of the paper's two kinds.
    Paper,
    /// This many tasks of the paper's kinds and of agent and block together, evenly spaced among the first 64; if more are asked for, the
    /// first ones.
    Count(usize),
}

impl Scene {
    /// Of twelve scenes, the one with the most expansions from its start; the first one if exact plans are out of reach.
    pub fn roomy(size: Size, tasks: Tasks) -> Self {
        let expansions = |seed: u64| {
            let mut scene = Self::seeded(seed, size, tasks);
            if scene.home.state_count() > LARGE.states as u64 {
                return 0;
            }
            scene.plan().expansions()
        };
        Self::seeded((0..12).max_by_key(|&seed| (expansions(seed), 12 - seed)).unwrap_or(0), size, tasks)
    }

    /// The scene of a seed.
    pub fn seeded(seed: u64, size: Size, tasks: Tasks) -> Self {
        let (home, start) = random_home(&mut Pcg32::new(seed, 3), size, Moves::Push, HomeHeap::new(&LARGE));
        let mut texts = vec!["agentInRoom(?a, ?r)", "blockInRoom(?o, ?r)"];
        if tasks != Tasks::Paper {
            texts.push("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)");
        }
        let lifted: Vec<LiftedTask> = texts.iter().map(|text| LiftedTask::parse(text, &SCHEMA).expect("a lifted task")).collect();
        let mut all = [GroundedTask::UNUSED; TaskSet::MOST];
        let mut grounded = Vec::new();
        // Grounding fails as a whole if the tasks are too many, so each kind is grounded alone.
        for (kind, lifted) in lifted.iter().enumerate() {
            let count = ground(&home, std::slice::from_ref(lifted), &start, &mut all).unwrap_or(TaskSet::MOST);
            grounded.extend(all.iter().take(count).map(|task| GroundedTask { lifted: kind as u8, ..*task }));
        }
        if let Tasks::Count(count) = tasks {
            grounded.truncate(count.max(64));
            grounded = grounded.iter().step_by((grounded.len() / count).max(1)).take(count).copied().collect();
        }
        let planner = OwnPlanner::new(&LARGE, &home, &lifted, &grounded);
        Self { home, start, lifted, tasks: grounded, planner }
    }

    /// The first scene of a size in the command line's memory: distances in homes that do not fit are bounded.
    pub fn bounded(size: Size) -> Self {
        let mut scene = Self::seeded(1, size, Tasks::Paper);
        scene.planner = OwnPlanner::new(&Capacities::STANDARD, &scene.home, &scene.lifted, &scene.tasks);
        scene
    }

    /// Ten of its tasks, evenly spaced.
    pub fn ten(&self) -> TaskSet {
        (0..self.tasks.len()).step_by((self.tasks.len() / 10).max(1)).take(10).collect()
    }

    /// Plans for all tasks from the start, of which these are likely.
    pub fn plan_expecting(&mut self, likely: TaskSet) -> Plan<'_> {
        self.planner.plan_expecting(&self.home, &self.start, likely)
    }

    /// Plans for all tasks from the start.
    pub fn plan(&mut self) -> Plan<'_> {
        let all = self.planner.all();
        self.planner.plan_for(&self.home, &self.start, all, u32::MAX)
    }

    /// Sweeps the whole state space.
    pub fn sweep(&self) -> Sweep {
        Sweep::new(&self.home, &self.start, &self.lifted, &self.tasks)
    }
}
